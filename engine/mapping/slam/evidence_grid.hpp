// The map under construction: cells that sum the evidence of scans, as LogOddsGrid does, over a plane that
// grows; and the deletion of obstacles that are seen through (Okada & Fujimoto, section II.C).
//
// A cell counts once a scan. Cells beside the scan's own echoes, within what noise may move them, are not
// missed: beams that graze a wall do not wear it away, and a wall's cells stay as many before its mean as
// behind.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "engine/mapping/slam/growing_array.hpp"
#include "kernels/count_fits.hpp"
#include "landfall/slam.hpp"

namespace landfall::internal {

// An echo in the map frame.
struct EchoRay {
  Point2 from_map;
  Point2 to_map;
  double noise_m = 0.0;  // how far the echo may be off
  bool follows = false;  // the beam before it had an echo too
};

class EvidenceGrid {
 public:
  static constexpr double evidence_unit = 1024.0;
  static constexpr double most_log_odds = 30.0;

  explicit EvidenceGrid(const SlamOptions& options);

  // Whether an obstacle cell that a ray passes is a wall's all the same; asked of occupied cells alone.
  using Spares = std::function<bool(const Point2& p_map, const EchoRay& ray)>;
  // The echoes of a scan. Returns the centres of obstacle cells that are gone: they were seen through.
  std::vector<Point2> add_scan(std::span<const EchoRay> rays, const Spares& spares = {});

  [[nodiscard]] bool empty() const { return cells_.width() == 0; }
  [[nodiscard]] double resolution_m() const { return options_.resolution_m; }
  [[nodiscard]] CellIndex cell_of(const Point2& p_map) const;
  [[nodiscard]] Occupancy at(CellIndex cell) const;
  // Occupied cells, for kernels::count_fits.
  [[nodiscard]] kernels::CellBits occupied() const;
  // Of the bits' lower-left corner.
  [[nodiscard]] CellIndex first() const;
  // Cells known, in a box that is no larger than needed; within `box` where given.
  [[nodiscard]] GridMap to_map(const CellBox* box = nullptr) const;
  [[nodiscard]] std::size_t memory_bytes() const { return cells_.memory_bytes() + bits_.memory_bytes(); }

 private:
  struct Cell {
    std::int16_t evidence = 0;  // log odds in units of 1 / evidence_unit
    std::uint8_t seen_in = 0;   // the last scan, from 1, that said something of the cell
    std::uint8_t through = 0;   // scans in a row that saw through it
  };

  void next_scan();
  void cover(std::span<const EchoRay> rays);
  void hit(CellIndex cell);
  void protect(std::span<const EchoRay> rays);
  void protect_around(const Point2& p_map, int radius_cells);
  void miss_along(const EchoRay& ray, const Spares& spares);
  void miss(Cell& value, const EchoRay& ray, const Spares& spares);
  [[nodiscard]] bool is_occupied(const Cell& cell) const { return cell.evidence >= occupied_; }
  void mark(CellIndex cell, bool occupied);
  [[nodiscard]] CellBox known_box() const;

  SlamOptions options_;
  std::int16_t hit_, miss_, occupied_, free_, most_, least_;
  GrowingArray<Cell> cells_;
  GrowingArray<std::uint32_t> bits_;  // by words
  std::uint8_t scan_ = 0;
  std::vector<Point2> gone_;
};

}  // namespace landfall::internal
