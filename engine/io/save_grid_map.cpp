#include <algorithm>
#include <string>

#include "engine/io/file.hpp"
#include "engine/io/text.hpp"
#include "landfall/io.hpp"

namespace landfall {
namespace {

// map_saver's grey values.
char pixel_of(Occupancy cell) {
  switch (cell) {
    case Occupancy::occupied:
      return '\0';
    case Occupancy::free:
      return static_cast<char>(254);
    case Occupancy::unknown:
      break;
  }
  return static_cast<char>(205);
}

std::string to_pgm(const GridMap& map) {
  const auto width = static_cast<std::size_t>(map.width_cells);
  std::string pgm =
      "P5\n" + std::to_string(map.width_cells) + " " + std::to_string(map.height_cells) + "\n255\n";
  const std::size_t header_bytes = pgm.size();
  pgm.resize(header_bytes + map.cells.size());
  auto out = pgm.begin() + static_cast<std::ptrdiff_t>(header_bytes);
  for (std::size_t row = static_cast<std::size_t>(map.height_cells); row-- > 0;) {
    const auto begin = map.cells.begin() + static_cast<std::ptrdiff_t>(row * width);
    out = std::transform(begin, begin + map.width_cells, out, pixel_of);
  }
  return pgm;
}

std::string single_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

std::string to_yaml(const GridMap& map, const std::string& image) {
  std::string yaml = "image: " + single_quoted(image) + "\nmode: trinary\nresolution: ";
  io::append_number(yaml, map.resolution_m);
  yaml += "\norigin: [";
  io::append_number(yaml, map.T_map_grid.x_m);
  yaml += ", ";
  io::append_number(yaml, map.T_map_grid.y_m);
  yaml += ", ";
  io::append_number(yaml, map.T_map_grid.theta_rad);
  return yaml + "]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n";
}

}  // namespace

void save_grid_map(const GridMap& map, const std::filesystem::path& yaml) {
  validate(map);
  std::filesystem::path image = yaml;
  image.replace_extension(".pgm");
  io::write_file(image, to_pgm(map));
  io::write_file(yaml, to_yaml(map, image.filename().string()));
}

}  // namespace landfall
