#include <numbers>

#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

class PlacesFile : public IoTest {
 protected:
  std::map<std::string, PosePrior> load(const std::string& yaml) const {
    return load_places(write("floor.places.yaml", yaml));
  }
  void expect_fault(const std::string& yaml, const std::vector<std::string>& parts) const {
    expect_error([&] { load(yaml); }, ErrorCode::file_format, parts);
  }
};

TEST_F(PlacesFile, APolygonOrAPoseWithItsSpread) {
  const auto places = load(R"(
kitchen: {polygon_map: [[0, 0], [4, 0], [4, 3], [0, 3]]}
leaving room entry:
  T_map_robot: [1, 2, 1.5]
  half_x_m: 0.8
  half_y_m: 0.8
  half_theta_rad: 0.785
desk:
  polygon_map: [[5, 5], [6, 5], [6, 6]]
  theta_rad: -1.5
  half_theta_rad: 0.5
)");
  ASSERT_EQ(places.size(), 3u);
  const auto& kitchen = std::get<Region>(places.at("kitchen").kind);
  EXPECT_EQ(kitchen.polygon_map.at(2), (Point2{.x_m = 4, .y_m = 3}));
  EXPECT_EQ(kitchen.half_theta_rad, std::numbers::pi);
  const auto& entry = std::get<Window>(places.at("leaving room entry").kind);
  EXPECT_EQ(entry.T_map_robot, (Pose2{.x_m = 1, .y_m = 2, .theta_rad = 1.5}));
  EXPECT_EQ(entry.half_theta_rad, 0.785);
  EXPECT_EQ(std::get<Region>(places.at("desk").kind).theta_rad, -1.5);
}

TEST_F(PlacesFile, Faults) {
  expect_fault("[1, 2]", {"floor.places.yaml", "an object"});
  expect_fault("kitchen: 3", {"floor.places.yaml:1: kitchen", "polygon_map or T_map_robot"});
  expect_fault("a: {polygon_map: [[0, 0], [1, 0], [1, 1]]}\nb: {half_x_m: 1}",
               {"floor.places.yaml:2: b.T_map_robot", "nothing"});
  expect_fault("a: {polygon_map: [[0, 0], [1, 0]]}", {"floor.places.yaml:1: a: "});
  expect_fault("a: {polygon_map: [[0, 0], [1, 0], [1, 1]], T_map_robot: [0, 0, 0]}", {"'T_map_robot'"});
  expect_fault("a: {T_map_robot: [0, 0, 0], half_x_m: -1}", {"floor.places.yaml:1: a: ", "half_x_m"});
  expect_fault("a: {T_map_robot: [0, 0, x]}", {"a.T_map_robot[2]: found 'x'"});
}

}  // namespace
}  // namespace landfall::testing
