// The volume of scores by Fourier transforms, and what makes sonars fit for it.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "arrays.hpp"
#include "bindings.hpp"
#include "engine/methods/fft/bare_transforms.hpp"
#include "landfall/correlation.hpp"
#include "landfall/error.hpp"
#include "landfall/extended_robot.hpp"

namespace landfall::python {
namespace nb = nanobind;
using namespace nb::literals;

namespace {

using Volume = nb::ndarray<const float, nb::numpy, nb::ndim<3>, nb::c_contig>;

Volume scores_of(nb::handle self) {
  const CorrelationVolume& volume = nb::cast<const CorrelationVolume&>(self);
  return Volume(volume.scores.data(),
                {static_cast<std::size_t>(volume.headings), static_cast<std::size_t>(volume.height_cells),
                 static_cast<std::size_t>(volume.width_cells)},
                self);
}

std::span<const float> values_of_shape(const ArrayLike<float>& values, const std::vector<std::size_t>& wanted,
                                       const char* what) {
  const std::vector<std::size_t> shape = shape_of(values);
  if (shape != wanted)
    throw Error(ErrorCode::invalid_argument,
                std::string(what) + " of shape " + shape_text(shape) + ", expected " + shape_text(wanted));
  return {values.array.data(), values.array.size()};
}

std::vector<std::size_t> shape_of(const GridMap& grid) {
  return {static_cast<std::size_t>(grid.height_cells), static_cast<std::size_t>(grid.width_cells)};
}

CorrelationVolume volume_of(const PreparedMap& map, const Scan& scan, double rotation_step_rad,
                            const std::optional<ArrayLike<float>>& values, int threads) {
  const CorrelationOptions options{.rotation_step_rad = rotation_step_rad, .threads = threads};
  const auto given =
      values ? std::optional(values_of_shape(*values, shape_of(map.grid()), "values")) : std::nullopt;
  const nb::gil_scoped_release released;
  return given ? correlation_volume(map.grid(), *given, scan, options)
               : correlation_volume(map, scan, options);
}

void bind_volume(nb::module_& module) {
  nb::class_<CorrelationVolume>(module, "CorrelationVolume",
                                "Scores over heading, row and column: heading k is k 2 pi / headings in the "
                                "grid's own frame, the robot in the\ncentre of a cell, free or not.")
      .def_prop_ro("scores", &scores_of, "(headings, height, width) float32, a read-only view without copy.")
      .def_ro("error_bound", &CorrelationVolume::error_bound,
              "No score is farther from the exact sum than this.")
      .def_prop_ro(
          "transform_shape",
          [](const CorrelationVolume& volume) {
            return std::make_tuple(volume.transform_rows, volume.transform_cols);
          },
          "(rows, columns) of the transforms, padding included.");

  const CorrelationOptions options;
  module.def("correlation_volume", &volume_of, "map"_a, "scan"_a, nb::kw_only(),
             "rotation_step_rad"_a = options.rotation_step_rad, "values"_a = nb::none(),
             "threads"_a = options.threads,
             "All scores of method `fft`: the sum, over the scan's echoes, of the map's likelihood field "
             "where they end.\n"
             "values: (height, width), any numbers in place of the field. Raises InvalidArgument, TooLarge.");
  using internal::BareTransforms;
  nb::class_<BareTransforms>(module, "BareTransforms",
                             "Transforms of such planes and nothing else: what a correlation is measured "
                             "against. Planned when made.")
      .def(nb::init<int, int>(), "rows"_a, "cols"_a)
      .def("run", &BareTransforms::run, "count"_a, nb::call_guard<nb::gil_scoped_release>(),
           "So many transforms forth and as many back, in one thread.");
  module.def(
      "transform_library", [] { return std::string(transform_library()); },
      "\"fftw\" or \"eigen\": -DLANDFALL_FFT of the build.");
}

void bind_extended_robot(nb::module_& module) {
  module.def(
      "keep_local_minima",
      [](const std::vector<Scan>& turn, bool full_turn) { return keep_local_minima(turn, full_turn); },
      "turn"_a, "full_turn"_a = true, nb::call_guard<nb::gil_scoped_release>(),
      "The scans of a turn on the spot with only those readings that are local minima along it, beam by\n"
      "beam; the others NaN. Of a run of equal readings below both its neighbours the middle is kept.\n"
      "full_turn: the first scan is the last one's neighbour. Raises InvalidArgument.");
  const TurnMinimaOptions minima;
  module.def(
      "merge_turn_minima",
      [](const std::vector<Scan>& turn, double equal_sigmas, int plateau_weight) {
        return merge_turn_minima(turn, {.equal_sigmas = equal_sigmas, .plateau_weight = plateau_weight});
      },
      "turn"_a, nb::kw_only(), "equal_sigmas"_a = minima.equal_sigmas,
      "plateau_weight"_a = minima.plateau_weight, nb::call_guard<nb::gil_scoped_release>(),
      "The minimum filter over all sonars of a full turn together: what of it can be trusted, as one scan\n"
      "from the turn's centre. Readings are interleaved by bearing. Those that range noise alone sets apart\n"
      "over half a cone's width are one end point in the middle of their plateau; elsewhere a reading is "
      "kept\n"
      "where none within half a turn's step is shorter. Raises InvalidArgument.");
  module.def(
      "merge_turn", [](const std::vector<Scan>& turn) { return merge_turn(turn); }, "turn"_a,
      nb::call_guard<nb::gil_scoped_release>(),
      "A turn on the spot as one scan, seen from the first of its n scans; the others were taken 2 pi / n "
      "apart.");
  module.def(
      "raised_cosine_mask",
      [](int size) {
        std::vector<float> mask = raised_cosine_mask(size);
        return adopt(std::move(mask), static_cast<std::size_t>(size), static_cast<std::size_t>(size));
      },
      "size"_a, "(size, size): 1 in the centre, 0 at the rim. Raises InvalidArgument unless odd, 3 to 255.");
  module.def(
      "blurred_map",
      [](const GridMap& grid, const ArrayLike<float>& mask, int times) {
        const std::size_t rows = mask.array.ndim() > 0 ? mask.array.shape(0) : 0;
        const std::span<const float> values = values_of_shape(mask, {rows, rows}, "mask");
        std::vector<float> blurred;
        {
          const nb::gil_scoped_release released;
          blurred = blurred_map(grid, values, times);
        }
        return adopt(std::move(blurred), static_cast<std::size_t>(grid.height_cells),
                     static_cast<std::size_t>(grid.width_cells));
      },
      "grid"_a, "mask"_a, "times"_a = 1,
      "(height, width): the occupied cells convolved with a mask so many times. Twice is blurring the map "
      "and the\nrobot's end points. Raises InvalidArgument.");
}

}  // namespace

void bind_correlation(nb::module_& module) {
  bind_volume(module);
  bind_extended_robot(module);
}

}  // namespace landfall::python
