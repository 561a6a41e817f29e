// NumPy arrays in and out.
#pragma once

#include <nanobind/ndarray.h>

#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

#include "landfall/pose2.hpp"

namespace landfall::python {

template <class T>
using Matrix = nanobind::ndarray<T, nanobind::numpy, nanobind::ndim<2>, nanobind::c_contig>;
template <class T>
using Vector = nanobind::ndarray<T, nanobind::numpy, nanobind::ndim<1>, nanobind::c_contig>;
// What callers may hand over: anything that NumPy takes for an array, converted to T where it is not.
template <class T>
struct ArrayLike {
  nanobind::ndarray<const T, nanobind::c_contig, nanobind::device::cpu> array;
};

// A view of memory that `owner` keeps alive; no copy.
template <class T>
Matrix<T> view(T* data, std::size_t rows, std::size_t cols, nanobind::handle owner) {
  return Matrix<T>(data, {rows, cols}, owner);
}
template <class T>
Vector<T> view(T* data, std::size_t size, nanobind::handle owner) {
  return Vector<T>(data, {size}, owner);
}
// The vector's memory moves into the array; no copy.
template <class T>
Matrix<T> adopt(std::vector<T> values, std::size_t rows, std::size_t cols) {
  auto* moved = new std::vector<T>(std::move(values));
  const nanobind::capsule owner(moved, [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return Matrix<T>(moved->data(), {rows, cols}, owner);
}

// Values of a 2-d array, row by row. Throws Error{invalid_argument} that names `what` and the shape found
// unless it has `cols` columns.
std::span<const double> rows_of(const ArrayLike<double>& values, std::size_t cols, const char* what);
// From rows (x_m, y_m, theta_rad); a list of poses is such an array.
std::vector<Pose2> poses_from(const ArrayLike<double>& rows, const char* what);
// From rows (x_m, y_m).
std::vector<Point2> points_from(const ArrayLike<double>& rows, const char* what);
// "(3, 4)"
std::string shape_text(const std::vector<std::size_t>& shape);
template <class T>
std::vector<std::size_t> shape_of(const ArrayLike<T>& values) {
  std::vector<std::size_t> shape;
  for (std::size_t i = 0; i < values.array.ndim(); ++i) shape.push_back(values.array.shape(i));
  return shape;
}

}  // namespace landfall::python

template <class T>
struct nanobind::detail::type_caster<landfall::python::ArrayLike<T>> {
  NB_TYPE_CASTER(landfall::python::ArrayLike<T>, const_name("numpy.typing.ArrayLike"))

  bool from_python(handle source, std::uint8_t, cleanup_list*) noexcept {
    try {
      const module_ numpy = module_::import_("numpy");
      value.array = nanobind::cast<decltype(value.array)>(
          numpy.attr("ascontiguousarray")(source, numpy.attr(dtype_name())));
      return true;
    } catch (...) {  // not an array: the caller sees a TypeError with the signature
      PyErr_Clear();
      return false;
    }
  }
  static constexpr const char* dtype_name() {
    if constexpr (std::is_same_v<T, float>) return "float32";
    if constexpr (std::is_same_v<T, double>) return "float64";
    return "uint8";
  }
};
