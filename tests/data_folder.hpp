// The folder of real maps and logs: LANDFALL_DATA, or ../shared/data beside the checkout.
#pragma once

#include <cstdlib>
#include <filesystem>

namespace landfall::testing {

inline std::filesystem::path data_folder() {
  const char* from_environment = std::getenv("LANDFALL_DATA");
  return from_environment != nullptr ? from_environment : LANDFALL_DEFAULT_DATA;
}
inline bool has_data() {
  return std::filesystem::is_directory(data_folder());
}

}  // namespace landfall::testing

#define LANDFALL_REQUIRE_DATA() \
  if (!landfall::testing::has_data()) GTEST_SKIP() << "no real data: set LANDFALL_DATA"
