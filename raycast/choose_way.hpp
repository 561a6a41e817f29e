// Which way of casting rays is the fastest for a map. A function of its shape alone, so that answers do not
// depend on what a clock said. It rests on bench_raycast, run with AVX-512, AVX2 and SSE4 on grids from 0.3
// to 20 million cells: there the distance walk is the fastest for fans and for single rays. Larger grids, as
// far as its table holds them, are taken to be alike; plans are cast against their walls.
#pragma once

#include <string_view>

namespace landfall::raycast {

enum class Way {
  embree,         // packets of rays against walls in a tree of boxes
  distance_walk,  // from one free square of a grid to the next
  segment_tree    // the nearest wall point in a cone: beams with a half-angle, on every map
};
std::string_view name(Way way);

// Of a grid; 0 x 0: a plan, which is more exact than any grid of it.
struct MapShape {
  int width_cells = 0;
  int height_cells = 0;
};

// For beams without a half-angle.
Way choose_way(const MapShape& map);

}  // namespace landfall::raycast
