#include "engine/refine/settle.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "landfall/align.hpp"
#include "landfall/consistent.hpp"
#include "landfall/error.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

using ::testing::HasSubstr;

// Five scans along a furnished room, and where they were taken.
struct Settle : ::testing::Test {
  const PreparedMap map{testing::furnished_room({3.0, -2.0, 0.5})};
  std::vector<Scan> scans;
  std::vector<Pose2> T_map_robot;
  std::size_t reference = 4;

  void SetUp() override {
    map.prepare();
    for (int i = 0; i < 5; ++i) {
      T_map_robot.push_back(Pose2{3.0, -2.0, 0.5} * Pose2{2.0 + 0.5 * i, 2.0 + 0.1 * i, 0.15 * i});
      Scan scan = testing::look(map, testing::full_circle(90), T_map_robot.back());
      scan.T_odom_robot = Pose2{-3.0, 8.0, 2.0} * T_map_robot.back();
      scan.stamp_s = i;
      scans.push_back(scan);
    }
  }

  // The composite with all scans before `step` displaced.
  [[nodiscard]] Scan composite_off(std::size_t step, const Pose2& T_off,
                                   const RelativePoseNoise& noise) const {
    std::vector<Pose2> poses = T_map_robot;
    for (std::size_t i = 0; i < step; ++i) poses[i] = T_off * poses[i];
    return merge(scans, poses, reference, noise);
  }
  void expect_true(const std::vector<Pose2>& T_map_part, double within_m) const {
    ASSERT_EQ(T_map_part.size(), T_map_robot.size());
    for (std::size_t i = 0; i < T_map_part.size(); ++i) {
      EXPECT_LT(translation_distance(T_map_part[i], T_map_robot[i]), within_m) << i;
      EXPECT_LT(angle_distance(T_map_part[i].theta_rad, T_map_robot[i].theta_rad), 0.02) << i;
    }
  }
};

TEST_F(Settle, EveryScanFindsItsPlace) {
  for (std::size_t step = 1; step < 5; ++step) {
    SCOPED_TRACE(step);
    const Scan composite = composite_off(step, {0.06, -0.05, 0.01}, aligned_noise);
    expect_true(internal::settle(internal::SettleProblem(map.state(), composite),
                                 Pose2{0.02, 0.02, 0.005} * T_map_robot[4])
                    .front(),
                0.08);
  }
}

TEST_F(Settle, OneStepMayBeFarOff) {
  for (std::size_t step = 1; step < 5; ++step) {
    SCOPED_TRACE(step);
    const Scan composite = composite_off(step, {0.32, 0.18, 0.0}, aligned_noise);
    // The composite alone would stand somewhere between.
    const auto ways = internal::settle(internal::SettleProblem(map.state(), composite),
                                       Pose2{-0.15, -0.1, 0.0} * T_map_robot[4]);
    expect_true(ways.back(), 0.08);
  }
}

TEST_F(Settle, TheBestOfSeveralStartsWins) {
  const Scan composite = composite_off(0, {}, aligned_noise);
  std::vector<std::vector<Pose2>> starts{T_map_robot, T_map_robot, T_map_robot};
  for (Pose2& pose : starts[0]) pose.x_m += 1.0;
  for (Pose2& pose : starts[2]) pose.y_m -= 0.8;
  expect_true(internal::settle(internal::SettleProblem(map.state(), composite), starts), 0.06);
}

TEST_F(Settle, ScansWithoutEchoesStayWhereTheirNeighboursAre) {
  std::fill(scans[2].ranges_m.begin(), scans[2].ranges_m.end(), 30.0F);
  const Scan composite = composite_off(0, {}, aligned_noise);
  expect_true(internal::settle(internal::SettleProblem(map.state(), composite), T_map_robot[4]).front(),
              0.06);
}

TEST_F(Settle, RemountedBeamsEndWhereTheirScansSeeThem) {
  const Scan composite = composite_off(2, {0.1, 0.05, 0.02}, aligned_noise);
  const Scan settled = internal::remount(composite, T_map_robot);
  EXPECT_NO_THROW(validate(settled));
  for (std::size_t i = 0, beam = 0; i < scans.size(); ++i)
    for (std::size_t b = 0; b < scans[i].ranges_m.size(); ++b, ++beam) {
      const Point2 expected =
          T_map_robot[i] * scans[i].sensor->beams[b].T_robot_beam * Point2{scans[i].ranges_m[b], 0.0};
      const Point2 found =
          T_map_robot[4] * settled.sensor->beams[beam].T_robot_beam * Point2{settled.ranges_m[beam], 0.0};
      ASSERT_NEAR(found.x_m, expected.x_m, 1e-6);
      ASSERT_NEAR(found.y_m, expected.y_m, 1e-6);
    }
}

TEST_F(Settle, SearchMendsRelativePosesOnlyWhereTheyMayBeOff) {
  const Pose2 T_off{0.3, 0.2, 0.0};
  const SearchResult mended = search(map, PosePrior{}, composite_off(3, T_off, aligned_noise));
  EXPECT_LT(translation_distance(mended.hypotheses.at(0).T_map_robot, T_map_robot[4]), 0.08);
  EXPECT_GT(mended.hypotheses.at(0).explained, 0.97);
  const SearchResult given = search(map, PosePrior{}, composite_off(3, T_off, {}));
  EXPECT_LT(given.hypotheses.at(0).explained, 0.9);
}

TEST_F(Settle, PolishedPosesFitTogether) {
  std::vector<SearchResult> results(5);
  for (std::size_t i = 0; i < 5; ++i) {
    results[i].hypotheses.resize(2);
    results[i].hypotheses[0].T_map_robot = {90.0, 90.0, 0.0};
    results[i].hypotheses[1].T_map_robot = Pose2{i == 1 ? 0.2 : 0.03, -0.02, 0.01} * T_map_robot[i];
  }
  const std::vector<int> choice(5, 1);
  const auto polished = polish(std::span(&map, 1), scans, results, choice);
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LT(translation_distance(polished[i].hypotheses[1].T_map_robot, T_map_robot[i]), 0.06) << i;
    EXPECT_EQ(polished[i].hypotheses[0].T_map_robot, results[i].hypotheses[0].T_map_robot) << i;
    EXPECT_GT(polished[i].hypotheses[1].explained, 0.95) << i;  // of where it is now
    EXPECT_EQ(polished[i].hypotheses[0].explained, 0.0) << i;
  }
  const auto on_one_thread = polish(std::span(&map, 1), scans, results, choice, {}, 1);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_EQ(polished[i].hypotheses[1].T_map_robot, on_one_thread[i].hypotheses[1].T_map_robot) << i;
}

TEST_F(Settle, WhatAJumpPartsIsNotPolished) {
  std::vector<SearchResult> results(5);
  for (std::size_t i = 0; i < 5; ++i) {
    results[i].hypotheses.resize(1);
    results[i].hypotheses[0].T_map_robot = T_map_robot[i];
  }
  results[2].hypotheses[0].T_map_robot = {-40.0, 30.0, 1.0};
  results[4].hypotheses.clear();
  const auto polished = polish(std::span(&map, 1), scans, results, std::vector<int>{0, 0, 0, 0, -1});
  EXPECT_EQ(polished[2].hypotheses[0].T_map_robot, results[2].hypotheses[0].T_map_robot);
  EXPECT_EQ(polished[3].hypotheses[0].T_map_robot, results[3].hypotheses[0].T_map_robot);
  EXPECT_TRUE(polished[4].hypotheses.empty());
}

TEST_F(Settle, RefusesWhatIsNotThere) {
  const auto message = [](const auto& action) -> std::string {
    try {
      action();
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(message([&] { (void)composite_off(0, {}, {.translation_m = -0.1}); }),
              HasSubstr("translation_m is -0.1"));
  const std::vector<SearchResult> results(5);
  EXPECT_THAT(message([&] { polish(std::span(&map, 1), scans, results, std::vector<int>(4, -1)); }),
              HasSubstr("4 choices and 5 results"));
  EXPECT_THAT(message([&] { polish(std::span(&map, 1), scans, results, std::vector<int>(5, 0)); }),
              HasSubstr("choice 0 is 0 of 0"));
  Scan wrong = composite_off(0, {}, aligned_noise);
  wrong.parts->beams.pop_back();
  EXPECT_THAT(message([&] { validate(wrong); }), HasSubstr("parts have 360 beams, expected 450"));
}

}  // namespace
}  // namespace landfall
