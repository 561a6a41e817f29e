// The end points of a scan as the bound tables see them: for a group of neighbouring headings, rounded to
// half blocks, equal ones merged.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/end_points.hpp"
#include "engine/search_tables.hpp"

namespace landfall::internal {

// A score in units of the bound tables, rounded up: a pose of that score has a table sum of at least this.
inline std::int64_t table_units(std::int32_t score) {
  return (std::int64_t{score} * kernels::bound_levels + 254) / 255;
}

class GroupPoints {
 public:
  // Headings [first, last) of the lattice.
  void build(const EndPoints& points, const Lattice& lattice, const BoundTable& table, int first, int last);

  [[nodiscard]] kernels::BoundPoints view() const;
  // Points whose end moves over more cells than the widest window: they bound nothing, and count in full.
  [[nodiscard]] std::int32_t unbounded() const { return unbounded_; }
  std::vector<std::int32_t>& scratch() { return scratch_; }

 private:
  struct Merged {
    std::int32_t plane;
    std::int32_t col;
    std::int32_t row;
    std::int32_t weight;
  };
  void merge(std::int32_t plane, std::int32_t col, std::int32_t row);
  void make_lists();

  std::vector<Merged> merged_;
  std::vector<std::int32_t> slots_;  // hash table: index into merged_, or -1
  std::vector<std::int32_t> plane_, col_, row_, list_end_;
  std::vector<std::int32_t> scratch_;
  std::int32_t unbounded_ = 0;
};

}  // namespace landfall::internal
