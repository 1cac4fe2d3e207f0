#pragma once

/// Modifiers: changes laid over a curve of numbers, one on the other, without touching its keys.
///
/// Some change the time at which the curve is sampled (cycles, steps, a warp), some its value (a function added,
/// limits, noise). Each may be confined to a stretch of time, faded in and out there, and applied only in part. Value,
/// rate and acceleration pass through all of them exactly.

#include <tweenfall/curves/curve.h>

#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

namespace tweenfall::modifiers {

/// The curve between its ends, again and again beyond them.
struct Cycles {
  enum class Mode { none, repeat, repeat_offset, mirror };
  Mode before = Mode::repeat, after = Mode::repeat;
  /// How many times at most; 0 is for ever. Beyond that the curve continues as it would without the modifier.
  int plays_before = 0, plays_after = 0;
};

/// Smooth noise, the same for the same seed: values within -strength to strength, with continuous acceleration.
struct Noise {
  enum class Mix { replace, add, multiply };
  Mix mix = Mix::add;
  std::uint64_t seed = 0;
  double strength = 1;  ///< U; for multiply a factor
  double scale = 1;     ///< s between the zeros of the coarsest layer; > 0
  double phase = 0;     ///< s, added to the time
  int layers = 1;       ///< each twice as fine as the one before and half as strong; 1 to 16
};

/// A polynomial of time in seconds.
struct Generator {
  /// c0 + c1 t + c2 t^2 + ...; factorized: (c0 t + c1)(c2 t + c3) ...
  std::vector<double> coefficients;
  bool factorized = false;
  bool additive = false;  ///< added to the curve, else in its place
};

/// amplitude f(multiplier t + phase) + offset. Where the function has no value (root and logarithm below 0, tangent at
/// its poles) the curve stays as it is.
struct BuiltIn {
  enum class Function { sin, cos, tan, sqrt, ln, sinc };  ///< radians; sinc is sin(pi x) / (pi x)
  Function function = Function::sin;
  double amplitude = 1;   ///< U
  double multiplier = 1;  ///< 1/s
  double phase = 0;
  double offset = 0;      ///< U
  bool additive = false;  ///< added to the curve, else in its place
};

/// Time moves in steps, which begin at offset + n step; outside `start` to `end` it runs as usual.
struct Stepped {
  double step = 1;    ///< s; > 0
  double offset = 0;  ///< s
  std::optional<double> start{}, end{};
  bool toward_offset = false;  ///< before the offset the later edge of each step is shown, not the earlier (Blender)
};

/// Bounds on the value, and on the time at which the curve is sampled.
struct Limits {
  std::optional<double> low{}, high{};   ///< U
  std::optional<double> start{}, end{};  ///< s
};

/// The band from reference + low to reference + high is stretched to another band, whose bounds move in straight lines.
struct Envelope {
  struct Point {
    double time, low, high;  ///< s, strictly increasing; U, the band there
  };
  double reference = 0, low = -1, high = 1;
  std::vector<Point> points;
};

/// The curve at the time that another curve gives.
struct TimeWarp {
  Curve<double> clock;  ///< s over s
};

/// The curve stretched and moved: offset + scale curve((t - time_offset) / time_scale).
struct Placement {
  double time_offset = 0;   ///< s
  double time_scale = 1;    ///< not 0; below 0 backwards
  double value_offset = 0;  ///< U
  double value_scale = 1;
};

using Kind = std::variant<Cycles, Noise, Generator, BuiltIn, Stepped, Limits, Envelope, TimeWarp, Placement>;

}  // namespace tweenfall::modifiers

namespace tweenfall {

/// A stretch of time with straight ramps of influence inside its ends.
struct ModifierRange {
  double start, end;                   ///< s
  double blend_in = 0, blend_out = 0;  ///< s
};

struct Modifier {
  modifiers::Kind kind;
  std::optional<ModifierRange> range{};  ///< default: always
  double influence = 1;                  ///< 0 leaves time and value as they are, 1 takes those of the modifier
};

/// The curve with the modifiers laid over it, the first innermost: time passes through them from the last to the first,
/// the value from the first to the last. Those that change the value see the time at which the curve itself is sampled,
/// so something added before cycles or steps is cycled and stepped too. Source: Blender's order of F-modifiers.
/// @throws std::invalid_argument naming the modifier: non-finite numbers, a step or scale not > 0, bounds or points out
///         of order, nothing to generate from.
[[nodiscard]] Curve<double> modified(const Curve<double>& curve, std::span<const Modifier> modifiers);

/// The same for Vec2, Vec3 and Vec4: `modifiers[i]` are laid over component i; an empty list changes nothing.
/// @throws as above, naming the component; std::invalid_argument unless there is one list per component.
template <class T>
[[nodiscard]] Curve<T> modified(const Curve<T>& curve, std::span<const std::vector<Modifier>> modifiers);

}  // namespace tweenfall
