// Turning and shifting map and prior together turns and shifts the answers, and changes nothing else.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <variant>

#include "random_world.hpp"
#include "same_answer.hpp"

namespace landfall {
namespace {

using testing::World;

// A prior of the map frame in the world's frame, where the map's frame stands at T_world_map.
struct Moved {
  Pose2 T_world_map;

  [[nodiscard]] Pose2 operator()(const Pose2& T_map_robot) const { return T_world_map * T_map_robot; }
  [[nodiscard]] Point2 operator()(const Point2& p_map) const { return T_world_map * p_map; }
  PosePrior operator()(const PosePrior& prior) const {
    return std::visit([this](const auto& kind) { return PosePrior{(*this)(kind)}; }, prior.kind);
  }
  Anywhere operator()(const Anywhere& anywhere) const { return anywhere; }
  // Its box stays aligned with the axes: only shifts leave it the same.
  Window operator()(Window window) const {
    window.T_map_robot = (*this)(window.T_map_robot);
    return window;
  }
  Gaussian operator()(Gaussian gaussian) const {
    gaussian.T_map_robot = (*this)(gaussian.T_map_robot);
    Eigen::Map<Eigen::Matrix3d> covariance(gaussian.covariance.data());
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(T_world_map.theta_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    const Eigen::Matrix3d turned = turn * covariance * turn.transpose();
    covariance = 0.5 * (turned + turned.transpose());
    return gaussian;
  }
  Region operator()(Region region) const {
    for (Point2& corner : region.polygon_map) corner = (*this)(corner);
    region.theta_rad += T_world_map.theta_rad;
    return region;
  }
  Beacons operator()(Beacons beacons) const {
    for (Beacon& disc : beacons.discs) disc.p_map = (*this)(disc.p_map);
    return beacons;
  }
  CandidatePoses operator()(CandidatePoses candidates) const {
    for (Pose2& T_map_robot : candidates.T_map_robot) T_map_robot = (*this)(T_map_robot);
    return candidates;
  }
  Mixture operator()(Mixture mixture) const {
    for (PosePrior& component : mixture.components) component = (*this)(component);
    return mixture;
  }
};

bool has_window(const PosePrior& prior) {
  if (std::holds_alternative<Window>(prior.kind)) return true;
  const auto* mixture = std::get_if<Mixture>(&prior.kind);
  return mixture != nullptr &&
         std::any_of(mixture->components.begin(), mixture->components.end(), has_window);
}

// Hypotheses as probable as a neighbour of theirs (the last one's may be cut off) may swap places with it.
bool is_tied(const SearchResult& result, std::size_t i) {
  const auto equally_probable = [&](std::size_t j) {
    return std::abs(result.hypotheses[i].probability - result.hypotheses[j].probability) <=
           1e-6 * result.hypotheses[i].probability;
  };
  return i + 1 == result.hypotheses.size() || equally_probable(i + 1) || (i > 0 && equally_probable(i - 1));
}

void expect_moved(const SearchResult& moved, const SearchResult& original, const Pose2& T_world_map) {
  EXPECT_EQ(moved.verdict, original.verdict);
  EXPECT_EQ(moved.proven, original.proven);
  EXPECT_EQ(moved.counts.poses_covered, original.counts.poses_covered);
  ASSERT_EQ(moved.hypotheses.size(), original.hypotheses.size());
  for (std::size_t i = 0; i < moved.hypotheses.size(); ++i) {
    SCOPED_TRACE("hypothesis " + std::to_string(i));
    const Hypothesis& here = moved.hypotheses[i];
    const Hypothesis& there = original.hypotheses[i];
    EXPECT_NEAR(here.probability, there.probability, 1e-6);
    if (is_tied(original, i)) continue;
    EXPECT_EQ(here.score, there.score);
    EXPECT_LT(translation_distance(here.T_map_robot_unrefined, T_world_map * there.T_map_robot_unrefined),
              1e-6);
    EXPECT_LT(translation_distance(here.T_map_robot, T_world_map * there.T_map_robot), 1e-6);
    EXPECT_LT(angle_distance(here.T_map_robot.theta_rad, (T_world_map * there.T_map_robot).theta_rad), 1e-6);
  }
}

int check_moved(bool turned, std::uint64_t first_seed) {
  int compared = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + 100; ++seed) {
    const World world = testing::small_world(seed);
    if (turned && has_window(world.prior)) continue;
    SCOPED_TRACE("seed " + std::to_string(seed));
    testing::Dice dice(seed, 40);
    const Pose2 T_world_map{dice.between(-30.0, 30.0), dice.between(-30.0, 30.0),
                            turned ? dice.between(-3.0, 3.0) : 0.0};
    GridMap grid = world.map.grid();
    grid.T_map_grid = T_world_map * grid.T_map_grid;
    const PreparedMap moved_map(grid, world.map.options());
    const SearchResult original = testing::answer_or_error(world.map, world.prior, world.scan, world.options);
    const SearchResult moved =
        testing::answer_or_error(moved_map, Moved{T_world_map}(world.prior), world.scan, world.options);
    expect_moved(moved, original, T_world_map);
    compared += original.hypotheses.size() > 1 && !is_tied(original, 0) ? 1 : 0;
  }
  return compared;
}

TEST(Frames, TurningMapAndPriorTurnsTheAnswers) {
  EXPECT_GT(check_moved(true, 3000), 30);
}

TEST(Frames, ShiftingMapAndPriorShiftsTheAnswers) {
  EXPECT_GT(check_moved(false, 3100), 20);
}

}  // namespace
}  // namespace landfall
