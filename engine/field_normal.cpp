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
[[gnu::always_inline]] inline FieldSample sample(const std::uint8_t* field, int width, int height,
                                                 double x_cells, double y_cells) {
  const double x = x_cells - 0.5;
  const double y = y_cells - 0.5;
  if (!(x >= 0.0 && y >= 0.0 && x < width - 1 && y < height - 1)) return {0.0, 0.0, 0.0};
  const auto col = static_cast<int>(x);
  const auto row = static_cast<int>(y);
  const double fx = x - col;
  const double fy = y - row;
  const std::uint8_t* at = field + static_cast<std::ptrdiff_t>(row) * width + col;
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

namespace {

// Sums that stay in registers.
template <Residual Kind>
FieldNormal linearise_as(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& pose) {
  constexpr double least_lack = 0.02;  // the root is steep at 0
  constexpr bool root = Kind == Residual::root;
  const std::uint8_t* field = map.field().data();
  const int width = map.grid().width_cells;
  const int height = map.grid().height_cells;
  const double c = std::cos(pose[2]);
  const double s = std::sin(pose[2]);
  const double x0 = pose[0];
  const double y0 = pose[1];
  double cost = 0.0, sum = 0.0;
  double h_xx = 0.0, h_xy = 0.0, h_xt = 0.0, h_yy = 0.0, h_yt = 0.0, h_tt = 0.0;
  double g_x = 0.0, g_y = 0.0, g_t = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double x = c * points.x_cells[i] - s * points.y_cells[i];
    const double y = s * points.x_cells[i] + c * points.y_cells[i];
    const FieldSample at = sample(field, width, height, x0 + x, y0 + y);
    const double lack = 1.0 - at.value;
    cost += root ? lack : lack * lack;
    sum += at.value;
    if (at.d_col == 0.0 && at.d_row == 0.0) continue;
    const double turn = at.d_row * x - at.d_col * y;
    const double weight = root ? 0.25 / std::max(least_lack, lack) : 1.0;
    const double w_x = weight * at.d_col;
    const double w_y = weight * at.d_row;
    h_xx += w_x * at.d_col;
    h_xy += w_x * at.d_row;
    h_xt += w_x * turn;
    h_yy += w_y * at.d_row;
    h_yt += w_y * turn;
    h_tt += weight * turn * turn;
    const double pull = root ? 0.5 : lack;
    g_x += pull * at.d_col;
    g_y += pull * at.d_row;
    g_t += pull * turn;
  }
  FieldNormal normal{.cost = cost, .field = sum};
  normal.hessian << h_xx, h_xy, h_xt, h_xy, h_yy, h_yt, h_xt, h_yt, h_tt;
  normal.gradient << g_x, g_y, g_t;
  return normal;
}

}  // namespace

FieldNormal linearise(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& pose,
                      Residual residual) {
  return residual == Residual::root ? linearise_as<Residual::root>(map, points, pose)
                                    : linearise_as<Residual::lack>(map, points, pose);
}

}  // namespace landfall::internal
