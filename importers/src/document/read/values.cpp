#include "document/read/values.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

}  // namespace

double radians(double degrees) {
  return degrees * (std::numbers::pi / 180);
}
double degrees(double radians) {
  return radians * (180 / std::numbers::pi);
}

json::Value usable(const json::Value& object, std::string_view name) {
  const json::Value value = object.is(Kind::object) ? object.find(name) : json::Value();
  return value && !value.is(Kind::faulty) ? value : json::Value();
}

json::Value below(json::Value object, std::initializer_list<std::string_view> names) {
  for (const std::string_view name : names) {
    const json::Value next = usable(object, name);
    if (!next) break;
    object = next;
  }
  return object;
}

double number_in(const json::Value& object, std::string_view name, double fallback) {
  const json::Value value = usable(object, name);
  return value && value.is(Kind::number) ? value.number() : fallback;
}

bool flag_in(const json::Value& object, std::string_view name, bool fallback) {
  const json::Value value = usable(object, name);
  return value && value.is(Kind::boolean) ? value.boolean() : fallback;
}

std::string text_in(const json::Value& object, std::string_view name, const std::string& fallback) {
  const json::Value value = usable(object, name);
  return value && value.is(Kind::text) ? std::string(value.text()) : fallback;
}

Vec3 vector_in(const json::Value& object, std::string_view name, const Vec3& fallback) {
  const json::Value value = usable(object, name);
  return value ? vector_of(value).value_or(fallback) : fallback;
}

std::vector<std::string> names_of(const json::Value& value) {
  std::vector<std::string> out;
  if (value.is(Kind::text)) out.emplace_back(value.text());
  for (const json::Value& item : value.items())
    if (item.is(Kind::text)) out.emplace_back(item.text());
  return out;
}

std::optional<Vec3> vector_of(const json::Value& value) {
  if (!value.is(Kind::list) || value.items().size() != 3) return {};
  for (const json::Value& item : value.items())
    if (!item.is(Kind::number)) return {};
  return Vec3(value.items()[0].number(), value.items()[1].number(), value.items()[2].number());
}

std::optional<Vec3> scale_of(const json::Value& value) {
  if (value.is(Kind::number)) return Vec3(value.number(), value.number(), value.number());
  return vector_of(value);
}

namespace {

int digit_of(char c) {
  return c >= 'a' ? c - 'a' + 10 : c >= 'A' ? c - 'A' + 10 : c - '0';
}

}  // namespace

std::optional<Color> color_of(const json::Value& value) {
  if (!value.is(Kind::text) || value.text().size() < 4) return {};
  Vec4 coordinates(0, 0, 0, 1);
  const bool brief = value.text().size() == 4;
  for (std::size_t i = 0; i < (value.text().size() - 1) / (brief ? 1 : 2); ++i) {
    const int high = digit_of(value.text()[brief ? 1 + i : 1 + 2 * i]);
    const int low = brief ? high : digit_of(value.text()[2 + 2 * i]);
    coordinates[static_cast<Eigen::Index>(i)] = (16 * high + low) / 255.0;
  }
  return from_space({coordinates, Vec4::Zero(), Vec4::Zero()}, ColorSpace::srgb).value;
}

std::string color_text(const Color& color) {
  const Vec4 coordinates = to_space(color, ColorSpace::srgb);
  std::string out = "#";
  for (Eigen::Index i = 0; i < 4; ++i) {
    const double part = std::clamp(coordinates[i], 0.0, 1.0);
    const int byte = static_cast<int>(std::floor(part * 255 + 0.5));
    if (i == 3 && byte == 255) break;
    out += "0123456789abcdef"[byte / 16];
    out += "0123456789abcdef"[byte % 16];
  }
  return out;
}

std::optional<Vec3> axis_of(const json::Value& value, Problems& problems) {
  if (value.is(Kind::text)) {
    const bool back = value.text().size() == 2;
    Vec3 axis(0, 0, 0);
    const char letter = value.text().empty() ? 'x' : value.text().back();
    axis[letter == 'y' ? 1 : letter == 'z' ? 2 : 0] = back ? -1 : 1;
    return axis;
  }
  const std::optional<Vec3> given = vector_of(value);
  if (!given) return {};
  const double size = given->cwiseAbs().maxCoeff();
  if (size == 0) {
    problems.add(value, "an axis of length 0 points nowhere");
    return {};
  }
  const Vec3 scaled = *given / size;
  return Vec3(scaled / scaled.norm());
}

EulerOrder order_of(std::string_view word) {
  EulerOrder order;
  if (word.size() != 3) return order;
  order.intrinsic = word[0] < 'a';
  for (std::size_t i = 0; i < 3; ++i) order.axes[i] = (word[i] | 32) - 'x';
  return order;
}

std::optional<Quat> rotation_of(const json::Value& value, const EulerOrder& order, Problems& problems) {
  if (const json::Value euler = usable(value, "euler")) {
    const std::optional<Vec3> angles = vector_of(euler);
    if (!angles) return {};
    return from_euler(Vec3(radians((*angles)[0]), radians((*angles)[1]), radians((*angles)[2])), order);
  }
  if (const json::Value quat = usable(value, "quat")) {
    if (!quat.is(Kind::list) || quat.items().size() != 4) return {};
    Vec4 parts;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!quat.items()[i].is(Kind::number)) return {};
      parts[static_cast<Eigen::Index>(i)] = quat.items()[i].number();
    }
    const double size = parts.cwiseAbs().maxCoeff();
    if (size == 0) {
      problems.add(quat, "a quaternion of length 0 is not a rotation; write [0, 0, 0, 1] for no turn");
      return {};
    }
    const Vec4 scaled = parts / size;
    const Vec4 unit = scaled / scaled.norm();
    // A quaternion that is of unit length already keeps its bits.
    const double length = parts.norm();
    const Vec4& used = std::abs(length - 1) < 1e-15 ? parts : unit;
    return Quat(used[3], used[0], used[1], used[2]);
  }
  const json::Value axis = usable(value, "axis");
  const json::Value angle = usable(value, "angle");
  if (!axis || !angle || !angle.is(Kind::number)) return {};
  const std::optional<Vec3> unit = axis_of(axis, problems);
  if (!unit) return {};
  const elementary::SinCos half = elementary::sin_cos(radians(angle.number()) / 2);
  return Quat(half.cos, half.sin * (*unit)[0], half.sin * (*unit)[1], half.sin * (*unit)[2]);
}

}  // namespace tweenfall::document
