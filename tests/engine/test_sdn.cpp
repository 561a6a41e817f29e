// Methods `sdn` and `fsdn` as search() asks them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "landfall/diffusion.hpp"
#include "landfall/error.hpp"
#include "rooms.hpp"
#include "same_answer.hpp"

namespace landfall {
namespace {

using testing::full_circle;
using testing::look;

constexpr double degree = std::numbers::pi / 180.0;

SearchOptions by(const char* method, std::uint64_t seed = 1) {
  return {.method = method, .rotation_step_rad = degree, .seed = seed};
}

bool is_at(const Hypothesis& hypothesis, const Pose2& T_map_robot, double within_m = 0.01) {
  return std::abs(hypothesis.T_map_robot.x_m - T_map_robot.x_m) <= within_m &&
         std::abs(hypothesis.T_map_robot.y_m - T_map_robot.y_m) <= within_m &&
         angle_distance(hypothesis.T_map_robot.theta_rad, T_map_robot.theta_rad) <= degree;
}

void add_box(WallMap& plan, double x0_m, double y0_m, double x1_m, double y1_m) {
  plan.walls.push_back({{x0_m, y0_m}, {x1_m, y0_m}});
  plan.walls.push_back({{x1_m, y0_m}, {x1_m, y1_m}});
  plan.walls.push_back({{x1_m, y1_m}, {x0_m, y1_m}});
  plan.walls.push_back({{x0_m, y1_m}, {x0_m, y0_m}});
}

// 4 x 3 m: the same after half a turn. An open door in its right wall, off the middle, leads to a closet.
WallMap room_with_door(double x_m, double y_m, bool open) {
  WallMap plan;
  if (!open) {
    add_box(plan, x_m, y_m, x_m + 4.0, y_m + 3.0);
    return plan;
  }
  add_box(plan, x_m + 4.0, y_m, x_m + 5.0, y_m + 3.0);
  plan.walls.erase(plan.walls.end() - 1);  // the wall between
  plan.walls.push_back({{x_m + 4.0, y_m}, {x_m + 4.0, y_m + 0.4}});
  plan.walls.push_back({{x_m + 4.0, y_m + 1.3}, {x_m + 4.0, y_m + 3.0}});
  plan.walls.push_back({{x_m, y_m}, {x_m + 4.0, y_m}});
  plan.walls.push_back({{x_m, y_m + 3.0}, {x_m + 4.0, y_m + 3.0}});
  plan.walls.push_back({{x_m, y_m}, {x_m, y_m + 3.0}});
  return plan;
}

PreparedMap prepared(const WallMap& plan) {
  return PreparedMap(plan, {.outside_unknown = true});
}

TEST(Fsdn, FindsTheRobotOnAPlanToACentimetre) {
  WallMap plan = room_with_door(0.0, 0.0, true);
  add_box(plan, 1.0, 2.0, 1.6, 2.5);
  const PreparedMap map = prepared(plan);
  const auto sensor = full_circle(360);
  int right = 0;
  int agreeing = 0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const Pose2 T_map_robot{1.1 + 0.25 * static_cast<double>(seed), 1.2,
                            0.6 * static_cast<double>(seed) - 3.0};
    const Scan scan =
        simulate(map, sensor, std::vector<Pose2>{T_map_robot}, {.noise = true, .seed = seed}).front();
    const SearchResult result = search(map, {Anywhere{}}, scan, by("fsdn", seed));
    ASSERT_FALSE(result.hypotheses.empty());
    const Hypothesis& best = result.hypotheses.front();
    right += is_at(best, T_map_robot) && result.verdict == Verdict::found ? 1 : 0;
    EXPECT_LT(translation_distance(best.T_map_robot_unrefined, T_map_robot), 0.1);
    agreeing += best.score > 300 ? 1 : 0;  // of 360 beams, from the network's own estimate
    EXPECT_FALSE(result.proven);
    EXPECT_GT(result.counts.rays_cast, 1000);
  }
  EXPECT_GE(right, 9);
  EXPECT_GE(agreeing, 7);
}

TEST(Fsdn, FindsTheRobotOnAGrid) {
  const PreparedMap map(testing::furnished_room());
  const Pose2 T_map_robot{2.31, 3.17, 0.4};
  const SearchResult result = search(map, {Anywhere{}}, look(map, full_circle(180), T_map_robot), by("fsdn"));
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_TRUE(is_at(result.hypotheses.front(), T_map_robot, 0.05));
  EXPECT_EQ(result.verdict, Verdict::found);
}

TEST(Sdn, FindsTheRobotInAWindow) {
  const PreparedMap map = prepared(room_with_door(0.0, 0.0, true));
  const Pose2 T_map_robot{1.5, 1.1, 0.4};
  const Scan scan = look(map, full_circle(180), T_map_robot);
  const Window window{{1.55, 1.15, 0.45}, 0.2, 0.2, 0.2};
  const SearchResult result = search(map, {window}, scan, by("sdn"));
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_TRUE(is_at(result.hypotheses.front(), T_map_robot));
}

TEST(Fsdn, AnswersDoNotDependOnThreadsNorOnTheBatch) {
  const PreparedMap map(testing::furnished_room());
  std::vector<Scan> scans;
  for (const double x_m : {1.5, 3.3, 5.2}) scans.push_back(look(map, full_circle(120), {x_m, 1.4, x_m}));
  SearchOptions options = by("fsdn");
  options.threads = 1;
  const std::vector<SearchResult> alone = search(map, {Anywhere{}}, scans, options);
  options.threads = 2;
  for (std::size_t i = 0; i < scans.size(); ++i)
    testing::expect_same_answer(search(map, {Anywhere{}}, scans[i], options), alone[i]);
  DiffusionOptions observed{.cells = 3000, .threads = 1, .snapshot_iterations = {0, 10}};
  const DiffusionRun one = run_diffusion(map, {Anywhere{}}, scans[0], observed);
  observed.threads = 2;
  const DiffusionRun two = run_diffusion(map, {Anywhere{}}, scans[0], observed);
  EXPECT_EQ(one.rays_cast, two.rays_cast);
  ASSERT_EQ(one.snapshots.size(), two.snapshots.size());
  for (std::size_t s = 0; s < one.snapshots.size(); ++s) {
    EXPECT_EQ(one.snapshots[s].T_map_robot, two.snapshots[s].T_map_robot);
    EXPECT_EQ(one.snapshots[s].active, two.snapshots[s].active);
  }
}

TEST(Fsdn, DiffusionKeepsTheNumberOfCells) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = look(map, full_circle(120), {3.0, 2.0, 1.0});
  const DiffusionRun run =
      run_diffusion(map, {Anywhere{}}, scan, {.cells = 300, .snapshot_iterations = {0, 1, 5, 20}});
  ASSERT_GE(run.snapshots.size(), 4);
  std::vector<int> active;
  for (const DiffusionSnapshot& snapshot : run.snapshots) {
    EXPECT_EQ(snapshot.T_map_robot.size(), 300);
    EXPECT_EQ(snapshot.level.size(), 300);
    active.push_back(static_cast<int>(std::count(snapshot.active.begin(), snapshot.active.end(), 1)));
  }
  EXPECT_LT(active.front(), 200);  // by chance
  EXPECT_GT(active.back(), active.front());
  ASSERT_FALSE(run.modes.empty());
  EXPECT_LT(translation_distance(run.modes.front().T_map_robot, {3.0, 2.0, 1.0}), 0.3);
  EXPECT_EQ(run.cells, 300);
}

TEST(Fsdn, IsLostWhereNoPoseFits) {
  const PreparedMap map = prepared(room_with_door(0.0, 0.0, false));
  const PreparedMap hall = [] {
    WallMap plan;
    add_box(plan, 0.0, 0.0, 30.0, 22.0);
    return prepared(plan);
  }();
  const Scan scan = look(hall, full_circle(120), {14.0, 9.0, 0.3});
  const SearchResult result = search(map, {Anywhere{}}, scan, by("fsdn"));
  EXPECT_EQ(result.verdict, Verdict::lost);
  EXPECT_FALSE(result.reason.empty());
  const DiffusionRun run = run_diffusion(map, {Anywhere{}}, scan);
  EXPECT_LE(static_cast<double>(run.draws), 12.0 * run.regions + 11.0 * run.cells);  // the limit
}

TEST(Fsdn, ASymmetricRoomIsAmbiguousWithItsDoorClosedAndFoundWithItOpen) {
  const Pose2 T_map_robot{1.4, 1.1, 0.5};
  const Pose2 T_map_twin{4.0 - 1.4, 3.0 - 1.1, 0.5 - std::numbers::pi};
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const PreparedMap closed = prepared(room_with_door(0.0, 0.0, false));
    const SearchResult twins =
        search(closed, {Anywhere{}}, look(closed, full_circle(360), T_map_robot), by("fsdn", seed));
    ASSERT_GE(twins.hypotheses.size(), 2);
    EXPECT_EQ(twins.verdict, Verdict::ambiguous);
    const bool first = is_at(twins.hypotheses[0], T_map_robot);
    EXPECT_TRUE(is_at(twins.hypotheses[first ? 0 : 1], T_map_robot)) << seed;
    EXPECT_TRUE(is_at(twins.hypotheses[first ? 1 : 0], T_map_twin)) << seed;
    const PreparedMap open = prepared(room_with_door(0.0, 0.0, true));
    const SearchResult one =
        search(open, {Anywhere{}}, look(open, full_circle(360), T_map_robot), by("fsdn", seed));
    EXPECT_EQ(one.verdict, Verdict::found) << seed;
    EXPECT_TRUE(is_at(one.hypotheses.front(), T_map_robot)) << seed;
  }
}

TEST(Fsdn, TwoRoomsThatLookTheSameAreAmbiguousUnlessABeaconTells) {
  WallMap plan = room_with_door(0.0, 0.0, true);
  for (const Wall& wall : room_with_door(8.0, 1.0, true).walls) plan.walls.push_back(wall);
  const PreparedMap map = prepared(plan);
  const Pose2 T_map_robot{9.4, 2.1, 0.5};
  const Pose2 T_map_twin{1.4, 1.1, 0.5};
  const Scan scan = look(map, full_circle(360), T_map_robot);
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    const SearchResult twins = search(map, {Anywhere{}}, scan, by("fsdn", seed));
    ASSERT_GE(twins.hypotheses.size(), 2);
    EXPECT_EQ(twins.verdict, Verdict::ambiguous);
    const bool first = is_at(twins.hypotheses[0], T_map_robot);
    EXPECT_TRUE(is_at(twins.hypotheses[first ? 0 : 1], T_map_robot)) << seed;
    EXPECT_TRUE(is_at(twins.hypotheses[first ? 1 : 0], T_map_twin)) << seed;
    const SearchResult one = search(map, {Beacons{{{{9.0, 2.5}, 1.0}}}}, scan, by("fsdn", seed));
    EXPECT_EQ(one.verdict, Verdict::found) << seed;
    ASSERT_FALSE(one.hypotheses.empty());
    EXPECT_TRUE(is_at(one.hypotheses.front(), T_map_robot)) << seed;
  }
}

// 3.1: "a number of FSDN cells are set to this position", the others are anywhere.
TEST(Fsdn, CellsOfABeaconStartFocusedThereWithHeadingsAllAround) {
  const PreparedMap map(testing::furnished_room());
  const Pose2 T_map_robot{3.05, 2.05, 1.0};
  const Scan scan = look(map, full_circle(120), T_map_robot);
  const PosePrior prior{Mixture{{3.0, 1.0}, {{Anywhere{}}, {Beacons{{{{3.0, 2.0}, 0.15}}}}}}};
  const DiffusionRun run = run_diffusion(map, prior, scan, {.cells = 2000, .snapshot_iterations = {0}});
  const DiffusionSnapshot& start = run.snapshots.front();
  int near = 0;
  int active = 0;
  double cos_sum = 0.0;
  double sin_sum = 0.0;
  for (std::size_t i = 0; i < start.T_map_robot.size(); ++i) {
    const Pose2& pose = start.T_map_robot[i];
    if (translation_distance(pose, {3.0, 2.0, 0.0}) > 0.25) continue;
    ++near;
    active += start.active[i];
    cos_sum += std::cos(pose.theta_rad);
    sin_sum += std::sin(pose.theta_rad);
  }
  EXPECT_NEAR(near, 500, 100);
  EXPECT_GT(active, 0.95 * near);  // from so deep a level one test does not lead above the top
  EXPECT_LT(std::hypot(cos_sum, sin_sum), 0.15 * near);
  ASSERT_FALSE(run.modes.empty());
  EXPECT_LT(translation_distance(run.modes.front().T_map_robot, T_map_robot), 0.2);
}

TEST(Fsdn, OneBeamScansAndEmptyPriorsHaveAnAnswer) {
  const PreparedMap map(testing::furnished_room());
  const auto one_beam = std::make_shared<const Sensor>(make_fan({.beams = 1, .range_max_m = 30.0}));
  const Scan scan = look(map, one_beam, {3.0, 2.0, 0.0});
  const SearchResult result = search(map, {Anywhere{}}, scan, by("fsdn"));
  EXPECT_NE(result.verdict, Verdict::found);
  EXPECT_EQ(result.beams_valid, 1);
  const SearchResult nowhere =
      search(map, {Window{{1.5, 4.7, 0.0}, 0.05, 0.05, 0.1}}, scan, by("fsdn"));  // in the cupboard
  EXPECT_EQ(nowhere.verdict, Verdict::lost);
  EXPECT_EQ(nowhere.reason, "the prior holds no free cell");
  EXPECT_TRUE(run_diffusion(map, {Window{{1.5, 4.7, 0.0}, 0.05, 0.05, 0.1}}, scan).modes.empty());
}

TEST(Fsdn, SonarsAreTestedByTheirCones) {
  const PreparedMap map(testing::furnished_room());
  Sensor ring{.name = "ring", .beams = {}};
  for (int i = 0; i < 24; ++i)
    ring.beams.push_back({.T_robot_beam = {0.0, 0.0, i * 15.0 * degree}, .half_angle_rad = 6.0 * degree});
  const Pose2 T_map_robot{2.31, 3.17, 0.4};
  const Scan scan = look(map, std::make_shared<const Sensor>(ring), T_map_robot);
  const SearchResult result = search(map, {Window{{2.4, 3.1, 0.3}, 0.4, 0.4, 0.4}}, scan, by("fsdn"));
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_LT(translation_distance(result.hypotheses.front().T_map_robot, T_map_robot), 0.15);
}

TEST(RunDiffusion, RefusesOptionsOutOfRange) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = look(map, full_circle(20), {3.0, 2.0, 0.0});
  EXPECT_THROW(run_diffusion(map, {Anywhere{}}, scan, {.cells = -1}), Error);
  EXPECT_THROW(run_diffusion(map, {Anywhere{}}, scan, {.top_half_m = 0.3}), Error);
  EXPECT_THROW(run_diffusion(map, {Anywhere{}}, scan, {.snapshot_iterations = {-2}}), Error);
  try {
    (void)run_diffusion(map, {Anywhere{}}, scan, {.max_modes = 0});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("max_modes is 0"), std::string::npos) << error.what();
  }
}

TEST(RunDiffusion, RefusesAPriorOffTheMapAsSearchDoes) {
  const PreparedMap map(testing::furnished_room());
  const Scan scan = look(map, full_circle(20), {3.0, 2.0, 0.0});
  const PosePrior elsewhere{Window{{100.0, 3.0, 0.0}, 1.0, 1.0, 1.0}};
  EXPECT_THROW((void)search(map, elsewhere, scan, by("fsdn")), Error);
  EXPECT_THROW((void)run_diffusion(map, elsewhere, scan), Error);
}

}  // namespace
}  // namespace landfall
