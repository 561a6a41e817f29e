// The one step of a composite that is far off.
#pragma once

#include <optional>

#include "engine/refine/settle/problem.hpp"

namespace landfall::internal {

// A step that is far off leaves the composite between where its two sides belong. The one step is broken, if
// any, that lets both sides fit so much better that it pays.
std::optional<Eigen::VectorXd> break_worst_step(const SettleProblem& problem, const Eigen::VectorXd& poses,
                                                int reach_cells);

}  // namespace landfall::internal
