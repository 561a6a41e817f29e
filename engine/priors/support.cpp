#include "engine/priors/support.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/priors/gaussian_cells.hpp"
#include "engine/priors/polygon_rows.hpp"

namespace landfall::internal {
namespace {

constexpr double sigmas = 3.0;
constexpr double slack = 1e-9;  // a border drawn exactly through a lattice pose includes it

struct MapBox {
  double x0_m, y0_m, x1_m, y1_m;
};

MapBox around(const Point2& middle, double half_x_m, double half_y_m) {
  return {middle.x_m - half_x_m, middle.y_m - half_y_m, middle.x_m + half_x_m, middle.y_m + half_y_m};
}

CellRange united(const CellRange& a, const CellRange& b) {
  if (a.empty() || b.empty()) return a.empty() ? b : a;
  return {std::min(a.col0, b.col0), std::min(a.row0, b.row0), std::max(a.col1, b.col1),
          std::max(a.row1, b.row1)};
}

BlockMask make_mask(const CellRange& box) {
  return box.empty() ? BlockMask{} : make_block_mask(box.col0, box.row0, box.col1, box.row1);
}

// The grid cells whose centres may lie in a box of the map frame, widened by a cell; clamped.
CellRange cells_around(const Lattice& lattice, const MapBox& box) {
  double col0 = 1e18;
  double row0 = 1e18;
  double col1 = -1e18;
  double row1 = -1e18;
  constexpr double farthest_m = 1e100;  // no sum of these is infinite
  for (const Point2 corner : {Point2{box.x0_m, box.y0_m}, Point2{box.x1_m, box.y0_m},
                              Point2{box.x0_m, box.y1_m}, Point2{box.x1_m, box.y1_m}}) {
    const Point2 p_grid =
        inverse(lattice.T_map_grid) * Point2{.x_m = std::clamp(corner.x_m, -farthest_m, farthest_m),
                                             .y_m = std::clamp(corner.y_m, -farthest_m, farthest_m)};
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

class SupportBuilder {
 private:
  [[nodiscard]] Point2 center(int col, int row) const {
    const double x_m = (col + 0.5) * lattice_.resolution_m;
    const double y_m = (row + 0.5) * lattice_.resolution_m;
    return {lattice_.T_map_grid.x_m + cos_grid_ * x_m - sin_grid_ * y_m,
            lattice_.T_map_grid.y_m + sin_grid_ * x_m + cos_grid_ * y_m};
  }
  // A condition on points as what insert_cells() asks: row -> (column -> is its centre inside?).
  template <class Inside>
  [[nodiscard]] auto by_centers(const Inside& inside) const {
    return [this, &inside](int row) {
      return [this, &inside, row](int col) { return inside(center(col, row)); };
    };
  }

 public:
  SupportBuilder(const Lattice& lattice, const SharedMask& free) : lattice_(lattice), free_(free) {
    out_.mask_of_heading.resize(static_cast<std::size_t>(lattice.headings));
  }

  void add(const Anywhere&) {
    on_map_ = true;
    std::fill(out_.mask_of_heading.begin(), out_.mask_of_heading.end(), free_);
  }

  void add(const Window& window) {
    const Point2 middle{window.T_map_robot.x_m, window.T_map_robot.y_m};
    const auto inside = [&](const Point2& p) {
      return std::abs(p.x_m - middle.x_m) <= window.half_x_m + slack &&
             std::abs(p.y_m - middle.y_m) <= window.half_y_m + slack;
    };
    const CellRange box = cells_around(lattice_, around(middle, window.half_x_m, window.half_y_m));
    BlockMask mask = make_mask(united(box, nearest_cell(middle)));
    insert_or_nearest(box, by_centers(inside), middle, mask);
    add_cone(std::move(mask), window.T_map_robot.theta_rad, window.half_theta_rad);
  }

  void add(const Region& region) {
    const std::vector<Point2>& corners = region.polygon_map;
    MapBox bounds{corners[0].x_m, corners[0].y_m, corners[0].x_m, corners[0].y_m};
    for (const Point2& p : corners)
      bounds = {std::min(bounds.x0_m, p.x_m), std::min(bounds.y0_m, p.y_m), std::max(bounds.x1_m, p.x_m),
                std::max(bounds.y1_m, p.y_m)};
    PolygonRows polygon(corners, lattice_.T_map_grid.theta_rad);
    const auto inside_row = [&](int row) {
      const std::vector<double>& crossings = polygon.crossings(polygon.to_rows(center(0, row)).y_m);
      return [this, &polygon, &crossings, row](int col) {
        const double x_m = polygon.to_rows(center(col, row)).x_m;
        return (crossings.end() - std::upper_bound(crossings.begin(), crossings.end(), x_m)) % 2 != 0;
      };
    };
    const Point2 middle{bounds.x0_m / 2 + bounds.x1_m / 2, bounds.y0_m / 2 + bounds.y1_m / 2};
    const CellRange box = cells_around(lattice_, bounds);
    BlockMask mask = make_mask(united(box, nearest_cell(middle)));
    insert_or_nearest(box, inside_row, middle, mask);
    add_cone(std::move(mask), region.theta_rad, region.half_theta_rad);
  }

  // One mask for all discs, of which there may be thousands.
  void add(const Beacons& beacons) {
    std::vector<CellRange> boxes;
    CellRange all;
    for (const Beacon& disc : beacons.discs) {
      boxes.push_back(cells_around(lattice_, around(disc.p_map, disc.radius_m, disc.radius_m)));
      all = united(all, united(boxes.back(), nearest_cell(disc.p_map)));
    }
    BlockMask mask = make_mask(all);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Beacon& disc = beacons.discs[i];
      const auto inside = [&](const Point2& p) {
        return std::hypot(p.x_m - disc.p_map.x_m, p.y_m - disc.p_map.y_m) <= disc.radius_m + slack;
      };
      insert_or_nearest(boxes[i], by_centers(inside), disc.p_map, mask);
    }
    add_cone(std::move(mask), 0.0, std::numbers::pi);
  }

  // One mask a heading, of whose poses there may be thousands.
  void add(const CandidatePoses& candidates) {
    std::vector<LatticePose> poses;
    for (const Pose2& T_map_robot : candidates.T_map_robot) {
      const LatticePose pose = lattice_.nearest(T_map_robot);
      if (!lattice_.contains(pose)) continue;
      on_map_ = true;
      if (free_->contains(pose.col, pose.row)) poses.push_back(pose);
    }
    std::sort(poses.begin(), poses.end());
    for (auto first = poses.begin(); first != poses.end();) {
      const auto last = std::find_if(first, poses.end(),
                                     [&](const LatticePose& pose) { return pose.heading != first->heading; });
      CellRange box;
      for (auto pose = first; pose != last; ++pose) box = united(box, one_cell(*pose));
      BlockMask mask = make_mask(box);
      for (auto pose = first; pose != last; ++pose) mask.insert(pose->col, pose->row);
      out_.mask_of_heading[static_cast<std::size_t>(first->heading)] =
          std::make_shared<const BlockMask>(std::move(mask));
      first = last;
    }
  }

  void add(const Gaussian& gaussian) {
    out_.gaussian = GaussianDensity(lattice_, gaussian);
    const GaussianDensity& density = *out_.gaussian;
    const Pose2& mean = gaussian.T_map_robot;
    const CellRange box = cells_around(
        lattice_, around({mean.x_m, mean.y_m}, sigmas * density.sigma_x_m(), sigmas * density.sigma_y_m()));
    GaussianCells cells(density, lattice_, *free_, box, -0.5 * sigmas * sigmas - slack);
    SharedMask last;
    for (const int heading : headings_in(mean.theta_rad, sigmas * density.sigma_theta_rad())) {
      auto mask = std::make_shared<BlockMask>(make_mask(box));
      out_.normaliser += cells.insert(heading_map_rad(heading), *mask);
      if (last == nullptr || last->words != mask->words) last = std::move(mask);
      out_.mask_of_heading[static_cast<std::size_t>(heading)] = last;
    }
    on_map_ = on_map_ || cells.any();
    if (cells.any()) return;
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
  [[nodiscard]] double heading_map_rad(int heading) const {
    return wrap_angle(lattice_.T_map_grid.theta_rad + lattice_.heading_grid_rad(heading));
  }

  // The free cells of the box that are inside; true where the centre of any cell is, free or not.
  template <class InsideRow>
  bool insert_cells(const CellRange& box, const InsideRow& inside_row, BlockMask& mask) const {
    const int step = lattice_.step_cells;
    bool any = false;
    for (int row = next_multiple(box.row0, step); row <= box.row1; row += step) {
      const auto inside = inside_row(row);
      for (int col = next_multiple(box.col0, step); col <= box.col1; col += step) {
        if (!inside(col)) continue;
        any = true;
        if (free_->contains(col, row)) mask.insert(col, row);
      }
    }
    return any;
  }

  // A support too thin to hold the centre of a cell holds the nearest cell.
  template <class InsideRow>
  void insert_or_nearest(const CellRange& box, const InsideRow& inside_row, const Point2& middle,
                         BlockMask& mask) {
    const CellRange nearest = nearest_cell(middle);
    const bool any = insert_cells(box, inside_row, mask);
    on_map_ = on_map_ || any || !nearest.empty();
    if (!any && !nearest.empty() && free_->contains(nearest.col0, nearest.row0))
      mask.insert(nearest.col0, nearest.row0);
  }

  static CellRange one_cell(const LatticePose& pose) { return {pose.col, pose.row, pose.col, pose.row}; }
  // Empty where a point is nearest to a cell outside of the grid.
  [[nodiscard]] CellRange nearest_cell(const Point2& p_map) const {
    const LatticePose pose = lattice_.nearest({p_map.x_m, p_map.y_m, 0.0});
    return lattice_.contains(pose) ? one_cell(pose) : CellRange{};
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
