#include "tests/fuzz/fuzz.hpp"

namespace landfall::fuzz {

void test_one_input(std::string_view json) {
  expect_answer_or_error([&] { return io::read_prior(json, "prior.json"); },
                         [](const PosePrior& prior) { validate(prior); });
}

}  // namespace landfall::fuzz
