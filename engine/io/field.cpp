#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "engine/io/document.hpp"

namespace landfall::io {
namespace {

std::string shown_json(const nlohmann::json& value) {
  if (value.is_array()) return "a list of " + std::to_string(value.size());
  if (value.is_object()) return "an object";
  if (value.is_string()) return shown(value.get_ref<const std::string&>());
  if (value.is_number_float()) return shown(value.get<double>());
  return value.dump();
}

bool is_finite_number(const nlohmann::json& value) {
  return value.is_number() && std::isfinite(value.get<double>());
}

}  // namespace

bool Field::is_text() const {
  return value_->is_string();
}
bool Field::is_object() const {
  return value_->is_object();
}
std::size_t Field::size() const {
  return value_->size();
}
Place Field::place() const {
  return document_->place_of(path_);
}

void Field::fail(std::string_view expected) const {
  fail_format(place(), path_, shown_json(*value_), expected);
}

std::string Field::path_of(std::string_view key) const {
  return path_.empty() ? std::string(key) : path_ + "." + std::string(key);
}

Field Field::element(std::size_t index) const {
  return {(*value_)[index], *document_, path_ + "[" + std::to_string(index) + "]"};
}

std::optional<Field> Field::find(std::string_view key) const {
  if (!value_->is_object()) fail("an object");
  const auto member = value_->find(std::string(key));
  if (member == value_->end() || member->is_null()) return std::nullopt;
  return Field(*member, *document_, path_of(key));
}

Field Field::at(std::string_view key) const {
  std::optional<Field> member = find(key);
  if (!member) fail_format(place(), path_of(key), "nothing", "this field");
  return *std::move(member);
}

std::vector<Field> Field::items() const {
  if (!value_->is_array()) fail("a list");
  std::vector<Field> elements;
  elements.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) elements.push_back(element(i));
  return elements;
}

void Field::expect_only(std::initializer_list<std::string_view> keys) const {
  if (!value_->is_object()) fail("an object");
  for (const auto& [key, member] : value_->items()) {
    if (std::find(keys.begin(), keys.end(), key) != keys.end()) continue;
    std::string known;
    for (const std::string_view name : keys) known.append(known.empty() ? "" : ", ").append(name);
    fail_format(document_->place_of(path_of(key)), path_, "a field " + shown(key), "none but " + known);
  }
}

std::vector<std::string> Field::keys() const {
  if (!value_->is_object()) fail("an object");
  std::vector<std::string> names;
  for (const auto& [key, member] : value_->items()) names.push_back(key);
  return names;
}

double Field::number() const {
  if (!is_finite_number(*value_)) fail("a finite number");
  return value_->get<double>();
}

double Field::positive() const {
  const double value = number();
  if (!(value > 0.0)) fail("a positive number");
  return value;
}

int Field::integer(int least, int most) const {
  const double value = number();
  if (value != std::floor(value) || value < least || value > most)
    fail("a whole number from " + std::to_string(least) + " to " + std::to_string(most));
  return static_cast<int>(value);
}

bool Field::flag() const {
  if (value_->is_boolean()) return value_->get<bool>();
  if (!value_->is_number() || (*value_ != 0 && *value_ != 1)) fail("0 or 1");
  return *value_ == 1;
}

std::string Field::text() const {
  if (!value_->is_string()) fail("a text");
  return value_->get<std::string>();
}

std::vector<double> Field::numbers(std::size_t count) const {
  if (!value_->is_array() || value_->size() != count) fail("a list of " + std::to_string(count) + " numbers");
  std::vector<double> values;
  values.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_finite_number((*value_)[i])) element(i).fail("a finite number");
    values.push_back((*value_)[i].get<double>());
  }
  return values;
}

Point2 Field::point() const {
  const std::vector<double> xy = numbers(2);
  return {.x_m = xy[0], .y_m = xy[1]};
}

Pose2 Field::pose() const {
  const std::vector<double> xyt = numbers(3);
  return {.x_m = xyt[0], .y_m = xyt[1], .theta_rad = xyt[2]};
}

std::vector<float> Field::ranges() const {
  if (!value_->is_array()) fail("a list of ranges");
  std::vector<float> ranges_m;
  ranges_m.reserve(value_->size());
  for (std::size_t i = 0; i < value_->size(); ++i) {
    const nlohmann::json& range = (*value_)[i];
    if (!range.is_null() && (!is_finite_number(range) || range.get<double>() < 0.0))
      element(i).fail("a number >= 0, or null");
    ranges_m.push_back(range.is_null() ? std::numeric_limits<float>::quiet_NaN()
                                       : static_cast<float>(range.get<double>()));
  }
  return ranges_m;
}

double Field::number_or(std::string_view key, double fallback) const {
  const std::optional<Field> member = find(key);
  return member ? member->number() : fallback;
}

}  // namespace landfall::io
