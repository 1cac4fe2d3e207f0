#pragma once

/// Handles: keys of a number in the form that animation editors store, each with two points in time and value that
/// the curve heads for.
///
/// Between two keys lies the Bezier cubic of key, handle, handle, key, read as value over time. A handle stays where it
/// is put (`given`), or is placed by a rule from the neighboring keys. Handles may reach beyond the next key; where
/// time would run backwards, `Overlong` says which handle is shortened.

#include <tweenfall/curves/keys.h>

#include <optional>
#include <span>
#include <vector>

namespace tweenfall {

/// The lengths in time of the two handles of a span, as shares of the span's duration.
struct HandleWidths {
  double start, end;
};

/// Whether time runs backwards somewhere between two keys with such handles.
/// Source: the discriminant of x'(s) for x(s) = 3 start s (1-s)^2 + 3 (1 - end) s^2 (1-s) + s^3.
[[nodiscard]] bool runs_backwards(const HandleWidths& widths) noexcept;

/// Widths for which time does not run backwards: the given ones, where they already fit and the rule keeps them.
/// @throws std::invalid_argument for a negative or non-finite width.
[[nodiscard]] HandleWidths resolved(const HandleWidths& widths, Overlong rule);

struct Handle {
  TangentKind kind = TangentKind::given;
  double time = 0, value = 0;  ///< s, U; read if `kind` is given, and for the length of an aligned handle
};

struct HandleKey {
  double time, value;          ///< s, U; times strictly increasing
  Handle in{}, out{};          ///< the first key's `in` and the last key's `out` are read by linear continuation
  std::optional<Ease> ease{};  ///< how the curve leaves this key; none: by its handle
};

struct HandleOptions {
  Ends ends = Ends::secant;                  ///< what `automatic` and `auto_clamped` assume beyond the ends
  Overlong overlong = Overlong::keep_ratio;  ///< Blender's rule is contain
  /// Automatic and auto-clamped keys get slopes that make the acceleration continuous, as far as the clamping allows
  /// ("continuous acceleration" in Blender).
  bool even_acceleration = false;
};

/// The same keys with every handle placed as its kind requires, and marked `given`.
///
/// Lengths in time: `vector`, `flat`, `plateau` and Maya's kinds a third of the span; `automatic` and `auto_clamped`
/// 0.39 of it, at most five times the length on the other side, or a third with even_acceleration; `aligned` keeps its
/// present length, measured in the plane of time and value, and stays as it is beside a given handle. Source: Blender
/// 3.4, blenkernel/intern/curve.cc; Autodesk, AnimX.
/// @throws std::invalid_argument naming the key: no keys, times out of order, non-finite numbers, a given handle on
///         the wrong side of its key.
[[nodiscard]] std::vector<HandleKey> placed_handles(std::span<const HandleKey> keys, const HandleOptions& options = {});

/// The curve through `keys`. Continued linearly, it follows the outer handles of its end keys, if they have length.
/// @throws as placed_handles.
[[nodiscard]] Curve<double> handle_curve(std::span<const HandleKey> keys, const HandleOptions& options = {});

/// `keys`, placed and with overlong handles shortened by the rule, and one more at `time` that does not change the
/// curve. At the time of a key nothing is added. The resulting handles may reach beyond their spans without time
/// running backwards: it is the same curve under any rule but `contain`.
/// @throws as placed_handles; std::invalid_argument when `time` lies outside the keys, or in a span with an ease other
///         than `hold` and `linear`.
[[nodiscard]] std::vector<HandleKey> insert_key(std::span<const HandleKey> keys, double time,
                                                const HandleOptions& options = {});

}  // namespace tweenfall
