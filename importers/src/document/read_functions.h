#pragma once

// Functions that stand in place of keys, and what happens outside keys.

#include <tweenfall/curves/curve.h>

#include "json/json_text.h"

#include <optional>
#include <type_traits>

namespace tweenfall::document {

// Amplitude and center of `oscillator` times `unit`.
[[nodiscard]] Curve<double> read_oscillator(const JsonValue& oscillator, double unit);
[[nodiscard]] Curve<Vec3> read_vector_oscillator(const JsonValue& oscillator);
[[nodiscard]] Curve<Vec3> read_projectile(const JsonValue& projectile);

// A slope in the value's unit per second; one number is for all parts.
template <class R>
[[nodiscard]] R slope_of(const JsonValue& slope) {
  if constexpr (std::is_same_v<R, double>) {
    return slope.number;
  } else {
    R result = R::Constant(slope.number);
    for (std::size_t i = 0; i < slope.items.size(); ++i) result[static_cast<Eigen::Index>(i)] = slope.items[i].number;
    return result;
  }
}

// What stands at "before" or "after".
struct OutsideParts {
  Outside rule = Outside::hold;
  double plays = 0;
  const JsonValue* slope = nullptr;
};
[[nodiscard]] OutsideParts outside_of(const JsonValue& track, std::string_view side);

template <class T>
[[nodiscard]] Curve<T> with_outside_of(const JsonValue& track, const Curve<T>& curve) {
  const auto rule = [&track](std::string_view side) {
    const OutsideParts parts = outside_of(track, side);
    OutsideRule<T> result{parts.rule, {}, parts.plays};
    if (parts.slope) result.slope = slope_of<Rate<T>>(*parts.slope);
    return result;
  };
  return curve.with_outside(rule("before"), rule("after"));
}

}  // namespace tweenfall::document
