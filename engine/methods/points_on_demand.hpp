// The end points of a scan as tiles and blocks of poses at one heading see them.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>

#include "engine/end_points.hpp"
#include "kernels/window_tile.hpp"

namespace landfall::internal {

// At every heading of the lattice, computed when first asked for; by several threads at a time, of whom one
// may compute in vain.
class PointsOnDemand {
 public:
  PointsOnDemand(const EndPoints& points, const Lattice& lattice, const kernels::WindowMaxima& maxima);
  ~PointsOnDemand();
  PointsOnDemand(const PointsOnDemand&) = delete;
  PointsOnDemand& operator=(const PointsOnDemand&) = delete;

  const kernels::TilePoints& at(int heading) {
    const AtHeading* known = at_[static_cast<std::size_t>(heading)].load(std::memory_order_acquire);
    return known != nullptr ? known->points : compute(heading);
  }

 private:
  struct AtHeading {
    std::unique_ptr<std::int32_t[]> numbers;  // what `points` points to
    kernels::TilePoints points;
  };

  const kernels::TilePoints& compute(int heading);

  const EndPoints& points_;
  const Lattice& lattice_;
  kernels::WindowMaxima maxima_;
  std::unique_ptr<std::atomic<const AtHeading*>[]> at_;
};

}  // namespace landfall::internal
