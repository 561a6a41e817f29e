// FFTW 3, single precision. Its planner is not thread-safe: ours is behind a lock; a host that plans with
// FFTW itself at the same time calls fftwf_make_planner_thread_safe() first. Plans differ from run to run
// (the planner measures), and so do sums, within the error bound of MapSpectra.
#include <fftw3.h>

#include <algorithm>
#include <mutex>

#include "engine/methods/fft/real_fft.hpp"

namespace landfall::internal {
namespace {

constexpr double planning_limit_s = 1.0;  // of one size; the best plan found until then

std::mutex& planner_mutex() {
  static std::mutex mutex;
  return mutex;
}

fftwf_complex* raw(Spectrum& spectrum) {
  return reinterpret_cast<fftwf_complex*>(spectrum.data());
}

}  // namespace

struct RealFft::Plans {
  fftwf_plan forward = nullptr;
  fftwf_plan inverse = nullptr;

  Plans(int rows, int cols, std::size_t reals, std::size_t bins) {
    Plane plane(reals);
    Spectrum spectrum(bins);
    const std::scoped_lock lock(planner_mutex());
    [[maybe_unused]] static const int system_wisdom = fftwf_import_system_wisdom();
    fftwf_set_timelimit(planning_limit_s);
    forward = fftwf_plan_dft_r2c_2d(rows, cols, plane.data(), raw(spectrum), FFTW_MEASURE);
    inverse = fftwf_plan_dft_c2r_2d(rows, cols, raw(spectrum), plane.data(), FFTW_MEASURE);
  }
  ~Plans() {
    const std::scoped_lock lock(planner_mutex());
    fftwf_destroy_plan(forward);
    fftwf_destroy_plan(inverse);
  }
  Plans(const Plans&) = delete;
  Plans& operator=(const Plans&) = delete;
};

RealFft::RealFft(int rows, int cols) : rows_(rows), cols_(cols) {
  plans_ = std::make_unique<const Plans>(rows, cols, reals(), bins());
  if (plans_->forward == nullptr || plans_->inverse == nullptr) throw std::bad_alloc();
}

RealFft::~RealFft() = default;

void RealFft::forward(const Plane& plane, Spectrum& spectrum) const {
  // FFTW takes no const input, but transforms from real to complex leave it as it is.
  fftwf_execute_dft_r2c(plans_->forward, const_cast<float*>(plane.data()), raw(spectrum));
}

void RealFft::inverse(Spectrum& spectrum, Plane& plane) const {
  fftwf_execute_dft_c2r(plans_->inverse, raw(spectrum), plane.data());
}

std::string_view RealFft::library() {
  return "fftw";
}

TransformCost RealFft::cost() {
  return {.ns_per_real_and_level = 0.12, .beyond_caches = 1.6, .far_beyond_caches = 4.2};
}

}  // namespace landfall::internal
