#include "repr.hpp"

#include <string>

namespace landfall::python {
namespace nb = nanobind;

nb::str repr_of(nb::handle self, std::initializer_list<const char*> attributes) {
  std::string text = std::string(nb::str(self.type().attr("__name__")).c_str()) + "(";
  bool first = true;
  for (const char* attribute : attributes) {
    text += (first ? "" : ", ") + std::string(attribute) + "=" + nb::repr(self.attr(attribute)).c_str();
    first = false;
  }
  return nb::str((text + ")").c_str());
}

}  // namespace landfall::python
