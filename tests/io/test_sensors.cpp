#include <numbers>

#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

constexpr double pi = std::numbers::pi;

class Sensors : public IoTest {
 protected:
  auto load(const std::string& yaml) const { return load_sensors(write("sensor.yaml", yaml)); }
  void expect_fault(const std::string& yaml, const std::vector<std::string>& parts) const {
    expect_error([&] { load(yaml); }, ErrorCode::file_format, parts);
  }
  void expect_round_trip(const Sensor& sensor, bool as_fan) const {
    save_sensor(sensor, at("sensor.yaml"));
    const auto back = load_sensors(at("sensor.yaml"));
    ASSERT_TRUE(back.contains(sensor.name));
    EXPECT_EQ(*back.at(sensor.name), sensor);
    EXPECT_EQ(read(at("sensor.yaml")).find("\"fan\"") != std::string::npos, as_fan);
  }
};

TEST_F(Sensors, ListOfBeams) {
  const auto sensors = load(R"(name: pair
range_noise_m: 0.03
range_noise_relative: 0.01
beams:
  - {T_robot_beam: [0.1, 0.2, 1.5], half_angle_rad: 0.1, range_min_m: 0.2, range_max_m: 5}
  - T_robot_beam: [0, 0, -1]
    range_max_m: 4.0
)");
  const Sensor expected{.name = "pair",
                        .beams = {{.T_robot_beam = {.x_m = 0.1, .y_m = 0.2, .theta_rad = 1.5},
                                   .half_angle_rad = 0.1,
                                   .range_min_m = 0.2,
                                   .range_max_m = 5.0},
                                  {.T_robot_beam = {.theta_rad = -1.0}, .range_max_m = 4.0}},
                        .range_noise_m = 0.03,
                        .range_noise_relative = 0.01};
  ASSERT_EQ(sensors.size(), 1U);
  EXPECT_EQ(*sensors.at("pair"), expected);
}

TEST_F(Sensors, Fan) {
  const auto sensors = load(
      "name: laser\nfan: {beams: 3, first_rad: -1.0, step_rad: 1.0, "
      "T_robot_sensor: [0.5, 0, 3.0], range_max_m: 30}\n");
  const Sensor& sensor = *sensors.at("laser");
  ASSERT_EQ(sensor.beams.size(), 3U);
  EXPECT_EQ(sensor.beams[0].T_robot_beam, (Pose2{.x_m = 0.5, .y_m = 0.0, .theta_rad = 2.0}));
  EXPECT_NEAR(sensor.beams[2].T_robot_beam.theta_rad, 4.0 - 2 * pi, 1e-12);
  EXPECT_EQ(sensor.beams[1].range_max_m, 30.0);
}

// A line of a few words asks for a million beams: a short file must not fill the memory.
TEST_F(Sensors, FansOfAFileShareALimit) {
  const auto fan = [](int number, int beams) {
    return "{name: s" + std::to_string(number) + ", fan: {beams: " + std::to_string(beams) +
           ", first_rad: 0, step_rad: 0.1, range_max_m: 8}}";
  };
  std::string list = "sensors:\n";
  for (int i = 0; i < 9; ++i) list += "  - " + fan(i, 1'000) + "\n";
  EXPECT_EQ(load(list).size(), 9U);
  list = "sensors:\n";
  for (int i = 0; i < 11; ++i) list += "  - " + fan(i, 1'000'000) + "\n";
  expect_error([&] { load(list); }, ErrorCode::too_large, {"sensor.yaml:12", "fan.beams", "1000000"});
}

TEST_F(Sensors, SeveralInOneFile) {
  const auto sensors = load(R"(sensors:
  - {name: front, fan: {beams: 2, first_rad: 0, step_rad: 0.1, range_max_m: 8}}
  - {name: rear, fan: {beams: 5, first_rad: 0, step_rad: 0.1, range_max_m: 8}}
)");
  EXPECT_EQ(sensors.size(), 2U);
  EXPECT_EQ(sensors.at("rear")->beams.size(), 5U);
}

TEST_F(Sensors, SavedSensorReadsBackEqual) {
  expect_round_trip(
      make_fan({.beams = 180, .first_rad = -pi / 2, .step_rad = pi / 180, .range_max_m = 79.38}), true);
  expect_round_trip(make_fan({.beams = 361, .first_rad = -pi / 2, .step_rad = pi / 360}), true);
  expect_round_trip(make_fan({.name = "odd: \"name\" #1\n",
                              .beams = 726,
                              .first_rad = -2.0862138,
                              .step_rad = 0.0061359,
                              .T_robot_sensor = {.x_m = 0.1, .y_m = -0.2},
                              .range_min_m = 0.02,
                              .range_max_m = 5.6}),
                    true);
  // A fan seen from a turned mount is evenly spaced only up to rounding: listed, so that it stays exact.
  Sensor uneven = make_fan({.beams = 100, .first_rad = 0.1, .step_rad = 0.01});
  uneven.beams[50].T_robot_beam.theta_rad += 1e-15;
  expect_round_trip(uneven, false);
  uneven.beams[3].range_max_m = 5.0;
  expect_round_trip(uneven, false);
  expect_round_trip(make_fan({.beams = 1, .first_rad = 0.3}), false);
}

TEST_F(Sensors, Faults) {
  const std::string fan = "fan: {beams: 3, first_rad: -1.0, step_rad: 1.0, range_max_m: 30}\n";
  expect_fault(fan, {"sensor.yaml:1: name: found nothing"});
  expect_fault("name: a\n", {"sensor.yaml", "either beams or fan"});
  expect_fault("name: a\nbeams: []\n" + fan, {"sensor.yaml", "either beams or fan"});
  expect_fault("name: a\nbeams: []\n", {"sensor.yaml", "'a': no beams"});
  expect_fault("name: a\nnoise: 0.1\n" + fan, {"sensor.yaml:2: ", "a field 'noise'", "range_noise_m"});
  expect_fault("name: a\nrange_noise_m: -1\n" + fan, {"sensor.yaml", "range_noise_m is -1"});
  expect_fault("name: a\nfan: {beams: 0, first_rad: 0, step_rad: 0, range_max_m: 1}\n",
               {"sensor.yaml:2: fan.beams: found 0, expected a whole number from 1 to 1000000"});
  expect_fault("name: a\nfan: {beams: 2.5, first_rad: 0, step_rad: 0, range_max_m: 1}\n",
               {"fan.beams: found 2.5"});
  expect_fault("name: a\nfan: {beams: 2, step_rad: 0, range_max_m: 1}\n", {"fan.first_rad: found nothing"});
  expect_fault("name: a\nbeams:\n - {T_robot_beam: [0, 0], range_max_m: 1}\n",
               {"sensor.yaml:3: beams[0].T_robot_beam: found a list of 2"});
  expect_fault("name: a\nbeams:\n - {T_robot_beam: [0, 0, 0]}\n", {"beams[0].range_max_m: found nothing"});
  expect_fault("name: a\nbeams:\n - {T_robot_beam: [0, 0, 0], range_max_m: 1, range_min_m: 2}\n",
               {"sensor.yaml", "beam 0: range_max_m"});
  expect_fault("sensors: []\n", {"sensors: found a list of 0"});
  expect_fault("sensors:\n - {name: a, " + fan.substr(0, fan.size() - 1) + "}\n - {name: a, " +
                   fan.substr(0, fan.size() - 1) + "}\n",
               {"sensors[1].name: found 'a'", "not taken"});
}

}  // namespace
}  // namespace landfall::testing
