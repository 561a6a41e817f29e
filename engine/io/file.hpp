// Whole files in and out.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace landfall::io {

// A file, or a pipe to its end. Throws Error{file_not_found} where it is missing, a directory or cannot be
// read.
std::string read_file(const std::filesystem::path& path);
// The same, unpacked where it is gzipped (told by its first bytes, not by its name).
std::string read_text_file(const std::filesystem::path& path);
// Writes under a temporary name beside `path` and renames: readers see the old file or the new one. A link
// stays, the file that it leads to is replaced. Throws Error{file_write}, for a device or a pipe too.
void write_file(const std::filesystem::path& path, std::string_view contents);

bool is_gzip(std::string_view bytes);
// Throws Error{file_format} where the data are damaged or truncated, Error{too_large} beyond 4 GiB.
std::string gunzip(std::string_view bytes, const std::string& file);
std::string gzip(std::string_view text);

// The file's ending without a final ".gz", lower case: ".log" for "drive.LOG.gz".
std::string text_extension(const std::filesystem::path& path);

}  // namespace landfall::io
