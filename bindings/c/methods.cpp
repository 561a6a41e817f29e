#include "bindings/c/handles.hpp"

using landfall::c::guarded;
using landfall::c::required;

size_t landfall_method_count(void) {
  return landfall::methods().size();
}

landfall_status landfall_method_get(size_t index, landfall_method* method) {
  return guarded(__func__, [&] {
    const auto methods = landfall::methods();
    if (index >= methods.size())
      landfall::c::refuse("index is " + std::to_string(index) + ", there are " +
                          std::to_string(methods.size()) + " methods");
    const landfall::MethodInfo& info = methods[index];
    required(method, "method") = {
        .name = info.name.data(), .summary = info.summary.data(), .source = info.source.data()};
  });
}

landfall_status landfall_active_isa(const char** isa) {
  return guarded(__func__, [&] {
    thread_local std::string name;
    name = landfall::active_isa();
    required(isa, "isa") = name.c_str();
  });
}
