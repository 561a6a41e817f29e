// A scan as SLAM needs it, in the robot's frame.
#pragma once

#include <vector>

#include "engine/align/surfaces.hpp"
#include "engine/mapping/slam/evidence_grid.hpp"
#include "landfall/slam.hpp"

namespace landfall::internal {

struct PreparedScan {
  std::vector<EchoRay> rays;  // robot frame
  // End points of the valid echoes, in cells.
  std::vector<float> x_cells;
  std::vector<float> y_cells;
  std::vector<SurfacePoint> surfaces;
  double farthest_m = 0.0;

  [[nodiscard]] int valid() const { return static_cast<int>(x_cells.size()); }
};

PreparedScan prepare(const Scan& scan, const SlamOptions& options);

}  // namespace landfall::internal
