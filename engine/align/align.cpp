#include "landfall/align.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

#include "engine/align/choose_chain.hpp"
#include "engine/align/match_step.hpp"
#include "engine/align/refine_jointly.hpp"
#include "engine/align/scan_view.hpp"
#include "engine/align/weigh_odometry.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/parallel.hpp"
#include "landfall/error.hpp"

namespace landfall {
namespace {

using namespace internal;

constexpr double finest_m = 0.01;
constexpr double coarsest_m = 1.0;
// Odometry that is stated to be perfect is taken as nearly so.
constexpr double least_sigma_m = 1e-3;
constexpr double least_sigma_rad = 1e-3;

[[noreturn]] void fail(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, "align: " + message);
}

void check(std::span<const Scan> scans, std::size_t reference, const AlignOptions& options) {
  if (scans.empty()) fail("no scans, expected at least one");
  if (reference >= scans.size())
    fail("reference is " + std::to_string(reference) + ", expected less than " +
         std::to_string(scans.size()));
  if (!(options.resolution_m >= finest_m && options.resolution_m <= coarsest_m))
    fail("resolution_m is " + number_text(options.resolution_m) + ", expected 0.01 to 1");
  check_odometry_noise("align", options.odometry);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    validate(scans[i]);
    if (!scans[i].T_odom_robot)
      fail("scan " + std::to_string(i) + " has no T_odom_robot, expected odometry in every scan");
  }
}

std::vector<OdometryStep> steps_of(std::span<const Scan> scans, const OdometryNoise& noise) {
  std::vector<OdometryStep> steps;
  for (std::size_t k = 0; k + 1 < scans.size(); ++k) {
    const Pose2 T_before_after = inverse(*scans[k].T_odom_robot) * *scans[k + 1].T_odom_robot;
    const OdometrySigma sigma = odometry_sigma(noise, T_before_after);
    steps.push_back({.T_before_after = T_before_after,
                     .sigma = {.translation_m = std::max(least_sigma_m, sigma.translation_m),
                               .rotation_rad = std::max(least_sigma_rad, sigma.rotation_rad)}});
  }
  return steps;
}

}  // namespace

std::vector<Pose2> align(std::span<const Scan> scans, std::size_t reference, const AlignOptions& options) {
  check(scans, reference, options);
  const std::vector<OdometryStep> steps = steps_of(scans, options.odometry);
  std::vector<std::unique_ptr<const ScanView>> prepared(scans.size());
  parallel_for(scans.size(), options.threads, [&](std::size_t i) {
    prepared[i] = std::make_unique<const ScanView>(scans[i], options.resolution_m);
  });
  std::vector<const ScanView*> views(scans.size());
  std::transform(prepared.begin(), prepared.end(), views.begin(),
                 [](const auto& view) { return view.get(); });
  std::vector<std::vector<StepMatch>> matches(steps.size());
  parallel_for(steps.size(), options.threads,
               [&](std::size_t k) { matches[k] = match_step(*views[k], *views[k + 1], steps[k]); });

  const ScanWindow window{.scans = views, .steps = steps, .reference = reference};
  return weigh_odometry(window, refine_jointly(window, choose_chain(window, matches)));
}

}  // namespace landfall
