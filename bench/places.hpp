// Where searches are timed: a made-up office, and where the data are the real buildings, each with a sample
// of scans.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#include "landfall/prepared_map.hpp"
#include "landfall/scan.hpp"
#include "landfall/search.hpp"

namespace landfall::bench {

inline constexpr std::size_t scans_per_place = 24;

struct Place {
  std::string name;
  PreparedMap map;
  std::vector<Scan> scans;
};

// Evenly over the free cells, which the map must have; the same for the same map.
std::vector<Pose2> random_free_poses(const GridMap& map, std::size_t count);

// Scans of 180 beams from random free poses.
Place office_place();
// Queries evenly spread over the building's log.
Place building_place(const std::string& name);
// The office and these buildings; where there are no data the office alone, with a message.
std::vector<Place> office_and(std::initializer_list<const char*> buildings);

// The largest score of the hypotheses, which are ranked by probability; 0 where there is none.
std::int64_t best_score(const SearchResult& result);
// Of values that are not empty, which it reorders.
double quantile(std::vector<double>& values, double share);

}  // namespace landfall::bench
