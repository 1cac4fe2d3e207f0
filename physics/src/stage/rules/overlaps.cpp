#include "stage/rules/overlaps.h"

#include <tweenfall/physics/contact.h>

#include <algorithm>

namespace tweenfall::staging {

namespace {

constexpr double barely = 1e-7;  // m

double depth_of(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  const Manifold manifold = collide(a, pose_a, b, pose_b);
  double depth = 0;
  for (int i = 0; i < manifold.count; ++i)
    depth = std::max(depth, manifold.points[static_cast<std::size_t>(i)].penetration);
  return depth;
}

bool apart(const Bounds& a, const Bounds& b) {
  return (a.low.array() > b.high.array()).any() || (b.low.array() > a.high.array()).any();
}

bool lies_in(const StageState& state, const StagedBody& body, const Pose& pose, const StagedBody& other) {
  const World& world = state.world;
  if (!other.present || other.id == body.id || world.is_sensor(other.id)) return false;
  const Shape &shape = world.shape(body.id), &shape_of_other = world.shape(other.id);
  const Pose pose_of_other = world.motion(other.id).pose;
  if (apart(bounds(shape, pose), bounds(shape_of_other, pose_of_other)) || !world.collides(body.id, other.id))
    return false;
  return depth_of(shape, pose, shape_of_other, pose_of_other) > barely;
}

bool is_clear(const StageState& state, const StagedBody& body, double time) {
  const Pose pose = rigid(body.path.at(time, Side::in)).pose;
  return std::ranges::none_of(state.bodies, [&](const StagedBody& other) { return lies_in(state, body, pose, other); });
}

}  // namespace

std::vector<BodyId> bodies_in(const StageState& state, const StagedBody& body, const Pose& pose) {
  std::vector<BodyId> found;
  for (const StagedBody& other : state.bodies)
    if (lies_in(state, body, pose, other)) found.push_back(other.id);
  std::ranges::sort(found, {}, &BodyId::index);
  return found;
}

std::optional<double> last_clear(const StageState& state, const StagedBody& body, double instant, double within,
                                 double step) {
  constexpr double exact = 1e-10;  // s
  const double first = std::max(0.0, instant - within);
  double late = instant;
  for (double early = instant; early > first;) {
    early = std::max(first, early - step / 4);
    // Nothing was shown of the path before the body came to it.
    if (body.path.side_at(early, Side::in) == Side::out && early > 0) return std::nullopt;
    if (!is_clear(state, body, early)) {
      late = early;
      continue;
    }
    while (late - early > exact) {
      const double middle = early + 0.5 * (late - early);
      if (middle == early || middle == late) break;  // so late that there are no times in between
      (is_clear(state, body, middle) ? early : late) = middle;
    }
    return early;
  }
  return std::nullopt;
}

void end_passing(StageState& state) {
  std::erase_if(state.passing, [&](const std::pair<BodyId, BodyId>& pair) {
    World& world = state.world;
    if (!world.contains(pair.first) || !world.contains(pair.second)) return true;
    const Shape &a = world.shape(pair.first), &b = world.shape(pair.second);
    const Pose pose_a = world.motion(pair.first).pose, pose_b = world.motion(pair.second).pose;
    if (!apart(bounds(a, pose_a), bounds(b, pose_b)) && depth_of(a, pose_a, b, pose_b) > 0) return false;
    world.collide(pair.first, pair.second);
    return true;
  });
}

}  // namespace tweenfall::staging
