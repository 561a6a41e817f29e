// ROS map_server's maps: http://wiki.ros.org/map_server. The meaning of pixels follows its
// image_loader.cpp, with a grid of three values: where `scale` would give a degree of occupancy
// between the thresholds, a cell is unknown.
#include <cmath>
#include <vector>

#include "engine/io/document.hpp"
#include "engine/io/file.hpp"
#include "engine/io/image.hpp"
#include "engine/io/readers.hpp"

namespace landfall {
namespace io {
namespace {

enum class MapMode { trinary, scale, raw };

struct MapFields {
  std::string image;
  double resolution_m = 0.0;
  Pose2 T_map_grid;
  bool negate = false;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  MapMode mode = MapMode::trinary;
};

MapMode read_mode(const Field& field) {
  const std::string name = field.text();
  if (name == "trinary") return MapMode::trinary;
  if (name == "scale") return MapMode::scale;
  if (name == "raw") return MapMode::raw;
  field.fail("trinary, scale or raw");
}

double read_share(const Field& map, std::string_view key, double fallback) {
  const std::optional<Field> field = map.find(key);
  if (!field) return fallback;
  const double share = field->number();
  if (share < 0.0 || share > 1.0) field->fail("a number from 0 to 1");
  return share;
}

MapFields read_fields(const Field& map) {
  MapFields fields;
  const Field image = map.at("image");
  fields.image = image.text();
  if (fields.image.empty()) image.fail("a file name");
  fields.resolution_m = map.at("resolution").positive();
  fields.T_map_grid = map.at("origin").pose();
  if (const auto negate = map.find("negate")) fields.negate = negate->flag();
  fields.occupied_thresh = read_share(map, "occupied_thresh", fields.occupied_thresh);
  fields.free_thresh = read_share(map, "free_thresh", fields.free_thresh);
  if (fields.free_thresh > fields.occupied_thresh)
    map.at("free_thresh").fail("at most occupied_thresh, " + shown(fields.occupied_thresh));
  if (const auto mode = map.find("mode")) fields.mode = read_mode(*mode);
  return fields;
}

Occupancy occupancy(const MapFields& fields, double mean_255) {
  const double value = fields.negate ? 255.0 - mean_255 : mean_255;
  double share = (255.0 - value) / 255.0;
  if (fields.mode == MapMode::raw) {
    const double percent = std::floor(value);
    if (percent > 100.0) return Occupancy::unknown;
    share = percent / 100.0;
  }
  if (share > fields.occupied_thresh) return Occupancy::occupied;
  if (share < fields.free_thresh) return Occupancy::free;
  return Occupancy::unknown;
}

// What a pixel means depends on the sum of its channels alone: a table of all sums. As in map_server,
// alpha counts as one more channel in trinary mode and not at all in the others.
class PixelTable {
 public:
  PixelTable(const MapFields& fields, const ImageHeader& image)
      : channels_(image.channels),
        averaged_(image.has_alpha && fields.mode != MapMode::trinary ? image.channels - 1 : image.channels) {
    const int max_sum = averaged_ * image.max_value;
    const double to_255 = 255.0 / image.max_value;
    by_sum_.reserve(static_cast<std::size_t>(max_sum) + 1);
    for (int sum = 0; sum <= max_sum; ++sum) by_sum_.push_back(occupancy(fields, to_255 * sum / averaged_));
  }

  void convert_row(const std::uint16_t* samples, Occupancy* cells, int width) const {
    if (channels_ == 1) {
      for (int i = 0; i < width; ++i) cells[i] = by_sum_[samples[i]];
      return;
    }
    for (int i = 0; i < width; ++i, samples += channels_) {
      int sum = 0;
      for (int c = 0; c < averaged_; ++c) sum += samples[c];
      cells[i] = by_sum_[static_cast<std::size_t>(sum)];
    }
  }

 private:
  int channels_;
  int averaged_;
  std::vector<Occupancy> by_sum_;
};

std::vector<Occupancy> read_cells(ImageReader& image, const PixelTable& table) {
  const auto width = static_cast<std::size_t>(image.header().width);
  const auto height = static_cast<std::size_t>(image.header().height);
  std::vector<std::uint16_t> samples(width * static_cast<std::size_t>(image.header().channels));
  std::vector<Occupancy> cells(width * height);
  // The image's first row is the map's last.
  for (std::size_t row = height; row-- > 0;) {
    image.read_row(samples);
    table.convert_row(samples.data(), cells.data() + row * width, image.header().width);
  }
  return cells;
}

std::filesystem::path beside(const std::filesystem::path& yaml, const std::string& image) {
  return yaml.parent_path() / image;
}

}  // namespace

GridMap read_grid_map(std::string_view yaml, const std::string& file, const ReadImage& read_image) {
  const Document document = Document::from_yaml(yaml, file);
  const MapFields fields = read_fields(document.root());
  const std::string bytes = read_image(fields.image);
  const std::string image_file = beside(file, fields.image).string();
  const std::unique_ptr<ImageReader> image = open_image(bytes, image_file);
  GridMap map{.width_cells = image->header().width,
              .height_cells = image->header().height,
              .resolution_m = fields.resolution_m,
              .T_map_grid = fields.T_map_grid,
              .cells = read_cells(*image, PixelTable(fields, image->header()))};
  try {
    validate(map);
  } catch (const Error& error) {
    throw Error(ErrorCode::file_format, file + ": " + error.what());
  }
  return map;
}

}  // namespace io

GridMap load_grid_map(const std::filesystem::path& yaml) {
  const auto read_image = [&](const std::string& image) {
    try {
      return io::read_file(io::beside(yaml, image));
    } catch (const Error& error) {
      throw Error(error.code(), yaml.string() + ": image: " + error.what());
    }
  };
  return io::read_grid_map(io::read_file(yaml), yaml.string(), read_image);
}

}  // namespace landfall
