#include <limits>
#include <nlohmann/json.hpp>

#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

TEST(ResultLine, HoldsTheContractsFieldsInOrder) {
  SearchResult result;
  result.verdict = Verdict::found;
  result.proven = true;
  result.stamp_s = 12.3;
  result.beams_valid = 171;
  result.times.total_ms = 1.25;
  Hypothesis hypothesis;
  hypothesis.T_map_robot = {.x_m = 1.0, .y_m = 2.0, .theta_rad = 0.5};
  hypothesis.score = 41000;
  hypothesis.explained = 0.97;
  hypothesis.probability = 0.999;
  hypothesis.covariance = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  result.hypotheses = {hypothesis};
  const std::string line = to_json_line(result, 7);
  EXPECT_EQ(line.find('\n'), std::string::npos);
  EXPECT_THAT(line,
              ::testing::StartsWith(
                  R"({"index":7,"stamp_s":12.3,"verdict":"found","proven":true,"search_ms":1.25,"beams":171,)"
                  R"("hypotheses":[{"x_m":1.0,"y_m":2.0,"theta_rad":0.5,"score":41000,"explained":0.97,)"
                  R"("probability":0.999,"covariance":[1.0,2.0,3.0,4.0,5.0,6.0,7.0,8.0,9.0])"));
  const auto json = nlohmann::json::parse(line);
  EXPECT_FALSE(json.contains("reason"));
  EXPECT_FALSE(json["hypotheses"][0].contains("map_index"));
}

TEST(ResultLine, NumbersThatAreNotFiniteBecomeNull) {
  SearchResult result;
  result.hypotheses.resize(2);
  result.hypotheses[0].covariance[0] = std::numeric_limits<double>::infinity();
  result.hypotheses[0].probability = std::numeric_limits<double>::quiet_NaN();
  result.hypotheses[1].map_index = 3;
  const auto json = nlohmann::json::parse(to_json_line(result, 0));
  EXPECT_TRUE(json["hypotheses"][0]["covariance"][0].is_null());
  EXPECT_TRUE(json["hypotheses"][0]["probability"].is_null());
  EXPECT_EQ(json["hypotheses"][1]["map_index"], 3);
}

TEST(ResultLine, LostSaysWhy) {
  SearchResult result;
  result.reason = "no valid \"beam\"";
  const auto json = nlohmann::json::parse(to_json_line(result, 0));
  EXPECT_EQ(json["verdict"], "lost");
  EXPECT_EQ(json["reason"], "no valid \"beam\"");
  EXPECT_TRUE(json["hypotheses"].empty());
}

}  // namespace
}  // namespace landfall::testing
