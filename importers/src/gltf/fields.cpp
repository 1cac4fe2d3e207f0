#include "fields.h"

#include <cmath>

namespace tweenfall::gltf {

namespace {

const nlohmann::json no_object = nlohmann::json::object();
const nlohmann::json no_list = nlohmann::json::array();

std::optional<std::size_t> whole_number(const nlohmann::json& value) {
  if (value.is_number_unsigned()) return value.get<std::size_t>();
  if (!value.is_number_float()) return std::nullopt;
  const double number = value.get<double>();
  if (!(number >= 0 && number < 1e15) || std::floor(number) != number) return std::nullopt;
  return static_cast<std::size_t>(number);
}

}  // namespace

Fields::Fields(const nlohmann::json& object, std::string place, ModelProblems& problems)
    : object_(&object), place_(std::move(place)), problems_(&problems) {
  if (object.is_object()) return;
  problems.add(place_, std::string("must be an object, not ") + object.type_name());
  object_ = &no_object;
}

const nlohmann::json* Fields::find(const char* name) const {
  const auto found = object_->find(name);
  return found == object_->end() ? nullptr : &*found;
}

std::optional<std::size_t> Fields::whole(const char* name) const {
  const nlohmann::json* value = find(name);
  if (!value) return std::nullopt;
  const auto number = whole_number(*value);
  if (!number)
    problems_->add(place_of(name), "must be a whole number of at least 0, not " + value->dump().substr(0, 40));
  return number;
}

std::optional<std::size_t> Fields::index_value(const nlohmann::json& value, const std::string& place,
                                               std::size_t count) const {
  const auto number = whole_number(value);
  if (!number) {
    problems_->add(place, "must be an index, not " + value.dump().substr(0, 40));
    return std::nullopt;
  }
  if (*number < count) return number;
  problems_->add(place,
                 "index " + std::to_string(*number) + " points past the end; there are " + std::to_string(count));
  return std::nullopt;
}

std::optional<std::size_t> Fields::index(const char* name, std::size_t count) const {
  const nlohmann::json* value = find(name);
  return value ? index_value(*value, place_of(name), count) : std::nullopt;
}

std::optional<std::size_t> Fields::required_index(const char* name, std::size_t count) const {
  if (!find(name)) problems_->add(place_, std::string("\"") + name + "\" is missing");
  return index(name, count);
}

std::string Fields::text(const char* name, const std::string& otherwise) const {
  const nlohmann::json* value = find(name);
  if (!value) return otherwise;
  if (value->is_string()) return value->get<std::string>();
  problems_->add(place_of(name), std::string("must be a string, not ") + value->type_name());
  return otherwise;
}

bool Fields::flag(const char* name) const {
  const nlohmann::json* value = find(name);
  if (value && !value->is_boolean())
    problems_->add(place_of(name), std::string("must be true or false, not ") + value->type_name());
  return value && value->is_boolean() && value->get<bool>();
}

std::vector<double> Fields::numbers(const char* name, std::size_t count) const {
  std::vector<double> all;
  if (!find(name)) return all;
  const nlohmann::json& values = list(name);
  for (const nlohmann::json& value : values)
    if (value.is_number() && std::isfinite(value.get<double>())) all.push_back(value.get<double>());
  if (all.size() == values.size() && (count == 0 || all.size() == count)) return all;
  const std::string wanted = count ? std::to_string(count) + " finite numbers" : "finite numbers";
  problems_->add(place_of(name), "must be a list of " + wanted);
  return {};
}

std::vector<std::size_t> Fields::indices(const char* name, std::size_t limit) const {
  std::vector<std::size_t> all;
  const nlohmann::json& values = list(name);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (const auto number = index_value(values[i], place_of(name) + "/" + std::to_string(i), limit))
      all.push_back(*number);
  return all;
}

const nlohmann::json& Fields::list(const char* name) const {
  const nlohmann::json* value = find(name);
  if (!value) return no_list;
  if (value->is_array()) return *value;
  problems_->add(place_of(name), std::string("must be a list, not ") + value->type_name());
  return no_list;
}

Fields Fields::inside(const char* name) const {
  const nlohmann::json* value = find(name);
  return {value ? *value : no_object, place_of(name), *problems_};
}

Fields Fields::at(const char* name, std::size_t position) const {
  return {list(name)[position], place_of(name) + "/" + std::to_string(position), *problems_};
}

}  // namespace tweenfall::gltf
