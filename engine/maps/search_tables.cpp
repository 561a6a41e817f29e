#include "engine/maps/search_tables.hpp"

#include <algorithm>
#include <array>

#include "engine/base/parallel.hpp"
#include "kernels/window_max.hpp"

namespace landfall::internal {
namespace {

using kernels::block_cells;

std::uint8_t to_level(std::uint8_t value) {
  return static_cast<std::uint8_t>((value * kernels::bound_levels + 254) / 255);
}

std::vector<std::uint8_t> reduce(std::span<const std::uint8_t> in, int cols, int rows, int factor,
                                 int out_cols, int out_rows) {
  std::vector<std::uint8_t> out(static_cast<std::size_t>(out_cols) * static_cast<std::size_t>(out_rows));
  const auto width = static_cast<std::size_t>(cols);
  parallel_for(static_cast<std::size_t>(out_rows), 0, [&](std::size_t r) {
    const std::size_t first = r * static_cast<std::size_t>(factor);
    const std::size_t last =
        std::min(first + static_cast<std::size_t>(factor), static_cast<std::size_t>(rows));
    std::vector<std::uint8_t> tallest(in.begin() + static_cast<std::ptrdiff_t>(first * width),
                                      in.begin() + static_cast<std::ptrdiff_t>((first + 1) * width));
    for (std::size_t row = first + 1; row < last; ++row)
      kernels::maximum(tallest.data(), in.data() + row * width, width, tallest.data());
    kernels::reduce_max(tallest.data(), width, static_cast<std::size_t>(factor),
                        out.data() + r * static_cast<std::size_t>(out_cols));
  });
  return out;
}

// One element of `padded` in eight is of one phase, and so on; both begin block_cells before the map.
void scatter_by_phase(std::span<const std::uint8_t> padded, std::size_t padded_row,
                      const kernels::WindowMaxima& maxima, std::vector<std::uint8_t>& level) {
  using kernels::WindowMaxima;
  const int row = static_cast<int>(padded_row) - block_cells + WindowMaxima::pad_rows;
  for (int phase_col = 0; phase_col < block_cells; ++phase_col) {
    const std::int32_t first = maxima.index(WindowMaxima::pad_cols - block_cells + phase_col, row);
    std::uint8_t* out = level.data() + first;
    for (std::size_t col = static_cast<std::size_t>(phase_col); col < padded.size(); col += block_cells)
      *out++ = padded[col];
  }
}

int divide_up(int a, int b) {
  return (a + b - 1) / b;
}

}  // namespace

BoundTable::BoundTable(const std::vector<std::uint8_t>& halves, int half_cols, int half_rows, int block_cells)
    : block_cells_(block_cells),
      cols_(divide_up(half_cols, phases) + pad_cols + kernels::run_cols),
      rows_(divide_up(half_rows, phases) + pad_rows + kernels::tile_rows),
      plane_size_(cols_ * rows_) {
  column_of_4_.resize(static_cast<std::size_t>(plane_size_) * window_sizes * phases * phases);
  for (int index = 0; index < window_sizes; ++index) fill_planes(index, halves, half_cols, half_rows);
  static_assert(sizes.back() < kernels::WindowShelf::sizes - 1);
  for (int size = 0; size < kernels::WindowShelf::sizes; ++size) {
    const int index = window_index(size);
    shelf_.plane_of_size[size] = index < 0 ? -1 : plane(index, 0, 0);
  }
  shelf_.plane_size = plane_size_;
  shelf_.stride = cols_;
  shelf_.pad_cols = pad_cols;
  shelf_.pad_rows = pad_rows;
}

// Windows of h halves that begin at half p - margin, p in [0, padded): enough to reach off the map.
void BoundTable::fill_planes(int index, const std::vector<std::uint8_t>& halves, int half_cols,
                             int half_rows) {
  const int margin = sizes.back();
  const int padded_cols = half_cols + margin;
  const int padded_rows = half_rows + margin;
  const auto width = static_cast<std::size_t>(padded_cols);
  const int size = window_halves(index);
  std::vector<std::uint8_t> across(width * static_cast<std::size_t>(half_rows));
  parallel_for(static_cast<std::size_t>(half_rows), 0, [&](std::size_t r) {
    const std::uint8_t* in = halves.data() + r * static_cast<std::size_t>(half_cols);
    for (int p = 0; p < padded_cols; ++p) {
      const int first = std::max(0, p - margin);
      const int last = std::min(half_cols, p - margin + size);
      if (first < last)
        across[r * width + static_cast<std::size_t>(p)] = *std::max_element(in + first, in + last);
    }
  });
  const auto plane_cells = static_cast<std::size_t>(plane_size_);
  std::vector<std::uint8_t> levels(plane_cells * phases * phases);  // of this size: [phase row][phase col]
  parallel_for(static_cast<std::size_t>(padded_rows), 0, [&](std::size_t q) {
    const int row_half = static_cast<int>(q) - margin;
    std::vector<std::uint8_t> tallest(width);
    for (int r = std::max(0, row_half); r < std::min(half_rows, row_half + size); ++r)
      kernels::maximum(tallest.data(), across.data() + static_cast<std::size_t>(r) * width, width,
                       tallest.data());
    const int phase_row = row_half & 1;
    const int row = (row_half - phase_row) / phases + pad_rows;
    for (int p = 0; p < padded_cols; ++p) {
      const int col_half = p - margin;
      const int phase_col = col_half & 1;
      const int col = (col_half - phase_col) / phases + pad_cols;
      const std::int64_t at = plane(0, phase_row, phase_col) + std::int64_t{row} * cols_ + col;
      levels[static_cast<std::size_t>(at)] = to_level(tallest[static_cast<std::size_t>(p)]);
    }
  });
  const auto cols = static_cast<std::size_t>(cols_);
  const auto rows = static_cast<std::size_t>(rows_);
  const std::vector<std::uint8_t> nothing(cols);
  parallel_for(rows * phases * phases, 0, [&](std::size_t i) {
    const std::size_t row = i % rows;
    const std::uint8_t* plane_levels = levels.data() + i / rows * plane_cells;
    const auto level_row = [&](std::size_t r) { return r < rows ? plane_levels + r * cols : nothing.data(); };
    kernels::interleave_4(level_row(row), level_row(row + 1), level_row(row + 2), level_row(row + 3), cols,
                          column_of_4_.data() + static_cast<std::size_t>(plane(index, 0, 0)) + i * cols);
  });
}

kernels::BoundPlanes BoundTable::planes() const {
  return {.column_of_4 = column_of_4_.data(),
          .stride = cols_,
          .last_col = cols_ - kernels::run_cols,
          .last_row = rows_ - kernels::tile_rows};
}

kernels::WindowMaxima WindowTables::maxima() const {
  using kernels::WindowMaxima;
  const std::int32_t stride = (width_cells + WindowMaxima::pad_cols) / block_cells + kernels::tile_cols;
  const std::int32_t rows = (height_cells + WindowMaxima::pad_rows) / block_cells + kernels::tile_rows;
  return {.level = level.data(),
          .stride = stride,
          .phase_size = rows * stride,
          .width = width_cells,
          .height = height_cells};
}

kernels::WindowPlanes WindowTables::planes() const {
  return {.column_of_2 = column_of_2.data(),
          .stride = width_cells + 2 * block_cells,
          .width = width_cells,
          .height = height_cells};
}

WindowTables make_window_tables(std::span<const std::uint8_t> field, int width_cells, int height_cells) {
  WindowTables tables{
      .width_cells = width_cells, .height_cells = height_cells, .level = {}, .column_of_2 = {}};
  const auto width = static_cast<std::size_t>(width_cells);
  const std::size_t stride = width + 2 * block_cells;
  const std::size_t rows = static_cast<std::size_t>(height_cells) + 2 * block_cells;
  const kernels::WindowMaxima maxima = tables.maxima();
  tables.level.resize(static_cast<std::size_t>(maxima.phase_size) * block_cells * block_cells);
  tables.column_of_2.resize(stride * rows);
  const std::vector<std::uint8_t> nothing(width);
  const auto field_row = [&](std::size_t padded_row) {
    const bool inside =
        padded_row >= block_cells && padded_row < block_cells + static_cast<std::size_t>(height_cells);
    return inside ? field.data() + (padded_row - block_cells) * width : nothing.data();
  };
  parallel_for(rows, 0, [&](std::size_t r) {
    kernels::interleave_2(field_row(r), field_row(r + 1), width,
                          tables.column_of_2.data() + r * stride + block_cells);
    std::vector<std::uint8_t> tallest(stride + block_cells);
    std::vector<std::uint8_t> scratch(stride + block_cells);
    for (std::size_t row = r; row < r + block_cells; ++row)
      kernels::maximum(tallest.data() + block_cells, field_row(row), width, tallest.data() + block_cells);
    std::vector<std::uint8_t> slid(stride + block_cells);
    kernels::sliding_max_8(tallest.data(), stride + block_cells, scratch.data(), slid.data());
    for (std::uint8_t& value : slid) value = kernels::window_level(value);
    scatter_by_phase(std::span(slid).first(stride), r, maxima, tables.level);
  });
  return tables;
}

BoundTable make_bound_table(std::span<const std::uint8_t> field, int width_cells, int height_cells,
                            int cells_a_block) {
  const int half = cells_a_block / BoundTable::phases;
  const int cols = divide_up(width_cells, half);
  const int rows = divide_up(height_cells, half);
  return {reduce(field, width_cells, height_cells, half, cols, rows), cols, rows, cells_a_block};
}

}  // namespace landfall::internal
