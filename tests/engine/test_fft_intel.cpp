// Method fft on a real building, both its ways. Skipped where there is no data.
#include <gtest/gtest.h>

#include <numbers>

#include "data_folder.hpp"
#include "engine/maps/prepared_state.hpp"
#include "engine/methods/fft/correlation_search.hpp"
#include "engine/methods/table.hpp"
#include "landfall/io.hpp"

namespace landfall {
namespace {

// 640 x 640 cells; 24 headings in place of 720 keep exhaustive search short.
TEST(Intel, FftEqualsExhaustiveBothWays) {
  LANDFALL_REQUIRE_DATA();
  const std::filesystem::path folder = testing::data_folder() / "intel";
  const PreparedMap map = load_map(folder / "map.yaml");
  const std::vector<Scan> queries = load_log(folder / "query.log.gz").scans;
  const SearchOptions options{.rotation_step_rad = 2.0 * std::numbers::pi / 24};
  const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, options.rotation_step_rad);
  const internal::Domain domain =
      internal::make_domain({Anywhere{}}, lattice, map.state().free_mask(0.0, lattice.step_cells));
  for (const std::size_t i : {40U, 333U}) {
    SCOPED_TRACE("query " + std::to_string(i));
    const internal::EndPoints points = internal::make_end_points(queries.at(i), lattice.resolution_m);
    const internal::Query query{.map = map.state(),
                                .scan = queries.at(i),
                                .points = points,
                                .lattice = lattice,
                                .domain = domain,
                                .options = options,
                                .margin = internal::rival_margin(points.size()),
                                .threads = 2,
                                .deadline = {}};
    const internal::Proposal expected = internal::propose_exhaustive(query);
    ASSERT_FALSE(expected.candidates.empty());
    for (const auto& propose : {internal::propose_by_transforms, internal::propose_directly}) {
      const internal::Proposal actual = propose(query);
      SCOPED_TRACE(actual.way);
      ASSERT_EQ(actual.candidates.size(), expected.candidates.size());
      for (std::size_t c = 0; c < expected.candidates.size(); ++c) {
        EXPECT_EQ(actual.candidates[c].score, expected.candidates[c].score);
        EXPECT_EQ(actual.candidates[c].pose, expected.candidates[c].pose);
      }
    }
  }
}

}  // namespace
}  // namespace landfall
