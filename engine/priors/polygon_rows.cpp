#include "engine/priors/polygon_rows.hpp"

#include <algorithm>
#include <cmath>

namespace landfall::internal {

PolygonRows::PolygonRows(std::span<const Point2> polygon_map, double theta_map_grid_rad)
    : cos_(std::cos(theta_map_grid_rad)), sin_(std::sin(theta_map_grid_rad)) {
  edges_.reserve(polygon_map.size());
  for (std::size_t i = 0, j = polygon_map.size() - 1; i < polygon_map.size(); j = i++)
    edges_.push_back({.a = to_rows(polygon_map[i]), .b = to_rows(polygon_map[j])});
  std::sort(edges_.begin(), edges_.end(),
            [](const Edge& one, const Edge& other) { return one.low_m() < other.low_m(); });
}

Point2 PolygonRows::to_rows(const Point2& p_map) const {
  return {.x_m = cos_ * p_map.x_m + sin_ * p_map.y_m, .y_m = cos_ * p_map.y_m - sin_ * p_map.x_m};
}

const std::vector<double>& PolygonRows::crossings(double y_m) {
  for (; next_ < edges_.size() && edges_[next_].low_m() <= y_m; ++next_) active_.push_back(edges_[next_]);
  std::erase_if(active_, [&](const Edge& edge) { return edge.high_m() <= y_m; });
  crossings_.clear();
  for (const auto& [a, b] : active_) {
    const double x_m = a.x_m + (y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m);
    if (!std::isnan(x_m)) crossings_.push_back(x_m);  // corners farther apart than numbers reach
  }
  std::sort(crossings_.begin(), crossings_.end());
  return crossings_;
}

}  // namespace landfall::internal
