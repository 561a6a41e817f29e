#include "bench/peers/textbook.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <span>
#include <utility>

namespace landfall::bench {
namespace {

// Columns or rows of nodes at height h.
std::size_t nodes_across(int cells, int h) {
  return static_cast<std::size_t>((cells + (1 << h) - 1) >> h);
}

}  // namespace

// No end point that matters is farther away than the map is wide.
Textbook::Textbook(const PreparedMap& map, int height)
    : width_cells_(map.grid().width_cells),
      height_cells_(map.grid().height_cells),
      margin_cells_(std::max(width_cells_, height_cells_) + (1 << height)),
      stride_(width_cells_ + 2 * margin_cells_) {
  add_field(map);
  for (int h = 1; h <= height; ++h) add_doubled_windows(h);
  for (int h = 0; h <= height; ++h) add_free_cells(map.grid(), h);
}

void Textbook::add_field(const PreparedMap& map) {
  const int rows = height_cells_ + 2 * margin_cells_;
  Bytes& grid =
      max_of_level_.emplace_back(static_cast<std::size_t>(stride_) * static_cast<std::size_t>(rows));
  for (int row = 0; row < height_cells_; ++row)
    std::copy_n(map.field().begin() + std::ptrdiff_t{row} * width_cells_, width_cells_,
                grid.begin() + std::ptrdiff_t{row + margin_cells_} * stride_ + margin_cells_);
}

// A window is four of half its size.
void Textbook::add_doubled_windows(int h) {
  const Bytes& halves = max_of_level_.back();
  const auto stride = static_cast<std::size_t>(stride_);
  const std::size_t half = std::size_t{1} << (h - 1);
  Bytes grid(halves.size());
  for (std::size_t row = 0; row + half < halves.size() / stride; ++row)
    for (std::size_t col = 0; col + half < stride; ++col) {
      const std::uint8_t* low = halves.data() + row * stride + col;
      const std::uint8_t* high = low + half * stride;
      grid[row * stride + col] = std::max(std::max(low[0], low[half]), std::max(high[0], high[half]));
    }
  max_of_level_.push_back(std::move(grid));
}

void Textbook::add_free_cells(const GridMap& map, int h) {
  const std::size_t cols = nodes_across(width_cells_, h);
  Bytes& holds_free = free_of_level_.emplace_back(cols * nodes_across(height_cells_, h));
  for (int row = 0; row < height_cells_; ++row)
    for (int col = 0; col < width_cells_; ++col)
      if (map.at({.col = col, .row = row}) == Occupancy::free)
        holds_free[static_cast<std::size_t>(row >> h) * cols + static_cast<std::size_t>(col >> h)] = 1;
}

// One search: the scan at all headings, and the best leaf so far.
class TextbookSearch {
 public:
  TextbookSearch(const Textbook& tables, const internal::EndPoints& points, const internal::Lattice& lattice)
      : tables_(tables), height_(static_cast<int>(tables.max_of_level_.size()) - 1) {
    internal::HeadingCells cells;
    for (int heading = 0; heading < lattice.headings; ++heading) {
      internal::cells_at_heading(points, lattice, heading, cells);
      for (std::size_t i = 0; i < points.size(); ++i)
        if (std::abs(cells.col[i]) < tables.width_cells_ && std::abs(cells.row[i]) < tables.height_cells_)
          offsets_.push_back(cells.row[i] * tables.stride_ + cells.col[i]);
      first_of_heading_.push_back(offsets_.size());
    }
  }

  TextbookAnswer run() {
    std::vector<Candidate> candidates = initial_candidates();
    std::sort(candidates.begin(), candidates.end(), better);
    search_depth_first(candidates, height_);
    return answer_;
  }

 private:
  struct Candidate {
    std::int32_t score;  // at a node an upper bound
    std::int32_t heading;
    std::int32_t row;
    std::int32_t col;
  };
  static bool better(const Candidate& a, const Candidate& b) { return a.score > b.score; }

  std::vector<Candidate> initial_candidates() {
    std::vector<Candidate> candidates;
    const int headings = static_cast<int>(first_of_heading_.size()) - 1;
    const int step = 1 << height_;
    for (int heading = 0; heading < headings; ++heading)
      for (int row = 0; row < tables_.height_cells_; row += step)
        for (int col = 0; col < tables_.width_cells_; col += step)
          if (holds_free(height_, row, col))
            candidates.push_back({score(height_, heading, row, col), heading, row, col});
    return candidates;
  }

  // Candidates come best first.
  void search_depth_first(std::span<const Candidate> candidates, int h) {
    for (const Candidate& candidate : candidates) {
      if (candidate.score <= answer_.score) return;
      if (h > 0) {
        branch(candidate, h - 1);
        continue;
      }
      answer_.score = candidate.score;
      answer_.pose = {.heading = candidate.heading, .row = candidate.row, .col = candidate.col};
    }
  }

  // Into the up to four nodes of height h.
  void branch(const Candidate& parent, int h) {
    std::array<Candidate, 4> children{};
    std::size_t count = 0;
    for (int up = 0; up < 2; ++up)
      for (int right = 0; right < 2; ++right) {
        const int row = parent.row + (up << h);
        const int col = parent.col + (right << h);
        if (row >= tables_.height_cells_ || col >= tables_.width_cells_ || !holds_free(h, row, col)) continue;
        const Candidate child{score(h, parent.heading, row, col), parent.heading, row, col};
        std::size_t at = count++;
        for (; at > 0 && better(child, children[at - 1]); --at) children[at] = children[at - 1];
        children[at] = child;
      }
    search_depth_first({children.data(), count}, h);
  }

  [[nodiscard]] bool holds_free(int h, int row, int col) const {
    const std::size_t cols = nodes_across(tables_.width_cells_, h);
    return tables_.free_of_level_[static_cast<std::size_t>(h)][static_cast<std::size_t>(row >> h) * cols +
                                                               static_cast<std::size_t>(col >> h)] != 0;
  }

  // 0 where it cannot exceed the best leaf; looked at after every few points, whose order is shuffled.
  std::int32_t score(int h, int heading, int row, int col) {
    constexpr std::size_t points_per_look = 16;
    ++answer_.nodes;
    const std::uint8_t* field = tables_.max_of_level_[static_cast<std::size_t>(h)].data() +
                                std::ptrdiff_t{row + tables_.margin_cells_} * tables_.stride_ + col +
                                tables_.margin_cells_;
    std::size_t i = first_of_heading_[static_cast<std::size_t>(heading)];
    const std::size_t end = first_of_heading_[static_cast<std::size_t>(heading) + 1];
    std::int32_t sum = 0;
    while (i + points_per_look <= end) {
      for (const std::size_t look = i + points_per_look; i < look; ++i) sum += field[offsets_[i]];
      if (sum + 255 * static_cast<std::int32_t>(end - i) <= answer_.score) return 0;
    }
    for (; i < end; ++i) sum += field[offsets_[i]];
    return sum;
  }

  const Textbook& tables_;
  int height_;
  std::vector<std::int32_t> offsets_;             // of the end points, heading after heading
  std::vector<std::size_t> first_of_heading_{0};  // and one past the last
  TextbookAnswer answer_;
};

TextbookAnswer Textbook::search(const internal::EndPoints& points, const internal::Lattice& lattice) const {
  assert(lattice.step_cells == 1 && lattice.width_cells == width_cells_ &&
         lattice.height_cells == height_cells_);
  return TextbookSearch(*this, points, lattice).run();
}

}  // namespace landfall::bench
