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

/// What a track drives. `user` is any other name: such a track is evaluated and reported, but not used here.
enum class Property { position, rotation, scale, color, weights, user };

/// The property that a word names; `user` for any word that is not one of ours.
[[nodiscard]] Property property_named(std::string_view word) noexcept;

struct Track {
  std::string node;  ///< name of the node
  /// "position", "rotation", "scale", "color", "weights", one number of one of the first four ("position.y", see
  /// component.h), or a name chosen by the user.
  std::string property;
  /// A Curve<Vec3> for position and scale, Curve<Quat> for rotation, Curve<Color> for color, WeightCurves for weights,
  /// and Curve<double> for a component.
  TrackCurve curve;
  /// Compose with the node's rest value instead of replacing it; for a component: add to the node's own number, or
  /// multiply its scale.
  bool relative = false;
  /// The author's words for how the curve leaves its keys ("smooth", "quad-in-out"), for display: each with the time of
  /// the first key that it applies to, s, until the next pair; empty words and an empty list mean nothing.
  std::vector<std::pair<double, std::string>> words{};
  EulerOrder order{};  ///< for a component of a rotation: the order of its angles

  [[nodiscard]] std::string name() const { return node + "." + property; }
};

/// First and last knot of any track's curve, s; {0, 0} for a constant, infinite for a formula.
[[nodiscard]] std::pair<double, double> extent(const TrackCurve& curve) noexcept;

}  // namespace tweenfall
