#include "engine/methods/sdn/cluster.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <vector>

namespace landfall::internal {
namespace {

struct Bin {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t theta = 0;
  friend auto operator<=>(const Bin&, const Bin&) = default;
};

struct Binned {
  Bin bin;
  std::uint32_t mapping;
  friend auto operator<=>(const Binned&, const Binned&) = default;
};

bool counts(const Mapping& mapping, Counted counted) {
  return counted == Counted::focused ? mapping.focused : mapping.active;
}

std::vector<Binned> in_bins(std::span<const Mapping> mappings, const FocusLevel& reach, Counted counted) {
  std::vector<Binned> binned;
  for (std::size_t i = 0; i < mappings.size(); ++i) {
    if (!counts(mappings[i], counted)) continue;
    const Pose2& pose = mappings[i].T_map_robot;
    binned.push_back(
        {.bin = {.x = static_cast<std::int32_t>(std::floor(pose.x_m / (2.0 * reach.half_m))),
                 .y = static_cast<std::int32_t>(std::floor(pose.y_m / (2.0 * reach.half_m))),
                 .theta = static_cast<std::int32_t>(std::floor(pose.theta_rad / (2.0 * reach.half_rad)))},
         .mapping = static_cast<std::uint32_t>(i)});
  }
  std::sort(binned.begin(), binned.end());
  return binned;
}

// The mapping in the middle of the fullest bin.
std::uint32_t densest(const std::vector<Binned>& binned) {
  std::size_t best = 0;
  std::size_t most = 0;
  for (std::size_t first = 0, last = 0; first < binned.size(); first = last) {
    while (last < binned.size() && binned[last].bin == binned[first].bin) ++last;
    if (last - first <= most) continue;
    most = last - first;
    best = first + most / 2;
  }
  return binned[best].mapping;
}

Cluster around(std::span<const Mapping> mappings, const Pose2& center, const FocusLevel& reach,
               Counted counted) {
  Cluster cluster;
  double x_m = 0.0;
  double y_m = 0.0;
  double c = 0.0;
  double s = 0.0;
  for (const Mapping& mapping : mappings) {
    const Pose2& pose = mapping.T_map_robot;
    if (!counts(mapping, counted) || std::abs(pose.x_m - center.x_m) > reach.half_m ||
        std::abs(pose.y_m - center.y_m) > reach.half_m ||
        angle_distance(pose.theta_rad, center.theta_rad) > reach.half_rad)
      continue;
    ++cluster.cells;
    x_m += pose.x_m - center.x_m;
    y_m += pose.y_m - center.y_m;
    c += std::cos(pose.theta_rad);
    s += std::sin(pose.theta_rad);
  }
  const auto count = static_cast<double>(std::max<std::size_t>(1, cluster.cells));
  cluster.T_map_robot = {center.x_m + x_m / count, center.y_m + y_m / count, std::atan2(s, c)};
  return cluster;
}

}  // namespace

Cluster largest_cluster(std::span<const Mapping> mappings, const FocusLevel& reach, Counted counted) {
  constexpr int rounds = 3;
  const std::vector<Binned> binned = in_bins(mappings, reach, counted);
  if (binned.empty()) return {};
  Cluster cluster{.cells = 1, .T_map_robot = mappings[densest(binned)].T_map_robot};
  for (int i = 0; i < rounds; ++i) {
    const Cluster next = around(mappings, cluster.T_map_robot, reach, counted);
    if (next.cells == 0) break;
    cluster = next;
  }
  return cluster;
}

}  // namespace landfall::internal
