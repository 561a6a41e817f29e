// JSON and YAML documents read field by field, so that every complaint names file, line and field.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/io/place.hpp"
#include "landfall/pose2.hpp"

namespace landfall::io {

class Document;

// A value of a document and its path in it ("beams[3].half_angle_rad"). Valid as long as the document.
class Field {
 public:
  Field(const nlohmann::json& value, const Document& document, std::string path)
      : value_(&value), document_(&document), path_(std::move(path)) {}

  [[nodiscard]] bool is_text() const;
  [[nodiscard]] bool is_object() const;
  [[nodiscard]] std::size_t size() const;

  // A member of an object: required, or where present (null counts as absent).
  [[nodiscard]] Field at(std::string_view key) const;
  [[nodiscard]] std::optional<Field> find(std::string_view key) const;
  // The names of an object's members, in alphabetical order.
  [[nodiscard]] std::vector<std::string> keys() const;
  // The elements of an array.
  [[nodiscard]] std::vector<Field> items() const;
  // Complains of members that have other names than these.
  void expect_only(std::initializer_list<std::string_view> keys) const;

  [[nodiscard]] double number() const;  // finite
  [[nodiscard]] double positive() const;
  [[nodiscard]] int integer(int least, int most) const;
  [[nodiscard]] bool flag() const;  // true, false, 1 or 0
  [[nodiscard]] std::string text() const;
  [[nodiscard]] std::vector<double> numbers(std::size_t count) const;  // an array of `count`
  [[nodiscard]] Point2 point() const;                                  // [x, y]
  [[nodiscard]] Pose2 pose() const;                                    // [x, y, theta]
  // Readings: finite, not negative; null is NaN (invalid).
  [[nodiscard]] std::vector<float> ranges() const;

  // number() of a member, or `fallback` where it is absent.
  [[nodiscard]] double number_or(std::string_view key, double fallback) const;

  [[nodiscard]] Place place() const;
  [[nodiscard]] const std::string& path() const { return path_; }
  [[noreturn]] void fail(std::string_view expected) const;

 private:
  [[nodiscard]] std::string path_of(std::string_view key) const;
  [[nodiscard]] Field element(std::size_t index) const;

  const nlohmann::json* value_;
  const Document* document_;
  std::string path_;
};

class Document {
 public:
  // Throws Error{file_format} with line and column where the text is not JSON, or not YAML.
  // `place.line` is that of the text's first line where it is part of a larger file (scan lines).
  static Document from_json(std::string_view text, const Place& place);
  static Document from_yaml(std::string_view text, const std::string& file);
  Document(Document&&) noexcept;
  Document& operator=(Document&&) noexcept;
  ~Document();

  [[nodiscard]] Field root() const;
  [[nodiscard]] Place place_of(const std::string& path) const;

 private:
  Document(nlohmann::json root, Place place, std::map<std::string, int> lines);

  std::unique_ptr<const nlohmann::json> root_;
  Place place_;
  std::map<std::string, int> lines_;  // of a YAML document's fields
};

}  // namespace landfall::io
