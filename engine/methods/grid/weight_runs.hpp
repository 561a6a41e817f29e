// A local grid as the kernel takes it: cells in runs of equal weight.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/methods/grid/local_grid.hpp"
#include "kernels/score_cells.hpp"

namespace landfall::internal {

class WeightRuns {
 public:
  // offset(cell, weight): where in the global grid a cell of that weight is looked up, from the robot's.
  template <typename Offset>
  void lay_out(const LocalGrid& grid, const Offset& offset) {
    offsets_.clear();
    ends_.clear();
    weights_.clear();
    for (std::size_t i = 0; i < grid.cells.size(); ++i) {
      if (i == 0 || grid.weights[i] != grid.weights[i - 1]) {
        weights_.push_back(grid.weights[i]);
        ends_.push_back(0);
      }
      offsets_.push_back(offset(grid.cells[i], grid.weights[i]));
      ends_.back() = static_cast<std::int32_t>(offsets_.size());
    }
  }

  [[nodiscard]] kernels::CellRuns runs() const {
    return {.offset = offsets_.data(),
            .run_end = ends_.data(),
            .run_weight = weights_.data(),
            .runs = ends_.size()};
  }

 private:
  std::vector<std::int32_t> offsets_, ends_, weights_;
};

}  // namespace landfall::internal
