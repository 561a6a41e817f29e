#include "engine/priors/off_map.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <variant>

#include "engine/base/number_text.hpp"

namespace landfall::internal {
namespace {

Point2 some_point(const PosePrior& prior);

Point2 point_of(const Anywhere&) {
  return {};
}
Point2 point_of(const Window& window) {
  return {window.T_map_robot.x_m, window.T_map_robot.y_m};
}
Point2 point_of(const Gaussian& gaussian) {
  return {gaussian.T_map_robot.x_m, gaussian.T_map_robot.y_m};
}
Point2 point_of(const Region& region) {
  return region.polygon_map.front();
}
Point2 point_of(const Beacons& beacons) {
  return beacons.discs.front().p_map;
}
Point2 point_of(const CandidatePoses& poses) {
  return {poses.T_map_robot.front().x_m, poses.T_map_robot.front().y_m};
}
Point2 point_of(const Mixture& mixture) {
  return some_point(mixture.components.front());
}

// Lists are not empty: validate() saw to it.
Point2 some_point(const PosePrior& prior) {
  return std::visit([](const auto& kind) { return point_of(kind); }, prior.kind);
}

std::string span_text(const GridMap& map) {
  const double width_m = map.width_cells * map.resolution_m;
  const double height_m = map.height_cells * map.resolution_m;
  constexpr double big = std::numeric_limits<double>::max();
  Point2 low{big, big};
  Point2 high{-big, -big};
  for (const Point2& corner :
       std::array<Point2, 4>{{{0.0, 0.0}, {width_m, 0.0}, {0.0, height_m}, {width_m, height_m}}}) {
    const Point2 p_map = map.T_map_grid * corner;
    low = {std::min(low.x_m, p_map.x_m), std::min(low.y_m, p_map.y_m)};
    high = {std::max(high.x_m, p_map.x_m), std::max(high.y_m, p_map.y_m)};
  }
  return "x " + number_text(low.x_m) + " to " + number_text(high.x_m) + " m, y " + number_text(low.y_m) +
         " to " + number_text(high.y_m) + " m";
}

}  // namespace

std::string off_map_text(std::span<const PosePrior> priors, std::size_t index,
                         std::span<const PreparedMap> maps) {
  const Point2 at = some_point(priors[index]);
  std::string text = "prior" + (priors.size() > 1 ? " " + std::to_string(index) : "") +
                     " lies entirely off the map" + (maps.size() > 1 ? "s" : "") + ": it is at (" +
                     number_text(at.x_m) + ", " + number_text(at.y_m) + ") m, and the ";
  text += maps.size() > 1 ? "first map spans " : "map spans ";
  return text + span_text(maps.front().grid());
}

}  // namespace landfall::internal
