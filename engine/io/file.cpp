#include "engine/io/file.hpp"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <fstream>
#include <iterator>
#include <system_error>

#include "landfall/error.hpp"

namespace landfall::io {
namespace {

std::filesystem::path temporary_name(const std::filesystem::path& path) {
  static std::atomic<unsigned> counter{0};
  std::filesystem::path name = path;
  name += ".tmp-" + std::to_string(::getpid()) + "-" + std::to_string(counter++);
  return name;
}

// What a rename onto `path` would replace: the file that a link leads to, not the link.
// Throws where that is a device or a pipe, which a rename would destroy.
std::filesystem::path replaceable(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) return path;
  if (std::filesystem::is_directory(status))
    throw Error(ErrorCode::file_write,
                path.string() + ": cannot be written: found a directory, expected a file");
  if (!std::filesystem::is_regular_file(status))
    throw Error(ErrorCode::file_write,
                path.string() + ": cannot be written: found a device or a pipe, expected a file");
  return std::filesystem::canonical(path, error);
}

std::string lower_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

// A pipe has no size to ask for.
std::string read_stream(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

std::string read_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw Error(ErrorCode::file_not_found, path.string() + ": no such file");
  if (std::filesystem::is_directory(path, error))
    throw Error(ErrorCode::file_not_found, path.string() + ": found a directory, expected a file");
  if (std::filesystem::is_fifo(path, error)) return read_stream(path);
  if (!std::filesystem::is_regular_file(path, error))
    throw Error(ErrorCode::file_not_found, path.string() + ": found a device, expected a file or a pipe");
  std::ifstream stream(path, std::ios::binary | std::ios::ate);
  if (!stream) throw Error(ErrorCode::file_not_found, path.string() + ": cannot be opened for reading");
  const std::streamoff size = stream.tellg();
  std::string contents(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  stream.seekg(0);
  if (!stream.read(contents.data(), static_cast<std::streamsize>(contents.size())))
    throw Error(ErrorCode::file_not_found, path.string() + ": cannot be read");
  return contents;
}

std::string read_text_file(const std::filesystem::path& path) {
  std::string contents = read_file(path);
  return is_gzip(contents) ? gunzip(contents, path.string()) : contents;
}

void write_file(const std::filesystem::path& path, std::string_view contents) {
  const std::filesystem::path target = replaceable(path);
  const std::filesystem::path temporary = temporary_name(target);
  std::ofstream stream(temporary, std::ios::binary);
  stream.write(contents.data(), static_cast<std::streamsize>(contents.size()));
  stream.close();
  std::error_code error;
  if (stream) std::filesystem::rename(temporary, target, error);
  if (stream && !error) return;
  const std::string reason = error ? error.message() : "cannot write beside it";
  std::filesystem::remove(temporary, error);
  throw Error(ErrorCode::file_write, path.string() + ": cannot be written: " + reason);
}

std::string text_extension(const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  return extension == ".gz" ? lower_case(path.stem().extension().string()) : extension;
}

}  // namespace landfall::io
