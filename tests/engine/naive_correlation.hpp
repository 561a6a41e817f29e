// Correlation as it is defined: the oracle of the transforms.
#pragma once

#include <cstddef>
#include <vector>

#include "engine/scans/end_points.hpp"

namespace landfall::testing {

struct Field {
  int width, height;
  std::vector<float> values;

  [[nodiscard]] float at(int col, int row) const {
    return col < 0 || row < 0 || col >= width || row >= height
               ? 0.0F
               : values[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                        static_cast<std::size_t>(col)];
  }
  [[nodiscard]] double sum(const internal::HeadingCells& points, int col, int row) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < points.col.size(); ++i)
      sum += static_cast<double>(at(col + points.col[i], row + points.row[i]));
    return sum;
  }
};

}  // namespace landfall::testing
