// Netpbm's portable grey and pixel maps: https://netpbm.sourceforge.net/doc/pgm.html and ppm.html.
#include <limits>

#include "engine/io/image.hpp"
#include "engine/io/place.hpp"
#include "engine/io/text.hpp"

namespace landfall::io {
namespace {

bool is_space(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

class NetpbmReader : public ImageReader {
 public:
  NetpbmReader(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {
    read_magic();
    const long long width = read_header_number("width");
    const long long height = read_header_number("height");
    const long long max_value = read_header_number("maximum value");
    check_image_size(width, height, file);
    if (max_value < 1 || max_value > std::numeric_limits<std::uint16_t>::max())
      fail_format({file_}, "maximum value", std::to_string(max_value), "1 to 65535");
    header_.width = static_cast<int>(width);
    header_.height = static_cast<int>(height);
    header_.max_value = static_cast<int>(max_value);
    if (!plain_ && !rest_.empty()) rest_.remove_prefix(1);  // the one blank after the header
    check_amount();
  }

  void read_row(std::span<std::uint16_t> samples) override {
    if (plain_) {
      for (std::uint16_t& sample : samples) sample = read_plain_sample();
    } else {
      copy_raw_row(samples);
    }
    for (const std::uint16_t sample : samples)
      if (sample > header_.max_value)
        fail_format({file_}, "pixel", std::to_string(sample), "at most " + std::to_string(header_.max_value));
  }

 private:
  void read_magic() {
    const std::string_view magic = rest_.substr(0, 2);
    if (magic != "P2" && magic != "P3" && magic != "P5" && magic != "P6")
      fail_format({file_}, "first bytes", shown(magic), "P2, P3, P5 or P6");
    plain_ = magic == "P2" || magic == "P3";
    header_.channels = magic == "P3" || magic == "P6" ? 3 : 1;
    rest_.remove_prefix(2);
  }

  void skip_spaces_and_comments() {
    while (!rest_.empty() && (is_space(rest_[0]) || rest_[0] == '#')) {
      const std::size_t comment_end = rest_[0] == '#' ? rest_.find('\n') : 0;
      rest_.remove_prefix(comment_end == std::string_view::npos ? rest_.size() : comment_end + 1);
    }
  }

  std::string_view read_digits() {
    std::size_t count = 0;
    while (count < rest_.size() && is_digit(rest_[count])) ++count;
    const std::string_view digits = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return digits;
  }

  long long read_header_number(const char* field) {
    skip_spaces_and_comments();
    const std::string_view digits = read_digits();
    if (digits.empty())
      fail_format({file_}, field, rest_.empty() ? "the end of the file" : shown(rest_.substr(0, 1)),
                  "a number");
    if (digits.size() > 18)
      fail_format({file_}, field, shown(digits), "at most 18 digits", ErrorCode::too_large);
    return *parse_integer(digits);
  }

  // So that a short file with a large header is refused before its map is allocated: a plain sample
  // takes a digit and, but for the last, a blank.
  void check_amount() const {
    const std::uint64_t samples = static_cast<std::uint64_t>(header_.width) *
                                  static_cast<std::uint64_t>(header_.height) *
                                  static_cast<std::uint64_t>(header_.channels);
    const std::uint64_t needed = plain_ ? 2 * samples - 1 : samples * bytes_per_sample();
    if (rest_.size() < needed)
      fail_format({file_}, "pixels", std::to_string(rest_.size()) + " bytes",
                  (plain_ ? "at least " : "") + std::to_string(needed) + " for " +
                      std::to_string(header_.width) + " x " + std::to_string(header_.height) +
                      " pixels (is the file truncated?)");
  }

  [[nodiscard]] unsigned bytes_per_sample() const { return header_.max_value > 255 ? 2 : 1; }

  void copy_raw_row(std::span<std::uint16_t> samples) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(rest_.data());
    if (bytes_per_sample() == 1) {
      for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = bytes[i];
    } else {
      for (std::size_t i = 0; i < samples.size(); ++i)
        samples[i] = static_cast<std::uint16_t>(bytes[2 * i] << 8 | bytes[2 * i + 1]);
    }
    rest_.remove_prefix(samples.size() * bytes_per_sample());
  }

  std::uint16_t read_plain_sample() {
    while (!rest_.empty() && is_space(rest_[0])) rest_.remove_prefix(1);
    const std::string_view digits = read_digits();
    if (digits.empty())
      fail_format({file_}, "pixel", rest_.empty() ? "the end of the file" : shown(rest_.substr(0, 1)),
                  "a number");
    const std::optional<long long> value = parse_integer(digits);
    if (!value || *value > header_.max_value)
      fail_format({file_}, "pixel", shown(digits), "at most " + std::to_string(header_.max_value));
    return static_cast<std::uint16_t>(*value);
  }

  std::string_view rest_;
  const std::string& file_;
  bool plain_ = false;
};

}  // namespace

std::unique_ptr<ImageReader> open_netpbm(std::string_view bytes, const std::string& file) {
  return std::make_unique<NetpbmReader>(bytes, file);
}

}  // namespace landfall::io
