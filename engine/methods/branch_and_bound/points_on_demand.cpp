#include "engine/methods/branch_and_bound/points_on_demand.hpp"

#include <new>
#include <type_traits>

namespace landfall::internal {
namespace {

constexpr std::size_t headings_at_first = 16;  // room for as many

}  // namespace

PointsOnDemand::PointsOnDemand(const EndPoints& points, const Lattice& lattice,
                               const kernels::WindowMaxima& maxima)
    : points_(points),
      lattice_(lattice),
      maxima_(maxima),
      at_(std::make_unique<std::atomic<const kernels::TilePoints*>[]>(
          static_cast<std::size_t>(lattice.headings))),
      memory_(headings_at_first * (3 * points.size() * sizeof(std::int32_t) + sizeof(kernels::TilePoints))) {}

template <class T>
T* PointsOnDemand::allocate(std::size_t count) {
  static_assert(std::is_trivially_destructible_v<T>);
  const std::lock_guard lock(mutex_);
  return static_cast<T*>(memory_.allocate(count * sizeof(T), alignof(T)));
}

const kernels::TilePoints& PointsOnDemand::compute(int heading) {
  const std::size_t count = points_.size();
  auto* col = allocate<std::int32_t>(3 * count);
  std::int32_t* row = col + count;
  std::int32_t* window = row + count;
  cells_at_heading(points_, lattice_, heading, col, row);
  const auto* mine = new (allocate<kernels::TilePoints>(1))
      kernels::TilePoints(kernels::tile_points(maxima_, col, row, count, window));
  const kernels::TilePoints* known = nullptr;
  const bool first =
      at_[static_cast<std::size_t>(heading)].compare_exchange_strong(known, mine, std::memory_order_acq_rel);
  return first ? *mine : *known;
}

}  // namespace landfall::internal
