#pragma once

// Functions that stand in place of keys, and what happens outside keys.

#include <tweenfall/curves/keys.h>

#include "json/json_text.h"

#include <optional>

namespace tweenfall::document {

// Amplitude and center of `oscillator` times `unit`.
[[nodiscard]] Curve<double> read_oscillator(const JsonValue& oscillator, double unit);
[[nodiscard]] Curve<Vec3> read_vector_oscillator(const JsonValue& oscillator);
[[nodiscard]] Curve<Vec3> read_projectile(const JsonValue& projectile);

[[nodiscard]] Outside outside_of(const JsonValue& track, std::string_view side);  // "before" or "after"

[[nodiscard]] Ends ends_of(const JsonValue& track);

template <class T>
[[nodiscard]] Curve<T> with_outside_of(const JsonValue& track, const Curve<T>& curve) {
  return curve.with_outside(outside_of(track, "before"), outside_of(track, "after"));
}

}  // namespace tweenfall::document
