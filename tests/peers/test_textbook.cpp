// The textbook's branch and bound, a peer of the benchmarks, against exhaustive search.
#include <gtest/gtest.h>

#include <algorithm>

#include "bench/peers/textbook.hpp"
#include "tests/engine/random_world.hpp"

namespace landfall {
namespace {

using bench::Textbook;
using bench::TextbookAnswer;
using testing::World;

// The worlds' maps and scans, asked as a textbook can be.
World asked_anywhere(World world) {
  world.prior = {Anywhere{}};
  world.options.method = "exhaustive";
  world.options.translation_step_m = 0.0;
  world.options.robot_radius_m = 0.0;
  world.options.max_hypotheses = 8;
  return world;
}

std::int64_t best_score_of_exhaustive(const World& world) {
  std::int64_t best = 0;
  for (const Hypothesis& hypothesis : search(world.map, world.prior, world.scan, world.options).hypotheses)
    best = std::max(best, hypothesis.score);
  return best;
}

std::int64_t score_at(const World& world, const internal::EndPoints& points, const internal::Lattice& lattice,
                      const internal::LatticePose& pose) {
  internal::HeadingCells cells;
  internal::cells_at_heading(points, lattice, pose.heading, cells);
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const CellIndex cell{.col = pose.col + cells.col[i], .row = pose.row + cells.row[i]};
    if (world.map.grid().contains(cell)) sum += world.map.field()[world.map.grid().index(cell)];
  }
  return sum;
}

template <class MakeWorld>
int worlds_with_answer(const MakeWorld& make_world, std::uint64_t seeds) {
  int answered = 0;
  for (std::uint64_t seed = 0; seed < seeds && !::testing::Test::HasFailure(); ++seed) {
    const World world = asked_anywhere(make_world(seed));
    const int height = static_cast<int>(seed % 8);
    SCOPED_TRACE("seed " + std::to_string(seed) + ", height " + std::to_string(height));
    const internal::Lattice lattice =
        internal::make_lattice(world.map.grid(), 0.0, world.options.rotation_step_rad);
    const internal::EndPoints points = internal::make_end_points(world.scan, lattice.resolution_m);
    const TextbookAnswer answer = Textbook(world.map, height).search(points, lattice);
    EXPECT_EQ(answer.score, best_score_of_exhaustive(world));
    if (answer.score == 0) continue;
    ++answered;
    EXPECT_EQ(answer.score, score_at(world, points, lattice, answer.pose));
    EXPECT_EQ(world.map.grid().at({.col = answer.pose.col, .row = answer.pose.row}), Occupancy::free);
  }
  return answered;
}

TEST(Textbook, ScoresAsExhaustiveInSmallWorlds) {
  EXPECT_GT(worlds_with_answer(testing::small_world, 300), 150);
}

TEST(Textbook, ScoresAsExhaustiveInLargeWorlds) {
  EXPECT_GT(worlds_with_answer(testing::large_world, 40), 20);
}

// Bounded nodes included.
TEST(Textbook, ExcludesMostPosesByTheirBounds) {
  testing::Dice dice(7);
  const PreparedMap map(testing::random_map(dice, 200, 300));
  const Scan scan = [&] {
    while (true) {
      Scan one = testing::random_scan(dice, map, 60);
      if (count_echoes(one) > 30) return one;
    }
  }();
  const internal::Lattice lattice = internal::make_lattice(map.grid(), 0.0, 2.0 * std::numbers::pi / 24.0);
  const internal::EndPoints points = internal::make_end_points(scan, lattice.resolution_m);
  const TextbookAnswer answer = Textbook(map, 4).search(points, lattice);
  EXPECT_GT(answer.score, 0);
  EXPECT_LT(answer.nodes, std::int64_t{lattice.width_cells} * lattice.height_cells * lattice.headings / 10);
}

}  // namespace
}  // namespace landfall
