#include <tweenfall/physics/stage/inspection.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "stage/stage_data.h"

namespace tweenfall {

namespace staging {

namespace {

struct StandingBody {
  std::size_t node;
  BodyId id;
  Shape shape;
  Pose pose;
  Bounds room;
  bool moves;  ///< by itself

  /// The shortest edge of its bounds, m; infinity for a plane, a mesh or a height field.
  [[nodiscard]] double size() const {
    return is_scenery(shape.solid) ? std::numeric_limits<double>::infinity() : (room.high - room.low).minCoeff();
  }
};

/// How deep two bodies overlap if that is more than touching; else 0.
double overlap_of(const StandingBody& a, const StandingBody& b) {
  const Manifold manifold = collide(a.shape, a.pose, b.shape, b.pose);
  double depth = 0;
  for (int i = 0; i < manifold.count; ++i)
    depth = std::max(depth, manifold.points[static_cast<std::size_t>(i)].penetration);
  return depth > 0.01 * std::min(a.size(), b.size()) ? depth : 0;
}

std::vector<StartOverlap> overlaps_in(const StageState& state) {
  constexpr std::size_t most_told = 100, most_tried = 200'000;
  std::vector<StandingBody> bodies;
  bodies.reserve(state.bodies.size());
  for (const StagedBody& body : state.bodies) {
    const Shape& shape = state.world.shape(body.id);
    const Pose pose = state.world.motion(body.id).pose;
    bodies.push_back({body.node, body.id, shape, pose, bounds(shape, pose),
                      !state.world.is_fixed(body.id) && state.world.owner(body.id) != Owner::keyed});
  }
  // Swept along x; a plane begins before all others.
  std::vector<const StandingBody*> swept;
  swept.reserve(bodies.size());
  for (const StandingBody& body : bodies) swept.push_back(&body);
  std::ranges::stable_sort(swept, {}, [](const StandingBody* body) { return body->room.low.x(); });
  std::vector<StartOverlap> found;
  std::size_t tried = 0;
  for (std::size_t i = 0; i < swept.size(); ++i)
    for (std::size_t k = i + 1; k < swept.size() && swept[k]->room.low.x() <= swept[i]->room.high.x(); ++k) {
      const StandingBody& first = *swept[swept[i]->moves ? i : k];
      const StandingBody& second = *swept[swept[i]->moves ? k : i];
      if (++tried > most_tried || found.size() == most_told) return found;
      if (!first.moves || (first.room.low.array() > second.room.high.array()).any() ||
          (second.room.low.array() > first.room.high.array()).any() || !state.world.collides(first.id, second.id))
        continue;
      if (const double depth = overlap_of(first, second); depth > 0) found.push_back({first.node, second.node, depth});
    }
  return found;
}

/// How far a unit push at the anchor moves a body, 1/kg; 0 for a body that is held.
double give_of(const StageState& state, std::size_t node, const Vec3& anchor) {
  const StagedBody* body = state.body(node);
  if (!body || state.world.is_fixed(body->id) || state.world.owner(body->id) == Owner::keyed) return 0;
  const MassProperties& mass = state.world.mass(body->id);
  return 1 / mass.mass + (anchor - mass.center).squaredNorm() * Mat3(mass.inertia.inverse()).norm();
}

std::vector<StiffSpring> stiff_springs_in(const StageState& state, const StageDescription& description) {
  std::vector<StiffSpring> found;
  for (std::size_t i = 0; i < description.forces.size(); ++i) {
    const ForceDescription& described = description.forces[i];
    const auto* kind = std::get_if<Spring>(&described.force);
    if (!kind) continue;
    const Spring& spring = *kind;
    const double give = give_of(state, described.a, spring.anchor_a) + give_of(state, described.b, spring.anchor_b);
    // The step h at which (stiffness h^2 + damping h) give is 1: above it the solver takes the spring implicitly.
    const double root = std::sqrt(spring.damping * spring.damping + 4 * spring.stiffness / give);
    const double longest = give > 0 ? 2 / give / (spring.damping + root) : description.step;
    if (longest < description.step) found.push_back({i, longest});
  }
  return found;
}

}  // namespace

}  // namespace staging

StageInspection inspect(const StageDescription& description, bool try_steps) {
  StageInspection out;
  const staging::StageState state = staging::described_state(description, out.faults);
  if (!out.faults.empty()) return out;
  out.overlaps = staging::overlaps_in(state);
  out.stiff_springs = staging::stiff_springs_in(state, description);
  staging::find_joint_starts(state, description, out);
  staging::find_extremes(state, description, try_steps, out);
  return out;
}

}  // namespace tweenfall
