#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view text) {
  const auto check = [](const std::vector<StampedPose>& poses) {
    for (const StampedPose& stamped : poses)
      if (!is_finite(stamped.pose)) throw Error(ErrorCode::invalid_argument, "a pose that is not finite");
  };
  expect_answer_or_error([&] { return io::read_trajectory(text, "poses.tum"); }, check);
}

}  // namespace landfall::fuzz
