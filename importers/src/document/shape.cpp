#include "document/shape.h"

#include <utility>

namespace tweenfall::document {

namespace {

bool kind_fits(const Shape& shape, const JsonValue& value) {
  switch (shape.kind) {
    case Shape::Kind::any:
      return true;
    case Shape::Kind::number:
      return value.is(JsonValue::Kind::number);
    case Shape::Kind::boolean:
      return value.is(JsonValue::Kind::boolean);
    case Shape::Kind::text:
      return value.is(JsonValue::Kind::text);
    case Shape::Kind::list:
    case Shape::Kind::tuple:
      return value.is(JsonValue::Kind::list);
    case Shape::Kind::object:
      return value.is(JsonValue::Kind::object);
    case Shape::Kind::choice:
      return resolved(shape, value) != nullptr;
  }
  return false;
}

bool ends_with(std::string_view name, std::string_view ending) {
  return name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending;
}

}  // namespace

const Field* Shape::field(std::string_view name) const {
  for (const Field& each : fields)
    if (each.name == name) return &each;
  return nullptr;
}

const Shape* Shape::member(std::string_view name) const {
  if (const Field* known = field(name)) return known->shape;
  for (const Ending& each : endings)
    if (ends_with(name, each.ending)) return each.shape;
  return others;
}

std::vector<std::string> Shape::field_names() const {
  std::vector<std::string> names;
  for (const Field& each : fields) names.push_back(each.name);
  return names;
}

bool is_free_name(std::string_view name) {
  return name.substr(0, 2) == "//" || name.substr(0, 2) == "x-";
}

const Shape* resolved(const Shape& shape, const JsonValue& value) {
  if (shape.kind != Shape::Kind::choice) return kind_fits(shape, value) ? &shape : nullptr;
  if (shape.select) {
    const Shape* selected = shape.select(value);
    return selected ? resolved(*selected, value) : nullptr;
  }
  for (const Shape* alternative : shape.alternatives)
    if (kind_fits(*alternative, value)) return resolved(*alternative, value);
  return nullptr;
}

const Shape* ShapeStore::add(Shape shape) {
  shapes_.push_back(std::move(shape));
  return &shapes_.back();
}

Shape* ShapeStore::reserve() {
  shapes_.emplace_back();
  return &shapes_.back();
}

}  // namespace tweenfall::document
