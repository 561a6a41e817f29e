// Named places: yaml with a polygon, or a pose and its spread, for each name.
#include "engine/io/file.hpp"
#include "engine/io/prior_fields.hpp"
#include "engine/io/readers.hpp"

namespace landfall {
namespace io {
namespace {

PosePrior read_place(const Field& field) {
  if (!field.is_object()) field.fail("an object with polygon_map or T_map_robot");
  if (field.find("polygon_map")) return {read_region(field)};
  return {read_window(field)};
}

}  // namespace

std::map<std::string, PosePrior> read_places(std::string_view yaml, const std::string& file) {
  const Document document = Document::from_yaml(yaml, file);
  const Field root = document.root();
  if (!root.is_object()) root.fail("an object with a place for each name");
  std::map<std::string, PosePrior> places;
  for (const std::string& name : root.keys()) {
    const Field field = root.at(name);
    const PosePrior place = read_place(field);
    try {
      validate(place);
    } catch (const Error& error) {
      throw Error(ErrorCode::file_format, to_string(field.place()) + ": " + name + ": " + error.what());
    }
    places.emplace(name, place);
  }
  return places;
}

}  // namespace io

std::map<std::string, PosePrior> load_places(const std::filesystem::path& yaml) {
  return io::read_places(io::read_file(yaml), yaml.string());
}

}  // namespace landfall
