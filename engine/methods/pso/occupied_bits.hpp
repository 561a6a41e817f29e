// A map's occupied cells for kernels::count_fits.
#pragma once

#include <cstdint>
#include <vector>

#include "kernels/count_fits.hpp"
#include "landfall/grid_map.hpp"

namespace landfall::internal {

// With a border of one free cell all around: cell (0, 0) of the grid is (1, 1) here.
struct OccupiedBits {
  std::vector<std::uint32_t> words{};
  std::int32_t row_words = 0;
  std::int32_t width_cells = 0;
  std::int32_t height_cells = 0;

  static constexpr int border = 1;
  [[nodiscard]] kernels::CellBits view() const {
    return {words.data(), row_words, width_cells, height_cells};
  }
};

OccupiedBits occupied_bits(const GridMap& grid);

}  // namespace landfall::internal
