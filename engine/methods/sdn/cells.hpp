// The networks' cells: each points at a pose, and is active or not.
//
// Beattie & Bishop, sections 2 and 3. A cell of the focused network stands for a region around its mapping,
// whose size its focus level says; it remembers the mappings of the levels above, so that moving up brings
// it back to the region that it came from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/counter_rng.hpp"
#include "engine/methods/sdn/focus_levels.hpp"
#include "landfall/pose2.hpp"

namespace landfall::internal {

// What the other cells see of a cell: copied by diffusion.
struct Mapping {
  Pose2 T_map_robot{};
  bool active = false;
  bool focused = false;    // within tolerance at the finest level, several times in a row
  std::uint8_t level = 0;  // of its region
};

class Cells {
 public:
  Cells(std::size_t count, std::span<const FocusLevel> levels);

  [[nodiscard]] std::size_t size() const { return level_.size(); }
  [[nodiscard]] std::size_t finest() const { return levels_.size() - 1; }
  [[nodiscard]] std::size_t level(std::size_t cell) const { return level_[cell]; }
  // As they were when the last testing phase ended.
  [[nodiscard]] const Mapping& mapping(std::size_t cell) const { return mappings_[cell]; }
  [[nodiscard]] std::span<const Mapping> mappings() const { return mappings_; }
  // After the test of this phase.
  [[nodiscard]] bool is_active(std::size_t cell) const { return next_[cell].active; }
  // Where the cell is about to be tested.
  [[nodiscard]] const Pose2& T_map_robot(std::size_t cell) const { return path_[index(cell)]; }

  // A new mapping, at the top level or below, where the prior tells as much.
  void place(std::size_t cell, const Pose2& T_map_robot, std::size_t level = 0);
  // 3.3: a mapping copied from another cell, which begins its search centred around this location at the top
  // level.
  void copy(std::size_t cell, const Pose2& T_map_robot, CounterRng& rng);
  // 3.2: within tolerance, a cell moves down a level, into a part of its region, and stays where it is at the
  // finest. Which part, the paper leaves open: the one that `polled`, another cell, points to, where that is
  // active, within this region and deeper; else one drawn at random.
  void pass(std::size_t cell, const Mapping& polled, CounterRng& rng);
  // Out of tolerance, it moves up a level, or several; above the top it becomes inactive.
  void fail(std::size_t cell, std::size_t levels = 1);
  // Ends a testing phase: what pass() and fail() did is seen by all cells. Only whole phases may be mixed
  // with reading mapping(); each cell may be moved by another thread.
  void publish() { mappings_.swap(next_); }

 private:
  [[nodiscard]] std::size_t index(std::size_t cell) const { return cell * levels_.size() + level_[cell]; }

  std::span<const FocusLevel> levels_;
  std::vector<std::uint8_t> level_;
  std::vector<std::uint8_t> passed_;  // tests in a row at the finest level
  std::vector<Pose2> path_;           // cell by cell, a pose a level
  std::vector<Mapping> mappings_;
  std::vector<Mapping> next_;
};

}  // namespace landfall::internal
