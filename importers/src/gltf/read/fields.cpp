#include "gltf/read/fields.h"

#include <cmath>

namespace tweenfall::gltf {

namespace {

using Kind = json::Value::Kind;

const json::Value& no_object() {
  static const json::Tree tree = [] {
    std::vector<json::Fault> faults;
    return json::Tree::parse("{}", faults);
  }();
  static const json::Value root = tree.root();
  return root;
}

/// Bounds the cost: fields are searched one by one, repeatedly for each element of a list beside them.
constexpr std::size_t most_members = 1000;

const char* kind_of(const json::Value& value) {
  switch (value.kind()) {
    case Kind::boolean:
      return "a boolean";
    case Kind::number:
      return "a number";
    case Kind::text:
      return "a string";
    case Kind::list:
      return "a list";
    case Kind::object:
      return "an object";
    default:
      return "null";
  }
}

std::string shown(const json::Value& value) {
  return value.is(Kind::list) || value.is(Kind::object) ? kind_of(value) : json::on_one_line(value).substr(0, 40);
}

std::optional<std::size_t> whole_number(const json::Value& value) {
  constexpr double exact_below = 9007199254740992;  // 2^53
  const double number = value.number();
  if (!value.is(Kind::number) || !(number >= 0 && number < exact_below) || std::floor(number) != number)
    return std::nullopt;
  return static_cast<std::size_t>(number);
}

}  // namespace

Fields::Fields(const json::Value& object, std::string place, models::ModelProblems& problems)
    : object_(object), place_(std::move(place)), problems_(&problems) {
  if (object.is(Kind::object) && object.members().size() <= most_members) return;
  problems.add(place_, object.is(Kind::object)
                           ? "has " + std::to_string(object.members().size()) + " members; at most " +
                                 std::to_string(most_members) + " can be read"
                           : std::string("must be an object, not ") + kind_of(object));
  object_ = no_object();
}

std::optional<std::size_t> Fields::whole(const char* name) const {
  const json::Value value = find(name);
  if (!value) return std::nullopt;
  const auto number = whole_number(value);
  if (!number)
    problems_->add(place_of(name), "must be a whole number of at least 0" +
                                       std::string(value.number() > 1e15 ? " and below 2^53" : "") + ", not " +
                                       shown(value));
  return number;
}

std::optional<std::size_t> Fields::index_value(const json::Value& value, const std::string& place,
                                               std::size_t count) const {
  const auto number = whole_number(value);
  if (!number) {
    problems_->add(place, "must be an index, not " + shown(value));
    return std::nullopt;
  }
  if (*number < count) return number;
  problems_->add(place,
                 "index " + std::to_string(*number) + " points past the end; there are " + std::to_string(count));
  return std::nullopt;
}

std::optional<std::size_t> Fields::index(const char* name, std::size_t count) const {
  const json::Value value = find(name);
  return value ? index_value(value, place_of(name), count) : std::nullopt;
}

std::optional<std::size_t> Fields::required_index(const char* name, std::size_t count) const {
  if (!find(name)) problems_->add(place_, std::string("\"") + name + "\" is missing");
  return index(name, count);
}

std::string Fields::text(const char* name, const std::string& otherwise) const {
  const json::Value value = find(name);
  if (!value) return otherwise;
  if (value.is(Kind::text)) return std::string(value.text());
  problems_->add(place_of(name), std::string("must be a string, not ") + kind_of(value));
  return otherwise;
}

bool Fields::flag(const char* name) const {
  const json::Value value = find(name);
  if (value && !value.is(Kind::boolean))
    problems_->add(place_of(name), std::string("must be true or false, not ") + kind_of(value));
  return value && value.boolean();
}

std::vector<double> Fields::numbers(const char* name, std::size_t count) const {
  std::vector<double> all;
  if (!has(name)) return all;
  const json::Items values = list(name);
  for (const json::Value& value : values)
    if (value.is(Kind::number)) all.push_back(value.number());
  if (all.size() == values.size() && (count == 0 || all.size() == count)) return all;
  const std::string wanted = count ? std::to_string(count) + " finite numbers" : "finite numbers";
  problems_->add(place_of(name), "must be a list of " + wanted);
  return {};
}

std::vector<std::size_t> Fields::indices(const char* name, std::size_t limit) const {
  std::vector<std::size_t> all;
  const json::Items values = list(name);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (const auto number = index_value(values[i], place_of(name) + "/" + std::to_string(i), limit))
      all.push_back(*number);
  return all;
}

json::Items Fields::list(const char* name) const {
  const json::Value value = find(name);
  if (!value) return json::Items();
  if (value.is(Kind::list)) return value.items();
  problems_->add(place_of(name), std::string("must be a list, not ") + kind_of(value));
  return json::Items();
}

Fields Fields::inside(const char* name) const {
  const json::Value value = find(name);
  return {value ? value : no_object(), place_of(name), *problems_};
}

Fields Fields::at(const char* name, std::size_t position) const {
  return {list(name)[position], place_of(name) + "/" + std::to_string(position), *problems_};
}

}  // namespace tweenfall::gltf
