// The simulated ranges of a testing phase: one beam from one pose each.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/maps/prepared_state.hpp"
#include "engine/methods/sdn/beam_bands.hpp"

namespace landfall::internal {

struct Test {
  Pose2 T_map_robot{};
  std::uint32_t beam = 0;  // of the bands' beams
};

class TestRays {
 public:
  TestRays(const PreparedState& map, const Scan& scan, const BeamBands& bands);

  // ranges_m[i] is of tests[i]. At most most_tests.
  static constexpr std::size_t most_tests = 256;
  void cast(std::span<const Test> tests, std::span<float> ranges_m) const;
  // How many of the scan's valid beams are in their band of a level from a pose.
  [[nodiscard]] int count_agreeing(const Pose2& T_map_robot, std::size_t level) const;

 private:
  void cast_cones(std::span<const Test> tests, std::span<float> ranges_m) const;

  const raycast::Scene& scene_;
  const BeamBands& bands_;
  std::vector<raycast::Beam> beams_;  // the bands'
  struct Direction {
    float x, y, dx, dy, range_max;
  };
  std::vector<Direction> directions_;
  bool cones_ = false;
};

}  // namespace landfall::internal
