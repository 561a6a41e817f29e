// What a score is worth: from sums of the field to likelihoods.
//
// Beams are not independent (neighbours see the same wall, the map has the same faults for all of them),
// so a scan's likelihood is tempered: exp(nats * share), where share is the score over the best
// imaginable one, and nats grows with the fourth root of the number of echoes (47 for 180). Between
// independent beams' linear growth and none at all; chosen so that two poses are told apart with 95 %
// where their shares differ by six hundredths, which a search in a wrong building's map hardly ever
// gives its best pose over its second (bench/RESULTS.md, "Verdicts").
#pragma once

#include <cstddef>
#include <cstdint>

#include "engine/query.hpp"

namespace landfall::internal {

// Nats for a share of 1, from the number of echoes.
double evidence_nats(std::size_t points);
// Nats for an explained share of 1.
inline constexpr double explained_nats = 20.0;
// What lies this many nats below the best pose is not looked for.
inline constexpr double rival_nats = 3.3;
// What is not looked for weighs, all together, this much of a pose at that border.
inline constexpr double unseen_weight = 0.3;

inline double share_of(std::int32_t score, std::size_t points) {
  return static_cast<double>(score) / (255.0 * static_cast<double>(points));
}

// The share that the best pose of the domain would reach by chance, were the scan from somewhere else:
// mean and spread of the share over a sample of the domain, and the extreme value of as many
// independent draws as the domain has distinct poses.
double chance_share(const Query& query);

}  // namespace landfall::internal
