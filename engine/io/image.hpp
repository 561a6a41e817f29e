// Grey and colour images, read row by row: netpbm (P2, P3, P5, P6; 8 and 16 bit) and png.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace landfall::io {

struct ImageHeader {
  int width = 0;
  int height = 0;
  int channels = 1;  // alpha, where there is one, is the last
  bool has_alpha = false;
  int max_value = 255;  // of a sample
};

class ImageReader {
 public:
  virtual ~ImageReader() = default;
  [[nodiscard]] const ImageHeader& header() const { return header_; }
  // The next row from the top: width x channels samples.
  virtual void read_row(std::span<std::uint16_t> samples) = 0;

 protected:
  ImageReader() = default;
  ImageHeader header_;
};

// `bytes` must outlive the reader. Throws Error{file_format} where they are no such image or fewer
// than its size needs, Error{too_large} where it has more pixels than a map may have cells: both
// before memory for pixels is taken.
std::unique_ptr<ImageReader> open_image(std::string_view bytes, const std::string& file);

std::unique_ptr<ImageReader> open_netpbm(std::string_view bytes, const std::string& file);
std::unique_ptr<ImageReader> open_png(std::string_view bytes, const std::string& file);

// The sizes as a header promises them, for both formats.
void check_image_size(std::int64_t width, std::int64_t height, const std::string& file);

}  // namespace landfall::io
