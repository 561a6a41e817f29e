// What stands behind the opaque handles, and how values, arrays and faults cross into C.
#pragma once

#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "landfall.h"
#include "landfall/error.hpp"
#include "landfall/prepared_map.hpp"
#include "landfall/prior.hpp"
#include "landfall/scan.hpp"
#include "landfall/search.hpp"

struct landfall_map {
  landfall::PreparedMap map;
};

struct landfall_sensor {
  std::shared_ptr<const landfall::Sensor> sensor;
};

struct landfall_scans {
  std::vector<landfall::Scan> scans;
};

struct landfall_prior {
  landfall::PosePrior prior;
};

struct landfall_results {
  std::vector<landfall::SearchResult> results;
  std::vector<std::vector<landfall_hypothesis>> hypotheses;  // of each result, as C sees them
};

struct landfall_stop {
  std::stop_source source;
};

namespace landfall::c {

// Keeps the fault that is being caught for landfall_last_error() and gives its code.
landfall_status keep_current_exception(const char* function) noexcept;

// Runs `body`; whatever it throws becomes a status.
template <class Body>
landfall_status guarded(const char* function, Body&& body) noexcept {
  try {
    body();
    return LANDFALL_OK;
  } catch (...) {
    return keep_current_exception(function);
  }
}

[[noreturn]] inline void refuse(const std::string& message) {
  throw Error(ErrorCode::invalid_argument, message);
}

template <class T>
T& required(T* pointer, const char* name) {
  if (pointer == nullptr) refuse(std::string(name) + " is NULL");
  return *pointer;
}

template <class T>
std::span<const T> array(const T* data, std::size_t count, const char* name) {
  if (data == nullptr && count > 0)
    refuse(std::string(name) + " is NULL, expected " + std::to_string(count) + " elements");
  return {data, count};
}

// The caller's options over the defaults; a caller built against an older header gives fewer fields.
template <class Options>
Options or_defaults(const Options* given, void (*init)(Options*)) {
  Options options;
  init(&options);
  if (given == nullptr) return options;
  if (given->struct_size < sizeof(std::size_t) || given->struct_size > sizeof(Options))
    refuse("options.struct_size is " + std::to_string(given->struct_size) + ", expected at most " +
           std::to_string(sizeof(Options)) + ", as its init function sets it");
  std::memcpy(&options, given, given->struct_size);
  return options;
}

inline Pose2 from_c(const landfall_pose& pose) {
  return {pose.x_m, pose.y_m, pose.theta_rad};
}
inline landfall_pose to_c(const Pose2& pose) {
  return {pose.x_m, pose.y_m, pose.theta_rad};
}
inline Point2 from_c(const landfall_point& point) {
  return {point.x_m, point.y_m};
}
inline std::vector<Pose2> from_c(std::span<const landfall_pose> poses) {
  std::vector<Pose2> converted;
  converted.reserve(poses.size());
  for (const landfall_pose& pose : poses) converted.push_back(from_c(pose));
  return converted;
}

}  // namespace landfall::c
