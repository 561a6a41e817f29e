// Gzip, and files that appear whole or not at all.
#include "engine/io/file.hpp"

#include <sys/stat.h>

#include <fstream>
#include <thread>

#include "engine/io/text.hpp"
#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

class Files : public IoTest {};

TEST_F(Files, GzipRoundTrip) {
  std::string text;
  for (int i = 0; i < 400000; ++i) text += std::to_string(i * 2654435761U % 977) + (i % 9 == 0 ? "\n" : " ");
  for (const std::string& piece : {std::string(), std::string("a"), text})
    EXPECT_EQ(io::gunzip(io::gzip(piece), "x.gz"), piece);
  EXPECT_LT(io::gzip(text).size(), text.size());
}

TEST_F(Files, GzipOfSeveralMembers) {
  EXPECT_EQ(io::gunzip(io::gzip("one ") + io::gzip("two"), "x.gz"), "one two");
}

TEST_F(Files, DamagedGzip) {
  std::string packed = io::gzip("some text that is longer than a few bytes");
  packed[14] = static_cast<char>(packed[14] ^ 0xff);
  expect_error([&] { io::gunzip(packed, "x.gz"); }, ErrorCode::file_format, {"x.gz: gzip: found "});
}

TEST_F(Files, WritingReplacesAndLeavesNothingElse) {
  io::write_file(at("result.txt"), "old");
  io::write_file(at("result.txt"), "new");
  EXPECT_EQ(read(at("result.txt")), "new");
  EXPECT_THAT(names(), ::testing::ElementsAre("result.txt"));
}

TEST_F(Files, FailedWriteKeepsTheOldFile) {
  expect_error([&] { io::write_file(at("none/result.txt"), "x"); }, ErrorCode::file_write,
               {"result.txt: cannot be written"});
  std::filesystem::create_directories(at("folder/inside"));
  expect_error([&] { io::write_file(at("folder"), "x"); }, ErrorCode::file_write,
               {"folder: cannot be written"});
  EXPECT_THAT(names(), ::testing::ElementsAre("folder"));
}

TEST_F(Files, WritingThroughALinkKeepsTheLink) {
  io::write_file(at("monday.txt"), "old");
  std::filesystem::create_symlink("monday.txt", at("latest.txt"));
  io::write_file(at("latest.txt"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(at("latest.txt")));
  EXPECT_EQ(read(at("monday.txt")), "new");
}

TEST_F(Files, PipesAreReadAndNeverReplaced) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  expect_error([&] { io::write_file(at("pipe"), "x"); }, ErrorCode::file_write,
               {"pipe: cannot be written", "pipe"});
  EXPECT_TRUE(std::filesystem::is_fifo(at("pipe")));
  std::thread writer([&] { std::ofstream(at("pipe")) << "a line\nanother\n"; });
  EXPECT_EQ(io::read_file(at("pipe")), "a line\nanother\n");
  writer.join();
}

TEST_F(Files, EndingsTellMapsAndSensors) {
  expect_error([&] { load_map(at("floor.pgm")); }, ErrorCode::file_format,
               {"floor.pgm: found ending '.pgm', expected .yaml"});
  expect_error([&] { load_sensors(at("laser.txt")); }, ErrorCode::file_format,
               {"laser.txt: found ending '.txt'"});
}

TEST_F(Files, NumbersAreShortestAndExact) {
  for (const double value : {0.0, 1.0, -0.1, 1.0 / 3.0, 976052892.4424, 1e-6, 1e-7, 1e15, -1.5e300, 5e-324}) {
    std::string text;
    io::append_number(text, value);
    EXPECT_EQ(io::parse_number(text), value) << text;
  }
  std::string text;
  io::append_number(text, 0.0001);
  io::append_number(text += ' ', 1e9);
  io::append_number(text += ' ', 79.38F);
  EXPECT_EQ(text, "0.0001 1000000000 79.38");
}

TEST_F(Files, NumbersAreWholeWords) {
  EXPECT_EQ(io::parse_number("+1.5"), 1.5);
  EXPECT_EQ(io::parse_number("-2e3"), -2000.0);
  EXPECT_EQ(io::parse_number("0."), 0.0);
  for (const char* text : {"", "+", "-", "1x", " 1", "1 ", "0x10", "+-1", "1,5", "1e999"})
    EXPECT_FALSE(io::parse_number(text)) << text;
}

}  // namespace
}  // namespace landfall::testing
