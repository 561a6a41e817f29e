#include <algorithm>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/peers/dense_correlation.hpp"

namespace landfall::bench {
namespace {

class OpenCvCorrelation : public DenseCorrelation {
 public:
  OpenCvCorrelation(const PreparedMap& map, int reach_cells)
      : width_(map.grid().width_cells),
        height_(map.grid().height_cells),
        margin_cells_(std::min(reach_cells, std::max(width_, height_))),
        field_(cv::Mat::zeros(height_ + 2 * margin_cells_, width_ + 2 * margin_cells_, CV_8U)) {
    cv::setNumThreads(1);
    for (int row = 0; row < height_; ++row)
      std::copy_n(map.field().begin() + std::ptrdiff_t{row} * width_, width_,
                  field_.ptr<std::uint8_t>(row + margin_cells_) + margin_cells_);
  }

  void correlate(const internal::HeadingCells& points, std::span<float> sums) override {
    const cv::Rect box = box_of(points);
    cv::Mat drawn = cv::Mat::zeros(box.size(), CV_8U);
    for (std::size_t i = 0; i < points.col.size(); ++i)
      if (matters(points, i)) ++drawn.at<std::uint8_t>(points.row[i] - box.y, points.col[i] - box.x);
    const cv::Mat seen = field_(cv::Rect(margin_cells_ + box.x, margin_cells_ + box.y, width_ + box.width - 1,
                                         height_ + box.height - 1));
    cv::Mat result(height_, width_, CV_32F, sums.data());
    cv::matchTemplate(seen, drawn, result, cv::TM_CCORR);
    CV_Assert(result.data == reinterpret_cast<std::uint8_t*>(sums.data()));
  }

 private:
  [[nodiscard]] bool matters(const internal::HeadingCells& points, std::size_t i) const {
    return std::abs(points.col[i]) < width_ && std::abs(points.row[i]) < height_;
  }

  [[nodiscard]] cv::Rect box_of(const internal::HeadingCells& points) const {
    cv::Rect box;
    for (std::size_t i = 0; i < points.col.size(); ++i)
      if (matters(points, i)) box |= cv::Rect(points.col[i], points.row[i], 1, 1);
    return box;
  }

  int width_;
  int height_;
  int margin_cells_;  // of zeros around the map
  cv::Mat field_;
};

}  // namespace

std::unique_ptr<DenseCorrelation> opencv_correlation(const PreparedMap& map, int reach_cells) {
  return std::make_unique<OpenCvCorrelation>(map, reach_cells);
}

}  // namespace landfall::bench
