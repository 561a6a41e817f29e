#include <zlib.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <new>

#include "engine/io/file.hpp"
#include "engine/io/place.hpp"

namespace landfall::io {
namespace {

constexpr int gzip_window_bits = 15 + 16;  // 16: zlib's gzip framing
constexpr std::size_t chunk_bytes = std::size_t{1} << 20;
constexpr std::size_t max_text_bytes = std::size_t{1} << 32;

struct EndInflate {
  void operator()(z_stream* stream) const { inflateEnd(stream); }
};
struct EndDeflate {
  void operator()(z_stream* stream) const { deflateEnd(stream); }
};

uInt next_piece(std::size_t bytes) {
  return static_cast<uInt>(std::min(bytes, chunk_bytes));
}

// zlib's interface takes non-const input that it does not change.
Bytef* input_of(std::string_view bytes) {
  return reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
}

// Runs `step` (inflate or deflate) over as much of `input` as it takes; true when it reports the end.
// `offset` counts the input bytes consumed.
template <typename Step>
int run(z_stream& stream, std::string_view input, std::size_t& offset, std::string& output, Step step) {
  output.resize(output.size() + chunk_bytes);
  stream.next_out = reinterpret_cast<Bytef*>(output.data() + output.size() - chunk_bytes);
  stream.avail_out = static_cast<uInt>(chunk_bytes);
  const uInt piece = next_piece(input.size() - offset);
  stream.next_in = input_of(input.substr(offset));
  stream.avail_in = piece;
  const int status = step(stream, offset + piece == input.size());
  offset += piece - stream.avail_in;
  output.resize(output.size() - stream.avail_out);
  return status;
}

}  // namespace

bool is_gzip(std::string_view bytes) {
  return bytes.substr(0, 2) == "\x1f\x8b";
}

std::string gunzip(std::string_view bytes, const std::string& file) {
  z_stream stream{};
  if (inflateInit2(&stream, gzip_window_bits) != Z_OK) throw std::bad_alloc();
  const std::unique_ptr<z_stream, EndInflate> end(&stream);
  const auto step = [](z_stream& s, bool) { return inflate(&s, Z_NO_FLUSH); };
  std::string text;
  for (std::size_t offset = 0;;) {
    const int status = run(stream, bytes, offset, text, step);
    const std::string where = "byte " + std::to_string(offset) + " of " + std::to_string(bytes.size());
    if (text.size() > max_text_bytes)
      fail_format({file}, "gzip", "over 4 GiB of text", "at most 4 GiB", ErrorCode::too_large);
    // A gzip file may be several members in a row.
    if (status == Z_STREAM_END) {
      if (!is_gzip(bytes.substr(offset))) return text;
      inflateReset(&stream);
    } else if (status == Z_BUF_ERROR || (status == Z_OK && offset == bytes.size() && stream.avail_out > 0)) {
      fail_format({file}, "gzip", "the end of the file inside the data, after " + where,
                  "a whole gzip file (is it truncated?)");
    } else if (status != Z_OK) {
      fail_format({file}, "gzip", "damaged data at " + where, "valid gzip data");
    }
  }
}

std::string gzip(std::string_view text) {
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, gzip_window_bits, MAX_MEM_LEVEL,
                   Z_DEFAULT_STRATEGY) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, EndDeflate> end(&stream);
  const auto step = [](z_stream& s, bool last) { return deflate(&s, last ? Z_FINISH : Z_NO_FLUSH); };
  std::string bytes;
  std::size_t offset = 0;
  while (run(stream, text, offset, bytes, step) != Z_STREAM_END) {
  }
  return bytes;
}

}  // namespace landfall::io
