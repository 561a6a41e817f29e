// Wall plans: {"units": "m", "walls": [[x1, y1, x2, y2], ...]}.
#include <string>

#include "engine/io/document.hpp"
#include "engine/io/file.hpp"
#include "engine/io/readers.hpp"
#include "engine/io/text.hpp"

namespace landfall {
namespace io {
namespace {

double metres_per_unit(const Field& plan) {
  const std::optional<Field> units = plan.find("units");
  if (!units || units->text() == "m") return 1.0;
  if (units->text() == "cm") return 0.01;
  if (units->text() == "mm") return 0.001;
  units->fail("m, cm or mm");
}

}  // namespace

WallMap read_wall_map(std::string_view json, const std::string& file) {
  const Document document = Document::from_json(json, {file});
  const double unit_m = metres_per_unit(document.root());
  const Field list = document.root().at("walls");
  WallMap map;
  map.walls.reserve(list.size());
  for (const Field& field : list.items()) {
    const std::vector<double> ends = field.numbers(4);
    map.walls.push_back({.a_map = {.x_m = ends[0] * unit_m, .y_m = ends[1] * unit_m},
                         .b_map = {.x_m = ends[2] * unit_m, .y_m = ends[3] * unit_m}});
  }
  if (map.walls.empty()) list.fail("at least one wall");
  return map;
}

}  // namespace io

WallMap load_wall_map(const std::filesystem::path& json) {
  return io::read_wall_map(io::read_file(json), json.string());
}

void save_wall_map(const WallMap& map, const std::filesystem::path& json) {
  validate(map);
  std::string text = "{\"units\": \"m\", \"walls\": [";
  const char* separator = "\n";
  for (const Wall& wall : map.walls) {
    text += separator;
    separator = ",\n";
    const char* bracket = "[";
    for (const double end : {wall.a_map.x_m, wall.a_map.y_m, wall.b_map.x_m, wall.b_map.y_m}) {
      text += bracket;
      bracket = ", ";
      io::append_number(text, end);
    }
    text += ']';
  }
  io::write_file(json, text + "\n]}\n");
}

}  // namespace landfall
