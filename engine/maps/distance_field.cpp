#include "engine/maps/distance_field.hpp"

#include <algorithm>
#include <cmath>

#include "engine/base/parallel.hpp"
#include "kernels/distance.hpp"

namespace landfall::internal {
namespace {

constexpr int columns_per_task = 512;
constexpr int rows_per_task = 32;

std::vector<std::uint16_t> column_distances(const std::vector<std::uint8_t>& marked, int width, int height,
                                            int cap) {
  std::vector<std::uint16_t> distance(marked.size());
  const auto tasks = static_cast<std::size_t>((width + columns_per_task - 1) / columns_per_task);
  parallel_for(tasks, 0, [&](std::size_t task) {
    const int first = static_cast<int>(task) * columns_per_task;
    kernels::column_distances(marked.data(), width, height, cap, first,
                              std::min(width, first + columns_per_task), distance.data());
  });
  return distance;
}

template <class Row>
void for_rows(int height, const Row& row_task) {
  const auto tasks = static_cast<std::size_t>((height + rows_per_task - 1) / rows_per_task);
  parallel_for(tasks, 0, [&](std::size_t task) {
    const int first = static_cast<int>(task) * rows_per_task;
    row_task(first, std::min(height, first + rows_per_task));
  });
}

// Field values by squared distance, up to the first 0.
std::vector<std::uint8_t> values_by_squared_distance(double resolution_m, double sigma_m) {
  std::vector<std::uint8_t> values;
  for (int squared = 0;; ++squared) {
    const double d_m2 = squared * resolution_m * resolution_m;
    values.push_back(
        static_cast<std::uint8_t>(std::lround(255.0 * std::exp(-d_m2 / (2.0 * sigma_m * sigma_m)))));
    if (values.back() == 0) return values;
  }
}

}  // namespace

std::vector<std::int32_t> squared_distances(const std::vector<std::uint8_t>& marked, int width, int height) {
  const int cap = height + 1;
  const std::vector<std::uint16_t> columns = column_distances(marked, width, height, cap);
  std::vector<std::int32_t> squared(marked.size());
  for_rows(height, [&](int first, int last) {
    std::vector<std::int32_t> scratch(2 * (static_cast<std::size_t>(width) + 1));
    for (int row = first; row < last; ++row) {
      const std::size_t at = static_cast<std::size_t>(row) * static_cast<std::size_t>(width);
      kernels::exact_row(columns.data() + at, width, cap, scratch.data(), squared.data() + at);
    }
  });
  return squared;
}

std::vector<std::uint8_t> likelihood_field(const GridMap& map, double sigma_m, std::uint8_t unknown_value) {
  std::vector<std::uint8_t> marked(map.cells.size());
  std::transform(map.cells.begin(), map.cells.end(), marked.begin(), [](Occupancy cell) {
    return cell == Occupancy::occupied ? std::uint8_t{1} : std::uint8_t{0};
  });
  const std::vector<std::uint8_t> values = values_by_squared_distance(map.resolution_m, sigma_m);
  const auto last = static_cast<std::int32_t>(values.size() - 1);
  const int radius = static_cast<int>(std::floor(std::sqrt(static_cast<double>(last))));
  constexpr int widest_window = 48;  // beyond it the exact transform costs less than the windowed one
  const bool windowed = radius <= widest_window;
  const int cap = windowed ? radius + 1 : map.height_cells + 1;
  const std::vector<std::uint16_t> columns = column_distances(marked, map.width_cells, map.height_cells, cap);
  std::vector<std::uint8_t> field = std::move(marked);
  const auto width = static_cast<std::size_t>(map.width_cells);
  for_rows(map.height_cells, [&](int first, int end) {
    std::vector<std::int32_t> squared(width);
    std::vector<std::int32_t> scratch(2 * (width + 1));
    for (int row = first; row < end; ++row) {
      const std::size_t at = static_cast<std::size_t>(row) * width;
      if (windowed) {
        kernels::clamped_row(columns.data() + at, map.width_cells, radius, squared.data());
      } else {
        kernels::exact_row(columns.data() + at, map.width_cells, cap, scratch.data(), squared.data());
      }
      for (std::size_t c = 0; c < width; ++c)
        field[at + c] = values[static_cast<std::size_t>(std::min(squared[c], last))];
      for (std::size_t c = 0; unknown_value > 0 && c < width; ++c)
        if (map.cells[at + c] == Occupancy::unknown) field[at + c] = std::max(field[at + c], unknown_value);
    }
  });
  return field;
}

}  // namespace landfall::internal
