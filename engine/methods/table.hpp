// The search methods: one file and one row each.
#pragma once

#include <span>
#include <string_view>

#include "engine/query.hpp"

namespace landfall::internal {

struct Method {
  MethodInfo info;
  Proposal (*propose)(const Query& query);
  bool centers_headings = false;   // on the prior
  bool samples = false;            // poses, and knows no margin within which it found all
  bool refines_by_ranges = false;  // where the map's walls are exact
};

std::span<const Method> method_table();
// "auto" is resolved here. Throws Error{unknown_name} that lists the names.
const Method& find_method(std::string_view name);

Proposal propose_exhaustive(const Query& query);
Proposal propose_branch_and_bound(const Query& query);
Proposal propose_grid(const Query& query);
Proposal propose_grid_published(const Query& query);
Proposal propose_grid_reduced(const Query& query);
Proposal propose_grid_uncorrected(const Query& query);
Proposal propose_grid_turned(const Query& query);
Proposal propose_fft(const Query& query);
Proposal propose_sdn(const Query& query);
Proposal propose_fsdn(const Query& query);
Proposal propose_pso(const Query& query);
Proposal propose_icp(const Query& query);
Proposal propose_icp_point_to_line(const Query& query);
Proposal propose_angle_histogram(const Query& query);

}  // namespace landfall::internal
