#include "engine/domain.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace landfall::internal {
namespace {

constexpr double sigmas = 3.0;
constexpr double slack = 1e-9;  // a border drawn exactly through a lattice pose includes it

struct CellBox {
  int col0, row0, col1, row1;
};

struct MapBox {
  double x0_m, y0_m, x1_m, y1_m;
};

// The grid cells whose centres may lie in a box of the map frame, widened by a cell; clamped.
CellBox cells_around(const Lattice& lattice, const MapBox& box) {
  double col0 = 1e18;
  double row0 = 1e18;
  double col1 = -1e18;
  double row1 = -1e18;
  for (const Point2 corner : {Point2{box.x0_m, box.y0_m}, Point2{box.x1_m, box.y0_m},
                              Point2{box.x0_m, box.y1_m}, Point2{box.x1_m, box.y1_m}}) {
    const Point2 p_grid = inverse(lattice.T_map_grid) * corner;
    col0 = std::min(col0, p_grid.x_m / lattice.resolution_m);
    col1 = std::max(col1, p_grid.x_m / lattice.resolution_m);
    row0 = std::min(row0, p_grid.y_m / lattice.resolution_m);
    row1 = std::max(row1, p_grid.y_m / lattice.resolution_m);
  }
  const auto clamp = [](double value, int limit) {
    return static_cast<int>(std::clamp(std::floor(value), -1.0, double(limit)));
  };
  return {std::max(0, clamp(col0 - 1, lattice.width_cells)), std::max(0, clamp(row0 - 1, lattice.height_cells)),
          std::min(lattice.width_cells - 1, clamp(col1 + 1, lattice.width_cells)),
          std::min(lattice.height_cells - 1, clamp(row1 + 1, lattice.height_cells))};
}

// Headings mostly share masks: each run of equal ones is counted once.
std::int64_t count_poses(const std::vector<SharedMask>& mask_of_heading) {
  std::int64_t poses = 0;
  for (std::size_t k = 0; k < mask_of_heading.size();) {
    std::size_t end = k + 1;
    while (end < mask_of_heading.size() && mask_of_heading[end] == mask_of_heading[k]) ++end;
    if (mask_of_heading[k] != nullptr) poses += mask_of_heading[k]->count() * static_cast<std::int64_t>(end - k);
    k = end;
  }
  return poses;
}

class Builder {
 public:
  Builder(const Lattice& lattice, const SharedMask& free) : lattice_(lattice), free_(free) {}

  DomainComponent component(const PosePrior& prior, double weight) {
    out_ = {};
    out_.weight = weight;
    out_.mask_of_heading.resize(static_cast<std::size_t>(lattice_.headings));
    std::visit([this](const auto& kind) { add(kind); }, prior.kind);
    if (!out_.is_gaussian) out_.normaliser = static_cast<double>(count_poses(out_.mask_of_heading));
    return out_;
  }
  [[nodiscard]] bool on_map() const { return on_map_; }

 private:
  using InSupport = std::function<bool(const Point2&)>;

  void add(const Anywhere&) {
    on_map_ = true;
    std::fill(out_.mask_of_heading.begin(), out_.mask_of_heading.end(), free_);
  }

  void add(const Window& window) {
    const Pose2& center = window.T_map_robot;
    const auto inside = [&](const Point2& p) {
      return std::abs(p.x_m - center.x_m) <= window.half_x_m + slack &&
             std::abs(p.y_m - center.y_m) <= window.half_y_m + slack;
    };
    const MapBox box{center.x_m - window.half_x_m, center.y_m - window.half_y_m,
                     center.x_m + window.half_x_m, center.y_m + window.half_y_m};
    add_cone(cells(box, inside, {center.x_m, center.y_m}), center.theta_rad, window.half_theta_rad);
  }

  void add(const Region& region) {
    const std::vector<Point2>& corners = region.polygon_map;
    const auto inside = [&](const Point2& p) {
      bool odd = false;
      for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
        const Point2& a = corners[i];
        const Point2& b = corners[j];
        if ((a.y_m > p.y_m) == (b.y_m > p.y_m)) continue;
        if (p.x_m < a.x_m + (p.y_m - a.y_m) / (b.y_m - a.y_m) * (b.x_m - a.x_m)) odd = !odd;
      }
      return odd;
    };
    MapBox box{corners[0].x_m, corners[0].y_m, corners[0].x_m, corners[0].y_m};
    for (const Point2& p : corners)
      box = {std::min(box.x0_m, p.x_m), std::min(box.y0_m, p.y_m), std::max(box.x1_m, p.x_m),
             std::max(box.y1_m, p.y_m)};
    const Point2 middle{(box.x0_m + box.x1_m) / 2, (box.y0_m + box.y1_m) / 2};
    add_cone(cells(box, inside, middle), region.theta_rad, region.half_theta_rad);
  }

  void add(const Beacons& beacons) {
    BlockMask all;
    for (const Beacon& disc : beacons.discs) {
      const auto inside = [&](const Point2& p) {
        return std::hypot(p.x_m - disc.p_map.x_m, p.y_m - disc.p_map.y_m) <= disc.radius_m + slack;
      };
      const MapBox box{disc.p_map.x_m - disc.radius_m, disc.p_map.y_m - disc.radius_m,
                       disc.p_map.x_m + disc.radius_m, disc.p_map.y_m + disc.radius_m};
      all = merged(all, cells(box, inside, disc.p_map));
    }
    add_cone(std::move(all), 0.0, std::numbers::pi);
  }

  void add(const CandidatePoses& candidates) {
    for (const Pose2& T_map_robot : candidates.T_map_robot) {
      const LatticePose pose = lattice_.nearest(T_map_robot);
      if (pose.col < 0 || pose.col >= lattice_.width_cells || pose.row < 0 || pose.row >= lattice_.height_cells) continue;
      on_map_ = true;
      if (!free_->contains(pose.col, pose.row)) continue;
      BlockMask one = make_block_mask(pose.col, pose.row, pose.col, pose.row);
      one.insert(pose.col, pose.row);
      SharedMask& mask = out_.mask_of_heading[static_cast<std::size_t>(pose.heading)];
      mask = std::make_shared<BlockMask>(mask == nullptr ? one : merged(*mask, one));
    }
  }

  void add(const Gaussian& gaussian) {
    out_.is_gaussian = true;
    out_.gaussian = gaussian;
    const double sigma_x_m = std::sqrt(gaussian.covariance[0]);
    const double sigma_y_m = std::sqrt(gaussian.covariance[4]);
    const double sigma_theta_rad = std::sqrt(gaussian.covariance[8]);
    const Pose2& mean = gaussian.T_map_robot;
    const MapBox box{mean.x_m - sigmas * sigma_x_m, mean.y_m - sigmas * sigma_y_m,
                     mean.x_m + sigmas * sigma_x_m, mean.y_m + sigmas * sigma_y_m};
    for (const int heading : headings_in(mean.theta_rad, std::min(std::numbers::pi, sigmas * sigma_theta_rad))) {
      const auto inside = [&](const Point2& p) {
        return log_gaussian(lattice_, gaussian, p, heading) >= -0.5 * sigmas * sigmas - slack;
      };
      auto mask = std::make_shared<BlockMask>(cells(box, inside, {mean.x_m, mean.y_m}));
      visit_cells(*mask, [&](int col, int row) {
        out_.normaliser += std::exp(log_gaussian(lattice_, gaussian, center(col, row), heading));
      });
      out_.mask_of_heading[static_cast<std::size_t>(heading)] = std::move(mask);
    }
  }

  void add(const Mixture&) {}  // flattened before

 public:
  // -mahalanobis^2 / 2; a direction without spread counts as the lattice's own step.
  static double log_gaussian(const Lattice& lattice, const Gaussian& gaussian, const Point2& p_map, int heading) {
    Eigen::Matrix3d covariance = Eigen::Map<const Eigen::Matrix3d>(gaussian.covariance.data());
    const double floor_m = lattice.resolution_m * lattice.step_cells / sigmas;
    const double floor_rad = lattice.heading_step_rad() / sigmas;
    covariance.diagonal() += Eigen::Vector3d(floor_m * floor_m, floor_m * floor_m, floor_rad * floor_rad) * 1e-2;
    const double theta_rad = lattice.T_map_grid.theta_rad + lattice.heading_grid_rad(heading);
    const Eigen::Vector3d off(p_map.x_m - gaussian.T_map_robot.x_m, p_map.y_m - gaussian.T_map_robot.y_m,
                              wrap_angle(theta_rad - gaussian.T_map_robot.theta_rad));
    return -0.5 * off.dot(covariance.ldlt().solve(off));
  }

  template <class Visit>
  static void visit_cells(const BlockMask& mask, const Visit& visit) {
    using kernels::block_cells;
    std::size_t i = 0;
    for (int r = 0; r < mask.rows; ++r) {
      for (int c = 0; c < mask.cols; ++c) {
        const std::uint64_t word = mask.words[i++];
        for (int bit = 0; word != 0 && bit < kernels::block_poses; ++bit)
          if ((word >> bit) & 1U)
            visit((mask.first_col + c) * block_cells + bit % block_cells,
                  (mask.first_row + r) * block_cells + bit / block_cells);
      }
    }
  }

 private:
  [[nodiscard]] Point2 center(int col, int row) const {
    const Pose2 pose = lattice_.T_map_robot({0, row, col});
    return {pose.x_m, pose.y_m};
  }

  // Free cells of the support; a support too thin to hold a lattice cell's centre holds the nearest.
  BlockMask cells(const MapBox& box, const InSupport& inside, const Point2& middle) {
    const CellBox range = cells_around(lattice_, box);
    if (range.col0 > range.col1 || range.row0 > range.row1) return {};
    BlockMask mask = make_block_mask(range.col0, range.row0, range.col1, range.row1);
    const auto up = [&](int value) { return (value + lattice_.step_cells - 1) / lattice_.step_cells * lattice_.step_cells; };
    bool any = false;
    for (int row = up(range.row0); row <= range.row1; row += lattice_.step_cells) {
      for (int col = up(range.col0); col <= range.col1; col += lattice_.step_cells) {
        if (!inside(center(col, row))) continue;
        any = true;
        if (free_->contains(col, row)) mask.insert(col, row);
      }
    }
    if (!any) {
      const LatticePose pose = lattice_.nearest({middle.x_m, middle.y_m, 0.0});
      any = pose.col >= range.col0 && pose.col <= range.col1 && pose.row >= range.row0 && pose.row <= range.row1;
      if (any && free_->contains(pose.col, pose.row)) mask.insert(pose.col, pose.row);
    }
    on_map_ = on_map_ || any;
    return mask;
  }

  // Lattice headings within a cone of the map frame; a cone too thin to hold one holds the nearest.
  [[nodiscard]] std::vector<int> headings_in(double theta_rad, double half_theta_rad) const {
    std::vector<int> headings;
    for (int k = 0; k < lattice_.headings; ++k) {
      const double heading_rad = lattice_.T_map_grid.theta_rad + lattice_.heading_grid_rad(k);
      if (angle_distance(heading_rad, theta_rad) <= half_theta_rad + slack) headings.push_back(k);
    }
    if (headings.empty()) headings.push_back(lattice_.nearest({0.0, 0.0, theta_rad}).heading);
    return headings;
  }

  void add_cone(BlockMask mask, double theta_rad, double half_theta_rad) {
    const auto shared = std::make_shared<const BlockMask>(std::move(mask));
    for (const int heading : headings_in(theta_rad, half_theta_rad))
      out_.mask_of_heading[static_cast<std::size_t>(heading)] = shared;
  }

  const Lattice& lattice_;
  const SharedMask& free_;
  DomainComponent out_;
  bool on_map_ = false;
};

void flatten(const PosePrior& prior, double weight, std::vector<std::pair<const PosePrior*, double>>& plain) {
  const auto* mixture = std::get_if<Mixture>(&prior.kind);
  if (mixture == nullptr) {
    plain.emplace_back(&prior, weight);
    return;
  }
  const double total = std::accumulate(mixture->weights.begin(), mixture->weights.end(), 0.0);
  for (std::size_t i = 0; i < mixture->components.size(); ++i)
    flatten(mixture->components[i], weight * mixture->weights[i] / total, plain);
}

}  // namespace

bool Domain::contains(const LatticePose& pose) const {
  const SharedMask& mask = mask_of_heading[static_cast<std::size_t>(pose.heading)];
  return mask != nullptr && mask->contains(pose.col, pose.row);
}

double Domain::log_prior(const Lattice& lattice, const LatticePose& pose) const {
  double density = 0.0;
  for (const DomainComponent& component : components) {
    const SharedMask& mask = component.mask_of_heading[static_cast<std::size_t>(pose.heading)];
    if (mask == nullptr || !mask->contains(pose.col, pose.row)) continue;
    double one = 1.0;
    if (component.is_gaussian) {
      const Pose2 T_map_robot = lattice.T_map_robot(pose);
      one = std::exp(Builder::log_gaussian(lattice, component.gaussian, {T_map_robot.x_m, T_map_robot.y_m}, pose.heading));
    }
    density += component.weight * one / component.normaliser;
  }
  return std::log(density);
}

Domain make_domain(const PosePrior& prior, const Lattice& lattice, const SharedMask& free) {
  std::vector<std::pair<const PosePrior*, double>> plain;
  flatten(prior, 1.0, plain);
  Domain domain;
  Builder builder(lattice, free);
  for (const auto& [part, weight] : plain) domain.components.push_back(builder.component(*part, weight));
  domain.on_map = builder.on_map();
  domain.mask_of_heading = domain.components.front().mask_of_heading;
  for (std::size_t i = 1; i < domain.components.size(); ++i) {
    for (std::size_t k = 0; k < domain.mask_of_heading.size(); ++k) {
      SharedMask& mask = domain.mask_of_heading[k];
      const SharedMask& other = domain.components[i].mask_of_heading[k];
      if (other == nullptr || other == mask) continue;
      mask = mask == nullptr ? other : std::make_shared<const BlockMask>(merged(*mask, *other));
    }
  }
  domain.poses = count_poses(domain.mask_of_heading);
  return domain;
}

}  // namespace landfall::internal
