#include <map>
#include <mutex>
#include <utility>

#include "engine/methods/fft/real_fft.hpp"

namespace landfall::internal {

std::shared_ptr<const RealFft> shared_fft(int rows, int cols) {
  static std::mutex mutex;
  static std::map<std::pair<int, int>, std::shared_ptr<const RealFft>> known;
  const std::scoped_lock lock(mutex);
  std::shared_ptr<const RealFft>& fft = known[{rows, cols}];
  if (fft == nullptr) fft = std::make_shared<const RealFft>(rows, cols);
  return fft;
}

}  // namespace landfall::internal
