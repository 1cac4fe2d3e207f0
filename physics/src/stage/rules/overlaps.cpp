#include "stage/rules/overlaps.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/contact.h>

#include <algorithm>
#include <cmath>

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

/// Shortest edge of the smaller body's bounds, m.
double size_of(const World& world, const BodyId& a, const BodyId& b) {
  double size = infinity;
  for (const BodyId& id : {a, b}) {
    const Bounds room = bounds(world.shape(id), world.motion(id).pose);
    size = std::min(size, (room.high - room.low).minCoeff());
  }
  return size;
}

void tell_strain(const StageState& state, const char* name, const char* what, double depth, std::vector<NodeId> nodes,
                 const std::string& joint, std::vector<Happening>& happenings) {
  StageEvent event;
  event.time = state.time;
  event.name = name;
  event.data = std::string("{\"") + what + "\": " + number_text(depth) + "}";
  event.nodes = std::move(nodes);
  event.joint = joint;
  Happening& happening = happenings.emplace_back();
  happening.time = state.time;
  happening.what = std::move(event);
}

// What lasts so long is told, and once more after it has fallen below half of that.
constexpr double too_deep = 0.05;  // of the smaller body's size
constexpr double well_again = 0.5;
constexpr double lasting = 0.05;  // s

/// Whether a strain that has gone on since then is to be told now.
template <class Strained>
bool is_news(Strained& strain, double now) {
  if (strain.told || now - strain.since < lasting - sliver) return false;
  return strain.told = true;
}

std::pair<std::uint32_t, std::uint32_t> by_pair(const Strain& strain) {
  return {strain.a.index, strain.b.index};
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
  double late = instant;
  for (double early = instant; early > 0 && instant - early < within;) {
    early = std::max({0.0, instant - within, early - step / 4});
    // Of what was before the body came to this path nothing was shown.
    if (body.path.side_at(early, Side::in) == Side::out && early > 0) return std::nullopt;
    if (!is_clear(state, body, early)) {
      late = early;
      continue;
    }
    while (late - early > exact) {
      const double middle = early + 0.5 * (late - early);
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

void report_strains(StageState& state, std::vector<Happening>& happenings) {
  constexpr double least = 1e-3;  // m; what lies less deep is no strain, however small it is
  std::vector<Strain> deep;
  for (const Contact& contact : state.world.contacts()) {
    double depth = 0;
    for (int i = 0; i < contact.manifold.count; ++i)
      depth = std::max(depth, contact.manifold.points[static_cast<std::size_t>(i)].penetration);
    if (!(depth > least)) continue;
    Strain strain{contact.a, contact.b, state.time};
    if (!deep.empty() && by_pair(deep.back()) == by_pair(strain)) continue;
    const auto known = std::ranges::lower_bound(state.strained, by_pair(strain), {}, by_pair);
    if (known != state.strained.end() && known->a == contact.a && known->b == contact.b) strain = *known;
    const double most = too_deep * size_of(state.world, contact.a, contact.b);
    if (!(depth > (strain.told ? well_again * most : most))) continue;
    if (is_news(strain, state.time))
      tell_strain(state, "overlap", "depth", depth, {state.node_of[contact.a.index], state.node_of[contact.b.index]},
                  {}, happenings);
    deep.push_back(strain);
  }
  state.strained = std::move(deep);

  std::vector<Tear> torn;
  const std::vector<StagedJoint>& joints = state.joints->list;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (!state.world.contains(joints[i].id)) continue;
    const double gap = state.world.reading(joints[i].id).gap;
    if (!(gap > least)) continue;
    Tear tear{i, state.time};
    if (const auto known = std::ranges::lower_bound(state.torn, i, {}, &Tear::joint);
        known != state.torn.end() && known->joint == i)
      tear = *known;
    const BodyId b = state.bodies[state.body_of[joints[i].b]].id;
    const BodyId a = joints[i].a == no_node ? b : state.bodies[state.body_of[joints[i].a]].id;
    const double most = too_deep * size_of(state.world, a, b);
    if (!(gap > (tear.told ? well_again * most : most))) continue;
    if (is_news(tear, state.time)) {
      std::vector<NodeId> nodes{joints[i].b};
      if (joints[i].a != no_node) nodes.insert(nodes.begin(), joints[i].a);
      tell_strain(state, "joint_strained", "gap", gap, std::move(nodes), joints[i].name, happenings);
    }
    torn.push_back(tear);
  }
  state.torn = std::move(torn);
}

}  // namespace tweenfall::staging
