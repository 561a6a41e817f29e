#include "engine/methods/grid/block_bounds.hpp"

#include <algorithm>
#include <atomic>
#include <memory>

#include "engine/base/parallel.hpp"
#include "engine/methods/grid/weight_runs.hpp"

namespace landfall::internal {
namespace {

using kernels::block_cells;

constexpr int side = 4;  // of a block, in cells
constexpr std::int64_t most_table_cells = std::int64_t{1} << 28;

// Over the window [row, row + side) x [col, col + side) of each cell, the largest and the smallest value of
// the global grid around the map. Windows that are a block apart lie beside each other.
class WindowTable {
 public:
  WindowTable(const std::vector<std::int8_t>& global, const Lattice& lattice, int reach)
      : margin_((reach + 2 * side) / side * side),
        rows_((lattice.height_cells + 2 * margin_) / side + 2),
        cols_((lattice.width_cells + 2 * margin_) / side + 2 + static_cast<int>(kernels::score_columns)),
        cells_(size(rows_, cols_)) {
    fill(global, lattice);
  }

  static std::int64_t table_cells(const Lattice& lattice, int reach) {
    const std::int64_t around = 2 * (std::int64_t{reach} + 4 * side);
    return 2 * (lattice.width_cells + around + 4 * side * static_cast<int>(kernels::score_columns)) *
           (lattice.height_cells + around);
  }

  // From a block's place.
  [[nodiscard]] std::int32_t offset(CellIndex cell, std::int32_t weight) const {
    return static_cast<std::int32_t>(index(cell.row, cell.col, weight));
  }
  [[nodiscard]] const std::int8_t* at(int block_row, int block_col) const {
    return cells_.data() + std::ptrdiff_t{block_row} * cols_ + block_col;
  }

 private:
  // First down the columns, then along the rows; beyond the map all is unknown, 0.
  void fill(const std::vector<std::int8_t>& global, const Lattice& lattice) {
    const int height = lattice.height_cells;
    const int width = lattice.width_cells;
    const std::size_t padded = static_cast<std::size_t>(width) + 2 * (side - 1);
    std::vector<std::int8_t> high(padded);
    std::vector<std::int8_t> low(padded);
    for (int row = 1 - side; row < height; ++row) {
      std::fill(high.begin(), high.end(), row < 0 || row + side > height ? std::int8_t{0} : std::int8_t{-1});
      std::fill(low.begin(), low.end(), row < 0 || row + side > height ? std::int8_t{0} : std::int8_t{1});
      for (int r = std::max(0, row); r < std::min(height, row + side); ++r) {
        const std::int8_t* values = global.data() + std::int64_t{r} * width;
        for (int col = 0; col < width; ++col) {
          const std::size_t at = static_cast<std::size_t>(col) + (side - 1);
          high[at] = std::max(high[at], values[col]);
          low[at] = std::min(low[at], values[col]);
        }
      }
      for (std::size_t beyond = 0; beyond < side - 1; ++beyond)
        high[beyond] = low[beyond] = high[padded - 1 - beyond] = low[padded - 1 - beyond] = 0;
      for (int col = 1 - side; col < width; ++col) {
        const std::ptrdiff_t at = std::ptrdiff_t{col} + (side - 1);
        cells_[index(row, col, 1)] = *std::max_element(high.begin() + at, high.begin() + at + side);
        cells_[index(row, col, -1)] = *std::min_element(low.begin() + at, low.begin() + at + side);
      }
    }
  }
  static std::size_t size(int rows, int cols) {
    return std::size_t{2 * side * side} * static_cast<std::size_t>(rows) * static_cast<std::size_t>(cols) +
           kernels::score_columns;
  }
  [[nodiscard]] std::size_t index(int row, int col, std::int32_t sign) const {
    const int r = row + margin_;
    const int c = col + margin_;
    const int plane = (sign > 0 ? 0 : side * side) + r % side * side + c % side;
    return (static_cast<std::size_t>(plane) * static_cast<std::size_t>(rows_) +
            static_cast<std::size_t>(r / side)) *
               static_cast<std::size_t>(cols_) +
           static_cast<std::size_t>(c / side);
  }

  int margin_;  // of cells around the map, a multiple of side
  int rows_;
  int cols_;
  std::vector<std::int8_t> cells_;
};

// The bits of block (row, col), of side x side cells, in the word of 8 x 8 that holds it.
std::uint64_t bits_of(int row, int col) {
  constexpr int per_word = block_cells / side;
  const std::uint64_t corner = 0x0f0f0f0fU;
  return corner << (row % per_word * side * block_cells + col % per_word * side);
}

// The blocks of one heading after the other. One per thread at a time.
class HeadingBounds {
 public:
  HeadingBounds(const GridLevel& level, const WindowTable& table, std::int32_t lowest)
      : level_(level), table_(table), lowest_(lowest), painter_(level.model) {}

  // Null where no block may score enough.
  SharedMask bound(int heading, std::int64_t& bounds_computed) {
    const BlockMask& poses = *level_.mask_of_heading[static_cast<std::size_t>(heading)];
    painter_.paint(level_.lattice.heading_grid_rad(heading), grid_);
    runs_.lay_out(grid_, [this](CellIndex cell, std::int32_t weight) { return table_.offset(cell, weight); });
    auto kept = std::make_shared<BlockMask>(poses);
    kept->counted = -1;
    constexpr int per_word = block_cells / side;
    bool any = false;
    const std::size_t cols = static_cast<std::size_t>(poses.cols) * per_word;
    bounds_.resize(kernels::whole_columns(cols));
    for (int row = 0; row < poses.rows * per_word; ++row) {
      std::uint64_t* words = kept->words.data() + std::ptrdiff_t{row / per_word} * poses.cols;
      const auto has_poses = [&](int col) { return (words[col / per_word] & bits_of(row, col)) != 0; };
      int first = 0;
      int last = static_cast<int>(cols) - 1;
      while (first <= last && !has_poses(first)) ++first;
      while (first <= last && !has_poses(last)) --last;
      if (first > last) continue;
      const std::size_t count = static_cast<std::size_t>(last - first) + 1;
      kernels::score_cells(table_.at(poses.first_row * per_word + row, poses.first_col * per_word + first),
                           runs_.runs(), count, bounds_.data());
      bounds_computed += static_cast<std::int64_t>(count);
      for (int col = first; col <= last; ++col) {
        if (bounds_[static_cast<std::size_t>(col - first)] < lowest_)
          words[col / per_word] &= ~bits_of(row, col);
        else
          any = any || has_poses(col);
      }
    }
    if (!any) return nullptr;
    kept->remember_count();
    return kept;
  }

 private:
  const GridLevel& level_;
  const WindowTable& table_;
  std::int32_t lowest_;
  LocalGridPainter painter_;
  LocalGrid grid_;
  WeightRuns runs_;
  std::vector<std::int32_t> bounds_;
};

}  // namespace

BoundedPoses poses_within_bounds(const GridLevel& level, std::int32_t lowest) {
  BoundedPoses result{.mask_of_heading = level.mask_of_heading};
  const int reach = level.model.reach_cells();
  if (WindowTable::table_cells(level.lattice, reach) > most_table_cells) return result;
  const WindowTable table(level.global, level.lattice, reach);
  std::atomic<std::int64_t> computed{0};
  std::atomic<bool> cut_short{false};
  const int threads = level.query.threads;
  const std::size_t headings = level.mask_of_heading.size();
  const auto tasks = std::min<std::size_t>(headings, static_cast<std::size_t>(4 * thread_count(threads)));
  parallel_for(tasks, threads, [&](std::size_t task) {
    HeadingBounds bounds(level, table, lowest);
    std::int64_t count = 0;
    for (std::size_t k = task; k < headings; k += tasks) {
      SharedMask& mask = result.mask_of_heading[k];
      if (mask == nullptr) continue;
      if (level.query.out_of_time()) {
        cut_short = true;
        mask = nullptr;
      } else {
        mask = bounds.bound(static_cast<int>(k), count);
      }
    }
    computed += count;
  });
  result.bounds_computed = computed;
  result.cut_short = cut_short;
  return result;
}

}  // namespace landfall::internal
