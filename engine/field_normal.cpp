#include "engine/field_normal.hpp"

#include <algorithm>
#include <cmath>

namespace landfall::internal {
namespace {

struct FieldSample {
  double value;  // 0..1
  double d_col;  // per cell
  double d_row;
};

// Bilinear between cell centres, 0 outside the map. Position in cells from the grid's corner.
FieldSample sample(const std::uint8_t* field, int width, int height, double x_cells, double y_cells) {
  const double x = x_cells - 0.5;
  const double y = y_cells - 0.5;
  const double col = std::floor(x);
  const double row = std::floor(y);
  if (!(col >= 0.0 && row >= 0.0 && col + 1.0 < width && row + 1.0 < height)) return {0.0, 0.0, 0.0};
  const double fx = x - col;
  const double fy = y - row;
  const std::uint8_t* at =
      field + static_cast<std::ptrdiff_t>(row) * width + static_cast<std::ptrdiff_t>(col);
  constexpr double scale = 1.0 / 255.0;
  const double v00 = at[0] * scale;
  const double v01 = at[1] * scale;
  const double v10 = at[width] * scale;
  const double v11 = at[width + 1] * scale;
  const double low = v00 + fx * (v01 - v00);
  const double high = v10 + fx * (v11 - v10);
  return {low + fy * (high - low), (1.0 - fy) * (v01 - v00) + fy * (v11 - v10), high - low};
}

}  // namespace

FieldNormal linearise(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& pose,
                      Residual residual) {
  constexpr double least_lack = 0.02;  // the root is steep at 0
  const std::uint8_t* field = map.field().data();
  const int width = map.grid().width_cells;
  const int height = map.grid().height_cells;
  const double c = std::cos(pose[2]);
  const double s = std::sin(pose[2]);
  FieldNormal normal;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = c * points.x_cells[i] - s * points.y_cells[i];
    const double y = s * points.x_cells[i] + c * points.y_cells[i];
    const FieldSample at = sample(field, width, height, pose[0] + x, pose[1] + y);
    const double lack = 1.0 - at.value;
    const bool root = residual == Residual::root;
    normal.cost += root ? lack : lack * lack;
    normal.field += at.value;
    const Eigen::Vector3d slope(at.d_col, at.d_row, at.d_row * x - at.d_col * y);
    const double weight = root ? 0.25 / std::max(least_lack, lack) : 1.0;
    normal.hessian.noalias() += weight * slope * slope.transpose();
    normal.gradient += (root ? 0.5 : lack) * slope;
  }
  return normal;
}

}  // namespace landfall::internal
