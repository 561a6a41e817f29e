// The likelihood of ranges, against its mixture written out.
#include "engine/rank/beam_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "drawn_map.hpp"
#include "rooms.hpp"

namespace landfall::internal {
namespace {

constexpr float none = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr PoseSpacing exact{};

// As stated, rough, poor: what a scan's readings may be, all alike.
struct Quality {
  double log_prior, too_short, too_long, anything, no_echo_of_a_wall, off_m;
  [[nodiscard]] double hit() const { return 1.0 - too_short - too_long - anything; }
};
constexpr Quality qualities[] = {
    {-0.1, 0.06, 0.06, 0.02, 0.1, 0.0}, {-3.0, 0.15, 0.2, 0.05, 0.3, 0.1}, {-4.0, 0.25, 0.3, 0.1, 0.5, 0.25}};

// The log of the sum over qualities, each with its likelihood of the scan.
double summed(const std::function<double(const Quality&)>& likelihood) {
  double sum = 0.0;
  for (const Quality& quality : qualities) sum += std::exp(quality.log_prior) * likelihood(quality);
  return std::log(sum);
}

double gaussian(double off_m, double variance) {
  return std::exp(-0.5 * off_m * off_m / variance) / std::sqrt(2.0 * std::numbers::pi * variance);
}

// A known floor around the robot, 40 m wide.
const GridMap& known_floor() {
  static const GridMap map = testing::empty_map(40, 40, 1.0, {-20.0, -20.0, 0.0});
  return map;
}

Scan scan_of(std::vector<float> ranges_m, double range_noise_relative = 0.0) {
  Sensor sensor{
      .name = "test", .beams = {}, .range_noise_m = 0.1, .range_noise_relative = range_noise_relative};
  sensor.beams.assign(ranges_m.size(), {.range_max_m = 10.0});
  return {.sensor = std::make_shared<const Sensor>(sensor), .ranges_m = std::move(ranges_m)};
}

double log_likelihood(const std::vector<float>& measured_m, const std::vector<float>& simulated_m,
                      const PoseSpacing& spacing = exact, double range_noise_relative = 0.0,
                      const GridMap& map = known_floor()) {
  return BeamModel(map, scan_of(measured_m, range_noise_relative)).log_likelihood({}, simulated_m, spacing);
}

TEST(BeamModel, AHitIsAGaussianOverWhatElseItMayBe) {
  EXPECT_NEAR(log_likelihood({4.0F}, {4.0F}), summed([](const Quality& q) {
                return q.hit() * gaussian(0.0, 0.01 + q.off_m * q.off_m) + q.anything / 10.0;
              }),
              1e-6);
  EXPECT_NEAR(log_likelihood({4.1F}, {4.0F}), summed([](const Quality& q) {
                return q.hit() * gaussian(0.1, 0.01 + q.off_m * q.off_m) + q.too_long / 6.0 +
                       q.anything / 10.0;
              }),
              1e-4);
}

TEST(BeamModel, TooShortAndTooLongLieBeforeAndBehindTheWall) {
  EXPECT_NEAR(log_likelihood({1.0F}, {4.0F}),
              summed([](const Quality& q) { return q.too_short / 4.0 + q.anything / 10.0; }), 1e-5);
  EXPECT_NEAR(log_likelihood({9.0F}, {4.0F}),
              summed([](const Quality& q) { return q.too_long / 6.0 + q.anything / 10.0; }), 1e-5);
}

TEST(BeamModel, AnEchoOfNothingAndNoEchoOfAWall) {
  EXPECT_NEAR(log_likelihood({3.0F}, {none}),
              summed([](const Quality& q) { return (q.too_short + q.anything) / 10.0; }), 1e-6);
  EXPECT_NEAR(log_likelihood({10.0F}, {none}),
              summed([](const Quality& q) { return 1.0 - q.too_short - q.anything; }), 1e-6);
  EXPECT_NEAR(log_likelihood({10.0F}, {3.0F}), summed([](const Quality& q) { return q.no_echo_of_a_wall; }),
              1e-6);
}

// A step of 0.6 m is 0.6 / sqrt(12) m, one sigma; one of 0.3 rad at 2 m as much.
TEST(BeamModel, NoiseGrowsWithTheRangeAndTheSpacingOfPoses) {
  const auto peak = [](double variance) {
    return summed([variance](const Quality& q) {
      return q.hit() * gaussian(0.0, variance + q.off_m * q.off_m) + q.anything / 10.0;
    });
  };
  EXPECT_NEAR(log_likelihood({2.0F}, {2.0F}, exact, 0.05), peak(0.04), 1e-6);
  EXPECT_NEAR(log_likelihood({2.0F}, {2.0F}, {.translation_m = 0.6}), peak(0.01 + 0.03), 1e-6);
  EXPECT_NEAR(log_likelihood({2.0F}, {2.0F}, {.rotation_rad = 0.3}), peak(0.01 + 0.03), 1e-6);
}

TEST(BeamModel, InvalidReadingsAreLeftOut) {
  const BeamModel model(known_floor(), scan_of({2.0F, nan, 3.0F}));
  EXPECT_EQ(model.beams().size(), 2u);
  EXPECT_EQ(log_likelihood({2.0F, nan, 3.0F}, {2.0F, 3.0F}), log_likelihood({2.0F, 3.0F}, {2.0F, 3.0F}));
}

TEST(BeamModel, BeamsBeyondTheTwentiethAddNothing) {
  const std::vector<float> twenty(20, 2.0F);
  const std::vector<float> eighty(80, 2.0F);
  EXPECT_NEAR(log_likelihood(eighty, eighty), log_likelihood(twenty, twenty), 1e-6);
  EXPECT_GT(log_likelihood(twenty, twenty), log_likelihood({2.0F}, {2.0F}) + 10.0);
}

// The robot looks from the free cell (0, 0) along x: cells from 3 m on are unknown. Twice the mean echo is 8
// m.
TEST(BeamModel, AnEchoFromAnUnknownCellIsAsLikelyAsElsewhere) {
  const GridMap map = testing::drawn_map({"...???????"}, 1.0, {0.0, -0.5, 0.0});
  EXPECT_NEAR(log_likelihood({4.0F}, {none}, exact, 0.0, map),
              summed([](const Quality& q) { return std::max(1.0 / 8.0, (q.too_short + q.anything) / 10.0); }),
              1e-6);
  EXPECT_LT(log_likelihood({2.0F}, {none}, exact, 0.0, map), std::log(0.05));  // from a free cell
  EXPECT_LT(log_likelihood({4.0F}, {2.0F}, exact, 0.0, map), std::log(0.05));  // from behind a wall
}

// Echoes at 2 and 4 m: anywhere within 6 m; one reading in three has none.
TEST(BeamModel, ElsewhereRangesAreAnything) {
  const BeamModel model(known_floor(), scan_of({2.0F, 4.0F, 10.0F}));
  EXPECT_NEAR(model.log_likelihood_elsewhere(), 2.0 * std::log(2.0 / 3.0 / 6.0) + std::log(1.0 / 3.0), 1e-9);
}

}  // namespace
}  // namespace landfall::internal
