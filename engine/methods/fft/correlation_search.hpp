// Method `fft` in its two ways; which of them runs is not seen in the candidates.
#pragma once

#include "engine/query.hpp"

namespace landfall::internal {

enum class CorrelationWay {
  transforms,  // all translations of a heading at once
  direct,      // block by block, point by point: where points or poses are few
};

// What costs less by the measured model (cost_model.hpp).
CorrelationWay choose_way(const Query& query);
Proposal propose_by_transforms(const Query& query);
Proposal propose_directly(const Query& query);

// Cells that the farthest end point is away from the robot's own, at any heading.
int reach_cells(const EndPoints& points);

}  // namespace landfall::internal
