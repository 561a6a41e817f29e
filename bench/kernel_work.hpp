// The kernels with inputs as the search gives them.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "bench/office.hpp"
#include "engine/maps/search_tables.hpp"
#include "engine/scans/end_points.hpp"
#include "kernels/bound_tile.hpp"
#include "kernels/end_points.hpp"
#include "kernels/score_block.hpp"
#include "kernels/score_row.hpp"
#include "kernels/window_tile.hpp"
#include "landfall/prepared_map.hpp"
#include "landfall/simulate.hpp"
#include "tests/kernels/random_field.hpp"

namespace landfall::bench {

using Integers = std::vector<std::int32_t>;

// What a kernel answered, all calls of a run one after the other.
struct Answers {
  std::vector<std::uint16_t> sums;
  Integers numbers;
  friend bool operator==(const Answers&, const Answers&) = default;
};

// The same calls each run; by the plain twin where `twin`.
struct Work {
  std::string name;
  std::string unit;  // a rate, such as "poses/s"
  double units_per_run = 0.0;
  std::function<void(bool twin, Answers& answers)> run;
  std::span<const std::uint8_t> table{};  // whose loads limit the kernel; empty: something else does
};

// Planes of window maxima, and points of a heading group on them; some weigh more than 1.
struct Planes {
  static constexpr int heavy_points = 30;
  static constexpr int all_points = 60;

  kernels::BoundPlanes planes;
  std::vector<std::uint32_t> column_of_4;
  Integers plane, col, row, first_byte, list_begin, list_end, tile_col, tile_row;

  Planes(int count, int cols, int rows, int runs)
      : planes{.column_of_4 = nullptr,
               .stride = cols,
               .last_col = cols - kernels::run_cols,
               .last_row = rows - kernels::tile_rows} {
    testing::RandomField random(1);
    const int whole_vectors = (count * cols * rows + 127) / 128 * 128;  // as sum_bytes wants it
    const std::vector<std::uint8_t> levels =
        random.bytes(4 * static_cast<std::size_t>(whole_vectors), kernels::bound_levels);
    column_of_4.resize(static_cast<std::size_t>(whole_vectors));
    std::memcpy(column_of_4.data(), levels.data(), levels.size());
    planes.column_of_4 = column_of_4.data();
    for (const int points : {heavy_points, all_points}) {
      list_begin.push_back(static_cast<std::int32_t>(plane.size()));
      for (int i = 0; i < points; ++i) {
        plane.push_back(random.between(0, count - 1) * cols * rows);
        col.push_back(random.between(0, planes.last_col));
        row.push_back(random.between(0, planes.last_row));
        first_byte.push_back(4 * (plane.back() + row.back() * cols + col.back()));
      }
      list_end.push_back(static_cast<std::int32_t>(plane.size()));
    }
    for (Integers* padded : {&plane, &col, &row, &first_byte})
      padded->resize(padded->size() + kernels::point_padding);
    tile_col = random.integers(static_cast<std::size_t>(runs), -cols / 2, cols / 2);
    tile_row = random.integers(static_cast<std::size_t>(runs), -rows / 2, rows / 2);
  }
  [[nodiscard]] kernels::BoundPoints points() const {
    return {.plane = plane.data(),
            .col = col.data(),
            .row = row.data(),
            .first_byte = first_byte.data(),
            .list_begin = list_begin.data(),
            .list_end = list_end.data(),
            .lists = static_cast<std::int32_t>(list_end.size()),
            .least_col = 0,
            .most_col = planes.last_col,
            .least_row = 0,
            .most_row = planes.last_row};
  }
};

inline Work bound_tile_work(const std::string& cache, int count, int cols, int rows) {
  constexpr std::size_t runs = 64;
  constexpr std::size_t run_blocks = kernels::most_tiles * kernels::tile_blocks;
  const auto data = std::make_shared<const Planes>(count, cols, rows, static_cast<int>(runs));
  return {.name = "bound_tile/" + cache,
          .unit = "bytes/s",
          .units_per_run =
              1.0 * runs * static_cast<double>(data->plane.size() - kernels::point_padding) * run_blocks,
          .run =
              [data, scratch = Integers(data->plane.size()),
               allowed = std::vector<std::uint64_t>(kernels::most_tiles, ~std::uint64_t{0})](
                  bool twin, Answers& answers) mutable {
                answers.sums.resize(runs * (run_blocks + kernels::most_tiles));
                const auto bound = twin ? kernels::scalar::bound_tiles : kernels::bound_tiles;
                std::uint16_t* sums = answers.sums.data();
                for (std::size_t r = 0; r < runs; ++r, sums += run_blocks + kernels::most_tiles)
                  bound(data->planes, data->points(), data->tile_col[r], data->tile_row[r],
                        kernels::most_tiles, 0, allowed.data(), scratch.data(), sums, sums + run_blocks);
              },
          .table = {reinterpret_cast<const std::uint8_t*>(data->column_of_4.data()),
                    data->column_of_4.size() * sizeof(std::uint32_t)}};
}

// A scan of 180 beams over half a turn, on the lattice of the office, seen at headings all around.
struct OfficeScan {
  static constexpr int views = 64;

  PreparedMap map{office()};
  internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, std::numbers::pi / 360.0);
  internal::EndPoints points;
  internal::WindowTables tables =
      internal::make_window_tables(map.field(), lattice.width_cells, lattice.height_cells);
  std::vector<internal::HeadingCells> cells;     // [view]
  std::vector<Integers> windows;                 // [view]
  std::vector<kernels::TilePoints> tile_points;  // [view]: of these
  Integers block_col, block_row;                 // [view]

  OfficeScan() {
    const auto sensor = std::make_shared<const Sensor>(
        make_fan({.beams = 180, .first_rad = -std::numbers::pi / 2.0, .step_rad = std::numbers::pi / 180.0}));
    const std::vector<Pose2> T_map_robot{{.x_m = 14.2, .y_m = 14.2, .theta_rad = 0.3}};
    points = internal::make_end_points(simulate(map, sensor, T_map_robot).front(), lattice.resolution_m);
    testing::RandomField random(3);
    for (int view = 0; view < views; ++view) {
      cells.emplace_back();
      internal::cells_at_heading(points, lattice, view * lattice.headings / views, cells.back());
      windows.emplace_back(points.size());
      tile_points.push_back(kernels::tile_points(tables.maxima(), cells.back().col.data(),
                                                 cells.back().row.data(), points.size(),
                                                 windows.back().data()));
      block_col.push_back(8 * random.between(0, lattice.width_cells / 8 - 1));
      block_row.push_back(8 * random.between(0, lattice.height_cells / 8 - 1));
    }
  }
};
using SharedScan = std::shared_ptr<const OfficeScan>;

// No threshold: every point is looked at.
inline Work bound_windows_work(const SharedScan& scan) {
  return {.name = "bound_windows",
          .unit = "blocks/s",
          .units_per_run = 1.0 * OfficeScan::views * kernels::tile_blocks,
          .run = [scan](bool twin, Answers& answers) {
            answers.numbers.resize(OfficeScan::views * kernels::tile_blocks);
            const auto bound = twin ? kernels::scalar::bound_windows : kernels::bound_windows;
            for (std::size_t v = 0; v < OfficeScan::views; ++v)
              bound(scan->tables.maxima(), scan->block_col[v], scan->block_row[v], scan->tile_points[v], 0,
                    ~std::uint64_t{0}, answers.numbers.data() + v * kernels::tile_blocks);
          }};
}

inline Work score_block_work(const SharedScan& scan) {
  return {.name = "score_block",
          .unit = "poses/s",
          .units_per_run = 1.0 * OfficeScan::views * kernels::block_poses,
          .run = [scan](bool twin, Answers& answers) {
            answers.numbers.resize(OfficeScan::views * kernels::block_poses);
            const auto score = twin ? kernels::scalar::score_block : kernels::score_block;
            for (std::size_t v = 0; v < OfficeScan::views; ++v)
              score(scan->tables.planes(), scan->block_col[v], scan->block_row[v], scan->cells[v].col.data(),
                    scan->cells[v].row.data(), scan->points.size(), 0,
                    answers.numbers.data() + v * kernels::block_poses);
          }};
}

inline Work score_row_work(const SharedScan& scan) {
  const auto width = static_cast<std::size_t>(scan->lattice.width_cells);
  return {
      .name = "score_row",
      .unit = "poses/s",
      .units_per_run = 1.0 * OfficeScan::views * static_cast<double>(width),
      .run = [scan, width, partial = std::vector<std::uint16_t>(width)](bool twin, Answers& answers) mutable {
        answers.numbers.assign(OfficeScan::views * width, 0);
        const auto score = twin ? kernels::scalar::score_row : kernels::score_row;
        for (std::size_t v = 0; v < OfficeScan::views; ++v)
          score(scan->map.field().data(), scan->lattice.width_cells, scan->lattice.height_cells,
                scan->block_row[v], scan->cells[v].col.data(), scan->cells[v].row.data(), scan->points.size(),
                partial.data(), answers.numbers.data() + v * width);
      }};
}

inline Work end_point_cells_work(const SharedScan& scan) {
  const std::size_t points = scan->points.size();
  return {.name = "end_point_cells",
          .unit = "points/s",
          .units_per_run = static_cast<double>(OfficeScan::views * points),
          .run = [scan, points](bool twin, Answers& answers) {
            answers.numbers.resize(2 * OfficeScan::views * points);
            const auto rotate = twin ? kernels::scalar::end_point_cells : kernels::end_point_cells;
            for (std::size_t v = 0; v < OfficeScan::views; ++v) {
              const double heading_rad = 0.1 * static_cast<double>(v);
              std::int32_t* col = answers.numbers.data() + 2 * v * points;
              rotate(scan->points.x_cells.data(), scan->points.y_cells.data(), points, std::cos(heading_rad),
                     std::sin(heading_rad), col, col + points);
            }
          }};
}

// The bound tables of a small room, of 640 x 640 cells, and of 4800 x 4120 cells.
inline std::vector<Work> all_work() {
  const auto scan = std::make_shared<const OfficeScan>();
  std::vector<Work> all;
  all.push_back(bound_tile_work("24KB", 1, 100, 60));
  all.push_back(bound_tile_work("1.6MB", 20, 220, 100));
  all.push_back(bound_tile_work("32MB", 20, 740, 535));
  all.push_back(bound_windows_work(scan));
  all.push_back(score_block_work(scan));
  all.push_back(score_row_work(scan));
  all.push_back(end_point_cells_work(scan));
  return all;
}

}  // namespace landfall::bench
