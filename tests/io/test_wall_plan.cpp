#include "io_test.hpp"
#include "landfall/io.hpp"

namespace landfall::testing {
namespace {

class WallPlan : public IoTest {
 protected:
  WallMap load(const std::string& json) const { return load_wall_map(write("plan.json", json)); }
  void expect_fault(const std::string& json, const std::vector<std::string>& parts) const {
    expect_error([&] { load(json); }, ErrorCode::file_format, parts);
  }
};

TEST_F(WallPlan, Units) {
  const WallMap metres{.walls = {{.a_map = {.x_m = 1.0, .y_m = 2.0}, .b_map = {.x_m = 3.0, .y_m = -4.0}}}};
  EXPECT_EQ(load(R"({"units": "m", "walls": [[1, 2, 3, -4]]})"), metres);
  EXPECT_EQ(load(R"({"walls": [[1, 2, 3, -4]], "source": "drawn"})"), metres);
  EXPECT_EQ(load(R"({"units": "cm", "walls": [[100, 200, 300, -400]]})"), metres);
  EXPECT_EQ(load(R"({"units": "mm", "walls": [[1000, 2000, 3000, -4000]]})"), metres);
}

TEST_F(WallPlan, SavedPlanReadsBackEqual) {
  const WallMap map{.walls = {{.a_map = {.x_m = 0.1, .y_m = 1.0 / 3.0}, .b_map = {.x_m = -1e-9, .y_m = 1e17}},
                              {.a_map = {}, .b_map = {.x_m = 5.0, .y_m = 0.0}}}};
  save_wall_map(map, at("plan.json"));
  EXPECT_EQ(load_wall_map(at("plan.json")), map);
}

TEST_F(WallPlan, Faults) {
  expect_fault("{\n\"walls\": [\n[0, 0, 1 1]]}",
               {"plan.json:3: column 10: found '1]]}', expected valid JSON"});
  expect_fault("{\"walls\": [", {"plan.json:1: column 12: found the end of the text"});
  expect_fault("[]", {"plan.json: ", "an object"});
  expect_fault(R"({"units": "m"})", {"plan.json: walls: found nothing"});
  expect_fault(R"({"units": "feet", "walls": [[0, 0, 1, 1]]})",
               {"units: found 'feet', expected m, cm or mm"});
  expect_fault(R"({"walls": []})", {"walls: found a list of 0, expected at least one wall"});
  expect_fault(R"({"walls": {}})", {"walls: found an object, expected a list"});
  expect_fault(R"({"walls": [[0, 0, 1, 1], [0, 0, 1]]})", {"walls[1]: found a list of 3", "4 numbers"});
  expect_fault(R"({"walls": [[0, 0, 1, "x"]]})", {"walls[0][3]: found 'x', expected a finite number"});
  expect_fault(R"({"walls": [[0, 0, 1, null]]})", {"walls[0][3]: found null"});
  expect_fault(R"({"walls": [[0, 0, 1, 1e999]]})", {"plan.json"});
  expect_fault(R"({"walls": [[0, 0, 1, NaN]]})", {"plan.json:1: column"});
}

}  // namespace
}  // namespace landfall::testing
