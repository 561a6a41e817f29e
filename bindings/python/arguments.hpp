// What callers may write for a pose or a prior: types of arguments only, so that the stubs say it too.
#pragma once

#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>

#include <cstdint>
#include <string>
#include <tuple>
#include <utility>

#include "arrays.hpp"
#include "landfall/pose2.hpp"
#include "landfall/prior.hpp"

namespace landfall::python {

// A Pose2, or any sequence (x_m, y_m, theta_rad).
struct PoseArgument : Pose2 {};

// An array of shape (poses, 3), or a list of poses: NumPy reads them alike.
struct PosesArgument : ArrayLike<double> {};

// The cells of a grid: bytes as they are; other numbers as they are too, for as bytes -1 would be 255 and 0.9
// would be 0.
struct CellsArgument {
  bool are_bytes = true;
  ArrayLike<std::uint8_t> bytes{};
  ArrayLike<double> numbers{};
};

// A prior of any kind.
struct PriorArgument : PosePrior {};

}  // namespace landfall::python

template <>
struct nanobind::detail::type_caster<landfall::python::PoseArgument> {
  NB_TYPE_CASTER(landfall::python::PoseArgument,
                 union_name(make_caster<landfall::Pose2>::Name, const_name("tuple[float, float, float]")))

  bool from_python(handle source, std::uint8_t, cleanup_list*) noexcept {
    if (try_cast(source, static_cast<landfall::Pose2&>(value))) return true;
    std::tuple<double, double, double> values;
    if (!try_cast(source, values)) return false;
    value = {{std::get<0>(values), std::get<1>(values), std::get<2>(values)}};
    return true;
  }
  static handle from_cpp(const landfall::Pose2& pose, rv_policy, cleanup_list*) noexcept {
    return cast(pose).release();
  }
};

template <>
struct nanobind::detail::type_caster<landfall::python::PosesArgument> {
  NB_TYPE_CASTER(landfall::python::PosesArgument,
                 union_name(const_name("numpy.typing.ArrayLike"), const_name("collections.abc.Sequence[") +
                                                                      make_caster<landfall::Pose2>::Name +
                                                                      const_name("]")))

  bool from_python(handle source, std::uint8_t, cleanup_list*) noexcept {
    return try_cast(source, static_cast<landfall::python::ArrayLike<double>&>(value));
  }
};

template <>
struct nanobind::detail::type_caster<landfall::python::CellsArgument> {
  NB_TYPE_CASTER(landfall::python::CellsArgument, const_name("numpy.typing.ArrayLike"))

  bool from_python(handle source, std::uint8_t, cleanup_list*) noexcept {
    try {
      const object array = module_::import_("numpy").attr("asarray")(source);
      const std::string type = nanobind::cast<std::string>(array.attr("dtype").attr("name"));
      value.are_bytes = type == "uint8" || type == "bool";
      return value.are_bytes ? try_cast(array, value.bytes) : try_cast(array, value.numbers);
    } catch (...) {  // not an array: the caller sees a TypeError with the signature
      PyErr_Clear();
      return false;
    }
  }
};

template <>
struct nanobind::detail::type_caster<landfall::python::PriorArgument> {
  template <class T>
  using Caster = make_caster<T>;
  NB_TYPE_CASTER(landfall::python::PriorArgument,
                 union_name(Caster<landfall::PosePrior>::Name, Caster<landfall::Anywhere>::Name,
                            Caster<landfall::Window>::Name, Caster<landfall::Gaussian>::Name,
                            Caster<landfall::Region>::Name, Caster<landfall::Beacons>::Name,
                            Caster<landfall::CandidatePoses>::Name, Caster<landfall::Mixture>::Name))

  bool from_python(handle source, std::uint8_t, cleanup_list*) noexcept {
    try {
      return try_cast(source, static_cast<landfall::PosePrior&>(value)) || is<landfall::Anywhere>(source) ||
             is<landfall::Window>(source) || is<landfall::Gaussian>(source) || is<landfall::Region>(source) ||
             is<landfall::Beacons>(source) || is<landfall::CandidatePoses>(source) ||
             is<landfall::Mixture>(source);
    } catch (...) {  // copying a prior may run out of memory
      return false;
    }
  }

 private:
  template <class Kind>
  bool is(handle source) {
    Kind kind;
    if (!try_cast(source, kind)) return false;
    value.kind = std::move(kind);
    return true;
  }
};
