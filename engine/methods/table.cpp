#include "engine/methods/table.hpp"

#include <array>
#include <string>

#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

constexpr std::string_view default_method = "branch_and_bound";

constexpr std::array<Method, 14> table{{
    {.info = {.name = "exhaustive",
              .summary = "scores every pose of the prior's lattice; the oracle",
              .source = ""},
     .propose = propose_exhaustive},
    {.info = {.name = "branch_and_bound",
              .summary = "the same optimum, proven, by admissible bounds over x, y and heading; the default",
              .source = "Olson 2009, 2015; Hess et al. 2016"},
     .propose = propose_branch_and_bound},
    {.info = {.name = "grid",
              .summary =
                  "occupancy-grid matching with oriented local grids: sonars, or any beams, in a window",
              .source = "Courcelle & Horn 1999"},
     .propose = propose_grid,
     .centers_headings = true},
    {.info = {.name = "grid_published",
              .summary = "grid's best score alone, as published: ranges decide nothing but the probability",
              .source = "Courcelle & Horn 1999"},
     .propose = propose_grid_published,
     .centers_headings = true},
    {.info = {.name = "grid_reduced",
              .summary = "grid by a pyramid of reduced grids, from the coarsest to the finest",
              .source = "Courcelle & Horn 1999"},
     .propose = propose_grid_reduced,
     .centers_headings = true},
    {.info = {.name = "grid_uncorrected",
              .summary = "grid_published without the correction of contours, for comparison",
              .source = "Courcelle & Horn 1999"},
     .propose = propose_grid_uncorrected,
     .centers_headings = true},
    {.info = {.name = "grid_turned",
              .summary = "grid_published with one local grid whose raster is turned, for comparison",
              .source = "Courcelle & Horn 1999"},
     .propose = propose_grid_turned,
     .centers_headings = true},
    {.info = {.name = "fft",
              .summary = "all translations at once by FFT, per heading; point by point where that is less",
              .source = "Espino, Moreno, Curto, Aguilar"},
     .propose = propose_fft},
    {.info = {.name = "sdn",
              .summary = "stochastic diffusion network, tested by ray casts: rooms; see fsdn",
              .source = "Beattie & Bishop"},
     .propose = propose_sdn,
     .samples = true,
     .refines_by_ranges = true},
    {.info = {.name = "fsdn",
              .summary = "focused stochastic diffusion network, tested by ray casts: plans, to a centimetre",
              .source = "Beattie & Bishop"},
     .propose = propose_fsdn,
     .samples = true,
     .refines_by_ranges = true},
    {.info = {.name = "pso",
              .summary =
                  "particle swarms, scan to the map's cells: tracking, or the whole map by many swarms",
              .source = "Okada & Fujimoto"},
     .propose = propose_pso,
     .samples = true},
    {.info = {.name = "icp",
              .summary = "iterative closest point, point to point, from a close prior",
              .source = "Besl & McKay 1992"},
     .propose = propose_icp,
     .samples = true},
    {.info = {.name = "icp_point_to_line",
              .summary = "iterative closest point along the map's normals, from a close prior",
              .source = "Chen & Medioni 1992"},
     .propose = propose_icp_point_to_line,
     .samples = true},
    {.info = {.name = "angle_histogram",
              .summary = "cross-correlated histograms of angles, then of x and y, from a close prior",
              .source = "Weiss, Wetzler & von Puttkamer 1994"},
     .propose = propose_angle_histogram,
     .samples = true},
}};

}  // namespace

std::span<const Method> method_table() {
  return table;
}

const Method& find_method(std::string_view name) {
  const std::string_view wanted = name == "auto" ? default_method : name;
  std::string known = "auto";
  for (const Method& method : table) {
    if (method.info.name == wanted) return method;
    known += ", " + std::string(method.info.name);
  }
  throw Error(ErrorCode::unknown_name,
              "option method is \"" + std::string(name) + "\", expected one of " + known);
}

}  // namespace landfall::internal
