// Every heading's sums by transforms; blocks whose best sum may be a rival, by the transforms' error bound,
// are scored again by the integer sum. The sums themselves are forgotten heading by heading.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "engine/base/parallel.hpp"
#include "engine/methods/fft/correlation_search.hpp"
#include "engine/methods/fft/correlator.hpp"
#include "engine/methods/fft/exact_blocks.hpp"

namespace landfall::internal {
namespace {

using kernels::block_cells;

// A block whose scores are at most `bound`.
struct PromisingBlock {
  std::int32_t bound = 0;
  LatticePose first;  // its lower-left cell, at its heading
};

std::string way_text(const CorrelationTiles& tiles) {
  const std::string size = std::to_string(tiles.fft_cols) + " x " + std::to_string(tiles.fft_rows);
  const std::string library(RealFft::library());
  if (tiles.count() == 1) return library + " " + size;
  return library + " " + std::to_string(tiles.count()) + " tiles of " + size;
}

// The headings that one thread takes.
class HeadingSums {
 public:
  HeadingSums(const Query& query, const MapSpectra& spectra, BestScore& at_least)
      : query_(query),
        tiles_(spectra.tiles()),
        correlator_(spectra),
        at_least_(at_least),
        column_max_(static_cast<std::size_t>(tiles_.tile_width_cells)) {}

  void visit(int heading) {
    const SharedMask& mask = query_.domain.mask_of_heading[static_cast<std::size_t>(heading)];
    if (mask == nullptr) return;
    cells_at_heading(query_.points, query_.lattice, heading, points_);
    const int drawn = correlator_.draw(points_);
    if (255 * std::int64_t{drawn} < lowest()) return;
    for (int tile = 0; tile < tiles_.count(); ++tile)
      if (overlaps(*mask, tile)) visit(heading, *mask, tile);
    if (promising.size() > most_kept_) forget_beaten();
  }

  std::vector<PromisingBlock> promising;
  std::int64_t blocks = 0;

 private:
  [[nodiscard]] std::int32_t lowest() const { return lowest_rival(at_least_.get(), query_.margin); }

  [[nodiscard]] bool overlaps(const BlockMask& mask, int tile) const {
    const int col = tiles_.first_col(tile);
    const int row = tiles_.first_row(tile);
    return mask.first_col * block_cells < col + tiles_.tile_width_cells &&
           (mask.first_col + mask.cols) * block_cells > col &&
           mask.first_row * block_cells < row + tiles_.tile_height_cells &&
           (mask.first_row + mask.rows) * block_cells > row;
  }

  void visit(int heading, const BlockMask& mask, int tile) {
    correlator_.correlate(tile);
    const int row0 = tiles_.first_row(tile);
    const int rows = std::min(tiles_.tile_height_cells, tiles_.height_cells - row0);
    for (int row = 0; row < rows; row += block_cells)
      visit_row_of_blocks(heading, mask, tile, row, std::min(block_cells, rows - row));
  }

  void visit_row_of_blocks(int heading, const BlockMask& mask, int tile, int row, int rows) {
    const int col0 = tiles_.first_col(tile);
    const int row0 = tiles_.first_row(tile);
    const int cols = std::min(tiles_.tile_width_cells, tiles_.width_cells - col0);
    find_column_max(row, rows, cols);
    for (int col = 0; col < cols; col += block_cells) {
      const std::uint64_t allowed = mask.at((col0 + col) / block_cells, (row0 + row) / block_cells);
      if (allowed == 0) continue;
      ++blocks;
      const int width = std::min(block_cells, cols - col);
      const float most = *std::max_element(&column_max_[static_cast<std::size_t>(col)],
                                           &column_max_[static_cast<std::size_t>(col)] + width);
      if (upper(most) < lowest()) continue;
      const float best = best_allowed(row, col, allowed);
      at_least_.raise(lower(best));
      if (upper(best) >= lowest())
        promising.push_back(
            {.bound = upper(best), .first = {.heading = heading, .row = row0 + row, .col = col0 + col}});
    }
  }

  void find_column_max(int row, int rows, int cols) {
    const float* sums = correlator_.sums() + static_cast<std::size_t>(row) * correlator_.stride();
    float* most = column_max_.data();
    std::copy_n(sums, cols, most);
    for (int r = 1; r < rows; ++r) {
      sums += correlator_.stride();
      for (int c = 0; c < cols; ++c) most[c] = most[c] < sums[c] ? sums[c] : most[c];
    }
  }

  [[nodiscard]] float best_allowed(int row, int col, std::uint64_t allowed) const {
    float best = std::numeric_limits<float>::lowest();
    for (; allowed != 0; allowed &= allowed - 1) {
      const int bit = std::countr_zero(allowed);
      const auto at = static_cast<std::size_t>(row + bit / block_cells) * correlator_.stride() +
                      static_cast<std::size_t>(col + bit % block_cells);
      best = std::max(best, correlator_.sums()[at]);
    }
    return best;
  }

  // The exact score that a sum stands for lies between these.
  [[nodiscard]] std::int32_t upper(float sum) const {
    return static_cast<std::int32_t>(std::floor(static_cast<double>(sum) + correlator_.error_bound()));
  }
  [[nodiscard]] std::int32_t lower(float sum) const {
    return static_cast<std::int32_t>(std::ceil(static_cast<double>(sum) - correlator_.error_bound()));
  }

  void forget_beaten() {
    std::erase_if(promising, [least = lowest()](const PromisingBlock& b) { return b.bound < least; });
    most_kept_ = std::max(most_kept_, 2 * promising.size());
  }

  const Query& query_;
  const CorrelationTiles& tiles_;
  Correlator correlator_;
  BestScore& at_least_;  // what the best pose scores at least
  std::vector<float> column_max_;
  HeadingCells points_;
  std::size_t most_kept_ = std::size_t{1} << 16;
};

class TransformSearch {
 public:
  explicit TransformSearch(const Query& query)
      : query_(query), spectra_(query.map.field_spectra(reach_cells(query.points))) {}

  Proposal run() {
    proposal_.way = way_text(spectra_->tiles());
    sum_headings();
    score_promising();
    return std::move(proposal_);
  }

 private:
  [[nodiscard]] std::size_t workers() const {
    return static_cast<std::size_t>(
        std::clamp(thread_count(query_.threads), 1, std::max(1, query_.lattice.headings)));
  }

  void sum_headings() {
    std::vector<std::unique_ptr<HeadingSums>> sums(workers());
    std::atomic<int> next{0};
    parallel_for(sums.size(), query_.threads, [&](std::size_t i) {
      sums[i] = std::make_unique<HeadingSums>(query_, *spectra_, at_least_);
      for (int heading = next++; heading < query_.lattice.headings && !query_.out_of_time(); heading = next++)
        sums[i]->visit(heading);
    });
    for (const auto& some : sums) {
      promising_.insert(promising_.end(), some->promising.begin(), some->promising.end());
      proposal_.counts.bounds_computed += some->blocks;
    }
    std::sort(promising_.begin(), promising_.end(), [](const PromisingBlock& a, const PromisingBlock& b) {
      return a.bound != b.bound ? a.bound > b.bound : a.first < b.first;
    });
  }

  // Best bound first: once one is beaten, so is the rest. A few are scored even when time is up.
  void score_promising() {
    constexpr std::size_t few = 16;
    BestScore best;
    std::vector<std::unique_ptr<ExactBlocks>> scorers(workers());
    std::atomic<std::size_t> next{0};
    parallel_for(scorers.size(), query_.threads, [&](std::size_t i) {
      scorers[i] = std::make_unique<ExactBlocks>(query_, best);
      HeadingCells points;
      int heading = -1;
      for (std::size_t n = next++; n < promising_.size(); n = next++) {
        const PromisingBlock& block = promising_[n];
        if (block.bound < lowest_rival(best.get(), query_.margin)) return;
        if (n >= few && query_.out_of_time()) return;
        if (block.first.heading != heading)
          cells_at_heading(query_.points, query_.lattice, block.first.heading, points);
        heading = block.first.heading;
        scorers[i]->visit(points, heading, block.first.row / block_cells, block.first.col / block_cells);
      }
    });
    for (const auto& scorer : scorers) {
      proposal_.candidates.insert(proposal_.candidates.end(), scorer->candidates.begin(),
                                  scorer->candidates.end());
      proposal_.counts.poses_scored += scorer->poses_scored;
    }
    keep_rivals(proposal_.candidates, query_.margin);
    proposal_.proven = !query_.out_of_time();
  }

  const Query& query_;
  std::shared_ptr<const MapSpectra> spectra_;
  BestScore at_least_;
  std::vector<PromisingBlock> promising_;
  Proposal proposal_;
};

}  // namespace

Proposal propose_by_transforms(const Query& query) {
  return TransformSearch(query).run();
}

}  // namespace landfall::internal
