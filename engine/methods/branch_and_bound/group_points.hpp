// The end points of a scan as the bound tables see them: for a group of neighbouring headings, rounded to
// half blocks, equal neighbours merged.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "engine/maps/search_tables.hpp"
#include "engine/scans/end_points.hpp"
#include "kernels/merge_windows.hpp"

namespace landfall::internal {

// A score in units of the bound tables, rounded up: a pose of that score has a table sum of at least this.
inline std::int64_t table_units(std::int32_t score) {
  return (std::int64_t{score} * kernels::bound_levels + 254) / 255;
}

class GroupPoints {
 public:
  // Headings [first, last) of the lattice.
  void build(const EndPoints& points, const Lattice& lattice, const BoundTable& table, int first, int last);

  [[nodiscard]] bool is_built() const { return lists_ > 0; }
  [[nodiscard]] kernels::BoundPoints view() const;
  // Points whose end moves over more cells than the widest window: they bound nothing, and count in full.
  [[nodiscard]] std::int32_t unbounded() const { return merged_.unbounded; }

 private:
  static constexpr std::size_t most_lists = 31;  // as many as a weight has bits

  // What BoundPoints points to, `room_` elements each.
  [[nodiscard]] std::int32_t* numbers(std::size_t which) const { return numbers_.get() + which * room_; }

  std::size_t room_ = 0;
  std::unique_ptr<std::int32_t[]> numbers_;  // plane, col, row, first_byte
  std::array<std::int32_t, most_lists> list_begin_{};
  std::array<std::int32_t, most_lists> list_end_{};
  int lists_ = 0;
  kernels::MergedCount merged_;
};

}  // namespace landfall::internal
