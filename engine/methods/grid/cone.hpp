// What one beam says, as the paper's emission cone: geometry, and the cells it covers.
//
// Courcelle & Horn 1999, section 3. Their equations (2) and (3) count headings from +y; here they start at
// +x, as in REP-103: a point of the cone at angle a and distance d lies at mount + d (cos(axis + a), sin(axis
// + a)).
#pragma once

#include <numbers>
#include <vector>

#include "landfall/grid_map.hpp"
#include "landfall/scan.hpp"

namespace landfall::internal {

// In the robot's frame, lengths in cells.
struct Cone {
  double mount_x_cells = 0.0;
  double mount_y_cells = 0.0;
  double axis_rad = 0.0;
  double half_angle_rad = 0.0;
  double range_cells = 0.0;  // to the face of the obstacle; without echo, as far as the beam sees
  bool echo = false;
  double behind_face_cells = 0.5 * std::numbers::sqrt2;  // where the arc lies
};

// A cone for every valid beam. Left out are echoes farther than farthest_cells; beams without echo end there.
std::vector<Cone> make_cones(const Scan& scan, double resolution_m, double farthest_cells);

// Equation (3): the model is turned, not its raster.
Cone turned(const Cone& cone, double heading_rad);

// Offsets from the robot's cell, whose centre is the robot; in order along the arc. An 8-connected curve of
// one cell's thickness, half a cell's diagonal behind the measured face: no cell that it crosses then reaches
// before the face, in whatever direction, and the part of a wall that is not the nearest is met as well. At
// half a side the best score is right in fewer cases (bench/RESULTS.md). Empty without echo.
void arc_cells(const Cone& cone, std::vector<CellIndex>& cells);

// Cells before the measured face whose centre is in the cone, and those on its axis; some appear twice, and
// some are the arc's too.
void sector_cells(const Cone& cone, std::vector<CellIndex>& cells);

}  // namespace landfall::internal
