// What a score is worth: from sums of the field to probabilities.
//
// How far a map is off (furniture moved, people, walls drawn thick) is not known beforehand, and it is off
// for all beams alike. With errors of unknown scale integrated out, the likelihood of a pose falls with a
// power of its misfit, 1 - share, where share is the score over the best imaginable one: a scan that fits
// well tells poses apart sharply, one that fits badly hardly does. Beams are not independent either, so that
// the power grows with the fourth root of the number of echoes. The constants were chosen once on five
// buildings (bench/RESULTS.md, "Verdicts").
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace landfall::internal {

// Log likelihood, but for a constant.
double log_evidence(double share, std::size_t points);
// Its derivative by the share.
double evidence_slope(double share, std::size_t points);
// log(exp(a) + exp(b)); either may be -infinity.
double log_add(double a, double b);
// What ray casting adds: the share that a beam seen through a wall costs, and one blocked earns back.
inline constexpr double ray_share = 0.1;

// How much less than the best pose one may score and yet be looked for. By its likelihood, which must be at
// least one in 665 of the best's (rival_nats): a part of what the best one lacks to a perfect fit. At most a
// fixed amount, which keeps searches with scans that fit badly within bounds. In scores, sums of the field.
inline constexpr double rival_nats = 6.5;

struct RivalMargin {
  double most_score = 0.0;
  double part_of_misfit = 1.0;
  double misfit_at_score_0 = std::numeric_limits<double>::infinity();

  [[nodiscard]] std::int32_t at(std::int32_t best_score) const {
    return static_cast<std::int32_t>(std::min(most_score, part_of_misfit * (misfit_at_score_0 - best_score)));
  }
};
// Of a scan with so many points; none: 0 at any score.
RivalMargin rival_margin(std::size_t points);
// Of a second look (search.cpp).
RivalMargin second_margin(std::size_t points);

// What all the poses weigh, beside the best one, that are never looked at.
inline constexpr double unseen_weight = 0.01;
// Nats for a share of the beams that a rival explains more of than the best pose: field and rays disagree.
inline constexpr double explains_more_nats = 30.0;

// What weighs, beside the best pose, that the scan is from no place of the map: a pose found by chance
// matches less well, and less of a wall. share: with what blocked beams earn back, for people and
// furniture end beams before a wall, while beams of a pose found by chance end on either side of it.
// held_m2: contour that the map confirms (contour.hpp).
inline constexpr double blocked_share = 0.6;
double elsewhere_weight(double share, double held_m2);

// The same, beside all poses of the prior, where ranges are compared (range_posterior.hpp).
inline constexpr double elsewhere_odds = 0.05;

inline double share_of(std::int32_t score, std::size_t points) {
  return static_cast<double>(score) / (255.0 * static_cast<double>(std::max<std::size_t>(1, points)));
}

}  // namespace landfall::internal
