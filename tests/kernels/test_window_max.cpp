#include "kernels/window_max.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "random_field.hpp"

namespace landfall {
namespace {

using Bytes = std::vector<std::uint8_t>;

TEST(SlidingMax, EqualsTheNaiveMaximum) {
  testing::RandomField random(7);
  for (const std::size_t count : {8U, 9U, 31U, 32U, 33U, 100U, 257U}) {
    const Bytes in = random.bytes(count);
    Bytes scratch(count), out(count);
    kernels::sliding_max_8(in.data(), count, scratch.data(), out.data());
    for (std::size_t c = 0; c + 8 <= count; ++c)
      EXPECT_EQ(out[c], *std::max_element(&in[c], &in[c] + 8)) << count << ": " << c;
  }
}

TEST(SlidingMax, LeavesRowsTooShortForAWindow) {
  const Bytes in(7, 9);
  Bytes scratch(7), out(7, 1);
  kernels::sliding_max_8(in.data(), in.size(), scratch.data(), out.data());
  EXPECT_EQ(out, Bytes(7, 1));
}

TEST(Maximum, TakesTheLargerByte) {
  const Bytes a{1, 5, 255, 0};
  const Bytes b{2, 4, 0, 0};
  Bytes out(4);
  kernels::maximum(a.data(), b.data(), 4, out.data());
  EXPECT_EQ(out, (Bytes{2, 5, 255, 0}));
}

TEST(Interleave, PutsTheFirstIntoTheLowestByte) {
  const Bytes a{0x01, 0xA1}, b{0x02, 0xA2}, c{0x03, 0xA3}, d{0x04, 0xA4};
  std::vector<std::uint16_t> pairs(2);
  kernels::interleave_2(a.data(), b.data(), 2, pairs.data());
  EXPECT_EQ(pairs, (std::vector<std::uint16_t>{0x0201U, 0xA2A1U}));
  std::vector<std::uint32_t> out(2);
  kernels::interleave_4(a.data(), b.data(), c.data(), d.data(), 2, out.data());
  EXPECT_EQ(out, (std::vector<std::uint32_t>{0x04030201U, 0xA4A3A2A1U}));
}

TEST(ReduceMax, CutsTheLastWindow) {
  const Bytes in{3, 1, 4, 1, 5, 9, 2, 6};
  Bytes out(3);
  kernels::reduce_max(in.data(), in.size(), 3, out.data());
  EXPECT_EQ(out, (Bytes{4, 9, 6}));
}

}  // namespace
}  // namespace landfall
