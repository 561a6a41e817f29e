// How probable a sequence of hypotheses is: what each scan says of its own, and odometry of neighbours.
#pragma once

#include <span>
#include <vector>

#include "engine/odometry.hpp"
#include "landfall/consistent.hpp"

namespace landfall::internal {

class SequenceModel {
 public:
  SequenceModel(std::span<const SearchResult> results, const ConsistentOptions& options);

  // Log densities, but for a constant.
  [[nodiscard]] static double log_emission(const Hypothesis& hypothesis);
  // Odometry's Gaussian, or a jump to anywhere; on another map always a jump.
  [[nodiscard]] double log_transition(const Hypothesis& before, const Hypothesis& after,
                                      const Pose2& T_before_after) const;
  // One step of Viterbi: log posteriors of the hypotheses of `after` from those of `before`.
  struct Extended {
    std::vector<double> log_posterior;
    std::vector<int> came_from;
  };
  [[nodiscard]] Extended extend(std::span<const Hypothesis> before, std::span<const double> log_posterior,
                                std::span<const Hypothesis> after, const Pose2& T_before_after) const;

 private:
  OdometryNoise noise_;
  double log_jump_;
};

// A hypothesis's own uncertainty and odometry's together.
OdometrySigma transition_sigma(const OdometryNoise& noise, const Pose2& T_before_after);

}  // namespace landfall::internal
