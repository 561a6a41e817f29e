// The scans of a composite on a map, each at a pose of its own, held to its neighbours: what there is to
// minimise.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "engine/maps/prepared_state.hpp"
#include "engine/scans/end_points.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// Poses are (x_cells, y_cells, theta_rad) in the grid's frame, three rows a part.
class SettleProblem {
 public:
  // scan.parts must be there; map and scan outlive this.
  SettleProblem(const PreparedState& map, const Scan& scan);

  // Expects the reference at a pose, with one sigma of an error: beside the evidence of the whole composite,
  // which is counted once for that and not once for every scan.
  void expect_reference(const Pose2& T_map_reference, double sigma_m, double sigma_rad);

  struct Linear {
    Eigen::MatrixXd hessian;
    Eigen::VectorXd gradient;  // downhill
    double cost = 0.0;         // less the log of evidence and of the relative poses' density
  };
  [[nodiscard]] Linear linearise(const Eigen::VectorXd& poses) const;

  // Sums of the field over the points of part i with its pose moved by (dx, dy) whole cells, each at most
  // `reach`: row by row.
  [[nodiscard]] std::vector<std::int64_t> scores_around(std::size_t i, const Eigen::Vector3d& pose,
                                                        int reach) const;
  // The two summands of the cost: for a sum of the field over all points, and for a step that is off.
  [[nodiscard]] double cost_of_score(std::int64_t score) const;
  [[nodiscard]] double cost_of_step(double off_squared_cells) const;

  [[nodiscard]] std::size_t parts() const { return points_.size(); }
  [[nodiscard]] std::span<const Pose2> T_reference_robot() const { return T_reference_robot_; }
  [[nodiscard]] double resolution_m() const { return map_.grid().resolution_m; }
  [[nodiscard]] Eigen::VectorXd in_cells(const std::vector<Pose2>& T_map_part) const;
  [[nodiscard]] std::vector<Pose2> in_metres(const Eigen::VectorXd& poses) const;

 private:
  [[nodiscard]] Eigen::Vector3d in_cells(const Pose2& pose) const;
  // The reference where it is expected.
  void hold_reference(const Eigen::VectorXd& poses, Linear& sum) const;
  // Part i + 1 beside part i.
  void hold(std::size_t i, const Eigen::VectorXd& poses, Linear& sum) const;

  const PreparedState& map_;
  std::span<const Pose2> T_reference_robot_;  // the scan's own
  std::vector<EndPoints> points_;
  std::vector<Eigen::Vector3d> steps_;
  Eigen::Vector3d weight_;
  Eigen::Index reference_ = 0;
  Eigen::Vector3d expected_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d expected_weight_ = Eigen::Vector3d::Zero();  // none expected
  std::size_t count_ = 0;
  // Evidence grows with the fourth root of the points, since what is off in a map is off for all of them. But
  // where a scan stands among the others, each says by itself.
  double scans_ = 1.0;
};

}  // namespace landfall::internal
