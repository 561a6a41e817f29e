// Priors as JSON that mirrors prior.hpp: "anywhere" or an object with one member that names the kind.
#include <algorithm>

#include "engine/io/document.hpp"
#include "engine/io/file.hpp"
#include "engine/io/prior_fields.hpp"
#include "engine/io/readers.hpp"

namespace landfall {
namespace io {

Window read_window(const Field& field) {
  field.expect_only({"T_map_robot", "half_x_m", "half_y_m", "half_theta_rad"});
  Window window;
  window.T_map_robot = field.at("T_map_robot").pose();
  window.half_x_m = field.number_or("half_x_m", window.half_x_m);
  window.half_y_m = field.number_or("half_y_m", window.half_y_m);
  window.half_theta_rad = field.number_or("half_theta_rad", window.half_theta_rad);
  return window;
}

Region read_region(const Field& field) {
  field.expect_only({"polygon_map", "theta_rad", "half_theta_rad"});
  Region region;
  for (const Field& corner : field.at("polygon_map").items()) region.polygon_map.push_back(corner.point());
  region.theta_rad = field.number_or("theta_rad", region.theta_rad);
  region.half_theta_rad = field.number_or("half_theta_rad", region.half_theta_rad);
  return region;
}

namespace {

constexpr int max_mixture_depth = 8;  // as validate() allows

PosePrior read_kind(const Field& field, int depth);

Gaussian read_gaussian(const Field& field) {
  field.expect_only({"T_map_robot", "covariance"});
  Gaussian gaussian;
  gaussian.T_map_robot = field.at("T_map_robot").pose();
  const std::vector<double> covariance = field.at("covariance").numbers(9);
  std::copy(covariance.begin(), covariance.end(), gaussian.covariance.begin());
  return gaussian;
}

Beacons read_beacons(const Field& field) {
  Beacons beacons;
  for (const Field& disc : field.items()) {
    disc.expect_only({"p_map", "radius_m"});
    beacons.discs.push_back({.p_map = disc.at("p_map").point(), .radius_m = disc.at("radius_m").number()});
  }
  return beacons;
}

CandidatePoses read_poses(const Field& field) {
  CandidatePoses poses;
  for (const Field& pose : field.items()) poses.T_map_robot.push_back(pose.pose());
  return poses;
}

Mixture read_mixture(const Field& field, int depth) {
  if (depth >= max_mixture_depth) field.fail("mixtures nested at most 8 deep");
  Mixture mixture;
  for (const Field& component : field.items()) {
    component.expect_only({"weight", "prior"});
    mixture.weights.push_back(component.at("weight").number());
    mixture.components.push_back(read_kind(component.at("prior"), depth + 1));
  }
  return mixture;
}

PosePrior read_kind(const Field& field, int depth) {
  constexpr const char* expected =
      "\"anywhere\", or an object with one of anywhere, window, gaussian, region, beacons, poses, mixture";
  if (field.is_text() && field.text() == "anywhere") return {Anywhere{}};
  if (!field.is_object() || field.size() != 1) field.fail(expected);
  if (field.find("anywhere")) return {Anywhere{}};
  if (const auto window = field.find("window")) return {read_window(*window)};
  if (const auto gaussian = field.find("gaussian")) return {read_gaussian(*gaussian)};
  if (const auto region = field.find("region")) return {read_region(*region)};
  if (const auto beacons = field.find("beacons")) return {read_beacons(*beacons)};
  if (const auto poses = field.find("poses")) return {read_poses(*poses)};
  if (const auto mixture = field.find("mixture")) return {read_mixture(*mixture, depth)};
  field.expect_only({"anywhere", "window", "gaussian", "region", "beacons", "poses", "mixture"});
  field.fail(expected);
}

}  // namespace

PosePrior read_prior(std::string_view json, const std::string& file) {
  const Document document = Document::from_json(json, {file});
  PosePrior prior = read_kind(document.root(), 0);
  try {
    validate(prior);
  } catch (const Error& error) {
    throw Error(ErrorCode::file_format, file + ": " + error.what());
  }
  return prior;
}

}  // namespace io

PosePrior load_prior(const std::filesystem::path& json) {
  return io::read_prior(io::read_file(json), json.string());
}

}  // namespace landfall
