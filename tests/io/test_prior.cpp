#include <numbers>

#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

class PriorFile : public IoTest {
 protected:
  PosePrior load(const std::string& json) const { return load_prior(write("prior.json", json)); }
  template <typename Kind>
  Kind load_as(const std::string& json) const {
    return std::get<Kind>(load(json).kind);
  }
  void expect_fault(const std::string& json, const std::vector<std::string>& parts) const {
    expect_error([&] { load(json); }, ErrorCode::file_format, parts);
  }
};

TEST_F(PriorFile, Kinds) {
  EXPECT_TRUE(std::holds_alternative<Anywhere>(load("\"anywhere\"").kind));
  EXPECT_TRUE(std::holds_alternative<Anywhere>(load("{\"anywhere\": {}}").kind));

  const auto window =
      load_as<Window>(R"({"window": {"T_map_robot": [1, 2, 3], "half_x_m": 4, "half_theta_rad": 0.5}})");
  EXPECT_EQ(window.T_map_robot, (Pose2{.x_m = 1, .y_m = 2, .theta_rad = 3}));
  EXPECT_EQ(window.half_x_m, 4.0);
  EXPECT_EQ(window.half_y_m, 0.5);
  EXPECT_EQ(window.half_theta_rad, 0.5);

  const auto gaussian = load_as<Gaussian>(
      R"({"gaussian": {"T_map_robot": [1, 2, 3], "covariance": [1, 0, 0, 0, 2, 0, 0, 0, 3]}})");
  EXPECT_EQ(gaussian.covariance[4], 2.0);

  const auto region =
      load_as<Region>(R"({"region": {"polygon_map": [[0, 0], [4, 0], [0, 3]], "theta_rad": 1}})");
  EXPECT_EQ(region.polygon_map.at(2), (Point2{.x_m = 0, .y_m = 3}));
  EXPECT_EQ(region.half_theta_rad, std::numbers::pi);

  const auto beacons = load_as<Beacons>(R"({"beacons": [{"p_map": [1, 2], "radius_m": 3}]})");
  EXPECT_EQ(beacons.discs.at(0).radius_m, 3.0);

  const auto poses = load_as<CandidatePoses>(R"({"poses": [[1, 2, 3], [4, 5, 6]]})");
  EXPECT_EQ(poses.T_map_robot.at(1), (Pose2{.x_m = 4, .y_m = 5, .theta_rad = 6}));

  const auto mixture = load_as<Mixture>(
      R"({"mixture": [{"weight": 0.25, "prior": "anywhere"}, {"weight": 3, "prior": {"poses": [[0, 0, 0]]}}]})");
  EXPECT_EQ(mixture.weights, (std::vector<double>{0.25, 3.0}));
  EXPECT_TRUE(std::holds_alternative<CandidatePoses>(mixture.components.at(1).kind));
}

TEST_F(PriorFile, Faults) {
  expect_fault("", {"prior.json:1: column 1"});
  expect_fault("\"nowhere\"", {"prior.json: found 'nowhere', expected \"anywhere\""});
  expect_fault("{}", {"found an object, expected \"anywhere\", or an object with one of"});
  expect_fault(R"({"circle": {}})", {"a field 'circle'", "window"});
  expect_fault(R"({"window": {}, "poses": []})", {"an object with one of"});
  expect_fault(R"({"window": {"half_x_m": 1}})", {"window.T_map_robot: found nothing"});
  expect_fault(R"({"window": {"T_map_robot": [0, 0, 0], "half_z_m": 1}})",
               {"window: found a field 'half_z_m'"});
  expect_fault(R"({"window": {"T_map_robot": [0, 0, 0], "half_x_m": -1}})", {"prior.json: ", "half_x_m"});
  expect_fault(R"({"window": {"T_map_robot": [0, 0, "x"]}})", {"window.T_map_robot[2]: found 'x'"});
  expect_fault(R"({"gaussian": {"T_map_robot": [0, 0, 0], "covariance": [1]}})",
               {"gaussian.covariance", "9 numbers"});
  expect_fault(R"({"region": {"polygon_map": [[0, 0], [1, 1]]}})", {"prior.json: "});
  expect_fault(R"({"beacons": []})", {"prior.json: "});
  expect_fault(R"({"beacons": [{"p_map": [0, 0]}]})", {"beacons[0].radius_m: found nothing"});
  expect_fault(R"({"poses": [[0, 0]]})", {"poses[0]: found a list of 2"});
  expect_fault(R"({"mixture": [{"prior": "anywhere"}]})", {"mixture[0].weight: found nothing"});
  expect_fault(R"({"mixture": [{"weight": -1, "prior": "anywhere"}]})", {"prior.json: ", "weight"});
  std::string nested = "\"anywhere\"";
  for (int i = 0; i < 1000; ++i) nested = R"({"mixture": [{"weight": 1, "prior": )" + nested + "}]}";
  expect_fault(nested, {"nested at most 8"});
}

}  // namespace
}  // namespace landfall::testing
