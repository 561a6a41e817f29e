// PNG maps of every colour type, written here with libpng itself.
#include <png.h>
#include <zlib.h>

#include <cstdint>

#include "io_test.hpp"
#include "landfall/io.hpp"
#include "tests/drawn_map.hpp"

namespace landfall::testing {
namespace {

struct PngImage {
  int width = 0;
  int bit_depth = 8;
  int color_type = PNG_COLOR_TYPE_GRAY;
  int interlace = PNG_INTERLACE_NONE;
  std::vector<std::vector<std::uint8_t>> rows;  // as packed in the file
  std::vector<png_color> palette;
};

std::string encode(const PngImage& image) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  std::string bytes;
  png_set_write_fn(
      png, &bytes,
      [](png_structp p, png_bytep data, std::size_t count) {
        static_cast<std::string*>(png_get_io_ptr(p))->append(reinterpret_cast<const char*>(data), count);
      },
      [](png_structp) {});
  png_set_IHDR(png, info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.rows.size()),
               image.bit_depth, image.color_type, image.interlace, PNG_COMPRESSION_TYPE_DEFAULT,
               PNG_FILTER_TYPE_DEFAULT);
  if (!image.palette.empty())
    png_set_PLTE(png, info, image.palette.data(), static_cast<int>(image.palette.size()));
  std::vector<png_bytep> rows;
  for (const auto& row : image.rows) rows.push_back(const_cast<png_bytep>(row.data()));
  png_set_rows(png, info, rows.data());
  png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

class PngTest : public IoTest {
 protected:
  GridMap load_bytes(const std::string& png, const std::string& more = "") const {
    write("floor.png", png);
    return load_grid_map(write("floor.yaml", "image: floor.png\nresolution: 1\norigin: [0, 0, 0]\n" + more));
  }
  GridMap load(const PngImage& image, const std::string& more = "") const {
    return load_bytes(encode(image), more);
  }
};

TEST_F(PngTest, Grey8) {
  EXPECT_EQ(load({.width = 3, .rows = {{0, 254, 205}, {254, 0, 254}}, .palette = {}}),
            drawn_map({"#.?", ".#."}));
}

TEST_F(PngTest, Grey16) {
  EXPECT_EQ(load({.width = 3, .bit_depth = 16, .rows = {{0, 1, 255, 254, 205, 0}}, .palette = {}}),
            drawn_map({"#.?"}));
}

TEST_F(PngTest, GreyOfFewBits) {
  EXPECT_EQ(load({.width = 4, .bit_depth = 1, .rows = {{0b01100000}}, .palette = {}}), drawn_map({"#..#"}));
  // 2 bits: 0, 85, 170, 255; occupancy 1, 2/3, 1/3, 0.
  EXPECT_EQ(load({.width = 4, .bit_depth = 2, .rows = {{0b00011011}}, .palette = {}}), drawn_map({"##?."}));
  EXPECT_EQ(load({.width = 2, .bit_depth = 4, .rows = {{0x0f}}, .palette = {}}), drawn_map({"#."}));
}

TEST_F(PngTest, ColourAndPalette) {
  EXPECT_EQ(load({.width = 3,
                  .color_type = PNG_COLOR_TYPE_RGB,
                  .rows = {{0, 0, 0, 250, 250, 250, 0, 255, 255}},
                  .palette = {}}),
            drawn_map({"#.?"}));
  EXPECT_EQ(load({.width = 3,
                  .color_type = PNG_COLOR_TYPE_PALETTE,
                  .rows = {{2, 1, 0}},
                  .palette = {{0, 255, 255}, {250, 250, 250}, {0, 0, 0}}}),
            drawn_map({"#.?"}));
}

// map_server: alpha is one more channel of the mean in trinary mode, and left out in the others.
TEST_F(PngTest, AlphaCountsInTrinaryModeAlone) {
  const PngImage colour{.width = 2,
                        .color_type = PNG_COLOR_TYPE_RGB_ALPHA,
                        .rows = {{0, 0, 0, 255, 0, 0, 0, 0}},
                        .palette = {}};
  EXPECT_EQ(load(colour), drawn_map({"##"}));  // means 63.75 (occupancy 0.75) and 0
  EXPECT_EQ(load(colour, "occupied_thresh: 0.8\n"), drawn_map({"?#"}));
  EXPECT_EQ(load(colour, "occupied_thresh: 0.8\nmode: scale\n"), drawn_map({"##"}));
  // Grey with alpha weighs as colour with alpha: (3 x 0 + 255) / 4, not (0 + 255) / 2.
  const PngImage grey{
      .width = 2, .color_type = PNG_COLOR_TYPE_GRAY_ALPHA, .rows = {{0, 255, 255, 255}}, .palette = {}};
  EXPECT_EQ(load(grey), drawn_map({"#."}));
  EXPECT_EQ(load(grey, "occupied_thresh: 0.76\n"), drawn_map({"?."}));
}

TEST_F(PngTest, InterlacedEqualsPlain) {
  PngImage image{.width = 5, .rows = {}, .palette = {}};
  for (int row = 0; row < 9; ++row) {
    image.rows.emplace_back();
    for (int col = 0; col < 5; ++col) image.rows.back().push_back(row * 5 + col % 3 == 0 ? 0 : 254 - 5 * row);
  }
  const GridMap plain = load(image);
  image.interlace = PNG_INTERLACE_ADAM7;
  EXPECT_EQ(load(image), plain);
}

TEST_F(PngTest, TruncatedAnywhereIsAnError) {
  PngImage image{.width = 64, .rows = {}, .palette = {}};
  for (int row = 0; row < 64; ++row) image.rows.emplace_back(64, static_cast<std::uint8_t>(row * row));
  const std::string whole = encode(image);
  for (std::size_t bytes = 4; bytes + 16 < whole.size(); bytes += 7)  // the last 16 are the end mark
    expect_error([&] { load_bytes(whole.substr(0, bytes)); }, ErrorCode::file_format, {"floor.png: "});
}

TEST_F(PngTest, DamagedDataIsAnError) {
  std::string png = encode({.width = 3, .rows = {{0, 254, 205}}, .palette = {}});
  png[png.size() - 18] = static_cast<char>(png[png.size() - 18] ^ 0x55);
  expect_error([&] { load_bytes(png); }, ErrorCode::file_format, {"floor.png: png: "});
}

TEST_F(PngTest, PromisesOfHugeImagesTakeNoMemory) {
  std::string png = encode({.width = 1, .rows = {{0}}, .palette = {}});
  const auto promise = [&](std::uint32_t width, std::uint32_t height) {
    for (int i = 0; i < 4; ++i) {
      png[16 + i] = static_cast<char>(width >> (24 - 8 * i));
      png[20 + i] = static_cast<char>(height >> (24 - 8 * i));
    }
    const auto crc = static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(&png[12]), 17));
    for (int i = 0; i < 4; ++i) png[29 + i] = static_cast<char>(crc >> (24 - 8 * i));
  };
  promise(100000, 100000);
  expect_error([&] { load_bytes(png); }, ErrorCode::too_large,
               {"floor.png: size: found 100000 x 100000 pixels"});
  promise(30000, 30000);
  expect_error([&] { load_bytes(png); }, ErrorCode::file_format,
               {"floor.png: pixels: found", "30000 x 30000"});
}

}  // namespace
}  // namespace landfall::testing
