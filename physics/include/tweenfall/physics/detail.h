#pragma once

/// What the steps of a world work with, for pictures and for finding causes: which bodies are
/// solved together, which are asleep, and where pairs are searched for. Contacts and joints are in the world itself.

#include <tweenfall/physics/world.h>

#include <vector>

namespace tweenfall {

struct BodyDetail {
  BodyId body;
  /// The bodies that contacts, joints and springs of the last step tie together have the one with the smallest index
  /// here; `BodyId{}` for a body that only its owner moves.
  BodyId island;
  bool asleep = false;
  /// The box in which the last step searched for pairs of the body, with room for its path; its bounds before any step;
  /// infinite for a plane.
  Bounds box{Vec3(0, 0, 0), Vec3(0, 0, 0)};
};

/// Of all bodies, by index. Nothing is stored for it between calls.
[[nodiscard]] std::vector<BodyDetail> body_details(const World& world);

/// Where the points of `World::contacts` are after the step, contact by contact. They were found where the
/// bodies were before the step, and have moved along: with the body that moves by itself, or midway between two such.
/// In a planar world they stay as they were found.
[[nodiscard]] std::vector<Vec3> contact_places(const World& world);

/// How far the impulses of the last step are from solving the linear complementarity problem of its contacts, in m/s:
/// the most by which an impulse pulls or surfaces close, or the lesser of the two where surfaces part and yet press.
/// 0 unless the world's solver is `ContactSolver::lcp`.
[[nodiscard]] double complementarity_residual(const World& world);

}  // namespace tweenfall
