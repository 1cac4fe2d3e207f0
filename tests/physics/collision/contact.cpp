#include <tweenfall/physics/contact.h>

#include <numbers>

#include "support.h"

using namespace tweenfall;
using test::near;

namespace {

Pose at(double x, double y, double z) {
  Pose pose;
  pose.position = Vec3(x, y, z);
  return pose;
}

Pose turned(Pose pose, const Vec3& axis, double degrees) {
  const double half = degrees * std::numbers::pi / 360;
  const Vec3 part = std::sin(half) * axis;
  pose.rotation = Quat(std::cos(half), part.x(), part.y(), part.z());
  return pose;
}

double deepest(const Manifold& manifold) {
  double most = -1e9;
  for (int i = 0; i < manifold.count; ++i)
    most = std::max(most, manifold.points[static_cast<std::size_t>(i)].penetration);
  return most;
}

}  // namespace

TEST_CASE("two balls touch on the line between their centers") {
  const Manifold manifold = collide({Sphere{1}}, at(0, 0, 0), {Sphere{0.5}}, at(0, 0, 1.4));
  REQUIRE(manifold.count == 1);
  CHECK(near(manifold.normal, Vec3(0, 0, 1), 1e-15));
  CHECK(near(manifold.points[0].penetration, 0.1, 1e-15));
  CHECK(near(manifold.points[0].position, Vec3(0, 0, 0.95), 1e-15));
  CHECK(collide({Sphere{1}}, at(0, 0, 0), {Sphere{0.5}}, at(0, 0, 1.6)).count == 0);
  CHECK(collide({Sphere{1}}, at(0, 0, 0), {Sphere{0.5}}, at(0, 0, 1.6), 0.2).count == 1);
}

TEST_CASE("a ball inside a box leaves through the nearest face") {
  const Manifold manifold = collide({Sphere{0.1}}, at(0.8, 0, 0), {Box{Vec3(1, 1, 1)}}, at(0, 0, 0));
  REQUIRE(manifold.count == 1);
  CHECK(near(manifold.normal, Vec3(-1, 0, 0), 1e-15));
  CHECK(near(manifold.points[0].penetration, 0.3, 1e-14));
}

TEST_CASE("a ball at a box's corner is pushed along the diagonal") {
  const Manifold manifold = collide({Box{Vec3(1, 1, 1)}}, at(0, 0, 0), {Sphere{1}}, at(1.5, 1.5, 1.5));
  REQUIRE(manifold.count == 1);
  CHECK(near(manifold.normal, Vec3(1, 1, 1) / std::sqrt(3.0), 1e-14));
  CHECK(near(manifold.points[0].penetration, 1 - std::sqrt(0.75), 1e-14));
}

TEST_CASE("a box resting on a plane or on a box has its four corners as contacts, with the same features every time") {
  const Shape box{Box{Vec3(0.5, 0.5, 0.5)}};
  const Shape floor_plane{Plane{}};
  const Shape floor_box{Box{Vec3(10, 1, 10)}};
  for (const double depth : {0.01, 0.0}) {
    const Manifold on_plane = collide(box, at(0, 0.5 - depth, 0), floor_plane, at(0, 0, 0), 1e-9);
    CHECK(on_plane.count == 4);
    CHECK(near(on_plane.normal, Vec3(0, -1, 0), 1e-15));
    CHECK(near(deepest(on_plane), depth, 1e-14));
    const Manifold on_box = collide(floor_box, at(0, -1, 0), box, at(0, 0.5 - depth, 0), 1e-9);
    CHECK(on_box.count == 4);
    CHECK(near(on_box.normal, Vec3(0, 1, 0), 1e-15));
    CHECK(near(deepest(on_box), depth, 1e-14));
  }
  const Manifold before = collide(box, at(0, 0.5, 0), box, at(0, 1.5, 0), 1e-3);
  const Manifold after =
      collide(box, at(1e-9, 0.5, -1e-9), box, turned(at(0, 1.5 + 1e-9, 0), Vec3(0, 1, 0), 1e-6), 1e-3);
  REQUIRE(before.count == 4);
  REQUIRE(after.count == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(before.points[i].feature == after.points[i].feature);
}

TEST_CASE("crossed box edges touch in one point midway") {
  // Both rolled by 45 degrees, one about x, one about z: their ridges cross at right angles.
  const Shape box{Box{Vec3(0.5, 0.5, 0.5)}};
  const double ridge = std::sqrt(0.5);
  const Manifold manifold = collide(box, turned(at(0, 0, 0), Vec3(1, 0, 0), 45), box,
                                    turned(at(0.1, 2 * ridge - 0.02, 0.05), Vec3(0, 0, 1), 45));
  REQUIRE(manifold.count == 1);
  CHECK(near(manifold.normal, Vec3(0, 1, 0), 1e-12));
  CHECK(near(manifold.points[0].penetration, 0.02, 1e-12));
  CHECK(near(manifold.points[0].position, Vec3(0.1, ridge - 0.01, 0), 1e-12));
}

TEST_CASE("a capsule lying on a face has two contacts, cut at the face's edges") {
  const Shape box{Box{Vec3(1, 1, 1)}};
  const Shape capsule{Capsule{0.25, 2}};
  const Pose lying = turned(at(0, 1.24, 0), Vec3(0, 0, 1), 90);
  const Manifold manifold = collide(box, at(0, 0, 0), capsule, lying);
  REQUIRE(manifold.count == 2);
  CHECK(near(manifold.normal, Vec3(0, 1, 0), 1e-12));
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(near(manifold.points[i].penetration, 0.01, 1e-12));
    CHECK(near(std::abs(manifold.points[i].position.x()), 1.0, 1e-12));
  }
  CHECK(near(std::abs(manifold.points[0].position.x() - manifold.points[1].position.x()), 2.0, 1e-12));
  const Manifold on_plane = collide(capsule, turned(at(0, 0.2, 0), Vec3(0, 0, 1), 90), {Plane{}}, at(0, 0, 0));
  REQUIRE(on_plane.count == 2);
  CHECK(near(on_plane.points[0].penetration, 0.05, 1e-12));
}

TEST_CASE("a capsule standing on a face has one contact below its end") {
  const Manifold manifold = collide({Box{Vec3(1, 1, 1)}}, at(0, 0, 0), {Capsule{0.25, 0.5}}, at(0.3, 1.7, 0.2));
  REQUIRE(manifold.count >= 1);
  CHECK(near(manifold.normal, Vec3(0, 1, 0), 1e-12));
  CHECK(near(deepest(manifold), 0.05, 1e-12));
}

TEST_CASE("capsules side by side have two contacts, crossed ones one") {
  const Shape capsule{Capsule{0.25, 1}};
  const Manifold beside = collide(capsule, at(0, 0, 0), capsule, at(0.45, 0.5, 0));
  REQUIRE(beside.count == 2);
  CHECK(near(beside.normal, Vec3(1, 0, 0), 1e-12));
  CHECK(near(beside.points[0].position.y(), -0.5, 1e-12));
  CHECK(near(beside.points[1].position.y(), 1.0, 1e-12));
  const Manifold crossed = collide(capsule, at(0, 0, 0), capsule, turned(at(0.4, 0, 0), Vec3(1, 0, 0), 90));
  REQUIRE(crossed.count == 1);
  CHECK(near(crossed.normal, Vec3(1, 0, 0), 1e-12));
  CHECK(near(crossed.points[0].penetration, 0.1, 1e-12));
}

TEST_CASE("a pair told the other way round has the opposite normal and the same points") {
  test::Random random(7);
  const Shape shapes[] = {{Sphere{0.4}}, {Box{Vec3(0.3, 0.5, 0.4)}}, {Capsule{0.2, 0.4}}};
  int touching = 0;
  for (int i = 0; i < 300; ++i) {
    const Shape& a = shapes[i % 3];
    const Shape& b = shapes[(i / 3) % 3];
    Pose pose_a = at(0, 0, 0), pose_b;
    pose_a.rotation = random.rotation();
    pose_b.rotation = random.rotation();
    pose_b.position = random.vector(0.7);
    const Manifold forth = collide(a, pose_a, b, pose_b);
    const Manifold back = collide(b, pose_b, a, pose_a);
    if (forth.count == 0 || back.count == 0) continue;
    ++touching;
    CHECK(std::abs(forth.normal.norm() - 1) < 1e-12);
    CHECK(std::abs(deepest(forth) - deepest(back)) < 5e-3);
    CHECK(forth.normal.dot(pose_b.position) > -0.5);
  }
  CHECK(touching > 50);
}
