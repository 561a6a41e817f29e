// The end points of a scan as tiles and blocks of poses at one heading see them.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <memory_resource>
#include <mutex>

#include "engine/scans/end_points.hpp"
#include "kernels/window_tile.hpp"

namespace landfall::internal {

// At every heading of the lattice, computed when first asked for; by several threads at a time, of whom one
// may compute in vain.
class PointsOnDemand {
 public:
  PointsOnDemand(const EndPoints& points, const Lattice& lattice, const kernels::WindowMaxima& maxima);

  const kernels::TilePoints& at(int heading) {
    const kernels::TilePoints* known = at_[static_cast<std::size_t>(heading)].load(std::memory_order_acquire);
    return known != nullptr ? *known : compute(heading);
  }

 private:
  const kernels::TilePoints& compute(int heading);
  template <class T>
  T* allocate(std::size_t count);

  const EndPoints& points_;
  const Lattice& lattice_;
  kernels::WindowMaxima maxima_;
  std::unique_ptr<std::atomic<const kernels::TilePoints*>[]> at_;
  // What these and their arrays lie in, for a search asks for dozens or hundreds.
  std::mutex mutex_;
  std::pmr::monotonic_buffer_resource memory_;
};

}  // namespace landfall::internal
