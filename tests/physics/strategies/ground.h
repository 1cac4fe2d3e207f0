#pragma once

/// Worlds that use other strategies than the defaults.

#include <tweenfall/physics/strategies.h>

#include <limits>

#include "support.h"

namespace tweenfall::test {

inline WorldSettings with(ContactSolver solver, Parting separation = Parting::soft,
                          Detection collision = Detection::ahead) {
  WorldSettings settings;
  settings.solver = solver;
  settings.separation = separation;
  settings.collision = collision;
  settings.sleep_after = std::numeric_limits<double>::infinity();
  return settings;
}

inline WorldSettings weightless(WorldSettings settings) {
  settings.gravity = Vec3::Zero();
  return settings;
}

inline BodyId add_floor(World& world, double restitution = 0) {
  BodySettings floor;
  floor.shape.solid = Plane{};
  floor.fixed = true;
  floor.restitution = restitution;
  return world.add(floor);
}

inline BodySettings solid_at(const Solid& solid, const Vec3& position, double mass = 1) {
  BodySettings body;
  body.shape.solid = solid;
  body.mass = mass;
  body.motion.pose.position = position;
  return body;
}

/// This many boxes of a kilogram and a meter, one on top of the other.
inline std::vector<BodyId> add_stack(World& world, int count) {
  std::vector<BodyId> boxes;
  for (int i = 0; i < count; ++i) boxes.push_back(world.add(solid_at(Box{Vec3(0.5, 0.5, 0.5)}, Vec3(0, 0.5 + i, 0))));
  return boxes;
}

/// Greatest overlap of what touches now, m.
inline double deepest(const World& world) {
  double most = 0;
  const std::vector<BodyId> bodies = world.bodies();
  for (std::size_t i = 0; i < bodies.size(); ++i)
    for (std::size_t k = i + 1; k < bodies.size(); ++k) {
      if (world.is_fixed(bodies[i]) && world.is_fixed(bodies[k])) continue;
      const Manifold manifold = collide(world.shape(bodies[i]), world.motion(bodies[i]).pose, world.shape(bodies[k]),
                                        world.motion(bodies[k]).pose);
      for (int point = 0; point < manifold.count; ++point)
        most = std::max(most, manifold.points[static_cast<std::size_t>(point)].penetration);
    }
  return most;
}

}  // namespace tweenfall::test
