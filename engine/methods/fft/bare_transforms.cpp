#include "engine/methods/fft/bare_transforms.hpp"

#include <string>

#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

std::shared_ptr<const RealFft> checked_fft(int rows, int cols) {
  if (rows < 1 || cols < 2 || cols % 2 != 0)
    throw Error(ErrorCode::invalid_argument, "transforms of " + std::to_string(rows) + " x " +
                                                 std::to_string(cols) + ", expected rows and even columns");
  return shared_fft(rows, cols);
}

}  // namespace

BareTransforms::BareTransforms(int rows, int cols)
    : fft_(checked_fft(rows, cols)), plane_(fft_->reals()), spectrum_(fft_->bins()) {}

void BareTransforms::run(int count) {
  for (int i = 0; i < count; ++i) {
    fft_->forward(plane_, spectrum_);
    fft_->inverse(spectrum_, plane_);
  }
}

}  // namespace landfall::internal
