#include "bindings/c/handles.hpp"
#include "landfall/simulate.hpp"

namespace {

using landfall::c::guarded;
using landfall::c::required;

// The table's texts are literals, so they end with a NUL; an empty view may hold no text at all.
const char* c_string(std::string_view literal) {
  return literal.empty() ? "" : literal.data();
}

}  // namespace

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
        .name = c_string(info.name), .summary = c_string(info.summary), .source = c_string(info.source)};
  });
}

landfall_status landfall_active_isa(const char** isa) {
  return guarded(__func__, [&] {
    thread_local std::string name;
    name = landfall::active_isa();
    required(isa, "isa") = name.c_str();
  });
}

landfall_status landfall_ray_caster(const landfall_map* map, const landfall_sensor* sensor,
                                    const char** ray_caster) {
  return guarded(__func__, [&] {
    thread_local std::string name;
    name = landfall::ray_caster(required(map, "map").map, *required(sensor, "sensor").sensor);
    required(ray_caster, "ray_caster") = name.c_str();
  });
}

landfall_status landfall_active_executor(const char** executor) {
  return guarded(__func__, [&] {
    thread_local std::string name;
    name = landfall::active_executor();
    required(executor, "executor") = name.c_str();
  });
}
