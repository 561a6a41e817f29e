#include "arrays.hpp"

#include "landfall/error.hpp"

namespace landfall::python {

std::string shape_text(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (std::size_t i = 0; i < shape.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
  return text + ")";
}

std::span<const double> rows_of(const ArrayLike<double>& values, std::size_t cols, const char* what) {
  const std::vector<std::size_t> shape = shape_of(values);
  if (shape.size() == 2 && shape[1] == cols) return {values.array.data(), values.array.size()};
  if (values.array.size() == 0) return {};
  throw Error(ErrorCode::invalid_argument, std::string(what) + ": an array of shape " + shape_text(shape) +
                                               ", expected (n, " + std::to_string(cols) + ")");
}

std::vector<Pose2> poses_from(const ArrayLike<double>& rows, const char* what) {
  const std::span<const double> values = rows_of(rows, 3, what);
  std::vector<Pose2> poses(values.size() / 3);
  for (std::size_t i = 0; i < poses.size(); ++i) {
    poses[i] = {values[3 * i], values[3 * i + 1], values[3 * i + 2]};
  }
  return poses;
}

std::vector<Point2> points_from(const ArrayLike<double>& rows, const char* what) {
  const std::span<const double> values = rows_of(rows, 2, what);
  std::vector<Point2> points(values.size() / 2);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = {values[2 * i], values[2 * i + 1]};
  return points;
}

}  // namespace landfall::python
