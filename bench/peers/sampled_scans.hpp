// Some of a place's scans, as the field methods see them, on the lattice of a search.
#pragma once

#include <vector>

#include "bench/places.hpp"
#include "engine/priors/lattice.hpp"
#include "engine/scans/end_points.hpp"

namespace landfall::bench {

struct SampledScans {
  static constexpr std::size_t scan_count = 3;

  PreparedMap map;
  internal::Lattice lattice;
  std::vector<internal::EndPoints> scans;

  explicit SampledScans(const Place& place)
      : map(place.map), lattice(internal::make_lattice(map.grid(), 0.0, SearchOptions{}.rotation_step_rad)) {
    for (std::size_t i = 0; i < scan_count; ++i)
      scans.push_back(
          internal::make_end_points(place.scans[i * place.scans.size() / scan_count], lattice.resolution_m));
  }
};

}  // namespace landfall::bench
