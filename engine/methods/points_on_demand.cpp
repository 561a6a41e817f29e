#include "engine/methods/points_on_demand.hpp"

namespace landfall::internal {

PointsOnDemand::PointsOnDemand(const EndPoints& points, const Lattice& lattice,
                               const kernels::WindowMaxima& maxima)
    : points_(points),
      lattice_(lattice),
      maxima_(maxima),
      at_(std::make_unique<std::atomic<const AtHeading*>[]>(static_cast<std::size_t>(lattice.headings))) {}

PointsOnDemand::~PointsOnDemand() {
  for (int heading = 0; heading < lattice_.headings; ++heading)
    delete at_[static_cast<std::size_t>(heading)].load(std::memory_order_relaxed);
}

const kernels::TilePoints& PointsOnDemand::compute(int heading) {
  const std::size_t count = points_.size();
  auto mine = std::make_unique<AtHeading>();
  mine->numbers = std::make_unique_for_overwrite<std::int32_t[]>(3 * count);
  std::int32_t* col = mine->numbers.get();
  std::int32_t* row = col + count;
  std::int32_t* window = row + count;
  cells_at_heading(points_, lattice_, heading, col, row);
  mine->points = kernels::tile_points(maxima_, col, row, count, window);
  const AtHeading* known = nullptr;
  if (at_[static_cast<std::size_t>(heading)].compare_exchange_strong(known, mine.get(),
                                                                     std::memory_order_acq_rel))
    return mine.release()->points;
  return known->points;
}

}  // namespace landfall::internal
