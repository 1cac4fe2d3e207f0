#include "document/fields/table.h"

#include <tweenfall/curves/number_text.h>

#include <cmath>

namespace tweenfall::document::fields {

void take(const json::Value& value, double& out, Building&) {
  if (value.is(json::Value::Kind::number)) out = value.number();
}

void take(const json::Value& value, int& out, Building&) {
  if (value.is(json::Value::Kind::number)) out = static_cast<int>(value.number());
}

void take(const json::Value& value, bool& out, Building&) {
  if (value.is(json::Value::Kind::boolean)) out = value.boolean();
}

void take(const json::Value& value, std::string& out, Building&) {
  if (value.is(json::Value::Kind::text)) out = value.text();
}

void take(const json::Value& value, std::optional<double>& out, Building&) {
  if (value.is(json::Value::Kind::number)) out = value.number();
}

void take(const json::Value& value, std::optional<Color>& out, Building&) {
  if (const std::optional<Color> color = color_of(value)) out = color;
}

void take(const json::Value& value, Vec3& out, Building&) {
  if (const std::optional<Vec3> vector = vector_of(value)) out = *vector;
}

void take(const json::Value& value, Quat& out, Building& building) {
  const EulerOrder order = order_of(text_in(value, "order", "XYZ"));
  if (const std::optional<Quat> rotation = rotation_of(value, order, building.problems)) out = *rotation;
}

std::string text_of_default(double value) {
  return std::isfinite(value) ? number_text(value) : std::string();
}

std::string text_of_default(bool value) {
  return value ? "true" : "false";
}

std::string text_of_default(const Vec3& value) {
  return "[" + number_text(value[0]) + ", " + number_text(value[1]) + ", " + number_text(value[2]) + "]";
}

}  // namespace tweenfall::document::fields
