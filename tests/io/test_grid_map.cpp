// Maps drawn by hand in every netpbm form and read back.
#include <numbers>

#include "io_test.hpp"
#include "landfall/io.hpp"
#include "tests/drawn_map.hpp"

namespace landfall::testing {
namespace {

class GridMapTest : public IoTest {
 protected:
  GridMap load(const std::string& image, const std::string& more = "") const {
    write("floor.img", image);
    return load_grid_map(write("floor.yaml", "image: floor.img\nresolution: 1\norigin: [0, 0, 0]\n" + more));
  }
};

std::string bytes(const std::vector<int>& values) {
  std::string text;
  for (const int value : values) text += static_cast<char>(value);
  return text;
}

TEST_F(GridMapTest, PlainGreyHasItsFirstRowOnTop) {
  const GridMap map = load("P2\n# by hand\n3 2\n255\n0 254 205\n254 0 254\n");
  EXPECT_EQ(map, drawn_map({"#.?", ".#."}));
  EXPECT_EQ(map.at({.col = 0, .row = 0}), Occupancy::free);
  EXPECT_EQ(map.at({.col = 0, .row = 1}), Occupancy::occupied);
}

TEST_F(GridMapTest, RawGrey) {
  EXPECT_EQ(load("P5 3 2 255\n" + bytes({0, 254, 205, 254, 0, 254})), drawn_map({"#.?", ".#."}));
}

TEST_F(GridMapTest, SixteenBitGreyIsBigEndian) {
  // 0x0001 is black and 0xfffe white; the other byte order would have it the other way round, nearly.
  EXPECT_EQ(load("P5 3 1 65535\n" + bytes({0x00, 0x01, 0xff, 0xfe, 0xcd, 0x00})), drawn_map({"#.?"}));
  EXPECT_EQ(load("P2 3 1 65535\n1 65534 52480\n"), drawn_map({"#.?"}));
}

TEST_F(GridMapTest, ColoursAreAveraged) {
  // Means 0, 250 and (0 + 255 + 255) / 3 = 170, whose occupancy is 1/3.
  EXPECT_EQ(load("P6 3 1 255\n" + bytes({0, 0, 0, 250, 250, 250, 0, 255, 255})), drawn_map({"#.?"}));
  EXPECT_EQ(load("P3 3 1 255\n0 0 0  250 250 250  0 255 255\n"), drawn_map({"#.?"}));
}

TEST_F(GridMapTest, ThresholdsAreExclusive) {
  // Occupancy of grey 51 is 0.8 and of 204 is 0.2, both exactly at a threshold: unknown.
  const std::string image = "P2 4 1 255\n50 51 204 205\n";
  EXPECT_EQ(load(image, "occupied_thresh: 0.8\nfree_thresh: 0.2\n"), drawn_map({"#??."}));
}

TEST_F(GridMapTest, DefaultsAreThoseOfMapServer) {
  // (255 - 89) / 255 = 0.651 and (255 - 90) / 255 = 0.647; (255 - 205) / 255 = 0.19608 and 206: 0.1922.
  EXPECT_EQ(load("P2 4 1 255\n89 90 205 206\n"), drawn_map({"#??."}));
}

TEST_F(GridMapTest, NegateSwapsBlackAndWhite) {
  const std::string image = "P2 3 1 255\n0 254 50\n";
  EXPECT_EQ(load(image, "negate: 1\n"), drawn_map({".#?"}));
  EXPECT_EQ(load(image, "negate: true\n"), drawn_map({".#?"}));
  EXPECT_EQ(load(image, "negate: 0\n"), drawn_map({"#.#"}));
}

TEST_F(GridMapTest, ScaleModeIsUnknownBetweenItsThresholds) {
  EXPECT_EQ(load("P2 4 1 255\n0 254 128 100\n", "mode: scale\n"), drawn_map({"#.??"}));
}

TEST_F(GridMapTest, RawModeReadsPercent) {
  // 0..100 is the occupancy in percent; above, as 255 for -1, unknown.
  EXPECT_EQ(load("P2 6 1 255\n0 19 65 66 100 101\n", "mode: raw\n"), drawn_map({"..?##?"}));
  EXPECT_EQ(load("P2 3 1 255\n255 155 154\n", "mode: raw\nnegate: 1\n"), drawn_map({".#?"}));
}

TEST_F(GridMapTest, RotatedOrigin) {
  write("floor.pgm", "P2 2 1 255\n0 254\n");
  const GridMap map = load_grid_map(
      write("floor.yaml", "image: floor.pgm\nresolution: 0.5\norigin: [10., 20, 1.5707963267948966]\n"));
  // Cell (1, 0)'s centre is 0.75 m along the grid's x, which is the map's y, and 0.25 m to its left.
  const Point2 center = map.center_of({.col = 1, .row = 0});
  EXPECT_NEAR(center.x_m, 9.75, 1e-12);
  EXPECT_NEAR(center.y_m, 20.75, 1e-12);
  EXPECT_EQ(map.cell_of({.x_m = 9.75, .y_m = 20.25}), (CellIndex{.col = 0, .row = 0}));
}

TEST_F(GridMapTest, ImageIsSoughtBesideTheYaml) {
  std::filesystem::create_directories(at("images"));
  write("images/floor.pgm", "P2 1 1 255\n0\n");
  EXPECT_NO_THROW(
      load_grid_map(write("a.yaml", "image: images/floor.pgm\nresolution: 1\norigin: [0, 0, 0]\n")));
  const std::string absolute = at("images/floor.pgm").string();
  EXPECT_NO_THROW(
      load_grid_map(write("b.yaml", "image: " + absolute + "\nresolution: 1\norigin: [0, 0, 0]\n")));
}

TEST_F(GridMapTest, UnknownFieldsArePassedOver) {
  EXPECT_NO_THROW(load("P2 1 1 255\n0\n", "frame_id: map\n"));
}

TEST_F(GridMapTest, SavedMapReadsBackEqual) {
  const GridMap map =
      drawn_map({"#.?#", "?.#.", "...."}, 0.05, {.x_m = -1.7, .y_m = 1.0 / 3.0, .theta_rad = 0.1});
  save_grid_map(map, at("it's a floor.yaml"));
  EXPECT_EQ(load_grid_map(at("it's a floor.yaml")), map);
  EXPECT_THAT(names(), ::testing::UnorderedElementsAre("it's a floor.yaml", "it's a floor.pgm"));
}

}  // namespace
}  // namespace landfall::testing
