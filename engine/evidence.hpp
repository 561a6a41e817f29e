// What a score is worth: from sums of the field to probabilities.
//
// Beams are not independent (neighbours see the same wall, the map has the same faults for all of them),
// so a scan's likelihood is tempered: exp(nats * share), where share is the score over the best
// imaginable one, and nats grows with the fourth root of the number of echoes (100 for 180): between
// independent beams' linear growth and none at all. The constants were chosen once, so that what is
// called certain is right in 99 of 100 cases in buildings with repeating corridors too, and what is
// asked of another building's map is called found in less than one of 100 (bench/RESULTS.md, "Verdicts").
#pragma once

#include <cstddef>
#include <cstdint>

namespace landfall::internal {

// Nats for a share of 1, from the number of echoes.
double evidence_nats(std::size_t points);
// What ray casting adds: the share that a beam seen through a wall costs, and one blocked earns back.
inline constexpr double ray_share = 0.1;

// What lies this many nats below the best pose is not looked for, and weighs next to nothing.
inline constexpr double rival_nats = 4.5;
// What all the poses weigh, beside the best one, that are never looked at.
inline constexpr double unseen_weight = 0.01;

// What weighs, beside a pose of this share and explained share, that the scan is from no place of the
// map: a pose found by chance matches less well. Even odds where both add up to 1.4.
double elsewhere_weight(double share, double explained);

inline double share_of(std::int32_t score, std::size_t points) {
  return static_cast<double>(score) / (255.0 * static_cast<double>(points));
}

}  // namespace landfall::internal
