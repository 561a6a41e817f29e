#include "engine/methods/branch_and_bound/point_order.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace landfall::internal {

EndPoints most_telling_first(const EndPoints& points, SharedSearch& search, const HeadingGroups& groups,
                             const std::vector<Node>& nodes) {
  constexpr std::size_t most_sampled = 64;
  using kernels::block_cells;
  const std::size_t sampled = std::min(most_sampled, nodes.size());
  const kernels::WindowMaxima& maxima = search.maxima;
  std::vector<std::int64_t> seen(points.size());  // sum of the windows' maxima
  for (std::size_t i = 0; i < sampled; ++i) {
    const Node& node = nodes[i * nodes.size() / sampled];
    const kernels::TilePoints& at =
        search.points->at((groups.first(node.group) + groups.last(node.group)) / 2);
    const int lane = std::countr_zero(node.lanes);
    const int col = (node.col + kernels::lane_col(lane)) * block_cells;
    const int row = (node.row + kernels::lane_row(lane)) * block_cells;
    for (std::size_t p = 0; p < points.size(); ++p)
      seen[p] += maxima.level[maxima.tile_index(col + at.col[p], row + at.row[p])];
  }
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return seen[a] < seen[b]; });
  EndPoints ordered;
  ordered.x_cells.reserve(points.size());
  ordered.y_cells.reserve(points.size());
  for (const std::size_t p : order) {
    ordered.x_cells.push_back(points.x_cells[p]);
    ordered.y_cells.push_back(points.y_cells[p]);
  }
  return ordered;
}

}  // namespace landfall::internal
