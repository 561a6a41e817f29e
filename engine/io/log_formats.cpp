// The formats of logs, a row each: how to recognise one, and its reader. A new format is one more file
// and one more row.
#include <algorithm>
#include <array>

#include "engine/io/file.hpp"
#include "engine/io/place.hpp"
#include "engine/io/readers.hpp"
#include "engine/io/text.hpp"

namespace landfall {
namespace io {
namespace {

struct LogFormat {
  const char* name;
  bool (*recognises)(std::string_view line);  // a line of the log that is neither empty nor a comment
  Log (*read)(const LogSource& source, const LoadLogOptions& options);
};

bool is_carmen(std::string_view line) {
  // Messages that CARMEN's loggers may start a log with.
  constexpr std::array<std::string_view, 20> kinds = {
      "PARAM",     "SYNC",        "ODOM",      "FLASER",    "RLASER",      "LASER3", "LASER4",
      "RAWLASER1", "RAWLASER2",   "RAWLASER3", "RAWLASER4", "ROBOTLASER1", "SONAR",  "BUMPER",
      "TRUEPOS",   "ROBOTLASER2", "NMEAGGA",   "NMEARMC",   "GPS",         "COMMENT"};
  return std::find(kinds.begin(), kinds.end(), Words(line).next()) != kinds.end();
}

bool is_scan_line(std::string_view line) {
  return Words(line).next().substr(0, 1) == "{";
}

bool is_corridor8(std::string_view line) {
  Words words(line);
  int numbers = 0;
  for (std::string_view word = words.next(); !word.empty(); word = words.next(), ++numbers)
    if (!parse_number(word)) return false;
  return numbers == 9;
}

bool is_scitos24(std::string_view line) {
  return std::count(line.begin(), line.end(), ',') == 24 && parse_number(line.substr(0, line.find(',')));
}

constexpr std::array<LogFormat, 4> formats = {{
    {"CARMEN text", is_carmen, read_carmen},
    {"scan lines (.jsonl)", is_scan_line, read_scan_lines},
    {"corridor8 sonar ranges", is_corridor8, read_corridor8},
    {"scitos24 sonar csv", is_scitos24, read_scitos24},
}};

std::string_view first_line(std::string_view text) {
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    const std::string_view word = Words(line).next();
    if (!word.empty() && word[0] != '#') return line;
  }
  return {};
}

}  // namespace

Log read_log(const LogSource& source, const LoadLogOptions& options) {
  const std::string_view line = first_line(source.text);
  for (const LogFormat& format : formats)
    if (format.recognises(line)) return format.read(source, options);
  std::string known;
  for (const LogFormat& format : formats) known.append(known.empty() ? "" : ", ").append(format.name);
  fail_format({source.file}, "",
              line.empty() ? "no line but comments" : "a log that starts with " + shown(line),
              "one of " + known);
}

}  // namespace io

Log load_log(const std::filesystem::path& path, const LoadLogOptions& options) {
  const std::string text = io::read_text_file(path);
  return io::read_log({text, path.string()}, options);
}

}  // namespace landfall
