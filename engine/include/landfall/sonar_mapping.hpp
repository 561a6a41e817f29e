// Scans of sonars in, maps out: triangulation-based fusion, and plain inverse sensor models.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "landfall/grid_map.hpp"
#include "landfall/scan.hpp"

namespace landfall {

// Ivanjko, Petrovic & Miklic 2005, An Implementation of the Triangulation Based Fusion Mapping Algorithm.
// The sonar model (equations 1 and 2) is the sensor's: its noise is the range's standard deviation, the
// beam's half-angle the bearing's uniform bound.
struct TbfOptions {
  double resolution_m = 0.05;
  double margin_m = 1.0;         // around all echoes and poses
  int window_scans = 50;         // sliding window, the newest scan included; the paper states no size
  double max_deviation_m = 0.1;  // points with sqrt(spectral radius of P_T) from here on leave no trace
  // A: g = A n_t f, cut at 1. Chosen so that about five partners occupy a wall at 1 m; twice as much finds a
  // few more walls at twice the artefacts (bench/RESULTS.md, Maps from sonars).
  double scale_m2 = 5e-4;
  double occupied_value = 0.5;  // g at or above: occupied; below, and crossed by a supported reading: free
  bool bounding_box = false;    // section 3: correct readings first
  bool box_corrects_no_echo = true;  // a reading without echo lies outside the box, too
  // Section 6. Segments that line up are connected, occupied cells that belong to none are dropped.
  bool connect_walls = false;
  double wall_gap_m = 0.6;     // longer gaps stay open, and so do those that were seen free
  double wall_length_m = 0.4;  // shorter runs are no wall
};

// A reading that has partners: where its target is, and how well that is known.
struct TriangulationPoint {
  Point2 p_map{};
  double covariance_xx_m2 = 0.0;
  double covariance_xy_m2 = 0.0;
  double covariance_yy_m2 = 0.0;
  std::int32_t triangulations = 0;  // n_t: its partners
  std::uint32_t scan = 0;           // the reading that it is of: the last one that supports it
  std::uint32_t beam = 0;
};

struct TbfResult {
  GridMap map{};
  std::vector<float> values{};  // g of equation 5, one per cell, 0 to 1; before walls are connected
  std::vector<TriangulationPoint> points{};
  std::vector<Scan> scans{};  // with the readings as they were fused: corrected to the box
};

// Every scan's T_map_robot must be set; they are taken in order. Readings without echo triangulate nothing.
// Throws Error{invalid_argument}: no scans, a scan without pose, a beam without half-angle, an option out
// of range; Error{too_large}: a map beyond limits.
TbfResult map_by_triangulation(std::span<const Scan> scans, const TbfOptions& options = {});

// Section 3 (Ivanjko, Petrovic & Macek 2003): the box that the sonars facing front, back, left and right
// span around the robot: those whose cone holds that direction, the farther of a pair, open where one has
// no echo. Readings that end outside are shortened along their own beam to its rim; those within stay.
Scan correct_to_bounding_box(const Scan& scan, bool correct_no_echo = true);

struct SonarGridOptions {
  double resolution_m = 0.05;
  double margin_m = 1.0;
  double occupied_weight = 0.4;    // probability on the axis of an arc of one cell: 0.5 plus this
  double empty_weight = 0.05;      // probability before the sonar: 0.5 less this
  double occupied_log_odds = 0.4;  // at or above: occupied
  double free_log_odds = -0.2;     // at or below: free; between: unknown
  double max_log_odds = 3.5;
};

// Elfes 1988, Using Occupancy Grids for Mobile Robot Perception and Navigation: each echo makes its cone less
// probable and its arc more, by profiles over range and bearing; log odds are added. Readings without echo
// say nothing. Throws as map_by_triangulation.
GridMap map_from_sonars(std::span<const Scan> scans, const SonarGridOptions& options = {});

// Occupied where an echo ends along its beam's axis, free along that axis before it, unknown elsewhere:
// readings as they are. Throws as map_by_triangulation.
GridMap map_of_end_points(std::span<const Scan> scans, double resolution_m = 0.05, double margin_m = 1.0);

}  // namespace landfall
