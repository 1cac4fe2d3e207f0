#pragma once

// Functions in place of keys, and the rules outside keys.

#include <tweenfall/anim/track.h>
#include <tweenfall/curves/keys.h>

#include "document/report/problems.h"

#include <optional>
#include <type_traits>

namespace tweenfall::document {

// Whether a track has a function instead of keys.
[[nodiscard]] bool has_function(const json::Value& track);

// The curve of such a track: a number or a vector. Empty where it is faulty, which is reported.
[[nodiscard]] std::optional<TrackCurve> read_function(const json::Value& track, Problems& problems);

// The same for an angle about an axis, in radians.
[[nodiscard]] std::optional<Curve<double>> read_angle_function(const json::Value& track, Problems& problems);

// A slope in the value's unit per second; a single number is for all parts.
template <class R>
[[nodiscard]] R slope_of(const json::Value& slope) {
  if constexpr (std::is_same_v<R, double>) {
    return slope.number();
  } else {
    R result = R::Constant(slope.number());
    for (std::size_t i = 0; i < slope.items().size(); ++i)
      result[static_cast<Eigen::Index>(i)] = slope.items()[i].number();
    return result;
  }
}

// The value of "before" or "after".
struct OutsideParts {
  Outside rule = Outside::hold;
  double plays = 0;
  json::Value slope{};
};
[[nodiscard]] OutsideParts outside_of(const json::Value& track, std::string_view side);

template <class T>
[[nodiscard]] Curve<T> with_outside_of(const json::Value& track, const Curve<T>& curve) {
  const auto rule = [&track](std::string_view side) {
    const OutsideParts parts = outside_of(track, side);
    OutsideRule<T> result{parts.rule, {}, parts.plays};
    if (parts.slope) result.slope = slope_of<Rate<T>>(parts.slope);
    return result;
  };
  return curve.with_outside(rule("before"), rule("after"));
}

}  // namespace tweenfall::document
