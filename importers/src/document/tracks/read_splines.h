#pragma once

// Splines in place of keys.

#include <tweenfall/curves/curve.h>

#include "document/report/problems.h"

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::document {

// The curve of a track's "spline", "bezier" or "b_spline", of double, Vec2, Vec3 or Vec4, its values times `unit`.
// Empty where it has none and where it is faulty, which is reported. The rules outside are not applied.
template <class T>
[[nodiscard]] std::optional<Curve<T>> read_spline(const json::Value& track, double unit, Problems& problems);

// The same for rotations, without "b_spline".
[[nodiscard]] std::optional<Curve<Quat>> read_rotation_spline(const json::Value& track, Problems& problems);

// Parts that both share

// Whether something in `value` is faulty, which has been reported then.
[[nodiscard]] bool has_faults(const json::Value& value);
// Whether a list, if present, has the required length; `why` explains the count.
[[nodiscard]] bool has_count(const json::Value& settings, std::string_view name, std::size_t count,
                             const std::string& why, Problems& problems);
// Whether the "times", if present, increase.
[[nodiscard]] bool has_rising_times(const json::Value& settings, Problems& problems);
// How many Bezier curves of a degree with shared ends the "points" define; 0 where their number does not fit.
[[nodiscard]] std::size_t bezier_curves_in(const json::Value& settings, std::size_t degree, Problems& problems);
// The "times", else the proposed ones stretched to the duration.
[[nodiscard]] std::vector<double> times_in(const json::Value& settings, std::vector<double> proposed);
// 0, 1, ..., spans
[[nodiscard]] std::vector<double> even_times(std::size_t spans);

}  // namespace tweenfall::document
