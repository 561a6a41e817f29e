#include <cmath>
#include <numbers>

#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

class Trajectory : public IoTest {
 protected:
  std::vector<StampedPose> load(const std::string& tum) const {
    return load_trajectory(write("poses.tum", tum));
  }
  void expect_fault(const std::string& tum, const std::vector<std::string>& parts) const {
    expect_error([&] { load(tum); }, ErrorCode::file_format, parts);
  }
};

TEST_F(Trajectory, HeadingOfTheQuaternion) {
  // sin(45 deg) = cos(45 deg): a turn by 90 degrees; and minus that quaternion is the same turn.
  const auto poses = load(
      "# t tx ty tz qx qy qz qw\n\n1.5 1 2 9 0 0 0.70710678 0.70710678\r\n"
      "2 0 0 0 0 0 -0.70710678 -0.70710678\n3 0 0 0 0 0 1 0\n");
  ASSERT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses[0].stamp_s, 1.5);
  EXPECT_EQ(poses[0].pose.x_m, 1.0);
  EXPECT_EQ(poses[0].pose.y_m, 2.0);
  EXPECT_NEAR(poses[0].pose.theta_rad, std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(poses[1].pose.theta_rad, std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(poses[2].pose.theta_rad, std::numbers::pi, 1e-12);
}

TEST_F(Trajectory, SmallTiltIsLaidFlat) {
  // 4 degrees about x after 90 about z: qz = qw = cos(2 deg) / sqrt(2), qx = qy = sin(2 deg) / sqrt(2).
  const auto poses = load("1 0 0 0 0.0246777 0.0246777 0.7066760 0.7066760\n");
  EXPECT_NEAR(poses.at(0).pose.theta_rad, std::numbers::pi / 2, 1e-6);
}

TEST_F(Trajectory, SavedPosesReadBack) {
  std::vector<StampedPose> poses(100);
  for (int i = 0; i < 100; ++i)
    poses[static_cast<std::size_t>(i)] = {
        .stamp_s = 976052892.4424 + 0.1 * i,
        .pose = {.x_m = i / 7.0, .y_m = -i / 3.0, .theta_rad = wrap_angle(0.1 * i)}};
  save_trajectory(poses, at("poses.tum"));
  const auto back = load_trajectory(at("poses.tum"));
  ASSERT_EQ(back.size(), poses.size());
  for (std::size_t i = 0; i < poses.size(); ++i) {
    EXPECT_EQ(back[i].stamp_s, poses[i].stamp_s);
    EXPECT_EQ(back[i].pose.x_m, poses[i].pose.x_m);
    EXPECT_EQ(back[i].pose.y_m, poses[i].pose.y_m);
    EXPECT_NEAR(angle_distance(back[i].pose.theta_rad, poses[i].pose.theta_rad), 0.0, 1e-15);
  }
}

TEST_F(Trajectory, Faults) {
  expect_fault("1 0 0 0 0 0 0 1\n2 0 0 0 0 0 1\n", {"poses.tum:2: qw: found the end of the line"});
  expect_fault("1 0 0 0 0 0 0 1 5\n", {"poses.tum:1: column 9: found '5'"});
  expect_fault("1 x 0 0 0 0 0 1\n", {"poses.tum:1: tx: found 'x', expected a finite number"});
  expect_fault("nan 0 0 0 0 0 0 1\n", {"poses.tum:1: timestamp: found 'nan'"});
  expect_fault("1 0 0 0 0 0 nan 1\n", {"poses.tum:1: qz: found 'nan'"});
  expect_fault("1 0 0 0 0 0 0 0\n", {"poses.tum:1: qx qy qz qw: found a quaternion of length 0", "unit"});
  expect_fault("1 0 0 0 0 0 1 1\n", {"poses.tum:1: qx qy qz qw: found a quaternion of length 1.41"});
  expect_fault("1 0 0 0 0.7071068 0 0 0.7071068\n", {"poses.tum:1: qx qy qz qw: found a tilt of 1.57"});
  expect_error([&] { load_trajectory(at("none.tum")); }, ErrorCode::file_not_found, {"none.tum"});
}

}  // namespace
}  // namespace landfall::testing
