#include "engine/methods/pso/occupied_bits.hpp"

namespace landfall::internal {

OccupiedBits occupied_bits(const GridMap& grid) {
  constexpr int word_bits = 32;
  OccupiedBits bits{.width_cells = grid.width_cells + 2 * OccupiedBits::border,
                    .height_cells = grid.height_cells + 2 * OccupiedBits::border};
  bits.row_words = (bits.width_cells + word_bits - 1) / word_bits;
  bits.words.assign(static_cast<std::size_t>(bits.row_words) * static_cast<std::size_t>(bits.height_cells),
                    0);
  std::size_t i = 0;
  for (int row = OccupiedBits::border; row < bits.height_cells - OccupiedBits::border; ++row)
    for (int col = OccupiedBits::border; col < bits.width_cells - OccupiedBits::border; ++col)
      if (grid.cells[i++] == Occupancy::occupied)
        bits.words[static_cast<std::size_t>(row) * static_cast<std::size_t>(bits.row_words) +
                   static_cast<std::size_t>(col / word_bits)] |= std::uint32_t{1} << (col % word_bits);
  return bits;
}

}  // namespace landfall::internal
