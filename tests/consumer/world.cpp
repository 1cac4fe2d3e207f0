// Steps a world, and uses the same parts of Eigen as the library, with other flags: whichever copy of an inline
// function the linker keeps, the world must end in the same bits.

#include <tweenfall/physics/joint.h>
#include <tweenfall/physics/world.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cinttypes>
#include <cstdio>

namespace {

using tweenfall::Mat3;
using tweenfall::Quat;
using tweenfall::Vec3;

double use_eigen(const Vec3& seed) {
  Quat turn(seed.x(), seed.y(), seed.z(), 1);
  const double length = turn.norm() + turn.squaredNorm() + turn.coeffs().sum();
  turn.normalize();
  Mat3 matrix = turn.toRotationMatrix() * seed.asDiagonal();
  matrix += seed * seed.transpose() + matrix.transpose() * matrix;
  const Quat other = turn * Quat(matrix.col(0).x(), 0, 1, 0).normalized() * turn.conjugate() * turn.inverse();
  const Vec3 moved = other * seed + matrix * seed.cross(matrix.inverse() * seed) + turn._transformVector(seed);
  return length + moved.dot(seed) + moved.norm() + moved.stableNorm() + matrix.squaredNorm() + matrix.trace() +
         matrix.determinant() + turn.dot(other) + seed.cwiseAbs().maxCoeff() + turn.slerp(0.3, other).w();
}

}  // namespace

int main() {
  tweenfall::World world;
  world.add({.shape = {tweenfall::Plane{Vec3(0, 1, 0), 0}}, .fixed = true});
  tweenfall::BodyId last{};
  for (int i = 0; i < 24; ++i) {
    const Vec3 place(0.3 * (i % 5), 1 + 0.7 * i, 0.2 * (i % 3));
    const tweenfall::Shape shape = i % 2 == 0 ? tweenfall::Shape{tweenfall::Box{Vec3(0.2, 0.3, 0.25)}}
                                              : tweenfall::Shape{tweenfall::Capsule{0.15, 0.2}};
    const Quat rotation = Quat(1, 0.1 * i, 0.3, 0.2 * (i % 7)).normalized();
    const tweenfall::BodyId body = world.add({.shape = shape,
                                              .mass = 1.0 + i,
                                              .restitution = 0.4,
                                              .motion = {.pose = {.position = place, .rotation = rotation},
                                                         .twist = {Vec3(0.1 * i, 0, 0), Vec3(1, 0.2 * i, 3)}}});
    if (i % 3 == 1)
      world.add_joint({.a = last,
                       .b = body,
                       .frame_a = {.position = Vec3(0, 0.4, 0)},
                       .frame_b = {.position = Vec3(0, -0.4, 0)},
                       .kind = tweenfall::SwingTwistJoint{.swing_y = 0.5, .swing_z = 0.3, .twist = {-0.4, 0.4}}});
    last = body;
  }
  double used = 0;
  for (int i = 0; i < 240; ++i) {
    used += use_eigen(Vec3(1, 0.5, 0.25 * (i + 1)));
    world.step(1.0 / 60);
  }
  std::printf("%016" PRIx64 "\n", world.state_hash());
  return used > 0 ? 0 : 1;
}
