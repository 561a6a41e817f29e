// The parts of the stochastic diffusion networks, on hand-made cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/maps/prepared_state.hpp"
#include "engine/methods/sdn/beam_bands.hpp"
#include "engine/methods/sdn/cells.hpp"
#include "engine/methods/sdn/choose_parameters.hpp"
#include "engine/methods/sdn/cluster.hpp"
#include "engine/methods/sdn/equilibrium.hpp"
#include "engine/priors/pose_sampler.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

using internal::Cells;
using internal::CounterRng;
using internal::FocusLevel;
using internal::Mapping;

const std::vector<FocusLevel> three_levels{
    {.half_m = 0.4, .half_rad = 0.1}, {.half_m = 0.2, .half_rad = 0.05}, {.half_m = 0.1, .half_rad = 0.025}};

const Mapping nobody{};  // polled, and inactive

TEST(FocusLevels, HalveOrFasterDownToTheFinest) {
  const auto levels = internal::make_focus_levels({.half_m = 0.5, .half_rad = 0.1});
  ASSERT_EQ(levels.size(), 7);  // 0.5 / 0.01 = 50 is between 2^5 and 2^6
  EXPECT_DOUBLE_EQ(levels.front().half_m, 0.5);
  EXPECT_NEAR(levels.back().half_m, internal::finest_level.half_m, 1e-12);
  EXPECT_NEAR(levels.back().half_rad, internal::finest_level.half_rad, 1e-12);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_LT(levels[i].half_rad, levels[i - 1].half_rad);
    EXPECT_GT(levels[i].half_m, 0.5 * levels[i - 1].half_m - 1e-12);
  }
}

TEST(FocusLevels, APriorAsSmallAsTheFinestHasOne) {
  EXPECT_EQ(internal::make_focus_levels({.half_m = 0.001, .half_rad = 0.001}).size(), 1);
}

TEST(Cells, AreActiveAfterATestThatPassesAtTheTop) {
  Cells cells(1, three_levels);
  CounterRng rng(1);
  cells.place(0, {1.0, 2.0, 0.5});
  cells.pass(0, nobody, rng);
  cells.publish();
  EXPECT_TRUE(cells.mapping(0).active);
  EXPECT_FALSE(cells.mapping(0).focused);
  EXPECT_EQ(cells.mapping(0).T_map_robot, (Pose2{1.0, 2.0, 0.5}));
  EXPECT_EQ(cells.level(0), 1);
}

TEST(Cells, AreInactiveAfterATestThatFailsAtTheTop) {
  Cells cells(1, three_levels);
  cells.place(0, {1.0, 2.0, 0.5});
  cells.fail(0);
  cells.publish();
  EXPECT_FALSE(cells.mapping(0).active);
  EXPECT_EQ(cells.level(0), 0);
}

TEST(Cells, MoveUpToTheRegionThatTheyCameFromAndStayActive) {
  Cells cells(1, three_levels);
  CounterRng rng(1);
  cells.place(0, {1.0, 2.0, 0.5});
  cells.pass(0, nobody, rng);
  cells.pass(0, nobody, rng);
  EXPECT_EQ(cells.level(0), 2);
  cells.fail(0);
  cells.fail(0);
  cells.publish();
  EXPECT_EQ(cells.level(0), 0);
  EXPECT_TRUE(cells.mapping(0).active);
  EXPECT_EQ(cells.T_map_robot(0), (Pose2{1.0, 2.0, 0.5}));
}

TEST(Cells, MoveUpTwoLevelsOrBecomeInactive) {
  Cells cells(2, three_levels);
  CounterRng rng(1);
  for (const std::size_t cell : {0, 1}) {
    cells.place(cell, {1.0, 2.0, 0.5});
    cells.pass(cell, nobody, rng);
  }
  cells.pass(0, nobody, rng);
  cells.fail(0, 2);
  cells.fail(1, 2);
  cells.publish();
  EXPECT_TRUE(cells.mapping(0).active);
  EXPECT_EQ(cells.T_map_robot(0), (Pose2{1.0, 2.0, 0.5}));
  EXPECT_FALSE(cells.mapping(1).active);
  EXPECT_EQ(cells.level(1), 0);
}

TEST(Cells, StartBelowTheTopWhereThePriorTellsAsMuch) {
  Cells cells(1, three_levels);
  cells.place(0, {1.0, 2.0, 0.5}, 2);
  EXPECT_EQ(cells.level(0), 2);
  for (const std::size_t level : {1, 0}) {  // up to regions around the same place
    cells.fail(0);
    EXPECT_EQ(cells.level(0), level);
    EXPECT_EQ(cells.T_map_robot(0), (Pose2{1.0, 2.0, 0.5}));
  }
}

TEST(Cells, MoveDownToThePartWhereADeeperCellOfTheirRegionIs) {
  const Mapping deeper{.T_map_robot = {1.39, 1.61, 0.59}, .active = true, .focused = false, .level = 2};
  Mapping inactive = deeper;
  inactive.active = false;
  Mapping no_deeper = deeper;
  no_deeper.level = 0;
  Mapping outside = deeper;
  outside.T_map_robot.theta_rad = 0.61;
  const auto parts_that_hold_it = [&](const Mapping& polled) {
    int near = 0;
    for (std::uint32_t i = 0; i < 100; ++i) {
      Cells cells(1, three_levels);
      CounterRng rng(9, i);
      cells.place(0, {1.0, 2.0, 0.5});
      cells.pass(0, polled, rng);
      EXPECT_EQ(cells.level(0), 1);
      const Pose2& T_map_part = cells.T_map_robot(0);
      near += std::abs(T_map_part.x_m - 1.39) <= 0.1 && std::abs(T_map_part.y_m - 1.61) <= 0.1 &&
                      std::abs(T_map_part.theta_rad - 0.59) <= 0.025
                  ? 1
                  : 0;
    }
    return near;
  };
  EXPECT_EQ(parts_that_hold_it(deeper), 100);
  EXPECT_EQ(parts_that_hold_it(inactive), 0);  // random parts reach no farther than 0.2 m
  EXPECT_EQ(parts_that_hold_it(no_deeper), 0);
  EXPECT_EQ(parts_that_hold_it(outside), 0);
}

TEST(Cells, MoveDownIntoPartsOfTheirRegion) {
  int moved = 0;
  for (std::uint32_t i = 0; i < 300; ++i) {
    Cells cells(1, three_levels);
    CounterRng rng(7, i);
    cells.place(0, {1.0, 2.0, 0.5});
    cells.pass(0, nobody, rng);
    const Pose2& T_map_part = cells.T_map_robot(0);
    EXPECT_LE(std::abs(T_map_part.x_m - 1.0), 0.2);
    EXPECT_LE(std::abs(T_map_part.y_m - 2.0), 0.2);
    EXPECT_LE(std::abs(T_map_part.theta_rad - 0.5), 0.05);
    moved += T_map_part == Pose2{1.0, 2.0, 0.5} ? 0 : 1;
  }
  EXPECT_NEAR(moved, 225, 30);  // one in four stays in the middle
}

TEST(Cells, AreFocusedAfterSeveralTestsAtTheFinestLevelAndStayThere) {
  Cells cells(1, std::span(three_levels).last(1));
  CounterRng rng(1);
  cells.place(0, {1.0, 2.0, 0.5});
  for (const bool focused : {false, false, true, true}) {
    cells.pass(0, nobody, rng);
    cells.publish();
    EXPECT_EQ(cells.mapping(0).focused, focused);
    EXPECT_EQ(cells.T_map_robot(0), (Pose2{1.0, 2.0, 0.5}));
  }
  cells.fail(0);
  cells.publish();
  EXPECT_FALSE(cells.mapping(0).focused);
  EXPECT_FALSE(cells.mapping(0).active);  // the finest level is the top here: the plain network
}

TEST(Cells, CopiesBeginAtTheTopAroundTheirDonor) {
  for (std::uint32_t i = 0; i < 50; ++i) {
    Cells cells(1, three_levels);
    CounterRng rng(3, i);
    cells.place(0, {5.0, 5.0, 0.0});
    cells.pass(0, nobody, rng);
    cells.copy(0, {1.0, 2.0, 0.5}, rng);
    EXPECT_EQ(cells.level(0), 0);
    EXPECT_LE(std::abs(cells.T_map_robot(0).x_m - 1.0), 0.4);
    EXPECT_LE(std::abs(cells.T_map_robot(0).theta_rad - 0.5), 0.1);
  }
}

TEST(Clusters, TheLargestIsAveragedWithACircularHeading) {
  std::vector<Mapping> mappings;
  for (const double off : {-0.01, 0.0, 0.01})
    mappings.push_back({.T_map_robot = {1.0 + off, 2.0 - off, wrap_angle(std::numbers::pi + off)},
                        .active = true,
                        .focused = true});
  mappings.push_back({.T_map_robot = {7.0, 7.0, 0.0}, .active = true, .focused = true});
  for (int i = 0; i < 9; ++i)  // more, but none that has focused
    mappings.push_back({.T_map_robot = {5.0, 5.0, 0.0}, .active = true, .focused = false});
  const FocusLevel reach{.half_m = 0.05, .half_rad = 0.05};
  const internal::Cluster cluster = internal::largest_cluster(mappings, reach);
  EXPECT_EQ(cluster.cells, 3);
  EXPECT_NEAR(cluster.T_map_robot.x_m, 1.0, 1e-12);
  EXPECT_NEAR(cluster.T_map_robot.y_m, 2.0, 1e-12);
  EXPECT_NEAR(angle_distance(cluster.T_map_robot.theta_rad, std::numbers::pi), 0.0, 1e-9);
  EXPECT_EQ(internal::largest_cluster(mappings, reach, internal::Counted::active).cells, 9);
  EXPECT_EQ(internal::largest_cluster({}, reach).cells, 0);
}

TEST(Equilibria, NeedALargeClusterThatKeepsItsSize) {
  internal::Equilibrium small({.cells = 100, .iterations = 4, .least_share = 0.2, .bound_share = 0.1});
  for (int i = 0; i < 20; ++i) EXPECT_FALSE(small.add(15));
  internal::Equilibrium growing({.cells = 100, .iterations = 4, .least_share = 0.2, .bound_share = 0.1});
  for (std::size_t z = 0; z <= 90; z += 10) EXPECT_FALSE(growing.add(z));
  EXPECT_FALSE(growing.add(90));  // 70, 80, 90, 90
  EXPECT_TRUE(growing.add(90));   // 80, 90, 90, 90: within 10 of 87.5
}

struct BandsOfARoom : ::testing::Test {
  const PreparedMap map{testing::empty_room(102, 82, 0.1)};  // 10 x 8 m within its walls
  const std::shared_ptr<const Sensor> sensor = testing::full_circle(360);
  const Pose2 T_map_robot{5.1, 4.1, 0.0};
  const Scan scan = testing::look(map, sensor, T_map_robot);
  const std::vector<FocusLevel> levels = internal::make_focus_levels({.half_m = 0.4, .half_rad = 0.15});
};

TEST_F(BandsOfARoom, HoldWhatThePosesOfARegionMeasure) {
  const internal::BeamBands all(scan, levels, {.region_share = 1.0, .map_noise_m = 0.0});
  for (std::size_t level = 0; level < levels.size(); ++level) {
    int held = 0;
    int asked = 0;
    for (std::uint32_t i = 0; i < 20; ++i) {
      CounterRng rng(11, i);
      const Pose2 T_map_other{T_map_robot.x_m + levels[level].half_m * (2.0 * rng.uniform() - 1.0),
                              T_map_robot.y_m + levels[level].half_m * (2.0 * rng.uniform() - 1.0),
                              levels[level].half_rad * (2.0 * rng.uniform() - 1.0)};
      const std::vector<float> simulated_m = simulate_ranges(map, *sensor, std::span(&T_map_other, 1));
      for (std::size_t b = 0; b < simulated_m.size(); ++b, ++asked)
        held += all.band(level, b).contains(simulated_m[b]) ? 1 : 0;
    }
    EXPECT_GT(held, 0.97 * asked) << "level " << level;
  }
}

TEST_F(BandsOfARoom, ShrinkWithTheLevelAndAreNarrowOnWallsThatAreMetHeadOn) {
  const internal::BeamBands bands(scan, levels, {});
  const auto width_m = [&](std::size_t level, std::size_t beam) {
    return bands.band(level, beam).high_m - bands.band(level, beam).low_m;
  };
  for (std::size_t level = 1; level < levels.size(); ++level)
    for (std::size_t b = 0; b < bands.size(); ++b)
      EXPECT_LE(width_m(level, b), width_m(level - 1, b) + 1e-6F);
  EXPECT_LT(width_m(0, 180), 0.5 * width_m(0, 180 + 35));  // beam 180 points along +x, at the wall
}

TEST_F(BandsOfARoom, LeaveOutInvalidBeamsAndAllowNothingHitWhereNothingWasHit) {
  Scan other = scan;
  other.ranges_m[3] = std::numeric_limits<float>::quiet_NaN();
  other.ranges_m[4] = 30.0F;
  const internal::BeamBands bands(other, levels, {});
  EXPECT_EQ(bands.size(), 359);
  EXPECT_EQ(bands.sensor_beam(3), 4);
  EXPECT_TRUE(bands.band(0, 3).contains(std::numeric_limits<float>::infinity()));
  EXPECT_FALSE(bands.band(0, 180).contains(std::numeric_limits<float>::infinity()));
}

TEST(Parameters, GrowWithWhatIsSearched) {
  EXPECT_EQ(internal::choose_cells(1.0), 48);
  EXPECT_EQ(internal::choose_cells(40'000.0), 280);
  EXPECT_EQ(internal::choose_cells(1e9), 4096);
  const internal::RunLimits limits = internal::choose_limits(1000.0, 128);
  EXPECT_GT(limits.draws, limits.rival_draws);
  EXPECT_GT(limits.iterations, 100);
}

TEST(Bands, TellABeamThroughAWallFromOneThatIsShortened) {
  const internal::Band band{.low_m = 2.0F, .high_m = 3.0F};
  EXPECT_TRUE(band.passes_wall(1.9F));
  EXPECT_FALSE(band.passes_wall(2.5F));
  EXPECT_FALSE(band.passes_wall(3.1F));
}

// 3.1: beacons among a prior of anywhere.
struct BeaconStarts : ::testing::Test {
  const PreparedMap map{testing::furnished_room()};
  const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, 0.02);
  const internal::SharedMask free = map.state().free_mask(0.0, 1);

  // Of cells drawn from anywhere and from a beacon.
  [[nodiscard]] std::vector<std::size_t> starts(double radius_m) const {
    const PosePrior prior{
        Mixture{{1.0, 1.0}, {{Anywhere{}}, {Beacons{{{.p_map = {3.0, 2.0}, .radius_m = radius_m}}}}}}};
    const internal::Domain domain = internal::make_domain(prior, lattice, free);
    const internal::PoseSampler sampler(lattice, domain);
    return internal::start_levels(sampler, levels);
  }
  const std::vector<FocusLevel> levels = internal::make_focus_levels({.half_m = 0.5, .half_rad = 0.0873});
};

TEST_F(BeaconStarts, AreAtTheFinestLevelWhoseRegionCoversTheDisc) {
  for (const double radius_m : {0.11, 0.2, 0.3}) {
    const std::vector<std::size_t> start = starts(radius_m);
    ASSERT_EQ(start.size(), 2);
    EXPECT_EQ(start[0], 0);
    const double slack_m = 2.0 * lattice.resolution_m;
    EXPECT_GE(levels[start[1]].half_m, radius_m - slack_m) << radius_m;
    EXPECT_LT(levels[start[1] + 1].half_m, radius_m + slack_m) << radius_m;
  }
  EXPECT_GT(starts(0.11)[1], starts(0.3)[1]);
}

TEST_F(BeaconStarts, AreAtTheTopWhereNoRegionCoversTheDisc) {
  EXPECT_EQ(starts(1.0)[1], 0);
}

TEST(PoseSampler, DrawsFromThePriorAlone) {
  const PreparedMap map(testing::furnished_room());
  const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, 0.1);
  const internal::SharedMask free = map.state().free_mask(0.0, 1);
  const Window window{{2.0, 2.0, 3.0}, 0.6, 0.4, 0.5};
  const Gaussian gaussian{{6.0, 3.0, 0.0}, {0.04, 0, 0, 0, 0.04, 0, 0, 0, 0.01}};
  const PosePrior prior{Mixture{{1.0, 3.0}, {{window}, {gaussian}}}};
  const internal::Domain domain = internal::make_domain(prior, lattice, free);
  const internal::PoseSampler sampler(lattice, domain);
  int in_window = 0;
  double mean_x_m = 0.0;
  constexpr int draws = 4000;
  for (std::uint32_t i = 0; i < draws; ++i) {
    CounterRng rng(5, i);
    const Pose2 T_map_robot = sampler.draw(rng);
    const CellIndex cell = map.grid().cell_of({T_map_robot.x_m, T_map_robot.y_m});
    EXPECT_EQ(map.grid().at(cell), Occupancy::free);
    if (T_map_robot.x_m < 4.0) {
      ++in_window;
      EXPECT_LE(std::abs(T_map_robot.x_m - 2.0), 0.65 + 1e-9);
      EXPECT_LE(angle_distance(T_map_robot.theta_rad, 3.0), 0.5 + 0.05 + 1e-9);
    } else {
      mean_x_m += T_map_robot.x_m;
    }
  }
  EXPECT_NEAR(in_window, 0.25 * draws, 5 * std::sqrt(draws * 0.25 * 0.75));
  EXPECT_NEAR(mean_x_m / (draws - in_window), 6.0, 0.03);
}

// Else what is searched would be as large as the step: networks that do not end.
TEST(PoseSampler, StepsWiderThanTheMapStayOnIt) {
  GridMap grid = testing::furnished_room();
  grid.cells.front() = Occupancy::free;
  const PreparedMap map(grid);
  const internal::Lattice lattice = internal::make_lattice(grid, 10'000 * grid.resolution_m, 0.1);
  const internal::Domain domain =
      internal::make_domain({Anywhere{}}, lattice, map.state().free_mask(0.0, lattice.step_cells));
  ASSERT_EQ(domain.poses, lattice.headings);
  const internal::PoseSampler sampler(lattice, domain);
  const double width_m = grid.width_cells * grid.resolution_m;
  const double height_m = grid.height_cells * grid.resolution_m;
  EXPECT_NEAR(sampler.volume(), width_m * height_m * 2.0 * std::numbers::pi, 1e-6 * sampler.volume());
  bool far_side = false;
  for (std::uint32_t i = 0; i < 1000; ++i) {
    CounterRng rng(5, i);
    const Pose2 T_grid_robot = inverse(grid.T_map_grid) * sampler.draw(rng);
    ASSERT_GE(std::min(T_grid_robot.x_m, T_grid_robot.y_m), -1e-9);
    ASSERT_LE(T_grid_robot.x_m, width_m + 1e-9);
    ASSERT_LE(T_grid_robot.y_m, height_m + 1e-9);
    far_side = far_side || T_grid_robot.x_m > 0.9 * width_m;
  }
  EXPECT_TRUE(far_side);
}

}  // namespace
}  // namespace landfall
