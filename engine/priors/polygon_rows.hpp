// A polygon asked row by row of a grid, from below: even-odd rule, a border counts as drawn half open.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "landfall/pose2.hpp"

namespace landfall::internal {

// Rows run along the grid's x axis. A row costs the edges that cross it, a cell then nothing: a polygon
// drawn by hand has a few corners, one traced along walls has thousands.
class PolygonRows {
 public:
  PolygonRows(std::span<const Point2> polygon_map, double theta_map_grid_rad);

  // A point in the frame of rows: the map's, turned by the grid's angle.
  [[nodiscard]] Point2 to_rows(const Point2& p_map) const;
  // Where the row at `y_m` crosses the border, ascending: an odd number of these beyond a point (x_m > the
  // point's) means that it is inside. Rows have to be asked for in ascending order.
  const std::vector<double>& crossings(double y_m);

 private:
  struct Edge {
    Point2 a;
    Point2 b;
    [[nodiscard]] double low_m() const { return a.y_m < b.y_m ? a.y_m : b.y_m; }
    [[nodiscard]] double high_m() const { return a.y_m < b.y_m ? b.y_m : a.y_m; }
  };

  double cos_;
  double sin_;
  std::vector<Edge> edges_;  // by their lower ends
  std::size_t next_ = 0;     // of these; those before are active or done
  std::vector<Edge> active_;
  std::vector<double> crossings_;
};

}  // namespace landfall::internal
