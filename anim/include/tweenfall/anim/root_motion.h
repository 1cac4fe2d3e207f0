#pragma once

/// Root motion: what of a pose carries the figure through the world, apart from what it does in place.
///
/// A walk is made of steps on the spot and of a way over the ground. `RootMotion` takes the way out of a pose, as a
/// frame in the figure's space that one of its nodes carries along (none while it rests), and leaves the rest in place;
/// put back, the pose is what it was. `RootTravel` goes on from loop to loop of a clip: the way of ten thousand loops
/// is that of one, repeated in closed form, so that nothing drifts. Steps of several clips are blended as screws. All
/// carry exact rates, and nothing is allocated.
///
/// Frames are rigid: their scale is 1.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>

#include <memory>
#include <span>
#include <string_view>

namespace tweenfall {

/// What of a node's motion carries the figure.
struct RootParts {
  enum class Turn { none, yaw, all };

  bool horizontal = true;  ///< its way over the ground
  bool vertical = false;   ///< its way up and down
  Turn turn = Turn::yaw;   ///< its turn from rest: none, the part about `up`, or all
  Vec3 up{0, 1, 0};        ///< in the figure's space; any length
};

/// Takes what carries the figure out of poses, and puts it back.
class RootMotion {
 public:
  /// @throws std::invalid_argument listing all problems: no such node, nothing to take out, no direction up.
  RootMotion(const Hierarchy& nodes, std::string_view node, const RootParts& parts = {});

  [[nodiscard]] std::size_t node() const noexcept { return chain_.front(); }
  [[nodiscard]] const RootParts& parts() const noexcept { return parts_; }

  /// The frame that the node carries along, in the figure's space, with its rates; none at rest.
  [[nodiscard]] Motion carried(std::span<const Motion> pose) const noexcept;

  /// Takes it out: moves the node, and what is below it, back to where it is in place. @returns the frame
  /// Scales of nodes above it must be even and not 0.
  Motion take_out(std::span<Motion> pose) const noexcept;

  /// Puts a frame into a pose in place: the one taken out, and the pose is what it was, to 1e-12.
  void put_back(std::span<Motion> pose, const Motion& frame) const noexcept;

 private:
  [[nodiscard]] Motion above(std::span<const Motion> pose) const noexcept;
  [[nodiscard]] Motion frame_of(const Motion& node) const noexcept;

  std::vector<std::size_t> chain_;  ///< the node and all above it
  RootParts parts_;
  Pose rest_;  ///< of the node, in the figure's space
};

/// The way of a clip from loop to loop.
class RootTravel {
 public:
  RootTravel() = default;
  /// From the frames that are carried at the start and at the end of the clip.
  RootTravel(const Pose& first, const Pose& last) noexcept;

  /// The way of one loop, seen from its start.
  [[nodiscard]] const Pose& loop() const noexcept { return loop_; }

  /// The way from the start of loop 0 to a frame carried in a later loop, or in an earlier one: `loop()` repeated
  /// `cycle` times, and then the way in that loop.
  [[nodiscard]] Motion at(const Motion& frame, double cycle) const noexcept;

  /// The way from one frame to another, seen from the first, over as many loops as lie between; its rates are those of
  /// the second. As exact after ten thousand loops as in the first.
  [[nodiscard]] Motion step(const Pose& from, double from_cycle, const Motion& to, double to_cycle) const noexcept;

 private:
  Pose first_, loop_;
};

/// Of a clip of a figure. @throws std::invalid_argument: a duration that is not finite; a clip that does not fit the
/// nodes.
[[nodiscard]] RootTravel root_travel(const RootMotion& root, std::shared_ptr<const Hierarchy> nodes, Clip clip);

/// The mean of steps by weights, which are divided by their sum: the screw whose turn and way are the mean of theirs,
/// so that figures that walk on arcs walk on the arc between, by frames of any length. Its rates are the mean of the
/// rates as the figure itself has them. One step that has all the weight is returned bit for bit; weights that sum to
/// nothing are no step. Turns of a step are below half a turn.
/// @param steps    seen from their start  @param weights  one for each; negative ones count as 0
[[nodiscard]] Motion blend_steps(std::span<const Motion> steps, std::span<const Sample<double>> weights) noexcept;

/// A rigid movement done `times` over, in closed form: with R the turn by an angle a about an axis and p the way,
/// R^n, and n times the part of p along the axis and sin(n a/2)/sin(a/2) R^((n-1)/2) times the part across.
/// @param times  any number; negative: undone so often
[[nodiscard]] Pose repeated(const Pose& rigid, double times) noexcept;

/// The rigid movement that undoes another.
[[nodiscard]] Pose undone(const Pose& rigid) noexcept;

/// Where the start of a way must be put, so that what has gone it so far stands at `place`.
[[nodiscard]] Pose anchor(const Pose& place, const Pose& travelled) noexcept;

}  // namespace tweenfall
