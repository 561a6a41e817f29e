// landfall::Error becomes the matching class of landfall/errors.py.
#include "landfall/error.hpp"

#include "bindings.hpp"

namespace landfall::python {
namespace nb = nanobind;

void bind_errors() {
  nb::register_exception_translator([](const std::exception_ptr& thrown, void*) {
    try {
      std::rethrow_exception(thrown);
    } catch (const Error& error) {
      const nb::object classes = nb::module_::import_("landfall.errors").attr("by_code");
      const nb::object matching = classes[to_string(error.code())];
      PyErr_SetString(matching.ptr(), error.what());
    }
  });
}

}  // namespace landfall::python
