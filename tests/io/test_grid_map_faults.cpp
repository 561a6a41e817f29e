// Every field of a map's yaml and of its image's header, damaged.
#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

class GridMapFaults : public IoTest {
 protected:
  void SetUp() override {
    IoTest::SetUp();
    write("ok.pgm", "P2 1 1 255\n0\n");
  }
  void expect_yaml_error(const std::string& yaml, const std::vector<std::string>& parts) const {
    const auto path = write("floor.yaml", yaml);
    expect_error([&] { load_grid_map(path); }, ErrorCode::file_format, parts);
  }
  void expect_image_error(const std::string& image, ErrorCode code,
                          const std::vector<std::string>& parts) const {
    write("floor.pgm", image);
    const auto path = write("floor.yaml", "image: floor.pgm\nresolution: 1\norigin: [0, 0, 0]\n");
    expect_error([&] { load_grid_map(path); }, code, parts);
  }
};

constexpr auto format = ErrorCode::file_format;

TEST_F(GridMapFaults, Resolution) {
  expect_yaml_error("image: ok.pgm\norigin: [0, 0, 0]\n", {"floor.yaml", "resolution: found nothing"});
  expect_yaml_error("image: ok.pgm\nresolution: fine\n",
                    {"floor.yaml:2: resolution: found 'fine'", "number"});
  expect_yaml_error("image: ok.pgm\nresolution: 0\n", {"floor.yaml:2: resolution: found 0", "positive"});
  expect_yaml_error("image: ok.pgm\nresolution: -0.05\n", {"resolution: found -0.05"});
  expect_yaml_error("image: ok.pgm\nresolution: .nan\n", {"resolution: found '.nan'"});
  expect_yaml_error("image: ok.pgm\nresolution: nan\n", {"resolution: found nan", "finite"});
}

TEST_F(GridMapFaults, Origin) {
  const std::string start = "image: ok.pgm\nresolution: 1\n";
  expect_yaml_error(start, {"origin: found nothing"});
  expect_yaml_error(start + "origin: [0, 0]\n", {"floor.yaml:3: origin: found a list of 2", "3 numbers"});
  expect_yaml_error(start + "origin: [0, x, 0]\n", {"floor.yaml:3: origin[1]: found 'x'"});
  expect_yaml_error(start + "origin: 0\n", {"floor.yaml:3: origin: found 0"});
  expect_yaml_error(start + "origin: [1e300, 0, 0]\n", {"floor.yaml", "origin", "1e+300"});
}

TEST_F(GridMapFaults, Image) {
  expect_yaml_error("resolution: 1\norigin: [0, 0, 0]\n", {"image: found nothing"});
  expect_yaml_error("image: ''\nresolution: 1\n", {"floor.yaml:1: image: found ''", "file name"});
  const auto path = write("floor.yaml", "image: none.pgm\nresolution: 1\norigin: [0, 0, 0]\n");
  expect_error([&] { load_grid_map(path); }, ErrorCode::file_not_found,
               {"floor.yaml: image: ", "none.pgm: no such"});
  const auto folder = write("floor.yaml", "image: .\nresolution: 1\norigin: [0, 0, 0]\n");
  expect_error([&] { load_grid_map(folder); }, ErrorCode::file_not_found, {"found a directory"});
}

TEST_F(GridMapFaults, ThresholdsNegateAndMode) {
  const std::string start = "image: ok.pgm\nresolution: 1\norigin: [0, 0, 0]\n";
  expect_yaml_error(start + "occupied_thresh: 1.5\n", {"floor.yaml:4: occupied_thresh: found 1.5", "0 to 1"});
  expect_yaml_error(start + "free_thresh: -0.1\n", {"floor.yaml:4: free_thresh: found -0.1"});
  expect_yaml_error(start + "free_thresh: 0.7\n",
                    {"floor.yaml:4: free_thresh: found 0.7", "occupied_thresh, 0.65"});
  expect_yaml_error(start + "negate: 2\n", {"floor.yaml:4: negate: found 2", "0 or 1"});
  expect_yaml_error(start + "mode: binary\n",
                    {"floor.yaml:4: mode: found 'binary'", "trinary, scale or raw"});
}

TEST_F(GridMapFaults, NotYaml) {
  expect_yaml_error("", {"floor.yaml"});
  expect_yaml_error("just words\n", {"floor.yaml:1", "found 'just words', expected an object"});
  expect_yaml_error("image: [a\nresolution: 1\n", {"floor.yaml:", "valid YAML"});
  expect_yaml_error("image: ok.pgm\nresolution: 1\nresolution: 2\n",
                    {"floor.yaml:3: resolution: found it a second"});
  expect_error([&] { load_grid_map(at("none.yaml")); }, ErrorCode::file_not_found,
               {"none.yaml: no such file"});
}

TEST_F(GridMapFaults, HostileYaml) {
  expect_yaml_error(std::string(2000, '['), {"floor.yaml"});
  std::ostringstream aliases;
  aliases << "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 9; ++i) {
    aliases << "a" << i << ": &a" << i << " [";
    for (int k = 0; k < 10; ++k) aliases << "*a" << i - 1 << (k < 9 ? ", " : "]\n");
  }
  const auto path = write("floor.yaml", aliases.str());
  expect_error([&] { load_grid_map(path); }, ErrorCode::too_large, {"floor.yaml", "a million values"});
}

TEST_F(GridMapFaults, ImageMagic) {
  expect_image_error("", format, {"floor.pgm", "first bytes"});
  expect_image_error("GIF89a", format, {"floor.pgm: first bytes: found 'GIF8'"});
  expect_image_error("P4 1 1\n1", format, {"found 'P4'", "P2, P3, P5 or P6"});
}

TEST_F(GridMapFaults, ImageSizes) {
  expect_image_error("P5", format, {"width: found the end of the file"});
  expect_image_error("P5 x 1 255\n", format, {"width: found 'x'"});
  expect_image_error("P5 1 -1 255\n", format, {"height: found '-'"});
  expect_image_error("P5 0 1 255\n", format, {"size: found 0 x 1 pixels", "at least 1 x 1"});
  expect_image_error("P5 1 1 0\n0", format, {"maximum value: found 0", "1 to 65535"});
  expect_image_error("P5 1 1 65536\n0", format, {"maximum value: found 65536"});
}

TEST_F(GridMapFaults, PromisesOfHugeImagesTakeNoMemory) {
  for (const char* magic : {"P2", "P3", "P5", "P6"}) {
    const std::string start(magic);
    expect_image_error(start + " 100000 100000 255\n", ErrorCode::too_large,
                       {"floor.pgm: size: found 100000 x 100000 pixels", std::to_string(max_map_cells)});
    expect_image_error(start + " 99999999999999999999 1 255\n", ErrorCode::too_large, {"width"});
    expect_image_error(start + " 999999999999999999 999999999999999999 255\n", ErrorCode::too_large,
                       {"size"});
    expect_image_error(start + " 70000 2 255\n", ErrorCode::too_large,
                       {"floor.pgm: size: found 70000 x 2 pixels", std::to_string(max_map_side_cells)});
    // Below the limit, but the file holds next to nothing of it.
    expect_image_error(start + " 30000 30000 255\n0 0", format, {"pixels: found", "truncated"});
  }
}

TEST_F(GridMapFaults, Pixels) {
  expect_image_error("P5 2 2 255\nabc", format, {"pixels: found 3 bytes, expected 4", "2 x 2"});
  expect_image_error("P5 2 1 65535\nabc", format, {"pixels: found 3 bytes, expected 4"});
  expect_image_error("P6 1 1 255\nab", format, {"pixels: found 2 bytes, expected 3"});
  expect_image_error("P5 1 1 100\n\x65", format, {"pixel: found 101, expected at most 100"});
  expect_image_error("P2 2 1 255\n0 256", format, {"pixel: found '256', expected at most 255"});
  expect_image_error("P2 2 1 255\n0 x 0", format, {"pixel: found 'x'"});
  expect_image_error("P2 2 1 255\n0     ", format, {"pixel: found the end of the file"});
}

}  // namespace
}  // namespace landfall::testing
