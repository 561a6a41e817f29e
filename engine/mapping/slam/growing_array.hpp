// Values over an endless plane of cells, held where they were asked for: a rectangle that grows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "landfall/error.hpp"
#include "landfall/grid_map.hpp"

namespace landfall::internal {

// Both corners included.
struct CellBox {
  CellIndex low;
  CellIndex high;
};

template <class T>
class GrowingArray {
 public:
  // Grows by multiples of `stride` cells.
  GrowingArray(T fill, int stride) : fill_(std::move(fill)), stride_(stride) {}

  [[nodiscard]] CellIndex first() const { return first_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const T* data() const { return values_.data(); }
  [[nodiscard]] std::size_t memory_bytes() const { return values_.capacity() * sizeof(T); }
  [[nodiscard]] bool contains(CellIndex cell) const {
    return cell.col >= first_.col && cell.col < first_.col + width_ && cell.row >= first_.row &&
           cell.row < first_.row + height_;
  }
  [[nodiscard]] std::ptrdiff_t index(CellIndex cell) const {
    return static_cast<std::ptrdiff_t>(cell.row - first_.row) * width_ + (cell.col - first_.col);
  }
  // The inverse, for a cell that is held.
  [[nodiscard]] CellIndex cell_at(std::ptrdiff_t index) const {
    return {.col = first_.col + static_cast<int>(index % width_),
            .row = first_.row + static_cast<int>(index / width_)};
  }
  // Of a cell that is held.
  [[nodiscard]] T& operator[](CellIndex cell) { return values_[static_cast<std::size_t>(index(cell))]; }
  [[nodiscard]] const T& operator[](CellIndex cell) const {
    return values_[static_cast<std::size_t>(index(cell))];
  }
  // What is not held is as if never touched.
  [[nodiscard]] const T& at(CellIndex cell) const { return contains(cell) ? (*this)[cell] : fill_; }

  template <class Change>
  void for_each(const Change& change) {
    for (T& value : values_) change(value);
  }

  // Holds the box from now on. It grows by half its size at least, so that a growing map is copied seldom.
  // Throws Error{too_large}.
  void cover(const CellBox& box) {
    const bool fits = width_ > 0 && contains(box.low) && contains(box.high);
    if (fits) return;
    CellBox grown = width_ == 0 ? with_margin(box) : with_room(box);
    grown.low = {.col = floor_to_stride(grown.low.col), .row = floor_to_stride(grown.low.row)};
    grown.high = {.col = floor_to_stride(grown.high.col + stride_),
                  .row = floor_to_stride(grown.high.row + stride_)};
    reallocate(grown);
  }

 private:
  [[nodiscard]] int floor_to_stride(int cell) const {
    return (cell >= 0 ? cell / stride_ : -((stride_ - 1 - cell) / stride_)) * stride_;
  }
  [[nodiscard]] static CellBox with_margin(const CellBox& box) {
    const int cols = (box.high.col - box.low.col) / 4;
    const int rows = (box.high.row - box.low.row) / 4;
    return {.low = {.col = box.low.col - cols, .row = box.low.row - rows},
            .high = {.col = box.high.col + cols, .row = box.high.row + rows}};
  }
  [[nodiscard]] CellBox with_room(const CellBox& box) const {
    const CellIndex last{.col = first_.col + width_ - 1, .row = first_.row + height_ - 1};
    const auto low = [](int asked, int held, int size) {
      return asked < held ? std::min(asked, held - size / 2) : held;
    };
    const auto high = [](int asked, int held, int size) {
      return asked > held ? std::max(asked, held + size / 2) : held;
    };
    return {
        .low = {.col = low(box.low.col, first_.col, width_), .row = low(box.low.row, first_.row, height_)},
        .high = {.col = high(box.high.col, last.col, width_), .row = high(box.high.row, last.row, height_)}};
  }
  // [low, high)
  void reallocate(const CellBox& box) {
    const std::int64_t width = std::int64_t{box.high.col} - box.low.col;
    const std::int64_t height = std::int64_t{box.high.row} - box.low.row;
    if (width > max_map_side_cells || height > max_map_side_cells || width * height > max_map_cells)
      throw Error(ErrorCode::too_large, "slam: " + std::to_string(width) + " x " + std::to_string(height) +
                                            " cells are needed, at most " + std::to_string(max_map_cells) +
                                            " and " + std::to_string(max_map_side_cells) +
                                            " a side are taken");
    std::vector<T> values(static_cast<std::size_t>(width * height), fill_);
    for (int row = 0; row < height_; ++row)
      std::move(values_.begin() + std::ptrdiff_t{row} * width_,
                values_.begin() + std::ptrdiff_t{row + 1} * width_,
                values.begin() + (std::int64_t{first_.row} + row - box.low.row) * width +
                    (first_.col - box.low.col));
    values_ = std::move(values);
    first_ = box.low;
    width_ = static_cast<int>(width);
    height_ = static_cast<int>(height);
  }

  T fill_;
  int stride_;
  CellIndex first_{};
  int width_ = 0;
  int height_ = 0;
  std::vector<T> values_;
};

}  // namespace landfall::internal
