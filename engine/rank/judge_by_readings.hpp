// Modes of a scan that was condensed from readings (Scan::measured), judged by all of these.
//
// The few end points that a minimum filter keeps (Espino et al., section 3.2) propose poses; several may hold
// as many of them. What was dropped tells these apart: a reading shorter than all that its cone holds speaks
// against a pose, one that is right for it.
#pragma once

#include "engine/rank/rank.hpp"

namespace landfall::internal {

// So many modes are judged at least: the right one need not be among the best by its end points.
inline constexpr int least_judged_modes = 24;

// For modes that are refined: each gets the likelihood of the readings (log_readings), and those that may win
// are moved to where end points and readings together are likeliest, by pattern search (Hooke & Jeeves 1961).
// Nothing is done for a scan without readings of its own.
void judge_by_readings(const Query& query, Modes& found, SearchCounts& counts);

}  // namespace landfall::internal
