// FieldSums as they are added up: lane by lane, so that every instruction set rounds alike.
#pragma once

#include <cstddef>

#include "kernels/field_sums.hpp"

namespace landfall::kernels {

// Point i is added in lane i % sum_lanes, and the lanes last of all.
inline constexpr std::size_t sum_lanes = 8;

struct FieldSumLanes {
  using Lanes = double[sum_lanes];

  alignas(64) Lanes cost = {};
  alignas(64) Lanes field = {};
  alignas(64) Lanes h_xx = {};
  alignas(64) Lanes h_xy = {};
  alignas(64) Lanes h_xt = {};
  alignas(64) Lanes h_yy = {};
  alignas(64) Lanes h_yt = {};
  alignas(64) Lanes h_tt = {};
  alignas(64) Lanes g_x = {};
  alignas(64) Lanes g_y = {};
  alignas(64) Lanes g_t = {};

  [[nodiscard]] FieldSums total() const {
    const auto sum = [](const Lanes& lanes) {
      return ((lanes[0] + lanes[1]) + (lanes[2] + lanes[3])) +
             ((lanes[4] + lanes[5]) + (lanes[6] + lanes[7]));
    };
    return {.cost = sum(cost),
            .field = sum(field),
            .h_xx = sum(h_xx),
            .h_xy = sum(h_xy),
            .h_xt = sum(h_xt),
            .h_yy = sum(h_yy),
            .h_yt = sum(h_yt),
            .h_tt = sum(h_tt),
            .g_x = sum(g_x),
            .g_y = sum(g_y),
            .g_t = sum(g_t)};
  }
};

namespace scalar {
// Adds points [first, last).
void add_lack(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
              std::size_t first, std::size_t last, FieldSumLanes& sums);
void add_root(const FieldView& field, const FieldPose& pose, const double* x_cells, const double* y_cells,
              std::size_t first, std::size_t last, FieldSumLanes& sums);
}  // namespace scalar

}  // namespace landfall::kernels
