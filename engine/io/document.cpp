#include "engine/io/document.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/io/text.hpp"

namespace landfall::io {
namespace {

// Guards against aliases that multiply and against text that nests without end.
constexpr int max_yaml_values = 1'000'000;
constexpr int max_yaml_depth = 32;
constexpr std::size_t max_yaml_bytes = std::size_t{64} << 20;

[[noreturn]] void fail_json(std::string_view text, const Place& place,
                            const nlohmann::json::parse_error& error) {
  const std::size_t byte = std::min(error.byte > 0 ? error.byte - 1 : 0, text.size());
  const std::string_view before = text.substr(0, byte);
  const auto lines_before = static_cast<int>(std::count(before.begin(), before.end(), '\n'));
  const std::size_t line_start = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
  const Place at{.file = place.file, .line = std::max(place.line, 1) + lines_before};
  const std::string_view rest = text.substr(byte, text.find('\n', byte) - byte);
  fail_format(at, "column " + std::to_string(byte - line_start + 1),
              byte == text.size() ? "the end of the text" : shown(rest), "valid JSON");
}

// Copies a YAML tree, with the line of each field beside it.
class YamlReader {
 public:
  explicit YamlReader(const std::string& file) : file_(file) {}

  nlohmann::json convert(const YAML::Node& node, const std::string& path, int depth = 0) {
    const Place place{.file = file_, .line = node.Mark().line + 1};
    if (++values_ > max_yaml_values)
      fail_format(place, path, "over a million values", "fewer", ErrorCode::too_large);
    if (depth > max_yaml_depth) fail_format(place, path, "values nested deeper than 32", "fewer levels");
    lines_[path] = place.line;
    if (node.IsScalar()) return scalar(node);
    if (node.IsSequence()) return sequence(node, path, depth);
    if (node.IsMap()) return map(node, path, depth);
    return nullptr;
  }

  std::map<std::string, int> take_lines() { return std::move(lines_); }

 private:
  static nlohmann::json scalar(const YAML::Node& node) {
    const std::string& text = node.Scalar();
    const bool quoted = node.Tag() == "!";
    if (quoted) return text;
    if (const std::optional<double> number = parse_number(text)) return *number;
    if (text == "true" || text == "false") return text == "true";
    if (text.empty() || text == "~" || text == "null") return nullptr;
    return text;
  }

  nlohmann::json sequence(const YAML::Node& node, const std::string& path, int depth) {
    nlohmann::json list = nlohmann::json::array();
    std::size_t index = 0;
    for (const auto& element : node)
      list.push_back(convert(element, path + "[" + std::to_string(index++) + "]", depth + 1));
    return list;
  }

  nlohmann::json map(const YAML::Node& node, const std::string& path, int depth) {
    nlohmann::json object = nlohmann::json::object();
    for (const auto& member : node) {
      if (!member.first.IsScalar())
        fail_format({file_, member.first.Mark().line + 1}, path, "a field without a name", "a name");
      const std::string& key = member.first.Scalar();
      const std::string member_path = path.empty() ? key : path + "." + key;
      if (object.contains(key))
        fail_format({file_, member.first.Mark().line + 1}, member_path, "it a second time", "it once");
      object[key] = convert(member.second, member_path, depth + 1);
    }
    return object;
  }

  const std::string& file_;
  int values_ = 0;
  std::map<std::string, int> lines_;
};

}  // namespace

Document::Document(nlohmann::json root, Place place, std::map<std::string, int> lines)
    : root_(std::make_unique<const nlohmann::json>(std::move(root))),
      place_(std::move(place)),
      lines_(std::move(lines)) {}
Document::Document(Document&&) noexcept = default;
Document& Document::operator=(Document&&) noexcept = default;
Document::~Document() = default;

Document Document::from_json(std::string_view text, const Place& place) {
  try {
    return {nlohmann::json::parse(text), place, {}};
  } catch (const nlohmann::json::parse_error& error) {
    fail_json(text, place, error);
  } catch (const nlohmann::json::exception& error) {
    fail_format(place, "", std::string("a number out of range (") + error.what() + ")", "valid JSON");
  }
}

Document Document::from_yaml(std::string_view text, const std::string& file) {
  if (text.size() > max_yaml_bytes)
    fail_format({file}, "", "over 64 MiB of yaml", "a smaller file", ErrorCode::too_large);
  try {
    YamlReader reader(file);
    nlohmann::json root = reader.convert(YAML::Load(std::string(text)), "");
    return {std::move(root), {file}, reader.take_lines()};
  } catch (const YAML::Exception& error) {
    fail_format({file, error.mark.is_null() ? 0 : error.mark.line + 1}, "", error.msg, "valid YAML");
  }
}

Field Document::root() const {
  return {*root_, *this, ""};
}

Place Document::place_of(const std::string& path) const {
  const auto line = lines_.find(path);
  return line == lines_.end() ? place_ : Place{.file = place_.file, .line = line->second};
}

}  // namespace landfall::io
