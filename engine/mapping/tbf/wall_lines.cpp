#include "engine/mapping/tbf/wall_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace landfall::internal {
namespace {

constexpr int headings = 180;
constexpr double half_width_cells = 1.0;  // of a wall as it is drawn, about its line
constexpr double neighbours_cells = 1.5;  // no gap between these
// Beside a segment of full length, shorter ones on its line are wall too, down to this share of it.
constexpr double share_lined_up = 0.4;

// Centres of occupied cells, in cells.
struct Points {
  std::vector<double> x{};
  std::vector<double> y{};
  std::vector<std::size_t> index{};
  std::vector<std::uint8_t> taken{};  // by a line before
  std::vector<std::uint8_t> votes{};  // whether its votes still count
};

// All points with x cos + y sin = offset; along it, -x sin + y cos grows.
struct Line {
  double cos = 1.0;
  double sin = 0.0;
  double offset = 0.0;

  [[nodiscard]] double across(double x, double y) const { return x * cos + y * sin - offset; }
  [[nodiscard]] double along(double x, double y) const { return y * cos - x * sin; }
};

Points occupied_points(const GridMap& map) {
  Points points;
  for (int row = 0; row < map.height_cells; ++row)
    for (int col = 0; col < map.width_cells; ++col) {
      const std::size_t index = map.index({.col = col, .row = row});
      if (map.cells[index] != Occupancy::occupied) continue;
      points.x.push_back(col + 0.5);
      points.y.push_back(row + 0.5);
      points.index.push_back(index);
    }
  points.taken.assign(points.x.size(), 0);
  points.votes.assign(points.x.size(), 1);
  return points;
}

// Counts of points per heading and offset, one cell wide.
class Votes {
 public:
  explicit Votes(const GridMap& map)
      : middle_bin_(static_cast<std::size_t>(std::hypot(map.width_cells, map.height_cells)) + 2),
        bins_(2 * middle_bin_),
        counts_(headings * bins_, 0) {}

  void add(double x, double y, int count) {
    for (int k = 0; k < headings; ++k) {
      const double bin = std::floor(through_origin(k).across(x, y)) + static_cast<double>(middle_bin_);
      counts_[static_cast<std::size_t>(k) * bins_ + static_cast<std::size_t>(bin)] += count;
    }
  }
  // The fullest bin's line, and its count; of equals the first.
  [[nodiscard]] std::pair<Line, int> most() const {
    const auto peak = std::max_element(counts_.begin(), counts_.end());
    const auto at = static_cast<std::size_t>(peak - counts_.begin());
    Line found = through_origin(static_cast<int>(at / bins_));
    found.offset = static_cast<double>(at % bins_) - static_cast<double>(middle_bin_) + 0.5;
    return {found, *peak};
  }

 private:
  static Line through_origin(int heading) {
    const double angle_rad = std::numbers::pi * heading / headings;
    return {.cos = std::cos(angle_rad), .sin = std::sin(angle_rad)};
  }

  std::size_t middle_bin_;
  std::size_t bins_;
  std::vector<int> counts_;
};

struct OnLine {
  double along;
  std::size_t point;
};

// The points within `width` of a line that no line before took, in order along it.
std::vector<OnLine> points_on(const Points& points, const Line& line, double width) {
  std::vector<OnLine> on;
  for (std::size_t i = 0; i < points.x.size(); ++i)
    if (points.taken[i] == 0 && std::abs(line.across(points.x[i], points.y[i])) <= width)
      on.push_back({.along = line.along(points.x[i], points.y[i]), .point = i});
  std::sort(on.begin(), on.end(), [](const OnLine& a, const OnLine& b) {
    return a.along != b.along ? a.along < b.along : a.point < b.point;
  });
  return on;
}

CellIndex cell_on(const Line& line, double along) {
  return {.col = static_cast<int>(std::floor(line.cos * line.offset - line.sin * along)),
          .row = static_cast<int>(std::floor(line.sin * line.offset + line.cos * along))};
}

// Whether a straight gap between two points of a line may be wall: readings passed at most half of it.
bool may_be_wall(const GridMap& map, std::span<const std::uint8_t> passed, const Line& line, double from,
                 double to) {
  int steps = 0;
  int open = 0;
  for (double along = from; along <= to; along += 0.5) {
    const CellIndex cell = cell_on(line, along);
    ++steps;
    open += map.contains(cell) && map.at(cell) != Occupancy::occupied && passed[map.index(cell)] != 0;
  }
  return 2 * open <= steps;
}

// Points that follow each other on a line, first to last.
struct Run {
  std::size_t first;
  std::size_t last;
  double length;
};

// Split where a gap is too long or open.
std::vector<Run> runs_of(const GridMap& map, std::span<const std::uint8_t> passed, const Line& line,
                         const std::vector<OnLine>& on, double gap_cells) {
  std::vector<Run> runs;
  for (std::size_t first = 0; first < on.size();) {
    std::size_t last = first;
    while (last + 1 < on.size()) {
      const double gap = on[last + 1].along - on[last].along;
      if (gap > neighbours_cells &&
          !(gap <= gap_cells && may_be_wall(map, passed, line, on[last].along, on[last + 1].along)))
        break;
      ++last;
    }
    runs.push_back({.first = first, .last = last, .length = on[last].along - on[first].along + 1.0});
    first = last + 1;
  }
  return runs;
}

void draw(const GridMap& map, std::vector<std::uint8_t>& wall, const Line& line, double from, double to) {
  for (double along = from; along <= to; along += 0.5) {
    const CellIndex cell = cell_on(line, along);
    if (map.contains(cell)) wall[map.index(cell)] = 1;
  }
}

// The run's points are wall, and so are its gaps.
void take(const GridMap& map, std::vector<std::uint8_t>& wall, Points& points, const Line& line,
          const std::vector<OnLine>& on, const Run& run) {
  for (std::size_t i = run.first; i <= run.last; ++i) {
    wall[points.index[on[i].point]] = 1;
    points.taken[on[i].point] = 1;
    if (i < run.last && on[i + 1].along - on[i].along > neighbours_cells)
      draw(map, wall, line, on[i].along, on[i + 1].along);
  }
}

}  // namespace

void connect_walls(GridMap& map, std::span<const std::uint8_t> passed, const TbfOptions& options) {
  Points points = occupied_points(map);
  std::vector<std::uint8_t> wall(map.cells.size(), 0);
  Votes votes(map);
  for (std::size_t i = 0; i < points.x.size(); ++i) votes.add(points.x[i], points.y[i], 1);
  const double gap_cells = options.wall_gap_m / map.resolution_m;
  const double length_cells = options.wall_length_m / map.resolution_m;
  // A segment is at least half occupied: fewer votes make none.
  const int fewest = std::max(3, static_cast<int>(0.5 * length_cells));
  for (std::pair<Line, int> peak = votes.most(); peak.second >= fewest; peak = votes.most()) {
    const std::vector<OnLine> on = points_on(points, peak.first, half_width_cells);
    const std::vector<Run> runs = runs_of(map, passed, peak.first, on, gap_cells);
    const bool is_wall =
        std::any_of(runs.begin(), runs.end(), [&](const Run& run) { return run.length >= length_cells; });
    for (const Run& run : runs)
      if (is_wall && run.length >= share_lined_up * length_cells)
        take(map, wall, points, peak.first, on, run);
    // Those on no run may still be on another line's, but call for no more lines of their own.
    for (const OnLine& each : on)
      if (std::exchange(points.votes[each.point], std::uint8_t{0}) != 0)
        votes.add(points.x[each.point], points.y[each.point], -1);
  }
  for (std::size_t i = 0; i < map.cells.size(); ++i)
    if (wall[i] != 0)
      map.cells[i] = Occupancy::occupied;
    else if (map.cells[i] == Occupancy::occupied)
      map.cells[i] = Occupancy::free;
}

}  // namespace landfall::internal
