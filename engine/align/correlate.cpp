#include "engine/align/correlate.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>

#include "engine/align/overlap.hpp"

namespace landfall::internal {
namespace {

constexpr double heading_step_rad = std::numbers::pi / 180.0;
constexpr double support_sigmas = 3.0;
// Odometry that is worse than this has lost the scan before.
constexpr double widest_search_m = 3.0;
// Sums of so many bytes fit into 16 bits.
constexpr std::size_t most_points = 257;

constexpr std::size_t most_poses = 12;
constexpr double least_nats_below_best = 15.0;
constexpr double distinct_m = 0.2;
constexpr double distinct_rad = 4.0 * heading_step_rad;

constexpr float excluded = std::numeric_limits<float>::lowest();

std::vector<Point2> some_points(std::span<const SurfacePoint> points) {
  const std::size_t stride = (points.size() + most_points - 1) / most_points;
  std::vector<Point2> some;
  for (std::size_t i = 0; i < points.size(); i += stride) some.push_back(points[i].p);
  return some;
}

// Log posteriors of headings x rows x columns around odometry's pose.
class PoseVolume {
 public:
  PoseVolume(const ScanView& before, const ScanView& after, const OdometryStep& step)
      : before_(before), step_(step), points_(some_points(after.points())) {
    const double reach_m = std::min(widest_search_m, support_sigmas * step.sigma.translation_m);
    const double reach_rad = std::min(std::numbers::pi, support_sigmas * step.sigma.rotation_rad);
    half_ = static_cast<int>(std::ceil(reach_m / before.resolution_m()));
    half_headings_ = static_cast<int>(std::ceil(reach_rad / heading_step_rad));
    side_ = 2 * half_ + 1;
    nats_per_value_ = overlap_nats(points_.size()) / (255.0 * static_cast<double>(points_.size()));
    posterior_.resize(static_cast<std::size_t>(headings()) * plane());
    for (int heading = 0; heading < headings(); ++heading) score(heading);
  }

  [[nodiscard]] std::vector<Pose2> best_poses() const;

 private:
  struct Peak {
    float posterior;
    int heading;
    int row;
    int col;
  };

  [[nodiscard]] int headings() const { return 2 * half_headings_ + 1; }
  [[nodiscard]] std::size_t plane() const {
    return static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_);
  }
  [[nodiscard]] float at(int heading, int row, int col) const {
    const bool inside =
        heading >= 0 && heading < headings() && row >= 0 && row < side_ && col >= 0 && col < side_;
    return inside ? posterior_[static_cast<std::size_t>(heading) * plane() +
                               static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
                               static_cast<std::size_t>(col)]
                  : excluded;
  }
  [[nodiscard]] Pose2 pose(const Peak& peak) const {
    return {.x_m = step_.T_before_after.x_m + (peak.col - half_) * before_.resolution_m(),
            .y_m = step_.T_before_after.y_m + (peak.row - half_) * before_.resolution_m(),
            .theta_rad = heading_rad(peak.heading)};
  }
  [[nodiscard]] double heading_rad(int heading) const {
    return wrap_angle(step_.T_before_after.theta_rad + (heading - half_headings_) * heading_step_rad);
  }

  void score(int heading);
  void add_point(ScanView::Cell low, std::vector<std::uint16_t>& sums) const;
  void add_prior(int heading, const std::vector<std::uint16_t>& sums);
  [[nodiscard]] bool is_peak(const Peak& peak) const;
  [[nodiscard]] std::vector<Peak> peaks() const;

  const ScanView& before_;
  const OdometryStep& step_;
  std::vector<Point2> points_;
  int half_ = 0;  // cells from odometry's pose to the edge
  int half_headings_ = 0;
  int side_ = 1;
  double nats_per_value_ = 0.0;
  std::vector<float> posterior_;
};

// sums[k] += cells[k], which compilers turn into vector code.
void add_row(const std::uint8_t* __restrict cells, int count, std::uint16_t* __restrict sums) {
  for (int k = 0; k < count; ++k) sums[k] = static_cast<std::uint16_t>(sums[k] + cells[k]);
}

void PoseVolume::score(int heading) {
  std::vector<std::uint16_t> sums(plane(), 0);
  const double c = std::cos(heading_rad(heading));
  const double s = std::sin(heading_rad(heading));
  for (const Point2& p : points_) {
    ScanView::Cell low = before_.cell_of(step_.T_before_after.x_m + c * p.x_m - s * p.y_m,
                                         step_.T_before_after.y_m + s * p.x_m + c * p.y_m);
    low.col -= half_;
    low.row -= half_;
    add_point(low, sums);
  }
  add_prior(heading, sums);
}

// The window of the field that begins at `low`.
void PoseVolume::add_point(ScanView::Cell low, std::vector<std::uint16_t>& sums) const {
  const std::uint8_t* field = before_.field().data();
  const int width = before_.width_cells();
  const int first = std::clamp(-low.col, 0, side_);  // of the window's columns, those in the field
  const int last = std::clamp(width - low.col, first, side_);
  for (int r = 0; r < side_; ++r) {
    std::uint16_t* row_sums = sums.data() + static_cast<std::ptrdiff_t>(r) * side_;
    const int row = low.row + r;
    const bool inside = row >= 0 && row < before_.height_cells();
    const int from = inside ? first : side_;
    const int to = inside ? last : side_;
    for (int k = 0; k < from; ++k) row_sums[k] = static_cast<std::uint16_t>(row_sums[k] + unseen_value);
    if (inside)
      add_row(field + static_cast<std::ptrdiff_t>(row) * width + low.col + from, to - from, row_sums + from);
    for (int k = to; k < side_; ++k) row_sums[k] = static_cast<std::uint16_t>(row_sums[k] + unseen_value);
  }
}

void PoseVolume::add_prior(int heading, const std::vector<std::uint16_t>& sums) {
  const double per_cell = before_.resolution_m() / step_.sigma.translation_m;
  const double turned = (heading - half_headings_) * heading_step_rad / step_.sigma.rotation_rad;
  float* posterior = posterior_.data() + static_cast<std::size_t>(heading) * plane();
  std::size_t i = 0;
  for (int row = -half_; row <= half_; ++row) {
    for (int col = -half_; col <= half_; ++col, ++i) {
      const double squared = per_cell * per_cell * (row * row + col * col) + turned * turned;
      const bool allowed = squared <= support_sigmas * support_sigmas;
      posterior[i] = allowed ? static_cast<float>(nats_per_value_ * sums[i] - 0.5 * squared) : excluded;
    }
  }
}

// No neighbour is better; of equal ones, the first is the peak.
bool PoseVolume::is_peak(const Peak& peak) const {
  bool before_here = true;
  for (int h = -1; h <= 1; ++h) {
    for (int r = -1; r <= 1; ++r) {
      for (int c = -1; c <= 1; ++c) {
        if (h == 0 && r == 0 && c == 0) {
          before_here = false;
          continue;
        }
        const float neighbour = at(peak.heading + h, peak.row + r, peak.col + c);
        if (neighbour > peak.posterior || (before_here && neighbour == peak.posterior)) return false;
      }
    }
  }
  return true;
}

std::vector<PoseVolume::Peak> PoseVolume::peaks() const {
  const float best = *std::max_element(posterior_.begin(), posterior_.end());
  const float least = best - static_cast<float>(least_nats_below_best);
  std::vector<Peak> found;
  std::size_t i = 0;
  for (int heading = 0; heading < headings(); ++heading) {
    for (int row = 0; row < side_; ++row) {
      for (int col = 0; col < side_; ++col, ++i) {
        const Peak peak{.posterior = posterior_[i], .heading = heading, .row = row, .col = col};
        if (peak.posterior >= least && is_peak(peak)) found.push_back(peak);
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Peak& a, const Peak& b) { return a.posterior > b.posterior; });
  return found;
}

std::vector<Pose2> PoseVolume::best_poses() const {
  std::vector<Pose2> kept;
  for (const Peak& peak : peaks()) {
    const Pose2 candidate = pose(peak);
    const bool near = std::any_of(kept.begin(), kept.end(), [&](const Pose2& other) {
      return translation_distance(candidate, other) < distinct_m &&
             angle_distance(candidate.theta_rad, other.theta_rad) < distinct_rad;
    });
    if (!near) kept.push_back(candidate);
    if (kept.size() == most_poses) break;
  }
  return kept;
}

}  // namespace

std::vector<Pose2> correlate(const ScanView& before, const ScanView& after, const OdometryStep& step) {
  if (before.points().empty() || after.points().empty()) return {};
  return PoseVolume(before, after, step).best_poses();
}

}  // namespace landfall::internal
