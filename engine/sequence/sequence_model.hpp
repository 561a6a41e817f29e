// How probable a sequence of hypotheses is: what each scan says of its own, and odometry of neighbours.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/sequence/odometry_quality.hpp"
#include "landfall/consistent.hpp"

namespace landfall::internal {

class SequenceModel {
 public:
  // T_odom_robot[i] is odometry under results[i], from which it is learnt how good odometry is.
  SequenceModel(std::span<const SearchResult> results, std::span<const Pose2> T_odom_robot,
                const ConsistentOptions& options);

  // Log densities, but for a constant.
  [[nodiscard]] static double log_emission(const Hypothesis& hypothesis);
  // Odometry's density, or a jump to anywhere; on another map always a jump.
  [[nodiscard]] double log_transition(const Hypothesis& before, const Hypothesis& after,
                                      const Pose2& T_before_after) const;
  // Odometry does not explain the second after the first.
  [[nodiscard]] bool is_jump(const Hypothesis& before, const Hypothesis& after,
                             const Pose2& T_before_after) const {
    return log_transition(before, after, T_before_after) <= log_jump_;
  }
  // A hypothesis's own uncertainty and odometry's together, as good as it proved.
  [[nodiscard]] OdometrySigma transition_sigma(const Pose2& T_before_after) const;
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
  OdometryQuality quality_;
};

// Throws Error{invalid_argument}, under the function's name: lengths that differ, a scan without odometry, a
// hypothesis on a map that is not given.
void check_sequence(const std::string& function, std::span<const PreparedMap> maps,
                    std::span<const Scan> scans, std::span<const SearchResult> results);

// The same for options out of range.
void check_options(const std::string& function, const ConsistentOptions& options);

}  // namespace landfall::internal
