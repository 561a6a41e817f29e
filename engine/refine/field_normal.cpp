#include "engine/refine/field_normal.hpp"

#include <cmath>

#include "kernels/field_sums.hpp"

namespace landfall::internal {

FieldNormal linearise(const PreparedState& map, const EndPoints& points, const Eigen::Vector3d& pose,
                      Residual residual) {
  const auto sum = residual == Residual::root ? kernels::sum_root : kernels::sum_lack;
  const kernels::FieldSums sums = sum({.values = map.field().data(),
                                       .width_cells = map.grid().width_cells,
                                       .height_cells = map.grid().height_cells},
                                      {.x_cells = pose[0],
                                       .y_cells = pose[1],
                                       .cos_theta = std::cos(pose[2]),
                                       .sin_theta = std::sin(pose[2])},
                                      points.x_cells.data(), points.y_cells.data(), points.size());
  FieldNormal normal{.cost = sums.cost, .field = sums.field};
  normal.hessian << sums.h_xx, sums.h_xy, sums.h_xt, sums.h_xy, sums.h_yy, sums.h_yt, sums.h_xt, sums.h_yt,
      sums.h_tt;
  normal.gradient << sums.g_x, sums.g_y, sums.g_t;
  return normal;
}

}  // namespace landfall::internal
