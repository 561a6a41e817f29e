// PNG through libpng. Its errors leave by longjmp, so every call runs inside `guarded`, between frames
// that have nothing to destroy, and becomes an Error outside.
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <new>
#include <vector>

#include "engine/io/image.hpp"
#include "engine/io/place.hpp"

namespace landfall::io {
namespace {

// A byte of deflated data makes at most 1032 bytes.
constexpr std::uint64_t max_deflate_ratio = 1032;

class PngReader : public ImageReader {
 public:
  PngReader(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &PngReader::on_error, &PngReader::on_warning);
    if (png_ == nullptr) throw std::bad_alloc();
    info_ = png_create_info_struct(png_);
    try {
      if (info_ == nullptr) throw std::bad_alloc();
      read_header();
    } catch (...) {
      png_destroy_read_struct(&png_, &info_, nullptr);
      throw;
    }
  }
  ~PngReader() override { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  void read_row(std::span<std::uint16_t> samples) override {
    if (!interlaced_.empty()) {
      std::copy_n(interlaced_.begin() + static_cast<std::ptrdiff_t>(next_row_ * row_bytes_), row_bytes_,
                  row_.begin());
      ++next_row_;
    } else {
      guarded([this] { png_read_row(png_, row_.data(), nullptr); });
    }
    if (header_.max_value == 255) {
      std::copy_n(row_.begin(), samples.size(), samples.begin());
    } else {
      for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<std::uint16_t>(row_[2 * i] << 8 | row_[2 * i + 1]);
    }
  }

 private:
  template <typename Call>
  void guarded(Call call) {
    if (setjmp(png_jmpbuf(png_)) != 0)
      fail_format({file_}, "png", message_.data(), "a whole, valid png image");
    call();
  }

  void read_header() {
    guarded([this] {
      png_set_user_limits(png_, PNG_UINT_31_MAX, PNG_UINT_31_MAX);  // ours come right after
      png_set_read_fn(png_, this, &PngReader::on_read);
      png_read_info(png_, info_);
    });
    const png_uint_32 width = png_get_image_width(png_, info_);
    const png_uint_32 height = png_get_image_height(png_, info_);
    check_image_size(width, height, file_);
    check_amount(width, height);
    // Grey with alpha as colour with alpha, so that means weigh alpha as map_server does.
    guarded([this] {
      png_set_expand(png_);
      const bool alpha = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0 ||
                         png_get_valid(png_, info_, PNG_INFO_tRNS) != 0;
      if (alpha) png_set_gray_to_rgb(png_);
      passes_ = png_set_interlace_handling(png_);
      png_read_update_info(png_, info_);
    });
    header_ = {.width = static_cast<int>(width),
               .height = static_cast<int>(height),
               .channels = png_get_channels(png_, info_),
               .has_alpha = (png_get_color_type(png_, info_) & PNG_COLOR_MASK_ALPHA) != 0,
               .max_value = png_get_bit_depth(png_, info_) == 16 ? 65535 : 255};
    row_bytes_ = png_get_rowbytes(png_, info_);
    row_.resize(row_bytes_);
    if (passes_ > 1) read_interlaced();
  }

  void check_amount(std::uint64_t width, std::uint64_t height) const {
    const std::uint64_t bits_per_pixel =
        std::uint64_t{png_get_bit_depth(png_, info_)} * png_get_channels(png_, info_);
    if (width * height * bits_per_pixel / 8 > (rest_.size() + 1) * max_deflate_ratio)
      fail_format({file_}, "pixels", std::to_string(rest_.size()) + " bytes of data",
                  "enough for " + std::to_string(width) + " x " + std::to_string(height) +
                      " pixels (is the file truncated?)");
  }

  void read_interlaced() {
    interlaced_.resize(row_bytes_ * static_cast<std::size_t>(header_.height));
    for (int pass = 0; pass < passes_; ++pass)
      for (int row = 0; row < header_.height; ++row)
        guarded([this, row] {
          png_read_row(png_, interlaced_.data() + static_cast<std::size_t>(row) * row_bytes_, nullptr);
        });
  }

  static void on_read(png_structp png, png_bytep out, std::size_t count) {
    auto* self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (self->rest_.size() < count) png_error(png, "the end of the file inside the data");
    std::memcpy(out, self->rest_.data(), count);
    self->rest_.remove_prefix(count);
  }

  static void on_error(png_structp png, png_const_charp message) {
    auto* self = static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(self->message_.data(), message, self->message_.size() - 1);
    png_longjmp(png, 1);
  }

  static void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}

  std::string_view rest_;
  const std::string& file_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::array<char, 128> message_{};
  int passes_ = 1;
  std::size_t row_bytes_ = 0;
  std::vector<unsigned char> row_;
  std::vector<unsigned char> interlaced_;  // all rows, where the file is interlaced
  std::size_t next_row_ = 0;
};

}  // namespace

std::unique_ptr<ImageReader> open_png(std::string_view bytes, const std::string& file) {
  return std::make_unique<PngReader>(bytes, file);
}

}  // namespace landfall::io
