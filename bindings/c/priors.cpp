#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "bindings/c/handles.hpp"
#include "landfall/error.hpp"
#include "landfall/io.hpp"

namespace {

using landfall::c::array;
using landfall::c::from_c;
using landfall::c::guarded;
using landfall::c::required;

void give(landfall_prior** prior, landfall::PosePrior made) {
  auto*& handle = required(prior, "prior");
  validate(made);
  handle = new landfall_prior{std::move(made)};
}

[[noreturn]] void fail_unknown_place(const std::string& path, const std::string& name,
                                     const std::map<std::string, landfall::PosePrior>& places) {
  std::string known;
  for (const auto& [other, prior] : places) known += (known.empty() ? "" : ", ") + other;
  throw landfall::Error(landfall::ErrorCode::unknown_name,
                        path + ": no place \"" + name + "\", expected one of " + known);
}

}  // namespace

landfall_status landfall_prior_anywhere(landfall_prior** prior) {
  return guarded(__func__, [&] { give(prior, {landfall::Anywhere{}}); });
}

landfall_status landfall_prior_window(landfall_pose T_map_robot, double half_x_m, double half_y_m,
                                      double half_theta_rad, landfall_prior** prior) {
  return guarded(__func__, [&] {
    give(prior, {landfall::Window{.T_map_robot = from_c(T_map_robot),
                                  .half_x_m = half_x_m,
                                  .half_y_m = half_y_m,
                                  .half_theta_rad = half_theta_rad}});
  });
}

landfall_status landfall_prior_gaussian(landfall_pose T_map_robot, const double covariance[9],
                                        landfall_prior** prior) {
  return guarded(__func__, [&] {
    landfall::Gaussian gaussian{.T_map_robot = from_c(T_map_robot), .covariance = {}};
    std::copy_n(&required(covariance, "covariance"), gaussian.covariance.size(), gaussian.covariance.begin());
    give(prior, {gaussian});
  });
}

landfall_status landfall_prior_region(const landfall_point* polygon_map, size_t point_count, double theta_rad,
                                      double half_theta_rad, landfall_prior** prior) {
  return guarded(__func__, [&] {
    landfall::Region region{.polygon_map = {}, .theta_rad = theta_rad, .half_theta_rad = half_theta_rad};
    for (const landfall_point& corner : array(polygon_map, point_count, "polygon_map"))
      region.polygon_map.push_back(from_c(corner));
    give(prior, {std::move(region)});
  });
}

landfall_status landfall_prior_beacons(const landfall_point* p_map, const double* radii_m, size_t count,
                                       landfall_prior** prior) {
  return guarded(__func__, [&] {
    const auto centres = array(p_map, count, "p_map");
    const auto radii = array(radii_m, count, "radii_m");
    landfall::Beacons beacons;
    for (std::size_t i = 0; i < count; ++i)
      beacons.discs.push_back({.p_map = from_c(centres[i]), .radius_m = radii[i]});
    give(prior, {std::move(beacons)});
  });
}

landfall_status landfall_prior_poses(const landfall_pose* T_map_robot, size_t count, landfall_prior** prior) {
  return guarded(__func__, [&] {
    give(prior, {landfall::CandidatePoses{from_c(array(T_map_robot, count, "T_map_robot"))}});
  });
}

landfall_status landfall_prior_mixture(const landfall_prior* const* components, const double* weights,
                                       size_t count, landfall_prior** prior) {
  return guarded(__func__, [&] {
    landfall::Mixture mixture;
    for (const landfall_prior* component : array(components, count, "components"))
      mixture.components.push_back(required(component, "a component").prior);
    const auto given = array(weights, count, "weights");
    mixture.weights.assign(given.begin(), given.end());
    give(prior, {std::move(mixture)});
  });
}

landfall_status landfall_prior_load(const char* path, landfall_prior** prior) {
  return guarded(__func__, [&] { give(prior, landfall::load_prior(&required(path, "path"))); });
}

landfall_status landfall_prior_place(const char* places_path, const char* name, landfall_prior** prior) {
  return guarded(__func__, [&] {
    const std::string path = &required(places_path, "places_path");
    const std::string wanted = &required(name, "name");
    const auto places = landfall::load_places(path);
    const auto place = places.find(wanted);
    if (place == places.end()) fail_unknown_place(path, wanted, places);
    give(prior, place->second);
  });
}

void landfall_prior_free(landfall_prior* prior) {
  delete prior;
}
