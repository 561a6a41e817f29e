// Peers side by side with landfall, on one thread each, in processor time. Every comparison first holds their
// answers to each other, false with a message on stderr where they differ, and then registers a benchmark for
// each, called PLACE/COMPARISON/WHO. The place must outlive the benchmarks.
#pragma once

#include "bench/places.hpp"

namespace landfall::bench {

// A scan without prior: the textbook's branch and bound.
bool compare_search(const Place& place);
// All poses of a map at one heading: OpenCV and FFTW beside the rows of `exhaustive`.
bool compare_dense_correlation(const Place& place);
// How well a scan fits at given poses: MRPT's likelihood field beside the rows of `exhaustive`.
bool compare_likelihood_field(const Place& place);
// Simulated scans: MRPT's beside ours. Ranges are compared, beam by beam.
bool compare_laser_scan(const Place& place);

// All of these with the peers that this build has.
bool compare_with_peers(const Place& place);
// A line on stderr for each peer that this build goes without.
void report_missing_peers();

}  // namespace landfall::bench
