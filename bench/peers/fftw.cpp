#include <fftw3.h>

#include <algorithm>
#include <complex>
#include <cstdlib>
#include <vector>

#include "bench/peers/dense_correlation.hpp"

namespace landfall::bench {
namespace {

struct Free {
  void operator()(void* memory) const { fftwf_free(memory); }
};
struct Destroy {
  void operator()(fftwf_plan plan) const { fftwf_destroy_plan(plan); }
};
using Reals = std::unique_ptr<float[], Free>;
using Spectrum = std::unique_ptr<std::complex<float>[], Free>;
using Plan = std::unique_ptr<std::remove_pointer_t<fftwf_plan>, Destroy>;

fftwf_complex* raw(const Spectrum& spectrum) {
  return reinterpret_cast<fftwf_complex*>(spectrum.get());
}

// The least size not below `least` that has only the factors FFTW is fast at.
int fast_size(int least) {
  for (int size = least;; ++size) {
    int rest = size;
    for (const int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return size;
  }
}

class FftwCorrelation : public DenseCorrelation {
 public:
  FftwCorrelation(const PreparedMap& map, int reach_cells)
      : width_(map.grid().width_cells),
        height_(map.grid().height_cells),
        cols_(fast_size(width_ + std::min(reach_cells, width_))),
        rows_(fast_size(height_ + std::min(reach_cells, height_))) {
    const std::size_t reals = static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_);
    bins_ = static_cast<std::size_t>(cols_ / 2 + 1) * static_cast<std::size_t>(rows_);
    plane_.reset(fftwf_alloc_real(reals));
    for (Spectrum* spectrum : {&field_, &drawn_})
      spectrum->reset(reinterpret_cast<std::complex<float>*>(fftwf_alloc_complex(bins_)));
    forth_.reset(fftwf_plan_dft_r2c_2d(rows_, cols_, plane_.get(), raw(drawn_), FFTW_MEASURE));
    back_.reset(fftwf_plan_dft_c2r_2d(rows_, cols_, raw(drawn_), plane_.get(), FFTW_MEASURE));
    std::fill_n(plane_.get(), reals, 0.0F);
    for (int row = 0; row < height_; ++row)
      std::copy_n(map.field().begin() + std::ptrdiff_t{row} * width_, width_, at(row, 0));
    fftwf_execute(forth_.get());
    for (std::size_t i = 0; i < bins_; ++i) field_[i] = drawn_[i] / static_cast<float>(reals);
  }

  void correlate(const internal::HeadingCells& points, std::span<float> sums) override {
    std::fill_n(plane_.get(), static_cast<std::size_t>(cols_) * static_cast<std::size_t>(rows_), 0.0F);
    for (std::size_t i = 0; i < points.col.size(); ++i)
      if (std::abs(points.col[i]) < width_ && std::abs(points.row[i]) < height_)
        *at((points.row[i] + rows_) % rows_, (points.col[i] + cols_) % cols_) += 1.0F;
    fftwf_execute(forth_.get());
    multiply();
    fftwf_execute(back_.get());
    for (int row = 0; row < height_; ++row)
      std::copy_n(at(row, 0), width_, sums.begin() + std::ptrdiff_t{row} * width_);
  }

 private:
  [[nodiscard]] float* at(int row, int col) const { return plane_.get() + std::ptrdiff_t{row} * cols_ + col; }

  // By hand: operator* of std::complex looks for infinities.
  void multiply() {
    for (std::size_t i = 0; i < bins_; ++i) {
      const std::complex<float> a = field_[i];
      const std::complex<float> b = drawn_[i];
      drawn_[i] = {a.real() * b.real() + a.imag() * b.imag(), a.imag() * b.real() - a.real() * b.imag()};
    }
  }

  int width_;
  int height_;
  int cols_;  // of the transforms: no end point wraps around into the map
  int rows_;
  std::size_t bins_ = 0;
  Reals plane_;
  Spectrum field_;  // divided by cols x rows, which FFTW leaves to us
  Spectrum drawn_;
  Plan forth_;
  Plan back_;
};

}  // namespace

std::unique_ptr<DenseCorrelation> fftw_correlation(const PreparedMap& map, int reach_cells) {
  return std::make_unique<FftwCorrelation>(map, reach_cells);
}

}  // namespace landfall::bench
