#include "engine/align/scan_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "raycast/grid_walk.hpp"

namespace landfall::internal {
namespace {

// Wide enough that a step of the coarse search cannot pass over a surface.
constexpr double blur_sigma_m = 0.12;
constexpr double blur_reach_sigmas = 2.5;
// Points are matched over less than this.
constexpr double nearest_reach_m = 0.5;
constexpr double margin_m = 0.8;
// Free space ends this far before an echo.
constexpr double wall_cells = 2.0;

int cells_for(double length_m, double resolution_m) {
  return static_cast<int>(std::ceil(length_m / resolution_m));
}

}  // namespace

ScanView::ScanView(const Scan& scan, double resolution_m) : resolution_m_(resolution_m) {
  const std::vector<Echo> echoes = echoes_within(scan, farthest_echo_m);
  points_ = surface_points(echoes);
  lay_out(echoes);
  trace_free_space(echoes);
  field_ = background_;
  blur_surfaces(echoes);
  index_points();
}

ScanView::Cell ScanView::cell_of(double x_m, double y_m) const {
  return {.col = static_cast<int>(std::floor((x_m - low_x_m_) / resolution_m_)),
          .row = static_cast<int>(std::floor((y_m - low_y_m_) / resolution_m_))};
}

void ScanView::lay_out(std::span<const Echo> echoes) {
  double high_x_m = 0.0;
  double high_y_m = 0.0;
  for (const Echo& echo : echoes) {
    low_x_m_ = std::min({low_x_m_, echo.p_origin.x_m, echo.p_end.x_m});
    low_y_m_ = std::min({low_y_m_, echo.p_origin.y_m, echo.p_end.y_m});
    high_x_m = std::max({high_x_m, echo.p_origin.x_m, echo.p_end.x_m});
    high_y_m = std::max({high_y_m, echo.p_origin.y_m, echo.p_end.y_m});
  }
  low_x_m_ -= margin_m;
  low_y_m_ -= margin_m;
  width_ = cells_for(high_x_m + margin_m - low_x_m_, resolution_m_) + 1;
  height_ = cells_for(high_y_m + margin_m - low_y_m_, resolution_m_) + 1;
  const std::size_t cells = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  background_.assign(cells, unseen_value);
  nearest_.assign(cells, no_point);
}

void ScanView::trace_free_space(std::span<const Echo> echoes) {
  for (const Echo& echo : echoes) {
    const double range_cells = echo.range_m / resolution_m_;
    if (range_cells <= wall_cells) continue;
    const double free_share = 1.0 - wall_cells / range_cells;
    raycast::CellWalk walk((echo.p_origin.x_m - low_x_m_) / resolution_m_,
                           (echo.p_origin.y_m - low_y_m_) / resolution_m_,
                           (echo.p_end.x_m - echo.p_origin.x_m) / resolution_m_,
                           (echo.p_end.y_m - echo.p_origin.y_m) / resolution_m_);
    for (; walk.entered() <= free_share; walk.step())
      background_[static_cast<std::size_t>(walk.row()) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(walk.col())] = 0;
  }
}

// The highest of the echoes' Gaussians.
void ScanView::blur_surfaces(std::span<const Echo> echoes) {
  const int reach = cells_for(blur_reach_sigmas * blur_sigma_m, resolution_m_);
  std::vector<double> along_col(static_cast<std::size_t>(2 * reach + 1));
  const auto bell = [&](int cell, double x_m, double low_m) {
    const double z = (low_m + (cell + 0.5) * resolution_m_ - x_m) / blur_sigma_m;
    return std::exp(-0.5 * z * z);
  };
  for (const Echo& echo : echoes) {
    const Cell at = cell_of(echo.p_end.x_m, echo.p_end.y_m);
    const int first = std::max(0, at.col - reach);
    const int last = std::min(width_ - 1, at.col + reach);
    for (int col = first; col <= last; ++col)
      along_col[static_cast<std::size_t>(col - first)] = bell(col, echo.p_end.x_m, low_x_m_);
    for (int row = std::max(0, at.row - reach); row <= std::min(height_ - 1, at.row + reach); ++row) {
      const double along_row = 255.0 * bell(row, echo.p_end.y_m, low_y_m_);
      std::uint8_t* cells = field_.data() + static_cast<std::ptrdiff_t>(row) * width_;
      for (int col = first; col <= last; ++col) {
        const double value = along_row * along_col[static_cast<std::size_t>(col - first)] + 0.5;
        cells[col] = std::max(cells[col], static_cast<std::uint8_t>(value));
      }
    }
  }
}

void ScanView::index_points() {
  const int reach = cells_for(nearest_reach_m, resolution_m_);
  std::vector<float> squared(nearest_.size(), static_cast<float>(reach * reach));
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const double col = (points_[i].p.x_m - low_x_m_) / resolution_m_ - 0.5;
    const double row = (points_[i].p.y_m - low_y_m_) / resolution_m_ - 0.5;
    const int mid_col = static_cast<int>(std::lround(col));
    const int mid_row = static_cast<int>(std::lround(row));
    for (int r = std::max(0, mid_row - reach); r <= std::min(height_ - 1, mid_row + reach); ++r) {
      const std::size_t line = static_cast<std::size_t>(r) * static_cast<std::size_t>(width_);
      for (int c = std::max(0, mid_col - reach); c <= std::min(width_ - 1, mid_col + reach); ++c) {
        const auto d = static_cast<float>((c - col) * (c - col) + (r - row) * (r - row));
        const std::size_t cell = line + static_cast<std::size_t>(c);
        if (d >= squared[cell]) continue;
        squared[cell] = d;
        nearest_[cell] = static_cast<std::uint16_t>(i);
      }
    }
  }
}

}  // namespace landfall::internal
