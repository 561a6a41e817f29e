// The convolution of the extended robot (Espino, Moreno, Curto, Aguilar: Autolocalization using the
// convolution of the extended robot, equations 8 to 11): per heading the end points of all readings are drawn
// into a map of their own and correlated with the environment's by Fourier transforms, all translations at
// once; the maximum over x, y and heading is the pose. What is ours: the environment is the likelihood field,
// the transforms are padded so that no robot wraps around the map's edge, their rounding never decides (what
// may be a rival is scored by the integer sum), and where points or poses are few the sums are direct.
#include "engine/methods/fft/correlation_search.hpp"
#include "engine/methods/table.hpp"

namespace landfall::internal {

Proposal propose_fft(const Query& query) {
  return choose_way(query) == CorrelationWay::transforms ? propose_by_transforms(query)
                                                         : propose_directly(query);
}

}  // namespace landfall::internal
