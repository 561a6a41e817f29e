#include "kernels/isa.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "instruction_sets.hpp"

namespace landfall {
namespace {

TEST(InstructionSets, PlainTwinsRunEverywhere) {
  const std::vector<std::string> names = testing::instruction_sets();
  EXPECT_EQ(std::count(names.begin(), names.end(), "SCALAR"), 1);
}

TEST(InstructionSets, AreForcedByName) {
  for (const std::string& name : testing::instruction_sets()) {
    const testing::UsedInstructionSet used(name);
    EXPECT_EQ(kernels::isa_name(), name);
    EXPECT_EQ(active_isa(), name);
    EXPECT_EQ(kernels::scalar_selected(), name == "SCALAR");
  }
}

TEST(InstructionSets, UnknownNameChangesNothing) {
  const testing::UsedInstructionSet used("SCALAR");
  EXPECT_FALSE(kernels::select_isa("AVX9000"));
  EXPECT_STREQ(kernels::isa_name(), "SCALAR");
  for (const std::string& name : testing::instruction_sets()) {
    ASSERT_TRUE(kernels::select_isa(name.c_str()));
    EXPECT_FALSE(kernels::select_isa("avx2"));  // names are Highway's own, in capitals
    EXPECT_EQ(kernels::isa_name(), name);
  }
}

TEST(InstructionSets, NoNameGivesTheBestAgain) {
  ASSERT_TRUE(kernels::select_isa(nullptr));
  const std::string best = kernels::isa_name();
  ASSERT_TRUE(kernels::select_isa("SCALAR"));
  ASSERT_TRUE(kernels::select_isa(""));
  EXPECT_EQ(kernels::isa_name(), best);
}

}  // namespace
}  // namespace landfall
