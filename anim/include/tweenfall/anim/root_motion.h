#pragma once

/// Root motion: the part of a motion that carries the figure through the world, apart from what it does in place.
///
/// A walk consists of steps on the spot and of a movement over the ground. `RootMotion` takes that movement out of a
/// pose, as a frame in the figure's space that one of its nodes carries along (the identity at rest), and leaves the
/// rest in place; putting it back restores the pose. `RootTravel` continues from loop to loop of a clip: the travel of
/// ten thousand loops is that of one, repeated in closed form, so that nothing drifts. Steps of several clips are
/// blended as screws. All carry exact rates, and nothing is allocated.
///
/// Frames are rigid: their scale is 1.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>

#include <memory>
#include <span>
#include <string_view>

namespace tweenfall {

/// The parts of a node's motion that carry the figure.
struct RootParts {
  enum class Turn { none, yaw, all };

  bool horizontal = true;  ///< its movement over the ground
  bool vertical = false;   ///< its movement up and down
  Turn turn = Turn::yaw;   ///< its turn from rest: none, the part about `up`, or all
  Vec3 up{0, 1, 0};        ///< in the figure's space; any length
};

/// Takes root motion out of poses, and puts it back.
class RootMotion {
 public:
  /// @throws std::invalid_argument listing all problems: no such node, nothing to take out, no direction up.
  RootMotion(const Hierarchy& nodes, std::string_view node, const RootParts& parts = {});

  [[nodiscard]] std::size_t node() const noexcept { return chain_.front(); }
  [[nodiscard]] const RootParts& parts() const noexcept { return parts_; }

  /// The frame that the node carries along, in the figure's space, with its rates; the identity at rest.
  [[nodiscard]] Motion carried(std::span<const Motion> pose) const noexcept;

  /// Takes it out: moves the node, and all nodes below it, back to in place. @returns the frame. Scales of nodes above
  /// it must be uniform and not 0.
  Motion take_out(std::span<Motion> pose) const noexcept;

  /// Adds a frame to a pose in place: with the frame taken out, this restores the pose, to 1e-12.
  void put_back(std::span<Motion> pose, const Motion& frame) const noexcept;

 private:
  [[nodiscard]] Motion above(std::span<const Motion> pose) const noexcept;
  [[nodiscard]] Motion frame_of(const Motion& node) const noexcept;

  std::vector<std::size_t> chain_;  ///< the node and all above it
  RootParts parts_;
  Pose rest_;  ///< of the node, in the figure's space
};

/// The travel of a clip from loop to loop.
class RootTravel {
 public:
  RootTravel() = default;
  /// From the carried frames at the start and at the end of the clip.
  RootTravel(const Pose& first, const Pose& last) noexcept;

  /// The travel of one loop, relative to its start.
  [[nodiscard]] const Pose& loop() const noexcept { return loop_; }

  /// The travel from the start of loop 0 to a frame carried in a later loop, or in an earlier one: `loop()` repeated
  /// `cycle` times, and then the travel within that loop.
  [[nodiscard]] Motion at(const Motion& frame, double cycle) const noexcept;

  /// The travel from one frame to another, relative to the first, over all loops in between; its rates are those of the
  /// second. It is as exact after ten thousand loops as in the first.
  [[nodiscard]] Motion step(const Pose& from, double from_cycle, const Motion& to, double to_cycle) const noexcept;

 private:
  Pose first_, loop_;
};

/// The travel of a clip of a figure. @throws std::invalid_argument: a duration that is not finite; a clip that does not
/// fit the nodes.
[[nodiscard]] RootTravel root_travel(const RootMotion& root, std::shared_ptr<const Hierarchy> nodes, Clip clip);

/// The mean of steps by weights, which are divided by their sum: the screw whose rotation and translation are the mean
/// of theirs, so that mixing walks on arcs gives a walk on the arc between, whatever the length of the frames. Its
/// rates are the mean of the rates in the figure's own axes. A step that has all the weight is returned bit for bit; if
/// the weights sum to zero, the result is the identity. Steps must turn by less than half a turn.
/// @param steps relative to their start @param weights  one for each; negative ones count as 0
[[nodiscard]] Motion blend_steps(std::span<const Motion> steps, std::span<const Sample<double>> weights) noexcept;

/// A rigid movement repeated `times` times, in closed form: with R the turn by an angle a about an axis and p the
/// translation, R^n, and n times p's part along the axis plus sin(n a/2)/sin(a/2) R^((n-1)/2) times the part across.
/// @param times any number; negative: the inverse, repeated
[[nodiscard]] Pose repeated(const Pose& rigid, double times) noexcept;

/// The inverse of a rigid movement.
[[nodiscard]] Pose undone(const Pose& rigid) noexcept;

/// The pose of the start of a path at which the figure, having travelled `travelled`, is at `place`.
[[nodiscard]] Pose anchor(const Pose& place, const Pose& travelled) noexcept;

}  // namespace tweenfall
