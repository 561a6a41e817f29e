// Which scheduler runs parallel work, and what an unknown name does.
#include "engine/base/executor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <string>

#include "engine/maps/prepared_state.hpp"
#include "executors.hpp"
#include "landfall/error.hpp"
#include "landfall/search.hpp"
#include "rooms.hpp"

namespace landfall {
namespace {

using ::testing::HasSubstr;

TEST(Executors, AreForcedByName) {
  for (const std::string& name : testing::executor_names()) {
    const testing::UsedExecutor used(name);
    EXPECT_EQ(internal::executor().name, name);
    EXPECT_EQ(active_executor(), name);
  }
}

TEST(Executors, UnknownNameChangesNothing) {
  for (const std::string& name : testing::executor_names()) {
    const testing::UsedExecutor used(name);
    EXPECT_FALSE(internal::select_executor("TBB"));  // names are in small letters
    EXPECT_EQ(active_executor(), name);
  }
}

TEST(Executors, NoNameGivesTheEnvironmentsAgain) {
  const std::string of_environment = active_executor();
  for (const std::string& name : testing::executor_names()) {
    ASSERT_TRUE(internal::select_executor(name.c_str()));
    ASSERT_TRUE(internal::select_executor(""));
    EXPECT_EQ(active_executor(), of_environment);
  }
}

// The parts that one call could not build are built by the next, and count nothing meanwhile.
TEST(Executors, APartWhoseBuildingFailedHoldsNothing) {
  const char* value = std::getenv("LANDFALL_EXECUTOR");
  const std::optional<std::string> before =
      value == nullptr ? std::nullopt : std::optional<std::string>(value);
  const PreparedMap map(testing::empty_room(80, 60, 0.1));
  const std::size_t bare = map.memory_bytes();
  ::setenv("LANDFALL_EXECUTOR", "nobody", 1);
  ASSERT_TRUE(internal::select_executor(nullptr));
  EXPECT_THROW((void)map.state().free_mask(0.3, 1), Error);
  EXPECT_EQ(map.memory_bytes(), bare);
  before ? ::setenv("LANDFALL_EXECUTOR", before->c_str(), 1) : ::unsetenv("LANDFALL_EXECUTOR");
  EXPECT_GT(map.state().free_mask(0.3, 1)->count(), 0);
  EXPECT_GT(map.memory_bytes(), bare);
}

// Run by ctest with LANDFALL_EXECUTOR set, see CMakeLists.txt.
TEST(Executors, EnvironmentDecides) {
  const char* wanted = std::getenv("LANDFALL_EXECUTOR");
  if (wanted == nullptr) GTEST_SKIP() << "LANDFALL_EXECUTOR is not set";
  const PreparedMap map(testing::furnished_room());
  const std::vector<std::string> names = testing::executor_names();
  if (std::count(names.begin(), names.end(), wanted) == 1) {
    map.prepare();
    EXPECT_EQ(active_executor(), wanted);
    return;
  }
  const Scan scan{.sensor = testing::full_circle(4), .ranges_m = {1.0F, 1.0F, 1.0F, 1.0F}};
  for (const std::function<void()>& use :
       std::initializer_list<std::function<void()>>{[] { (void)active_executor(); }, [&] { map.prepare(); },
                                                    [&] { (void)search(map, {Anywhere{}}, scan); }}) {
    try {
      use();
      FAIL() << "no error";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::unknown_name);
      EXPECT_THAT(error.what(), HasSubstr("LANDFALL_EXECUTOR is \"" + std::string(wanted) + "\""));
      EXPECT_THAT(error.what(), HasSubstr(names.front()));
      const bool lacks_openmp = std::string(wanted) == "openmp";
      EXPECT_THAT(error.what(), HasSubstr(lacks_openmp ? "CMake option LANDFALL_OPENMP" : names.back()));
    }
  }
}

}  // namespace
}  // namespace landfall
