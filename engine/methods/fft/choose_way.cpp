#include <algorithm>
#include <cmath>

#include "engine/methods/fft/correlation_search.hpp"
#include "engine/methods/fft/cost_model.hpp"
#include "engine/methods/fft/tiles.hpp"

namespace landfall::internal {
namespace {

std::int64_t used_blocks(const BlockMask& mask) {
  return std::count_if(mask.words.begin(), mask.words.end(), [](std::uint64_t word) { return word != 0; });
}

}  // namespace

int reach_cells(const EndPoints& points) {
  double farthest = 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    farthest = std::max(farthest, std::hypot(points.x_cells[i], points.y_cells[i]));
  return static_cast<int>(farthest) + 2;  // rounded to the cell that holds it
}

CorrelationWay choose_way(const Query& query) {
  const Lattice& lattice = query.lattice;
  const int reach = prepared_reach(lattice.width_cells, lattice.height_cells, reach_cells(query.points));
  const double heading_ns = choose_tiles(lattice.width_cells, lattice.height_cells, reach).cost_ns();
  const double block_ns = direct_ns(static_cast<double>(query.points.size()));
  double by_transforms_ns = 0.0;
  double directly_ns = 0.0;
  const BlockMask* last = nullptr;  // neighbouring headings share masks
  std::int64_t blocks = 0;
  for (const SharedMask& mask : query.domain.mask_of_heading) {
    if (mask == nullptr) continue;
    if (mask.get() != last) blocks = used_blocks(*mask);
    last = mask.get();
    by_transforms_ns += heading_ns;
    directly_ns += static_cast<double>(blocks) * block_ns;
  }
  return by_transforms_ns < directly_ns ? CorrelationWay::transforms : CorrelationWay::direct;
}

}  // namespace landfall::internal
