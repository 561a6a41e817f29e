// A line of results.jsonl.
#include <nlohmann/json.hpp>

#include "landfall/io.hpp"

namespace landfall {
namespace {

using Json = nlohmann::ordered_json;  // writes numbers that are not finite as null

Json to_json(const Hypothesis& hypothesis) {
  Json json = {{"x_m", hypothesis.T_map_robot.x_m},
               {"y_m", hypothesis.T_map_robot.y_m},
               {"theta_rad", hypothesis.T_map_robot.theta_rad},
               {"score", hypothesis.score},
               {"explained", hypothesis.explained},
               {"probability", hypothesis.probability},
               {"covariance", hypothesis.covariance}};
  const Pose2& T_map_robot = hypothesis.T_map_robot_unrefined;
  json["unrefined"] = {T_map_robot.x_m, T_map_robot.y_m, T_map_robot.theta_rad};
  if (hypothesis.map_index > 0) json["map_index"] = hypothesis.map_index;
  return json;
}

}  // namespace

std::string to_json_line(const SearchResult& result, std::size_t index) {
  Json line = {{"index", index},
               {"stamp_s", result.stamp_s},
               {"verdict", to_string(result.verdict)},
               {"proven", result.proven},
               {"search_ms", result.times.total_ms},
               {"beams", result.beams_valid},
               {"hypotheses", Json::array()}};
  for (const Hypothesis& hypothesis : result.hypotheses) line["hypotheses"].push_back(to_json(hypothesis));
  line["method"] = result.method;
  if (!result.reason.empty()) line["reason"] = result.reason;
  line["counts"] = {{"poses_covered", result.counts.poses_covered},
                    {"poses_scored", result.counts.poses_scored},
                    {"rays_cast", result.counts.rays_cast}};
  return line.dump(-1, ' ', true, Json::error_handler_t::replace);
}

}  // namespace landfall
