#include "engine/methods/fft/correlator.hpp"

#include <cmath>
#include <cstdlib>

namespace landfall::internal {
namespace {

// field x conjugate of robot. By hand: operator* of std::complex looks for infinities.
void multiply(const Spectrum& field, const Spectrum& robot, Spectrum& product) {
  const auto* a = reinterpret_cast<const float*>(field.data());
  const auto* b = reinterpret_cast<const float*>(robot.data());
  auto* out = reinterpret_cast<float*>(product.data());
  for (std::size_t i = 0; i < 2 * product.size(); i += 2) {
    const float re = a[i] * b[i] + a[i + 1] * b[i + 1];
    const float im = a[i + 1] * b[i] - a[i] * b[i + 1];
    out[i] = re;
    out[i + 1] = im;
  }
}

}  // namespace

Correlator::Correlator(const MapSpectra& spectra)
    : spectra_(spectra),
      drawn_(spectra.fft().reals()),
      robot_(spectra.fft().bins()),
      product_(spectra.fft().bins()),
      sums_(spectra.fft().reals()) {}

int Correlator::draw(const HeadingCells& points) {
  const CorrelationTiles& tiles = spectra_.tiles();
  int drawn = 0;
  double squares = 0.0;
  const auto for_cells = [&](const auto& work) {
    for (std::size_t i = 0; i < points.col.size(); ++i) {
      if (std::abs(points.col[i]) >= tiles.width_cells || std::abs(points.row[i]) >= tiles.height_cells)
        continue;
      const int x = points.col[i] < 0 ? points.col[i] + tiles.fft_cols : points.col[i];
      const int y = points.row[i] < 0 ? points.row[i] + tiles.fft_rows : points.row[i];
      work(drawn_[static_cast<std::size_t>(y) * stride() + static_cast<std::size_t>(x)]);
    }
  };
  for_cells([&](float& count) {
    squares += 2.0 * static_cast<double>(count) + 1.0;
    count += 1.0F;
    ++drawn;
  });
  spectra_.fft().forward(drawn_, robot_);
  for_cells([](float& count) { count = 0.0F; });
  error_bound_ = spectra_.error_bound(drawn, std::sqrt(squares));
  return drawn;
}

void Correlator::correlate(int tile) {
  multiply(spectra_.of_tile(tile), robot_, product_);
  spectra_.fft().inverse(product_, sums_);
}

}  // namespace landfall::internal
