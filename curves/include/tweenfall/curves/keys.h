#pragma once

/// Keys: the form in which people write curves.
///
/// A key has a time, a value and a word for how the curve *leaves* it: `hold`, `linear`, a
/// tangent rule (`smooth`, `smooth_clamped`, ...) or an easing shape. A key may instead
/// state its slopes; then the span is a Hermite cubic, or a Bezier with weighted handles.
/// Each key of a curve may use another kind.

#include <tweenfall/curves/color.h>
#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/ease.h>

#include <optional>
#include <span>

namespace tweenfall {

/// How the slope at one side of a key is chosen. The kinds from `plateau` on look at both neighboring keys, per
/// component; at the first and last key, which have one neighbor, they are flat unless the ends wrap.
enum class TangentKind {
  automatic,     ///< as the rule `smooth` would choose
  flat,          ///< zero
  given,         ///< as stated
  vector,        ///< straight toward the next (previous) key
  aligned,       ///< that of the key's other side
  mirrored,      ///< that of the key's other side, with a handle as long in time
  plateau,       ///< the neighbors' chord, but flat at a local extreme and beside an equal value
  auto_clamped,  ///< as automatic, but flat at a local extreme, and no handle leaves the values of its span (Blender)
  auto_chord,    ///< the neighbors' chord, flat at a local extreme and limited to keep within the values (Maya's auto)
  auto_mix,      ///< as auto_chord, but with the two secants mixed by the spans' durations (Maya)
  auto_ease,     ///< as auto_mix, drawn more to the nearer neighbor (Maya)
};

/// A slope at one side of a key.
template <class T>
struct Tangent {
  using Kind = TangentKind;
  Kind kind = Kind::automatic;
  Rate<T> rate = zero<Rate<T>>();  ///< U/s; read when given. For rotations: angular velocity, rad/s
  double weight = 1.0 / 3.0;       ///< the handle's share of the span, > 0; 1/3 is the plain Hermite cubic
};

/// Rotations: which way round to the next key, and with how many whole turns.
struct Turn {
  /// `along` is the way that turns positively about `axis`: counterclockwise seen from the tip of the axis.
  enum class Way { shorter, longer, along };
  Way way = Way::shorter;
  int whole_turns = 0;  ///< added in the direction of the way; if negative, subtracted
  Vec3 axis{0, 0, 0};   ///< outer axes; read for `along`, and for whole turns between equal rotations

  bool operator==(const Turn&) const = default;
};

template <class T>
struct Key {
  double time;                         ///< s; strictly increasing along a curve
  T value;                             ///< rotations need not be normalized
  Ease ease = Ease::smooth_clamped();  ///< how the curve leaves this key
  /// Slopes; a span is Hermite when the key it leaves has `out` or the one it reaches has `in`. Outside::linear
  /// continues at the slope of the first key's `in` and the last key's `out`, if given or flat.
  std::optional<Tangent<T>> in{}, out{};
  std::optional<T> value_in{};  ///< the value arriving, where the curve jumps
  Turn turn{};                  ///< rotations only: the way to the next key
};

/// What automatic tangents assume beyond the first and last key.
enum class Ends {
  secant,  ///< the slope of the end's own span ("zero curvature")
  flat,    ///< zero
  wrap,    ///< the curve is one period of a loop: neighbors are taken from its other end
};

/// What happens to two handles so long that time would run backwards between their keys. Slopes are kept.
enum class Overlong {
  keep_ratio,  ///< both shortened by one factor, until time just no longer runs backwards
  keep_start,  ///< the first kept, up to 4/3 of the span; the second as near to its length as time allows
  contain,     ///< each shortened to the span, whether or not time runs backwards (Blender)
};

struct KeyOptions {
  Ends ends = Ends::secant;
  Overlong overlong = Overlong::keep_ratio;
  /// Colors only: the space in which values are mixed.
  ColorSpace space = ColorSpace::oklab;
  /// Colors only, in spaces with a hue: which way around it goes.
  HueRule hue = HueRule::shorter;
  /// Scales and ratios: interpolate the logarithm, so that 1 to 4 passes 2 half way. Values must be > 0.
  bool logarithmic = false;
  /// Rotations: keys that state no way of their own take the long way around instead of the short one.
  bool long_way = false;
};

/// The curve through `keys`.
/// @throws std::invalid_argument naming the key and the value: no keys, times not strictly increasing,
///         non-finite numbers, a zero quaternion, a weight not > 0, `ease` beside `out` where it conflicts, two
///         sides of a key aligned to each other; for rotations, a tangent kind other than the first four, or a turn
///         without the axis that it needs.
template <class T>
[[nodiscard]] Curve<T> keyed_curve(std::span<const Key<T>> keys, const KeyOptions& options = {});

template <class T>
[[nodiscard]] Curve<T> keyed_curve(std::initializer_list<Key<T>> keys, const KeyOptions& options = {}) {
  return keyed_curve<T>(std::span<const Key<T>>(keys.begin(), keys.size()), options);
}

}  // namespace tweenfall
