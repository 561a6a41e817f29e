#include "engine/methods/grid/time_matching.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "engine/base/options.hpp"
#include "engine/base/thread_time.hpp"
#include "engine/methods/grid/level.hpp"
#include "engine/priors/central_heading.hpp"
#include "engine/scans/end_points.hpp"
#include "landfall/error.hpp"

namespace landfall::internal {
namespace {

template <typename Work>
double median_ms(int repetitions, const Work& work) {
  std::vector<double> times_ms;
  for (int i = 0; i < repetitions; ++i) {
    const double start_ms = thread_time_ms();
    work();
    times_ms.push_back(thread_time_ms() - start_ms);
  }
  const auto middle = times_ms.begin() + static_cast<std::ptrdiff_t>(times_ms.size() / 2);
  std::nth_element(times_ms.begin(), middle, times_ms.end());
  return *middle;
}

}  // namespace

GridMatchingTimes time_grid_matching(const PreparedMap& map, const PosePrior& prior, const Scan& scan,
                                     const SearchOptions& options, int repetitions) {
  validate(options);
  validate(prior);
  validate(scan);
  if (repetitions < 1)
    throw Error(ErrorCode::invalid_argument, "time_grid_matching: repetitions is " +
                                                 std::to_string(repetitions) + ", expected at least 1");
  const PreparedState& state = map.state();
  const Lattice lattice =
      centered_on(prior, make_lattice(map.grid(), options.translation_step_m, options.rotation_step_rad));
  const Domain domain =
      make_domain(prior, lattice, state.free_mask(options.robot_radius_m, lattice.step_cells));
  const EndPoints points = make_end_points(scan, lattice.resolution_m);
  const Query query{.map = state,
                    .scan = scan,
                    .points = points,
                    .lattice = lattice,
                    .domain = domain,
                    .options = options,
                    .threads = 1,
                    .deadline = {}};
  const LocalModel model = make_local_model(scan, lattice, options.robot_radius_m);
  const GridLevel level{.query = query,
                        .lattice = lattice,
                        .mask_of_heading = domain.mask_of_heading,
                        .global = state.global_grid(Contours::corrected),
                        .model = model,
                        .rival_share = grid_rival_share};
  GridMatchingTimes times;
  times.local_grids_ms = median_ms(repetitions, [&] {
    LocalGridPainter painter(model);
    LocalGrid grid;
    for (int k = 0; k < lattice.headings; ++k)
      if (domain.mask_of_heading[static_cast<std::size_t>(k)] != nullptr)
        painter.paint(lattice.heading_grid_rad(k), grid);
  });
  const double both_ms = median_ms(repetitions, [&] { (void)score_level(level); });
  times.matching_ms = std::max(0.0, both_ms - times.local_grids_ms);
  return times;
}

}  // namespace landfall::internal
