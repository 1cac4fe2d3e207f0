#pragma once

/// A track: one curve, and the name of what it drives.

#include <tweenfall/curves/curve.h>

#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tweenfall {

/// A value that switches at given times and has no rate: booleans and texts.
template <class T>
class StepCurve {
 public:
  /// @throws std::invalid_argument when empty or times do not strictly increase.
  explicit StepCurve(std::vector<std::pair<double, T>> steps);

  /// The value in force at `time`; the first one before the first step. `Side::in` at a step is the value before it.
  [[nodiscard]] const T& value(double time, Side side = Side::out) const noexcept;
  [[nodiscard]] const std::vector<std::pair<double, T>>& steps() const noexcept { return steps_; }

 private:
  std::vector<std::pair<double, T>> steps_;
};

extern template class StepCurve<bool>;
extern template class StepCurve<std::string>;

/// One scalar curve for each morph target, in the mesh's order.
using WeightCurves = std::vector<Curve<double>>;

using TrackCurve = std::variant<Curve<double>, Curve<Vec2>, Curve<Vec3>, Curve<Vec4>, Curve<Color>, Curve<Quat>,
                                WeightCurves, StepCurve<bool>, StepCurve<std::string>>;

/// What a track drives. `user` is any other name: evaluated and reported, but nothing of ours reads it.
enum class Property { position, rotation, scale, color, weights, user };

/// The property that a word names; `user` for a word that is none of ours.
[[nodiscard]] Property property_named(std::string_view word) noexcept;

struct Track {
  std::string node;      ///< name of the node
  std::string property;  ///< "position", "rotation", "scale", "color", "weights" or a name of the user's
  TrackCurve
      curve;  ///< position, scale: Curve<Vec3>; rotation: Curve<Quat>; color: Curve<Color>; weights: WeightCurves
  bool relative = false;  ///< compose with the node's rest value instead of replacing it
  /// The author's words for how the curve goes on from its keys ("smooth", "quad-in-out"), for people: each with the
  /// time of the first key that it is said of, s, up to the next pair; empty words and an empty list say nothing.
  std::vector<std::pair<double, std::string>> words{};

  [[nodiscard]] std::string name() const { return node + "." + property; }
};

/// First and last knot of any track's curve, s; {0, 0} for a constant, infinite for a formula.
[[nodiscard]] std::pair<double, double> extent(const TrackCurve& curve) noexcept;

}  // namespace tweenfall
