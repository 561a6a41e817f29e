#include "engine/mapping/slam/evidence_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace landfall::internal {
namespace {

constexpr int word_bits = 32;
constexpr int cell_stride = 64;
constexpr int word_stride = 2;
// So many scans in a row must see through an obstacle before it is deleted: one may be wrong.
constexpr int scans_to_delete = 3;
// Echoes next to each other lie on one surface where they are so close.
constexpr double link_m = 0.1;
constexpr double link_relative = 0.1;

std::int16_t units(double log_odds) {
  return static_cast<std::int16_t>(std::lround(log_odds * EvidenceGrid::evidence_unit));
}

int floor_div(int a, int b) {
  return a >= 0 ? a / b : -((b - 1 - a) / b);
}

constexpr double infinity = std::numeric_limits<double>::infinity();

// Length along a ray, in units of its direction, from a place within a cell, 0 to 1, to the cell's border;
// never where it runs along it.
double first_crossing(double place, double direction) {
  if (direction == 0.0) return infinity;
  return (direction > 0.0 ? 1.0 - place : place) / std::abs(direction);
}

double distance(const Point2& a, const Point2& b) {
  return std::hypot(a.x_m - b.x_m, a.y_m - b.y_m);
}

void add(CellBox& box, CellIndex cell) {
  box.low = {.col = std::min(box.low.col, cell.col), .row = std::min(box.low.row, cell.row)};
  box.high = {.col = std::max(box.high.col, cell.col), .row = std::max(box.high.row, cell.row)};
}

}  // namespace

EvidenceGrid::EvidenceGrid(const SlamOptions& options)
    : options_(options),
      hit_(units(options.log_odds_hit)),
      miss_(units(options.log_odds_miss)),
      occupied_(units(options.occupied_log_odds)),
      free_(units(options.free_log_odds)),
      most_(units(options.max_log_odds)),
      least_(units(options.min_log_odds)),
      cells_({}, cell_stride),
      bits_(0, word_stride) {}

CellIndex EvidenceGrid::cell_of(const Point2& p_map) const {
  return {.col = static_cast<int>(std::floor(p_map.x_m / options_.resolution_m)),
          .row = static_cast<int>(std::floor(p_map.y_m / options_.resolution_m))};
}

Occupancy EvidenceGrid::at(CellIndex cell) const {
  const Cell& value = cells_.at(cell);
  return is_occupied(value)        ? Occupancy::occupied
         : value.evidence <= free_ ? Occupancy::free
                                   : Occupancy::unknown;
}

kernels::CellBits EvidenceGrid::occupied() const {
  return {.words = bits_.data(),
          .row_words = bits_.width(),
          .width_cells = bits_.width() * word_bits,
          .height_cells = bits_.height()};
}

CellIndex EvidenceGrid::first() const {
  return {.col = bits_.first().col * word_bits, .row = bits_.first().row};
}

std::vector<Point2> EvidenceGrid::add_scan(std::span<const EchoRay> rays, const Spares& spares) {
  if (rays.empty()) return {};
  cover(rays);
  next_scan();
  for (const EchoRay& ray : rays) hit(cell_of(ray.to_map));
  protect(rays);
  for (const EchoRay& ray : rays) miss_along(ray, spares);
  return std::exchange(gone_, {});
}

void EvidenceGrid::next_scan() {
  if (scan_ < std::numeric_limits<std::uint8_t>::max()) {
    ++scan_;
    return;
  }
  cells_.for_each([](Cell& cell) { cell.seen_in = 0; });
  scan_ = 1;
}

// With a border: what lies beyond the bits counts as lying there.
void EvidenceGrid::cover(std::span<const EchoRay> rays) {
  CellBox box{.low = cell_of(rays.front().from_map), .high = cell_of(rays.front().from_map)};
  int border = 1;
  for (const EchoRay& ray : rays) {
    add(box, cell_of(ray.from_map));
    add(box, cell_of(ray.to_map));
    border = std::max(border, 1 + static_cast<int>(std::ceil(ray.noise_m / options_.resolution_m)));
  }
  box.low = {.col = box.low.col - border, .row = box.low.row - border};
  box.high = {.col = box.high.col + border, .row = box.high.row + border};
  cells_.cover(box);
  bits_.cover({.low = {.col = floor_div(box.low.col, word_bits), .row = box.low.row},
               .high = {.col = floor_div(box.high.col, word_bits), .row = box.high.row}});
}

void EvidenceGrid::hit(CellIndex cell) {
  Cell& value = cells_[cell];
  value.through = 0;
  if (value.seen_in == scan_) return;
  value.seen_in = scan_;
  value.evidence = static_cast<std::int16_t>(std::min<int>(most_, value.evidence + hit_));
  if (is_occupied(value)) mark(cell, true);
}

void EvidenceGrid::protect(std::span<const EchoRay> rays) {
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const EchoRay& ray = rays[i];
    const int radius = static_cast<int>(std::ceil(ray.noise_m / options_.resolution_m));
    protect_around(ray.to_map, radius);
    if (i == 0 || !ray.follows) continue;
    const Point2& before = rays[i - 1].to_map;
    const double gap_m = distance(before, ray.to_map);
    if (gap_m > link_m + link_relative * distance(ray.from_map, ray.to_map)) continue;
    const double step_m = options_.resolution_m * std::max(1, radius);
    const int steps = static_cast<int>(gap_m / step_m);
    for (int k = 1; k <= steps; ++k) {
      const double t = static_cast<double>(k) / (steps + 1);
      protect_around({.x_m = before.x_m + t * (ray.to_map.x_m - before.x_m),
                      .y_m = before.y_m + t * (ray.to_map.y_m - before.y_m)},
                     radius);
    }
  }
}

void EvidenceGrid::protect_around(const Point2& p_map, int radius_cells) {
  const CellIndex center = cell_of(p_map);
  for (int row = center.row - radius_cells; row <= center.row + radius_cells; ++row)
    for (int col = center.col - radius_cells; col <= center.col + radius_cells; ++col)
      cells_[{.col = col, .row = row}].seen_in = scan_;
}

// Every cell before the one where the ray ends, as raycast::CellWalk passes them; without its checks, for
// this is most of a scan's time.
void EvidenceGrid::miss_along(const EchoRay& ray, const Spares& spares) {
  const double cell_m = options_.resolution_m;
  const CellIndex start = cell_of(ray.from_map);
  const CellIndex end = cell_of(ray.to_map);
  const double dx = (ray.to_map.x_m - ray.from_map.x_m) / cell_m;
  const double dy = (ray.to_map.y_m - ray.from_map.y_m) / cell_m;
  const double per_col = dx == 0.0 ? infinity : std::abs(1.0 / dx);
  const double per_row = dy == 0.0 ? infinity : std::abs(1.0 / dy);
  double next_col = first_crossing(ray.from_map.x_m / cell_m - start.col, dx);
  double next_row = first_crossing(ray.from_map.y_m / cell_m - start.row, dy);
  const std::ptrdiff_t to_col = dx > 0.0 ? 1 : -1;
  const std::ptrdiff_t to_row = dy > 0.0 ? cells_.width() : -cells_.width();
  Cell* cell = &cells_[start];
  for (int steps = std::abs(end.col - start.col) + std::abs(end.row - start.row); steps > 0; --steps) {
    if (cell->seen_in != scan_) miss(*cell, ray, spares);
    // Both ways at once: which comes next is hard to foresee.
    const bool along_row = next_col < next_row;
    next_col += along_row ? per_col : 0.0;
    next_row += along_row ? 0.0 : per_row;
    cell += along_row ? to_col : to_row;
  }
}

void EvidenceGrid::miss(Cell& value, const EchoRay& ray, const Spares& spares) {
  value.seen_in = scan_;
  const auto missed = static_cast<std::int16_t>(std::max<int>(least_, value.evidence + miss_));
  if (!is_occupied(value)) {
    value.evidence = missed;
    return;
  }
  const CellIndex cell = cells_.cell_at(&value - cells_.data());
  const Point2 p_map{.x_m = (cell.col + 0.5) * options_.resolution_m,
                     .y_m = (cell.row + 0.5) * options_.resolution_m};
  if (spares && spares(p_map, ray)) return;
  value.evidence = missed;
  const bool near = distance(ray.from_map, p_map) <= options_.deletion_range_m;
  if (near && ++value.through >= scans_to_delete) value.evidence = std::min(value.evidence, free_);
  if (is_occupied(value)) return;
  value.through = 0;
  mark(cell, false);
  gone_.push_back(p_map);
}

void EvidenceGrid::mark(CellIndex cell, bool occupied) {
  const int word = floor_div(cell.col, word_bits);
  const std::uint32_t bit = std::uint32_t{1} << (cell.col - word * word_bits);
  std::uint32_t& bits = bits_[{.col = word, .row = cell.row}];
  bits = occupied ? bits | bit : bits & ~bit;
}

CellBox EvidenceGrid::known_box() const {
  const int none = std::numeric_limits<int>::max();
  CellBox box{.low = {.col = none, .row = none}, .high = {.col = -none, .row = -none}};
  for (int row = 0; row < cells_.height(); ++row)
    for (int col = 0; col < cells_.width(); ++col) {
      const CellIndex cell{.col = cells_.first().col + col, .row = cells_.first().row + row};
      if (at(cell) != Occupancy::unknown) add(box, cell);
    }
  return box.low.col == none ? CellBox{} : box;
}

GridMap EvidenceGrid::to_map(const CellBox* box) const {
  const CellBox known = box == nullptr ? known_box() : *box;
  GridMap map{.width_cells = known.high.col - known.low.col + 1,
              .height_cells = known.high.row - known.low.row + 1,
              .resolution_m = options_.resolution_m,
              .T_map_grid = {.x_m = known.low.col * options_.resolution_m,
                             .y_m = known.low.row * options_.resolution_m},
              .cells = {}};
  map.cells.reserve(static_cast<std::size_t>(map.width_cells) * static_cast<std::size_t>(map.height_cells));
  for (int row = known.low.row; row <= known.high.row; ++row)
    for (int col = known.low.col; col <= known.high.col; ++col)
      map.cells.push_back(at({.col = col, .row = row}));
  return map;
}

}  // namespace landfall::internal
