#pragma once

#include <tweenfall/physics/world.h>

#include <cmath>
#include <numbers>

namespace tweenfall::jointed {

using std::numbers::pi;
inline constexpr double g = 9.81;
inline const WorldSettings awake{.sleep_after = HUGE_VAL};
inline const WorldSettings weightless{.gravity = Vec3(0, 0, 0), .sleep_after = HUGE_VAL};

/// A joint at a point of the world between bodies in their present poses; the default handle for a means the world.
inline JointId join(World& world, BodyId a, BodyId b, const Vec3& point, const JointKind& kind,
                    const Vec3& axis = Vec3(0, 0, 1), const Vec3& second = Vec3(0, 0, 0)) {
  const JointFrames frames =
      joint_frames(a == BodyId{} ? Pose{} : world.motion(a).pose, world.motion(b).pose, point, axis, second);
  return world.add_joint({.a = a, .b = b, .frame_a = frames.a, .frame_b = frames.b, .kind = kind});
}

inline BodyId add_box(World& world, const Vec3& center, const Vec3& half, double mass) {
  return world.add({.shape = {Box{half}}, .mass = mass, .motion = {.pose = {.position = center}}});
}

inline BodyId add_ball(World& world, const Vec3& center, double radius, double mass) {
  return world.add({.shape = {Sphere{radius}}, .mass = mass, .motion = {.pose = {.position = center}}});
}

/// Kinetic and potential energy of everything that is not fixed, J.
inline double energy_of(const World& world, double gravity = 9.81) {
  double sum = world.kinetic_energy();
  for (const BodyId& body : world.bodies()) {
    if (world.is_fixed(body)) continue;
    const Pose pose = world.motion(body).pose;
    sum += world.mass(body).mass * gravity * (pose.position + pose.rotation * world.mass(body).center).y();
  }
  return sum;
}

}  // namespace tweenfall::jointed
