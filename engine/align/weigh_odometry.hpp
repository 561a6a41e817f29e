// What matches and odometry say together, once it is seen how good odometry is.
#pragma once

#include <vector>

#include "engine/align/refine_jointly.hpp"

namespace landfall::internal {

// T_reference_robot of every scan: each step is the mean of its match and odometry, weighted by their
// covariances. Odometry's is the stated one times an unknown factor for all translations of the window, and
// another for all rotations; both are integrated out, given how far the matches are off odometry (an
// empirical Bayes estimate). A match's is that of its residuals, widened, since they are not independent and
// two scans never see quite the same.
std::vector<Pose2> weigh_odometry(const ScanWindow& window, const RefinedWindow& matched);

}  // namespace landfall::internal
