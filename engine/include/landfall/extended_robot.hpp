// What makes sonars tell where a robot is (Espino et al., sections 3.1 to 3.3): a slow turn on the spot read
// as one scan, the readings of it that can be trusted, and maps blurred by how far both may be off.
#pragma once

#include <span>
#include <vector>

#include "landfall/grid_map.hpp"
#include "landfall/scan.hpp"

namespace landfall {

// A sonar reads too long wherever its sound meets a wall at a slant, and right where it meets one head on:
// at the local minima along a turn (equation 14). The same scans with all other readings invalid (NaN), beam
// by beam. `turn`: scans of one sensor in the order in which they were taken.
// What the paper leaves open: invalid readings are passed over, as if not taken; one without echo is longer
// than any echo and never kept. Of a run of equal readings that is below both its neighbours the middle one
// is kept, of an even run the two in the middle: there the sonar faces the wall. Where all are equal nothing
// is. full_turn: the first scan is the last one's neighbour; else the first and last readings, of which only
// one neighbour is known, are dropped.
// Throws Error{invalid_argument}: a scan that does not validate, or scans of different sensors.
std::vector<Scan> keep_local_minima(std::span<const Scan> turn, bool full_turn = true);

struct TurnMinimaOptions {
  double equal_sigmas = 3.0;  // of the sensor's range noise: no more sets equal readings apart
  int plateau_weight = 3;     // end points that a plateau counts for
};

// The minimum filter over all sonars of a full turn together: what of the turn can be trusted, as one scan
// from the turn's centre. Scan i of n was taken at heading i 2 pi / n of scan 0's robot frame.
//  - Readings are interleaved by bearing, whichever sonar took them, and wrap around at 2 pi. Those without
//    echo are longer than any echo.
//  - A plateau: a surface met head on, or an edge, is as near anywhere in the cone. Readings that noise alone
//    sets apart, over half a cone's width or more, none shorter among them, become one end point: at their
//    mean distance, in the plateau's middle, which may lie between two headings. Where something nearer cuts
//    the plateau off, the middle is a half-angle inside its other end; one wider than a cone has two.
//  - Elsewhere a reading is kept where none within half a turn's step of its bearing is shorter, averaged
//    with those that noise alone sets apart from it: errors are positive, so of those that look one way the
//    shortest is right. (Equation 14 asks one sonar's two neighbours, a whole step away.)
// Beams that begin at the centre, a plateau's several times; a single invalid one where nothing is left. The
// scan's `measured` are all the readings (merge_turn): search judges by them what the end points propose.
// Throws Error{invalid_argument}: no scans, a scan that does not validate, scans of different sensors,
// equal_sigmas that are negative or not finite, a weight outside 0 to 100.
Scan merge_turn_minima(std::span<const Scan> turn, const TurnMinimaOptions& options = {});

// The readings of a turn on the spot as one scan: scan i of n was taken at heading i 2 pi / n of scan 0's
// robot frame (equation 12). Throws as merge() does.
Scan merge_turn(std::span<const Scan> turn);

// A raised cosine of the distance to the centre, size x size values row by row: 1 in the centre, 0 at half
// the size, so in the outermost ring of figure 6. Throws Error{invalid_argument} unless size is odd, 3 to
// 255.
std::vector<float> raised_cosine_mask(int size);

// The occupied cells (1, others 0) convolved with a mask `times` times: equation 15 for 1. Blurring the
// robot's end points too (equation 16) is blurring the map twice, for the mask is symmetric. One value per
// cell, row by row; what spills over the map's edge is lost. Throws Error{invalid_argument}: a grid that does
// not validate, a mask that is not square and odd, times outside 0 to 8.
std::vector<float> blurred_map(const GridMap& grid, std::span<const float> mask, int times = 1);

}  // namespace landfall
