#include "engine/mapping/slam/check.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "engine/base/number_text.hpp"
#include "engine/mapping/slam/evidence_grid.hpp"
#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// [least, most]; NaN is in none.
void require(const char* field, double value, double least, double most, const char* expected) {
  if (value >= least && value <= most && std::isfinite(value)) return;
  throw Error(ErrorCode::invalid_argument,
              std::string("slam: ") + field + " is " + number_text(value) + ", expected " + expected);
}

void check(const SwarmOptions& swarm) {
  require("swarm.particles", swarm.particles, 4, 1e6, "4 to 1000000");
  require("swarm.iterations", swarm.iterations, 0, 10'000, "0 to 10000");
  require("swarm.inertia", swarm.inertia, 0.0, 1.0, "0 to 1");
  require("swarm.own_pull", swarm.own_pull, 0.0, 4.0, "0 to 4");
  require("swarm.swarm_pull", swarm.swarm_pull, 0.0, 4.0, "0 to 4");
  require("swarm.good_enough", swarm.good_enough, 0.0, 1.0, "0 to 1");
  require("swarm.reach_m", swarm.reach_m, 0.0, 100.0, "0 to 100");
  require("swarm.reach_rad", swarm.reach_rad, 0.0, std::numbers::pi, "0 to pi");
}

}  // namespace

void check(const SlamOptions& options) {
  check(options.swarm);
  require("resolution_m", options.resolution_m, 0.001, 10.0, "0.001 to 10");
  require("range_min_m", options.range_min_m, 0.0, infinity, "a number >= 0");
  require("range_max_m", options.range_max_m, 0.0, infinity, "a number >= 0");
  require("deletion_range_m", options.deletion_range_m, 0.0, infinity, "a number >= 0");
  require("least_agreement", options.least_agreement, 0.0, 1.0, "0 to 1");
  require("recovery_reach_m", options.recovery_reach_m, 0.0, 100.0, "0 to 100");
  const double most = EvidenceGrid::most_log_odds;
  require("max_log_odds", options.max_log_odds, 0.01, most, "0.01 to 30");
  require("min_log_odds", options.min_log_odds, -most, options.free_log_odds, "-30 to free_log_odds");
  require("log_odds_hit", options.log_odds_hit, 0.001, most, "0.001 to 30");
  require("log_odds_miss", options.log_odds_miss, -most, -0.001, "-30 to -0.001");
  require("occupied_log_odds", options.occupied_log_odds, -most, most, "-30 to 30");
  require("free_log_odds", options.free_log_odds, -most, std::nextafter(options.occupied_log_odds, -infinity),
          "less than occupied_log_odds");
}

}  // namespace landfall::internal
