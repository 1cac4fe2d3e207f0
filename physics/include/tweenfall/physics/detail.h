#pragma once

/// What a world's steps work with, for pictures and for those who look for the cause of something: which bodies are
/// solved together, which sleep, and where pairs are looked for. Contacts and joints the world tells itself.

#include <tweenfall/physics/world.h>

#include <vector>

namespace tweenfall {

struct BodyDetail {
  BodyId body;
  /// Of the bodies that contacts, joints and springs of the last step tie together the one with the smallest index;
  /// `BodyId{}` for one that nothing moves but its owner.
  BodyId island;
  bool asleep = false;
  /// In which the last step looked for its pairs, with room for its way; its bounds before any step, infinite for a
  /// plane.
  Bounds box{Vec3(0, 0, 0), Vec3(0, 0, 0)};
};

/// Of all bodies, by index. Nothing is kept for it between calls.
[[nodiscard]] std::vector<BodyDetail> body_details(const World& world);

/// Where the points of `World::contacts` are after the step, one contact after the other. They were found where the
/// bodies were before it, and have gone along since: with the one that moves by itself, or midway between two of those.
/// In a plane they are told as they were found.
[[nodiscard]] std::vector<Vec3> contact_places(const World& world);

/// How far the impulses of the last step are from solving the linear complementarity problem of its contacts, in m/s:
/// the most by which an impulse pulls or surfaces close, or the lesser of the two where surfaces part and yet press.
/// 0 unless the world's solver is `ContactSolver::lcp`.
[[nodiscard]] double complementarity_residual(const World& world);

}  // namespace tweenfall
