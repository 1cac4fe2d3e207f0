#pragma once

// Values from a tree that was checked against its form. Where a value is missing or faulty (which was reported), the
// fallback is used, so that everything else can still be checked.

#include <tweenfall/curves/color.h>
#include <tweenfall/curves/rotation.h>

#include "document/report/problems.h"

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

namespace tweenfall::document {

[[nodiscard]] double radians(double degrees);
[[nodiscard]] double degrees(double radians);

// A member that can be used; null when absent or faulty.
[[nodiscard]] json::Value usable(const json::Value& object, std::string_view name);

// The value below `object` along the names, or the last existing one.
[[nodiscard]] json::Value below(json::Value object, std::initializer_list<std::string_view> names);

[[nodiscard]] double number_in(const json::Value& object, std::string_view name, double fallback);
[[nodiscard]] bool flag_in(const json::Value& object, std::string_view name, bool fallback);
[[nodiscard]] std::string text_in(const json::Value& object, std::string_view name, const std::string& fallback = {});
[[nodiscard]] Vec3 vector_in(const json::Value& object, std::string_view name, const Vec3& fallback);

// From a name, or from a list of names.
[[nodiscard]] std::vector<std::string> names_of(const json::Value& value);
[[nodiscard]] std::optional<Vec3> vector_of(const json::Value& value);
[[nodiscard]] std::optional<Vec3> scale_of(const json::Value& value);  // a single number is for all three axes
[[nodiscard]] std::optional<Color> color_of(const json::Value& value);
[[nodiscard]] std::string color_text(const Color& color);

// Unit axis; a zero one is a problem.
[[nodiscard]] std::optional<Vec3> axis_of(const json::Value& value, Problems& problems);
[[nodiscard]] EulerOrder order_of(std::string_view word);
// Any spelling; a zero quaternion or axis is a problem.
[[nodiscard]] std::optional<Quat> rotation_of(const json::Value& value, const EulerOrder& order, Problems& problems);

}  // namespace tweenfall::document
