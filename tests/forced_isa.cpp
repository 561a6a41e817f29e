// Where LANDFALL_ISA names an instruction set, all tests of the executable run on it, or are skipped where
// this machine lacks it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "instruction_sets.hpp"

namespace landfall::testing {
namespace {

class ForcedInstructionSet : public ::testing::Environment {
 public:
  void SetUp() override {
    if (!forced()) return;
    const std::vector<std::string> present = instruction_sets();
    skipped_ = std::count(present.begin(), present.end(), name_) == 0;
    if (skipped_) GTEST_SKIP() << "no " << name_ << " on this machine";
    ASSERT_EQ(active_isa(), name_);
  }
  void TearDown() override {
    if (!forced() || skipped_) return;
    EXPECT_EQ(active_isa(), name_) << "a test left another one selected";
  }

 private:
  // An unknown name is the tests' own matter.
  [[nodiscard]] bool forced() const {
    return std::count(instruction_set_names.begin(), instruction_set_names.end(), name_) > 0;
  }

  bool skipped_ = false;
  const std::string name_ = std::getenv("LANDFALL_ISA") == nullptr ? "" : std::getenv("LANDFALL_ISA");
};

[[maybe_unused]] const auto* const registered =
    ::testing::AddGlobalTestEnvironment(new ForcedInstructionSet);  // gtest deletes it

}  // namespace
}  // namespace landfall::testing
