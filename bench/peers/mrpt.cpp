#include "bench/peers/mrpt.hpp"

#include <mrpt/maps/COccupancyGridMap2D.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose2D.h>

#include <limits>

namespace landfall::bench {
namespace {

float chance_of_free(Occupancy cell) {
  switch (cell) {
    case Occupancy::free:
      return 1.0F;
    case Occupancy::occupied:
      return 0.0F;
    case Occupancy::unknown:
      break;
  }
  return 0.5F;
}

}  // namespace

struct MrptMap::State {
  mrpt::maps::COccupancyGridMap2D grid;
  mrpt::maps::CSimplePointsMap points;
  mutable mrpt::obs::CObservation2DRangeScan scan;
};

MrptMap::MrptMap(const PreparedMap& map) : state_(std::make_unique<State>()) {
  const GridMap& from = map.grid();
  const auto resolution_m = static_cast<float>(from.resolution_m);
  mrpt::maps::COccupancyGridMap2D& grid = state_->grid;
  grid.setSize(0.0F, static_cast<float>(from.width_cells) * resolution_m, 0.0F,
               static_cast<float>(from.height_cells) * resolution_m, resolution_m);
  for (int row = 0; row < from.height_cells; ++row)
    for (int col = 0; col < from.width_cells; ++col)
      grid.setCell(col, row, chance_of_free(from.at({.col = col, .row = row})));
  auto& likelihood = grid.likelihoodOptions;
  likelihood.LF_stdHit = static_cast<float>(map.options().field_sigma_m);
  likelihood.LF_maxCorrsDistance = 4.0F * likelihood.LF_stdHit;
  likelihood.LF_zHit = 1.0F;
  likelihood.LF_zRandom = 0.0F;
  likelihood.LF_decimation = 1;
  likelihood.LF_alternateAverageMethod = true;
  likelihood.enableLikelihoodCache = true;
}

MrptMap::~MrptMap() = default;
MrptMap::MrptMap(MrptMap&&) noexcept = default;
MrptMap& MrptMap::operator=(MrptMap&&) noexcept = default;

void MrptMap::set_points(std::span<const double> x_m, std::span<const double> y_m) {
  state_->points.clear();
  for (std::size_t i = 0; i < x_m.size(); ++i)
    state_->points.insertPoint(static_cast<float>(x_m[i]), static_cast<float>(y_m[i]));
}

double MrptMap::log_mean_likelihood(const Pose2& T_grid_robot) const {
  const mrpt::poses::CPose2D pose(T_grid_robot.x_m, T_grid_robot.y_m, T_grid_robot.theta_rad);
  return state_->grid.computeLikelihoodField_Thrun(&state_->points, &pose);
}

void MrptMap::simulate_scan(const Pose2& T_grid_sensor, double aperture_rad, double range_max_m,
                            std::span<float> ranges_m) const {
  constexpr float least_occupancy = 0.6F;  // MRPT's default: unknown cells do not stop a ray
  mrpt::obs::CObservation2DRangeScan& scan = state_->scan;
  scan.aperture = static_cast<float>(aperture_rad);
  scan.maxRange = static_cast<float>(range_max_m);
  scan.rightToLeft = true;
  state_->grid.laserScanSimulator(
      scan, mrpt::poses::CPose2D(T_grid_sensor.x_m, T_grid_sensor.y_m, T_grid_sensor.theta_rad),
      least_occupancy, ranges_m.size());
  for (std::size_t i = 0; i < ranges_m.size(); ++i)
    ranges_m[i] =
        scan.getScanRangeValidity(i) ? scan.getScanRange(i) : std::numeric_limits<float>::infinity();
}

}  // namespace landfall::bench
