// Branch and bound as published: Hess, Kohler, Rapp, Andor, "Real-Time Loop Closure in 2D LIDAR SLAM",
// ICRA 2016, section V. A fair baseline for landfall's own: scalar, one thread, one candidate at a time.
// What is added to the paper, for speed: nodes without a free cell are left out, a sum that cannot reach the
// best score any more is given up, and the grids have margins of zeros in place of border tests.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/priors/lattice.hpp"
#include "engine/scans/end_points.hpp"
#include "landfall/prepared_map.hpp"

namespace landfall::bench {

struct TextbookAnswer {
  internal::LatticePose pose;
  std::int32_t score = 0;  // 0: nothing scores
  std::int64_t nodes = 0;  // bounded or, at the leaves, scored
};

class Textbook {
 public:
  // The precomputation grids M_0 .. M_height: M_h is the maximum of the likelihood field over 2^h x 2^h
  // cells, at every cell. A search begins with candidates of 2^height x 2^height cells; the answer does not
  // depend on it. Memory: height + 1 grids of 9 times the map's larger side squared.
  Textbook(const PreparedMap& map, int height);

  // The best of the lattice's poses on free cells. The lattice is that of the map, with step_cells 1.
  [[nodiscard]] TextbookAnswer search(const internal::EndPoints& points,
                                      const internal::Lattice& lattice) const;

 private:
  friend class TextbookSearch;
  using Bytes = std::vector<std::uint8_t>;

  void add_field(const PreparedMap& map);
  void add_doubled_windows(int h);
  void add_free_cells(const GridMap& map, int h);

  int width_cells_;
  int height_cells_;
  int margin_cells_;
  int stride_;
  std::vector<Bytes> max_of_level_;   // [h][row + margin][col + margin]
  std::vector<Bytes> free_of_level_;  // [h][row / 2^h][col / 2^h]: 1 where one of the node's cells is free
};

}  // namespace landfall::bench
