// What a correlation is measured against: transforms of its size and nothing else.
#pragma once

#include <memory>

#include "engine/methods/fft/real_fft.hpp"

namespace landfall::internal {

// Planned and allocated when constructed. One per thread.
class BareTransforms {
 public:
  // Throws Error{invalid_argument}: no rows, or columns that are not even.
  BareTransforms(int rows, int cols);

  // So many transforms forth and as many back.
  void run(int count);

 private:
  std::shared_ptr<const RealFft> fft_;
  Plane plane_;
  Spectrum spectrum_;
};

}  // namespace landfall::internal
