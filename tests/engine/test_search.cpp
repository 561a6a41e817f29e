// search(): what it refuses, when it has nothing to say, and that a batch is its scans one by one.
#include "landfall/search.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <stop_token>
#include <thread>

#include "drawn_map.hpp"
#include "landfall/error.hpp"
#include "rooms.hpp"
#include "same_answer.hpp"

namespace landfall {
namespace {

using testing::furnished_room;
using ::testing::HasSubstr;
using testing::look;
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

const SearchOptions coarse{.rotation_step_rad = 0.05};

struct InARoom : ::testing::Test {
  const PreparedMap map{furnished_room()};
  const Pose2 T_map_robot{2.31, 3.17, 0.4};
  const Scan scan = look(map, testing::full_circle(120), T_map_robot);

  [[nodiscard]] Scan scan_of(float range_m) const {
    Scan same = scan;
    same.ranges_m.assign(same.ranges_m.size(), range_m);
    return same;
  }
  // The message of the error that a search with these options throws; empty: none.
  [[nodiscard]] std::string refusal(const SearchOptions& options,
                                    ErrorCode code = ErrorCode::invalid_argument) const {
    try {
      search(map, {Anywhere{}}, scan, options);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), code);
      return error.what();
    }
    return {};
  }
};

using SearchInARoom = InARoom;

TEST_F(SearchInARoom, FindsTheRobot) {
  for (const char* method : {"auto", "branch_and_bound", "exhaustive"}) {
    SearchOptions options = coarse;
    options.method = method;
    const SearchResult result = search(map, {Anywhere{}}, scan, options);
    ASSERT_FALSE(result.hypotheses.empty());
    const Hypothesis& best = result.hypotheses.front();
    EXPECT_LT(translation_distance(best.T_map_robot, T_map_robot), 0.05);
    EXPECT_LT(angle_distance(best.T_map_robot.theta_rad, T_map_robot.theta_rad), 0.01);
    EXPECT_EQ(result.verdict, Verdict::found);
    EXPECT_GE(best.probability, 0.95);
    EXPECT_GE(best.explained, 0.95);
    EXPECT_TRUE(result.proven);
    EXPECT_EQ(result.reason, "");
    EXPECT_EQ(result.beams_valid, 120);
    EXPECT_EQ(result.beams_echo, 120);
    const auto free_cells = std::count(map.grid().cells.begin(), map.grid().cells.end(), Occupancy::free);
    EXPECT_EQ(result.counts.poses_covered, 126 * free_cells);
    EXPECT_LE(result.counts.poses_scored, result.counts.poses_covered);
    EXPECT_THAT(result.method, HasSubstr(std::string(method) == "auto" ? "branch_and_bound" : method));
    EXPECT_THAT(result.method, HasSubstr(active_isa()));
  }
}

TEST_F(SearchInARoom, HypothesesAreDistinctRankedAndShareOne) {
  SearchOptions options = coarse;
  options.max_hypotheses = 20;
  options.distinct_translation_m = 1.0;
  const SearchResult result = search(map, {Anywhere{}}, scan, options);
  double sum = 0.0;
  for (std::size_t i = 0; i < result.hypotheses.size(); ++i) {
    const Hypothesis& one = result.hypotheses[i];
    sum += one.probability;
    if (i > 0) {
      EXPECT_LE(one.probability, result.hypotheses[i - 1].probability);
    }
    for (std::size_t j = 0; j < i; ++j) {
      const Pose2& other = result.hypotheses[j].T_map_robot_unrefined;
      EXPECT_TRUE(translation_distance(one.T_map_robot_unrefined, other) >= options.distinct_translation_m ||
                  angle_distance(one.T_map_robot_unrefined.theta_rad, other.theta_rad) >=
                      options.distinct_rotation_rad);
    }
  }
  EXPECT_LE(sum, 1.0 + 1e-9);
}

TEST_F(SearchInARoom, BadOptionsAreNamed) {
  struct Bad {
    const char* option;
    std::function<void(SearchOptions&)> set;
  };
  const std::vector<Bad> cases{
      {"max_hypotheses", [](SearchOptions& o) { o.max_hypotheses = 0; }},
      {"max_hypotheses", [](SearchOptions& o) { o.max_hypotheses = 1001; }},
      {"threads", [](SearchOptions& o) { o.threads = -1; }},
      {"threads", [](SearchOptions& o) { o.threads = 5000; }},
      {"time_budget_s", [](SearchOptions& o) { o.time_budget_s = -1.0; }},
      {"time_budget_s", [](SearchOptions& o) { o.time_budget_s = not_a_number; }},
      {"robot_radius_m", [](SearchOptions& o) { o.robot_radius_m = -0.1; }},
      {"robot_radius_m", [](SearchOptions& o) { o.robot_radius_m = not_a_number; }},
      {"distinct_translation_m", [](SearchOptions& o) { o.distinct_translation_m = -1.0; }},
      {"distinct_rotation_rad", [](SearchOptions& o) { o.distinct_rotation_rad = not_a_number; }},
      {"translation_step_m", [](SearchOptions& o) { o.translation_step_m = 0.15; }},
      {"translation_step_m", [](SearchOptions& o) { o.translation_step_m = -0.1; }},
      {"translation_step_m", [](SearchOptions& o) { o.translation_step_m = not_a_number; }},
      {"rotation_step_rad", [](SearchOptions& o) { o.rotation_step_rad = 0.0; }},
      {"rotation_step_rad", [](SearchOptions& o) { o.rotation_step_rad = 7.0; }},
      {"rotation_step_rad", [](SearchOptions& o) { o.rotation_step_rad = not_a_number; }},
  };
  for (const Bad& bad : cases) {
    SearchOptions options = coarse;
    bad.set(options);
    EXPECT_THAT(refusal(options), HasSubstr(bad.option));
  }
  EXPECT_EQ(refusal(coarse), "");
}

TEST_F(SearchInARoom, UnknownMethodListsTheKnownOnes) {
  SearchOptions options = coarse;
  options.method = "clairvoyance";
  const std::string message = refusal(options, ErrorCode::unknown_name);
  EXPECT_THAT(message, HasSubstr("clairvoyance"));
  EXPECT_THAT(message, HasSubstr("auto"));
  for (const MethodInfo& method : methods()) EXPECT_THAT(message, HasSubstr(std::string(method.name)));
}

TEST_F(SearchInARoom, NumbersOfMapsPriorsAndScansMustFit) {
  const std::vector<Scan> three(3, scan);
  const std::vector<PosePrior> two(2, PosePrior{Anywhere{}});
  EXPECT_THROW(search(map, two, three, coarse), Error);
  EXPECT_THROW(search(map, std::span<const PosePrior>(), three, coarse), Error);
  EXPECT_THROW(search(std::span<const PreparedMap>(), two, three, coarse), Error);
  EXPECT_TRUE(search(map, {Anywhere{}}, std::span<const Scan>(), coarse).empty());
}

TEST_F(SearchInARoom, BadScansAndPriorsAreRefused) {
  Scan short_of_one = scan;
  short_of_one.ranges_m.pop_back();
  EXPECT_THROW(search(map, {Anywhere{}}, short_of_one, coarse), Error);
  EXPECT_THROW(search(map, {Anywhere{}}, Scan{}, coarse), Error);
  EXPECT_THROW(search(map, {Window{{0, 0, 0}, -1.0, 1.0, 1.0}}, scan, coarse), Error);
  EXPECT_THROW(search(map, {Beacons{}}, scan, coarse), Error);
}

TEST_F(SearchInARoom, APriorEntirelyOffTheMapIsAnError) {
  try {
    search(map, {Window{{100.0, 3.0, 0.0}, 1.0, 1.0, 1.0}}, scan, coarse);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    EXPECT_THAT(error.what(),
                HasSubstr("prior lies entirely off the map: it is at (100, 3) m, and the map spans x "));
  }
}

TEST_F(SearchInARoom, NothingToGoByIsLostWithAReason) {
  const auto expect_lost = [&](const PosePrior& prior, const Scan& asked, const char* reason) {
    const SearchResult result = search(map, prior, asked, coarse);
    EXPECT_EQ(result.verdict, Verdict::lost);
    EXPECT_THAT(result.reason, HasSubstr(reason));
    EXPECT_TRUE(result.hypotheses.empty());
    EXPECT_FALSE(result.proven);
  };
  expect_lost({Anywhere{}}, scan_of(std::numeric_limits<float>::quiet_NaN()), "no valid beam");
  expect_lost({Anywhere{}}, scan_of(-1.0F), "no valid beam");
  expect_lost({Anywhere{}}, scan_of(30.0F), "no beam has an echo");
  expect_lost({Anywhere{}}, scan_of(std::numeric_limits<float>::infinity()), "no beam has an echo");
  expect_lost({Window{{2.0, 4.8, 0.0}, 0.1, 0.1, 1.0}}, scan, "no free cell");  // within the cupboard
}

TEST_F(SearchInARoom, AScanFromElsewhereIsLost) {
  // 20 m all around: every echo is off the map from every pose.
  const SearchResult result = search(map, {Anywhere{}}, scan_of(20.0F), coarse);
  EXPECT_EQ(result.verdict, Verdict::lost);
  EXPECT_THAT(result.reason, HasSubstr("no echo falls near a wall"));
  EXPECT_TRUE(result.hypotheses.empty());
  EXPECT_TRUE(result.proven);  // that nothing scores
}

TEST_F(SearchInARoom, ABudgetGivesTheBestSoFar) {
  SearchOptions options{
      .method = "exhaustive", .rotation_step_rad = 2.0 * std::numbers::pi / 36'000, .time_budget_s = 0.2};
  const SearchResult result = search(map, {Anywhere{}}, scan, options);
  EXPECT_FALSE(result.proven);
  EXPECT_LT(result.times.propose_ms, 3000.0);
  EXPECT_FALSE(result.hypotheses.empty());
  options.method = "branch_and_bound";
  options.time_budget_s = 1e-9;
  const SearchResult nothing_yet = search(map, {Anywhere{}}, scan, options);
  EXPECT_FALSE(nothing_yet.proven);
  EXPECT_NE(nothing_yet.verdict, Verdict::found);
  options.time_budget_s = 1000.0;
  options.rotation_step_rad = coarse.rotation_step_rad;
  EXPECT_TRUE(search(map, {Anywhere{}}, scan, options).proven);
}

TEST_F(SearchInARoom, ABudgetBeyondAllClocksIsNone) {
  SearchOptions options = coarse;
  for (const double budget_s : {1e10, 1e300}) {
    options.time_budget_s = budget_s;
    const SearchResult result = search(map, {Anywhere{}}, scan, options);
    EXPECT_TRUE(result.proven) << budget_s;
    EXPECT_EQ(result.verdict, Verdict::found) << budget_s;
  }
}

// The map's origin is free here: what was not computed must not pass for the pose (0, 0, 0).
TEST(TimeBudget, PosesThatNobodyLookedAtAreNoAnswer) {
  const PreparedMap map(furnished_room({-4.0, -3.0, 0.0}));
  const Scan scan = look(map, testing::full_circle(120), {0.3, 0.2, 0.1});
  for (const char* method : {"pso", "icp", "icp_point_to_line", "angle_histogram", "fsdn"}) {
    const SearchResult result =
        search(map, {Anywhere{}}, scan, {.method = method, .rotation_step_rad = 0.05, .time_budget_s = 1e-9});
    EXPECT_TRUE(result.hypotheses.empty()) << method;
    EXPECT_EQ(result.counts.poses_scored, 0) << method;
    EXPECT_THAT(result.reason, HasSubstr("time budget")) << method;
  }
}

// So far away that no point counts: a share of nothing is no perfect one.
TEST_F(SearchInARoom, EchoesBeyondAllMapsProveNothing) {
  const auto far_sighted = testing::full_circle(8, 1e6);
  const Scan far{.sensor = far_sighted, .ranges_m = std::vector<float>(8, 4e5F)};
  std::size_t offered = 0;
  for (const MethodInfo& method : methods()) {
    SearchOptions options = coarse;
    options.method = method.name;
    const SearchResult result = search(map, {Window{T_map_robot, 0.3, 0.3, 0.2}}, far, options);
    EXPECT_EQ(result.verdict, Verdict::lost) << method.name;
    for (const Hypothesis& one : result.hypotheses) EXPECT_LT(one.probability, 0.01) << method.name;
    offered += result.hypotheses.size();
  }
  EXPECT_GT(offered, 0U);  // by scan matchers: their starts
}

// `grid` casts the scan's beams from each pose that it compares, and those it answers once more.
TEST_F(SearchInARoom, RaysThatTellPosesApartAreCounted) {
  SearchOptions options = coarse;
  options.method = "grid";
  const SearchResult result = search(map, {Window{T_map_robot, 0.3, 0.3, 0.2}}, scan, options);
  ASSERT_FALSE(result.hypotheses.empty());
  EXPECT_GT(result.counts.rays_cast, 20 * 120);
  EXPECT_EQ(result.counts.rays_cast % 120, 0);
}

TEST_F(SearchInARoom, AStopEndsASearchThatIsUnderWay) {
  std::stop_source source;
  const SearchOptions options{.method = "exhaustive",
                              .rotation_step_rad = 2.0 * std::numbers::pi / 36'000,
                              .threads = 1,
                              .stop = source.get_token()};
  const std::vector<Scan> scans(200, scan);  // minutes of work
  std::thread stopper([&source] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    source.request_stop();
  });
  const auto start = std::chrono::steady_clock::now();
  const std::vector<SearchResult> results = search(map, {Anywhere{}}, scans, options);
  const std::chrono::duration<double> took_s = std::chrono::steady_clock::now() - start;
  stopper.join();
  EXPECT_LT(took_s.count(), 20.0);
  ASSERT_EQ(results.size(), scans.size());
  EXPECT_FALSE(results.back().proven);
  EXPECT_EQ(results.back().verdict, Verdict::lost);
  EXPECT_EQ(results.back().reason, "stopped before any pose was scored");
}

TEST_F(SearchInARoom, ATokenThatNobodyPullsChangesNothing) {
  std::stop_source source;
  SearchOptions options = coarse;
  const SearchResult without = search(map, {Anywhere{}}, scan, options);
  options.stop = source.get_token();
  const SearchResult with = search(map, {Anywhere{}}, scan, options);
  EXPECT_TRUE(with.proven);
  ASSERT_EQ(with.hypotheses.size(), without.hypotheses.size());
  EXPECT_EQ(with.hypotheses[0].score, without.hypotheses[0].score);
  EXPECT_EQ(with.hypotheses[0].T_map_robot, without.hypotheses[0].T_map_robot);
}

TEST_F(SearchInARoom, ABatchEqualsItsScansOneByOne) {
  std::vector<Scan> scans;
  std::vector<PosePrior> priors;
  for (int i = 0; i < 12; ++i) {
    const Pose2 truth{1.0 + 0.5 * i, 1.5, 0.3 * i};
    scans.push_back(i == 4 ? scan_of(30.0F) : look(map, testing::full_circle(40 + 10 * i), truth));
    scans.back().stamp_s = i;
    if (i % 2 == 0)
      priors.push_back({Anywhere{}});
    else
      priors.push_back({Window{truth, 1.0, 1.0, 1.0}});
  }
  std::vector<SearchResult> alone;
  for (std::size_t i = 0; i < scans.size(); ++i) alone.push_back(search(map, priors[i], scans[i], coarse));
  for (const int threads : {0, 1, 2}) {
    SearchOptions options = coarse;
    options.threads = threads;
    const std::vector<SearchResult> batch = search(map, priors, scans, options);
    ASSERT_EQ(batch.size(), scans.size());
    for (std::size_t i = 0; i < scans.size(); ++i) {
      EXPECT_EQ(batch[i].stamp_s, static_cast<double>(i));
      testing::expect_same_answer(batch[i], alone[i]);
    }
  }
  std::reverse(scans.begin(), scans.end());
  std::reverse(priors.begin(), priors.end());
  const std::vector<SearchResult> reversed = search(map, priors, scans, coarse);
  for (std::size_t i = 0; i < scans.size(); ++i)
    testing::expect_same_answer(reversed[i], alone[scans.size() - 1 - i]);
}

TEST(Methods, AreListedWithTheirSources) {
  std::vector<std::string> names;
  for (const MethodInfo& method : methods()) {
    names.emplace_back(method.name);
    EXPECT_FALSE(method.summary.empty());
  }
  EXPECT_THAT(names, ::testing::IsSupersetOf({"exhaustive", "branch_and_bound"}));
}

}  // namespace
}  // namespace landfall
