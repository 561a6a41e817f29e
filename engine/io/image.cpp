#include "engine/io/image.hpp"

#include "engine/io/place.hpp"
#include "landfall/grid_map.hpp"

namespace landfall::io {

std::unique_ptr<ImageReader> open_image(std::string_view bytes, const std::string& file) {
  if (bytes.substr(0, 4) == "\x89PNG") return open_png(bytes, file);
  if (bytes.substr(0, 1) == "P") return open_netpbm(bytes, file);
  fail_format({file}, "first bytes", shown(bytes.substr(0, 4)), "a pgm (P2, P5), ppm (P3, P6) or png image");
}

void check_image_size(std::int64_t width, std::int64_t height, const std::string& file) {
  const std::string size = std::to_string(width) + " x " + std::to_string(height) + " pixels";
  if (width < 1 || height < 1) fail_format({file}, "size", size, "at least 1 x 1");
  if (width > max_map_cells / height)
    fail_format({file}, "size", size, "at most " + std::to_string(max_map_cells) + " pixels",
                ErrorCode::too_large);
  if (width > max_map_side_cells || height > max_map_side_cells)
    fail_format({file}, "size", size, "at most " + std::to_string(max_map_side_cells) + " pixels a side",
                ErrorCode::too_large);
}

}  // namespace landfall::io
