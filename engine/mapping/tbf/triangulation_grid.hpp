// The grid G that triangulation points are written into. Ivanjko, Petrovic & Miklic 2005, equations 3 to 5.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/mapping/tbf/ellipse_cells.hpp"
#include "engine/mapping/tbf/sonar_reading.hpp"
#include "engine/mapping/tbf/triangulation.hpp"
#include "landfall/sonar_mapping.hpp"

namespace landfall::internal {

class TriangulationGrid {
 public:
  // `grid` gives the place of the cells; its axes are the map's. All g are 0.
  TriangulationGrid(GridMap grid, const TbfOptions& options);

  // Equation 5 with the reading that the point is of, the last that supports it. A point whose
  // sqrt(spectral radius of P_T) is not below max_deviation_m changes no g.
  void add(const Triangulation& point, const SonarReading& reading);
  // The robot stood there: what its sonars' circle covers is free unless g says more.
  void add_robot(const Pose2& T_map_robot, double radius_m);

  [[nodiscard]] const std::vector<float>& values() const { return values_; }
  // Not 0: on the line L of a point, but in none of its ellipse.
  [[nodiscard]] const std::vector<std::uint8_t>& on_line() const { return on_line_; }
  // Occupied by g; free where a supported reading passed: the line L, and the inner half of its cone short
  // of its arc. Added for localization in the map: L alone leaves the floor between two lines unknown.
  [[nodiscard]] GridMap to_map() const;

 private:
  void raise_ellipse(const Triangulation& point);
  void halve_line(const Point2& from_map, const Point2& to_map);
  void clear_cone(const SonarReading& reading);

  GridMap grid_;
  TbfOptions options_;
  std::vector<float> values_;          // g
  std::vector<std::uint8_t> on_line_;  // of a supported reading, before its point
  std::vector<std::uint8_t> cleared_;  // by a supported reading's cone, or by the robot
  std::vector<std::uint32_t> ellipse_of_;
  std::uint32_t point_number_ = 0;
  std::vector<CellDensity> ellipse_{};
};

}  // namespace landfall::internal
