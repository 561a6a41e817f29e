#include "engine/support.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

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
  return {std::max(0, clamp(col0 - 1, lattice.width_cells)),
          std::max(0, clamp(row0 - 1, lattice.height_cells)),
          std::min(lattice.width_cells - 1, clamp(col1 + 1, lattice.width_cells)),
          std::min(lattice.height_cells - 1, clamp(row1 + 1, lattice.height_cells))};
}

template <class Visit>
void visit_cells(const BlockMask& mask, const Visit& visit) {
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

class SupportBuilder {
 public:
  SupportBuilder(const Lattice& lattice, const SharedMask& free) : lattice_(lattice), free_(free) {
    out_.mask_of_heading.resize(static_cast<std::size_t>(lattice.headings));
  }

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
    const MapBox box{center.x_m - window.half_x_m, center.y_m - window.half_y_m, center.x_m + window.half_x_m,
                     center.y_m + window.half_y_m};
    add_cone(cells_or_nearest(box, inside, {center.x_m, center.y_m}), center.theta_rad,
             window.half_theta_rad);
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
    add_cone(cells_or_nearest(box, inside, middle), region.theta_rad, region.half_theta_rad);
  }

  void add(const Beacons& beacons) {
    BlockMask all;
    for (const Beacon& disc : beacons.discs) {
      const auto inside = [&](const Point2& p) {
        return std::hypot(p.x_m - disc.p_map.x_m, p.y_m - disc.p_map.y_m) <= disc.radius_m + slack;
      };
      const MapBox box{disc.p_map.x_m - disc.radius_m, disc.p_map.y_m - disc.radius_m,
                       disc.p_map.x_m + disc.radius_m, disc.p_map.y_m + disc.radius_m};
      all = merged(all, cells_or_nearest(box, inside, disc.p_map));
    }
    add_cone(std::move(all), 0.0, std::numbers::pi);
  }

  void add(const CandidatePoses& candidates) {
    for (const Pose2& T_map_robot : candidates.T_map_robot) {
      const LatticePose pose = lattice_.nearest(T_map_robot);
      if (!lattice_.contains(pose)) continue;
      on_map_ = true;
      if (!free_->contains(pose.col, pose.row)) continue;
      BlockMask one = make_block_mask(pose.col, pose.row, pose.col, pose.row);
      one.insert(pose.col, pose.row);
      SharedMask& mask = out_.mask_of_heading[static_cast<std::size_t>(pose.heading)];
      mask = std::make_shared<BlockMask>(mask == nullptr ? one : merged(*mask, one));
    }
  }

  void add(const Gaussian& gaussian) {
    out_.gaussian = GaussianDensity(lattice_, gaussian);
    const GaussianDensity& density = *out_.gaussian;
    const Pose2& mean = gaussian.T_map_robot;
    const double reach_x_m = sigmas * density.sigma_x_m();
    const double reach_y_m = sigmas * density.sigma_y_m();
    const MapBox box{mean.x_m - reach_x_m, mean.y_m - reach_y_m, mean.x_m + reach_x_m, mean.y_m + reach_y_m};
    bool any = false;
    for (const int heading : headings_in(mean.theta_rad, sigmas * density.sigma_theta_rad())) {
      const double theta_rad = heading_map_rad(heading);
      auto mask = std::make_shared<BlockMask>(cells(
          box,
          [&](const Point2& p) {
            return density.log({p.x_m, p.y_m, theta_rad}) >= -0.5 * sigmas * sigmas - slack;
          },
          any));
      visit_cells(*mask, [&](int col, int row) {
        const Point2 p = center(col, row);
        out_.normaliser += std::exp(density.log({p.x_m, p.y_m, theta_rad}));
      });
      out_.mask_of_heading[static_cast<std::size_t>(heading)] = std::move(mask);
    }
    if (any) return;
    add(CandidatePoses{{mean}});
    out_.gaussian.reset();
  }

  void add(const Mixture&) {}  // its parts are added one by one

  DomainComponent take(bool& on_map) && {
    if (!out_.gaussian) out_.normaliser = static_cast<double>(count_poses(out_.mask_of_heading));
    on_map = on_map || on_map_;
    return std::move(out_);
  }

 private:
  using InSupport = std::function<bool(const Point2&)>;

  [[nodiscard]] Point2 center(int col, int row) const {
    const double x_m = (col + 0.5) * lattice_.resolution_m;
    const double y_m = (row + 0.5) * lattice_.resolution_m;
    return {lattice_.T_map_grid.x_m + cos_grid_ * x_m - sin_grid_ * y_m,
            lattice_.T_map_grid.y_m + sin_grid_ * x_m + cos_grid_ * y_m};
  }
  [[nodiscard]] double heading_map_rad(int heading) const {
    return wrap_angle(lattice_.T_map_grid.theta_rad + lattice_.heading_grid_rad(heading));
  }

  // Free cells of the support; `any` is set where it holds the centre of a cell, free or not.
  BlockMask cells(const MapBox& box, const InSupport& inside, bool& any) {
    const CellBox range = cells_around(lattice_, box);
    if (range.col0 > range.col1 || range.row0 > range.row1) return {};
    BlockMask mask = make_block_mask(range.col0, range.row0, range.col1, range.row1);
    const int step = lattice_.step_cells;
    const auto up = [step](int value) { return (value + step - 1) / step * step; };
    for (int row = up(range.row0); row <= range.row1; row += step) {
      for (int col = up(range.col0); col <= range.col1; col += step) {
        if (!inside(center(col, row))) continue;
        any = true;
        if (free_->contains(col, row)) mask.insert(col, row);
      }
    }
    on_map_ = on_map_ || any;
    return mask;
  }

  BlockMask cells_or_nearest(const MapBox& box, const InSupport& inside, const Point2& middle) {
    bool any = false;
    BlockMask mask = cells(box, inside, any);
    const LatticePose pose = lattice_.nearest({middle.x_m, middle.y_m, 0.0});
    if (any || !lattice_.contains(pose)) return mask;
    on_map_ = true;
    BlockMask one = make_block_mask(pose.col, pose.row, pose.col, pose.row);
    if (free_->contains(pose.col, pose.row)) one.insert(pose.col, pose.row);
    return one;
  }

  // Lattice headings within a cone of the map frame, in order; a cone too thin to hold one holds the nearest.
  [[nodiscard]] std::vector<int> headings_in(double theta_rad, double half_theta_rad) const {
    const int nearest = lattice_.nearest({0.0, 0.0, theta_rad}).heading;
    const auto wrapped = [&](int k) {
      return (k % lattice_.headings + lattice_.headings) % lattice_.headings;
    };
    const auto is_inside = [&](int k) {
      return angle_distance(heading_map_rad(wrapped(k)), theta_rad) <= half_theta_rad + slack;
    };
    int first = nearest;
    int last = nearest + 1;
    while (last - first < lattice_.headings && is_inside(last)) ++last;
    while (last - first < lattice_.headings && is_inside(first - 1)) --first;
    std::vector<int> headings;
    for (int k = first; k < last; ++k) headings.push_back(wrapped(k));
    std::sort(headings.begin(), headings.end());
    return headings;
  }

  void add_cone(BlockMask mask, double theta_rad, double half_theta_rad) {
    const auto shared = std::make_shared<const BlockMask>(std::move(mask));
    for (const int heading : headings_in(theta_rad, half_theta_rad))
      out_.mask_of_heading[static_cast<std::size_t>(heading)] = shared;
  }

  const Lattice& lattice_;
  const SharedMask& free_;
  double cos_grid_ = std::cos(lattice_.T_map_grid.theta_rad);  // asked for every cell
  double sin_grid_ = std::sin(lattice_.T_map_grid.theta_rad);
  DomainComponent out_;
  bool on_map_ = false;
};

}  // namespace

// Headings mostly share masks: each run of equal ones is counted once.
std::int64_t count_poses(const std::vector<SharedMask>& mask_of_heading) {
  std::int64_t poses = 0;
  for (std::size_t k = 0; k < mask_of_heading.size();) {
    std::size_t end = k + 1;
    while (end < mask_of_heading.size() && mask_of_heading[end] == mask_of_heading[k]) ++end;
    if (mask_of_heading[k] != nullptr)
      poses += mask_of_heading[k]->count() * static_cast<std::int64_t>(end - k);
    k = end;
  }
  return poses;
}

DomainComponent make_support(const PosePrior& prior, const Lattice& lattice, const SharedMask& free,
                             bool& on_map) {
  SupportBuilder builder(lattice, free);
  std::visit([&builder](const auto& kind) { builder.add(kind); }, prior.kind);
  return std::move(builder).take(on_map);
}

}  // namespace landfall::internal
