// Networks run one after the other, each without the modes found before; two side by side look for rivals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/methods/sdn/network.hpp"
#include "engine/query.hpp"
#include "landfall/diffusion.hpp"

namespace landfall::internal {

// Settings of a search; zeros are chosen from the search space.
struct DiffusionSettings {
  bool focused = true;
  std::size_t cells = 0;
  FocusLevel top{};
  double region_share = default_region_share;
  std::size_t most_modes = 32;  // bad ones included
  bool measure_time = false;
  // Called after each iteration of each network.
  std::function<void(const Network& network, std::uint32_t run)> observe{};
};

struct DiffusionAnswer {
  std::vector<DiffusionMode> modes{};  // in the order found
  std::vector<FocusLevel> levels{};
  double regions = 0.0;  // of the top level in the prior
  std::size_t cells = 0;
  std::int64_t iterations = 0;
  NetworkCounts counts{};
  int beams = 0;  // that can be tested
};

// The modes of one query; none where no pose fits within the limit.
DiffusionAnswer find_modes_by_diffusion(const Query& query, const DiffusionSettings& settings);

}  // namespace landfall::internal
