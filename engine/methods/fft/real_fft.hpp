// Fourier transforms of real planes, by the library that -DLANDFALL_FFT names: FFTW in single precision, or
// Eigen's (real_fft_fftw.cpp, real_fft_eigen.cpp: one of them is compiled).
#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <new>
#include <string_view>
#include <vector>

namespace landfall::internal {

// FFTW's vector code asks for aligned planes.
template <class T>
struct AlignedAllocator {
  using value_type = T;  // NOLINT(readability-identifier-naming): the standard's name
  static constexpr std::align_val_t alignment{64};

  AlignedAllocator() = default;
  template <class U>
  explicit AlignedAllocator(const AlignedAllocator<U>&) noexcept {}

  T* allocate(std::size_t count) { return static_cast<T*>(::operator new(count * sizeof(T), alignment)); }
  void deallocate(T* memory, std::size_t) noexcept { ::operator delete(memory, alignment); }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const noexcept {
    return true;
  }
};
using Plane = std::vector<float, AlignedAllocator<float>>;
using Spectrum = std::vector<std::complex<float>, AlignedAllocator<std::complex<float>>>;

// Nanoseconds of one thread, and how many times as much beyond the caches.
struct TransformCost {
  double ns_per_real_and_level = 0.0;
  double beyond_caches = 1.0;
  double far_beyond_caches = 1.0;
};

// Planes of rows x cols, row by row; their spectra of rows x (cols / 2 + 1). `cols` is even. Neither
// direction scales: there and back multiplies by rows x cols. Safe from several threads.
class RealFft {
 public:
  RealFft(int rows, int cols);
  ~RealFft();
  RealFft(const RealFft&) = delete;
  RealFft& operator=(const RealFft&) = delete;

  [[nodiscard]] int rows() const { return rows_; }
  [[nodiscard]] int cols() const { return cols_; }
  [[nodiscard]] std::size_t reals() const {
    return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_);
  }
  [[nodiscard]] std::size_t bins() const {
    return static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_ / 2 + 1);
  }

  void forward(const Plane& plane, Spectrum& spectrum) const;
  // Leaves nothing of use in the spectrum.
  void inverse(Spectrum& spectrum, Plane& plane) const;

  // The library's name: "fftw" or "eigen".
  static std::string_view library();
  // What its transforms cost (cost_model.hpp).
  static TransformCost cost();

 private:
  struct Plans;

  int rows_;
  int cols_;
  std::unique_ptr<const Plans> plans_;
};

// Made once per size in a process, for all maps.
std::shared_ptr<const RealFft> shared_fft(int rows, int cols);

}  // namespace landfall::internal
