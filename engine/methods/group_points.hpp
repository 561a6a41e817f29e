// The end points of a scan as the bound tables see them: for a group of neighbouring headings, rounded to
// half blocks, equal neighbours merged.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/end_points.hpp"
#include "engine/search_tables.hpp"

namespace landfall::internal {

// A score in units of the bound tables, rounded up: a pose of that score has a table sum of at least this.
inline std::int64_t table_units(std::int32_t score) {
  return (std::int64_t{score} * kernels::bound_levels + 254) / 255;
}

// Neighbouring points that share a window.
struct MergedPoint {
  std::int32_t plane;
  std::int32_t col;
  std::int32_t row;
  std::uint32_t weight;
};

class GroupPoints {
 public:
  // Headings [first, last) of the lattice.
  void build(const EndPoints& points, const Lattice& lattice, const BoundTable& table, int first, int last);

  [[nodiscard]] bool is_built() const { return lists_ > 0; }
  [[nodiscard]] kernels::BoundPoints view() const;
  // Points whose end moves over more cells than the widest window: they bound nothing, and count in full.
  [[nodiscard]] std::int32_t unbounded() const { return unbounded_; }

 private:
  static constexpr int most_lists = 8;

  void fill_lists(const std::vector<MergedPoint>& merged, std::size_t points);

  std::vector<std::int32_t> plane_, col_, row_;  // one list after the other
  std::array<std::int32_t, most_lists> list_begin_{};
  std::array<std::int32_t, most_lists> list_end_{};
  int lists_ = 0;
  std::int32_t unbounded_ = 0;
};

}  // namespace landfall::internal
