#include "kernels/isa.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "instruction_sets.hpp"
#include "landfall/error.hpp"

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

// Else the tests by name would leave it out, and nobody would see.
TEST(InstructionSets, TheListHasTheBestOfThisMachine) {
  ASSERT_TRUE(kernels::select_isa(nullptr));
  const std::string best = kernels::isa_name();
  ASSERT_TRUE(kernels::select_isa(std::getenv("LANDFALL_ISA")));
  EXPECT_THAT(testing::instruction_set_names, ::testing::Contains(best));
  EXPECT_EQ(testing::instruction_sets().front(), best);
}

TEST(InstructionSets, EveryOneOfTheListIsRunByName) {
  std::string names;
  for (const char* name : testing::instruction_set_names)
    names += (names.empty() ? "" : " ") + std::string(name);
  EXPECT_EQ(names, LANDFALL_ISAS_OF_CTEST);
}

// Run by ctest with LANDFALL_ISA set, see CMakeLists.txt.
TEST(InstructionSets, EnvironmentDecides) {
  const char* wanted = std::getenv("LANDFALL_ISA");
  if (wanted == nullptr) GTEST_SKIP() << "LANDFALL_ISA is not set";
  if (std::string(wanted) == "SCALAR") {
    EXPECT_EQ(active_isa(), "SCALAR");
    return;
  }
  try {
    (void)active_isa();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unknown_name);
    EXPECT_THAT(error.what(), ::testing::HasSubstr(wanted));
  }
}

}  // namespace
}  // namespace landfall
