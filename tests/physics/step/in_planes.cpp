// Scenes that are their own mirror image in a plane: by symmetry nothing ever leaves it, or turns but about its normal.

#include <tweenfall/physics/world.h>

#include <array>
#include <numbers>

#include "support.h"

using namespace tweenfall;

namespace {

constexpr double never_asleep = std::numeric_limits<double>::infinity();

/// A solid, and the normal of a plane in which it is its own image, in its own axes.
struct SymmetricSolid {
  Solid solid;
  Vec3 normal;
};

/// A prism or a double pyramid over a polygon with corners anywhere, along z.
Solid symmetric_hull(test::Random& random, bool prism) {
  const double radius = random.between(0.15, 0.35), height = random.between(0.1, 0.4);
  const int corners = 3 + static_cast<int>(random.between(0, 4.999));
  std::vector<Vec3> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = (2 * std::numbers::pi * i + random.between(-0.3, 0.3)) / corners;
    const Vec3 corner(radius * std::cos(angle), radius * std::sin(angle), 0);
    points.push_back(corner + Vec3(0, 0, prism ? height : 0));
    if (prism) points.push_back(corner - Vec3(0, 0, height));
  }
  if (!prism) points.insert(points.end(), {Vec3(0.02, 0.03, height), Vec3(0.02, 0.03, -height)});
  return Hull{ConvexHull(points)};
}

constexpr int symmetric_kinds = 8;

SymmetricSolid symmetric_solid(test::Random& random, int kind) {
  const double a = random.between(0.1, 0.3), b = random.between(0.1, 0.4), c = random.between(0.1, 0.4),
               angle = random.between(0, 6), chosen = random.between(0, 1);
  const Vec3 around(std::cos(angle), 0, std::sin(angle)), along(0, 1, 0);
  switch (kind) {
    case 0:
      return {Sphere{a}, along};
    case 1:
      return {Box{Vec3(a, b, c)}, Vec3::Unit(static_cast<int>(2.999 * chosen))};
    case 2:
      return {Capsule{a, b}, chosen < 0.3 ? along : around};
    case 3:
      return {Cylinder{a, b}, chosen < 0.3 ? along : around};
    case 4:
      return {Cone{a, b}, around};
    case 5:
      return {TaperedCapsule{a, 0.5 * a, b}, around};
    default:
      return {symmetric_hull(random, kind == 6), Vec3(0, 0, 1)};
  }
}

/// Where a scene in the plane z = 0 is put.
struct PlaneToTry {
  const char* name;
  Quat turn;
};

std::vector<PlaneToTry> planes_to_try() {
  const Quat quarter = Quat(0.5, 0.5, 0.5, 0.5);
  return {{"z", Quat(1, 0, 0, 0)},
          {"x", quarter},
          {"y", quarter.conjugate()},
          {"upright", Quat(Eigen::AngleAxisd(0.7, Vec3(0, 1, 0)))},
          {"askew", Quat(0.3, -0.5, 0.7, 0.4).normalized()}};
}

/// Bodies that should stay in a plane.
class BodiesInPlane {
 public:
  BodiesInPlane(World& world, const Quat& turn) : world_(world), turn_(turn), normal_(turn * Vec3(0, 0, 1)) {}

  /// @param body  its place and velocity in the plane z = 0, with z up to here
  BodyId add(BodySettings body, const Vec3& normal, double angle) {
    const Quat upright = Quat::FromTwoVectors(normal, Vec3(0, 0, 1)), around(Eigen::AngleAxisd(angle, Vec3(0, 0, 1)));
    body.motion.pose.position = turn_ * body.motion.pose.position;
    body.motion.pose.rotation = (turn_ * (around * upright)).normalized();
    body.motion.twist = {turn_ * body.motion.twist.linear, turn_ * body.motion.twist.angular};
    const BodyId id = world_.add(body);
    bodies_.push_back({id, center_of(id), across_of(id)});
    return id;
  }
  /// How far the centers have left it, m, or bodies have turned out of it, rad.
  [[nodiscard]] double farthest() const {
    double most = 0;
    for (const auto& [id, center, across] : bodies_)
      most = std::max({most, std::abs(normal_.dot(center_of(id) - center)), (across_of(id) - across).norm()});
    return most;
  }

 private:
  struct Placed {
    BodyId id;
    Vec3 center, across;
  };
  [[nodiscard]] Vec3 center_of(BodyId id) const {
    const Pose pose = world_.motion(id).pose;
    return pose.position + pose.rotation * world_.mass(id).center;
  }
  [[nodiscard]] Vec3 across_of(BodyId id) const { return world_.motion(id).pose.rotation.conjugate() * normal_; }

  World& world_;
  Quat turn_;
  Vec3 normal_;
  std::vector<Placed> bodies_;
};

BodySettings solid_body(const Solid& solid, double mass, double friction, double restitution) {
  BodySettings body;
  body.shape.solid = solid;
  body.mass = mass;
  body.friction = friction;
  body.restitution = restitution;
  return body;
}

}  // namespace

TEST_CASE("two bodies of any shape that meet in a plane stay in it to a billionth of a meter, and turn in it alone") {
  test::Random random(21);
  for (const PlaneToTry& tried : planes_to_try()) {
    CAPTURE(tried.name);
    int left = 0;
    for (int run = 0; run < 2 * symmetric_kinds * symmetric_kinds; ++run) {
      World world({.gravity = Vec3::Zero(), .sleep_after = never_asleep});
      BodiesInPlane plane(world, tried.turn);
      const double friction = run % 3 == 0 ? 0 : random.between(0, 1), restitution = 0.25 * (run % 5);
      for (int i = 0; i < 2; ++i) {
        const SymmetricSolid symmetric =
            symmetric_solid(random, (i == 0 ? run : run / symmetric_kinds) % symmetric_kinds);
        BodySettings body = solid_body(symmetric.solid, 1 + i, friction, restitution);
        const double height = random.between(-0.2, 0.2), toward = random.between(-1, 1), up = random.between(-1, 1),
                     spin = random.between(-5, 5), angle = random.between(-3, 3);
        body.motion.pose.position = Vec3(1.2 * i, height, 0.3);
        body.motion.twist = {Vec3(i == 0 ? 4 : toward, up, 0), Vec3(0, 0, spin)};
        plane.add(body, symmetric.normal, angle);
      }
      for (int i = 0; i < 240; ++i) world.step(1.0 / 120);
      if (!(plane.farthest() < 1e-9)) ++left;
    }
    CHECK(left == 0);
  }
}

TEST_CASE("heaps of any shapes that fall in a plane onto the ground stay in it, and turn in it alone") {
  test::Random random(22);
  for (const PlaneToTry& tried : planes_to_try()) {
    CAPTURE(tried.name);
    double farthest = 0;
    for (int run = 0; run < 24; ++run) {
      World world({.gravity = tried.turn * Vec3(0, -9.81, 0), .sleep_after = run % 2 == 0 ? never_asleep : 0.5});
      BodySettings ground{.shape = {Box{Vec3(100, 1, 100)}}, .fixed = true};
      ground.motion.pose = {.position = tried.turn * Vec3(0, -1, 0), .rotation = tried.turn};
      if (run % 3 == 0) ground = {.shape = {Plane{tried.turn * Vec3(0, 1, 0)}}, .fixed = true};
      world.add(ground);
      BodiesInPlane plane(world, tried.turn);
      const double friction = run % 4 == 0 ? 0 : random.between(0, 1), restitution = 0.25 * (run % 5);
      const int count = 2 + run;
      for (int i = 0; i < count; ++i) {
        const double chosen = random.between(0, symmetric_kinds - 0.001), aside = random.between(-1, 1),
                     up = random.between(0, 0.3), angle = random.between(-3, 3), along = random.between(-2, 2),
                     spin = random.between(-5, 5);
        const SymmetricSolid symmetric = symmetric_solid(random, static_cast<int>(chosen));
        BodySettings body = solid_body(symmetric.solid, 1 + 0.1 * i, friction, restitution);
        body.motion.pose.position = Vec3(i % 3 + aside, 0.5 + 0.8 * (i / 3) + up, -0.7);
        if (i % 5 > 0) body.motion.twist = {Vec3(along, 0, 0), Vec3(0, 0, spin)};
        plane.add(body, symmetric.normal, angle);
      }
      for (int i = 0; i < 240; ++i) world.step(1.0 / (run % 2 == 0 ? 60 : 120));
      farthest = std::max(farthest, plane.farthest());
    }
    CHECK(farthest < 1e-9);
  }
}

TEST_CASE("what falls flat or on its rim in a plane at 4 m/s, so that it takes steps again in parts, stays in it") {
  test::Random random(24);
  for (const PlaneToTry& tried : planes_to_try()) {
    CAPTURE(tried.name);
    double farthest = 0;
    for (int run = 0; run < 60; ++run) {
      World world({.gravity = tried.turn * Vec3(0, -9.81, 0), .sleep_after = never_asleep});
      BodySettings ground{.shape = {Box{Vec3(20, 0.5, 20)}}, .fixed = true};
      ground.motion.pose = {.position = tried.turn * Vec3(0, -0.5, 0), .rotation = tried.turn};
      if (run % 2 == 0) ground = {.shape = {Plane{tried.turn * Vec3(0, 1, 0)}}, .fixed = true};
      world.add(ground);
      BodiesInPlane plane(world, tried.turn);
      const std::array<Solid, 5> solids = {Cylinder{0.15, 0.15}, Cylinder{0.05, 0.3}, Cone{0.15, 0.15},
                                           TaperedCapsule{0.12, 0.06, 0.15}, Box{Vec3(0.2, 0.02, 0.15)}};
      for (int i = 0; i < 1 + run % 3; ++i) {
        const double up = random.between(0, 4.0 / 60), spin = random.between(-5, 5), lean = random.between(-0.2, 0.2),
                     angle = random.between(-3, 3);
        BodySettings body = solid_body(solids[static_cast<std::size_t>((run + i) % 5)], 1, 0.5, 0.3);
        body.motion.pose.position = Vec3(0.35 * i, 0.6 + up, 0.4);
        body.motion.twist = {Vec3(0, -4, 0), Vec3(0, 0, spin)};
        plane.add(body, Vec3(0, 0, 1), run % 4 < 2 ? lean : angle);
      }
      for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
      farthest = std::max(farthest, plane.farthest());
    }
    CHECK(farthest < 1e-9);
  }
}

TEST_CASE("a body in a plane whose resting contacts are its own image still follows what pushes it out") {
  for (const Solid& solid : {Solid(Box{Vec3(0.3, 0.2, 0.4)}), Solid(Sphere{0.2}), Solid(Cylinder{0.3, 0.2})}) {
    World world({.sleep_after = never_asleep});
    world.add({.shape = {Plane{}}, .friction = 0, .fixed = true});
    BodySettings body = solid_body(solid, 2, 0, 0);
    body.motion.pose.position = Vec3(0, 0.2, 0);
    const BodyId id = world.add(body);
    for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
    CHECK(world.motion(id).pose.position.z() == 0);
    for (int i = 0; i < 60; ++i) {
      world.apply_force(id, Vec3(0, 0, 3), world.motion(id).pose.position);
      world.step(1.0 / 60);
    }
    // F t / m and F t^2 / (2 m)
    CHECK(world.twist(id).linear.z() == doctest::Approx(1.5).epsilon(1e-9));
    CHECK(world.motion(id).pose.position.z() == doctest::Approx(0.75).epsilon(1e-9));
  }
}

TEST_CASE("a body that lies still in balance falls as soon as what carries it is gone") {
  for (const Solid& solid : {Solid(Box{Vec3(0.3, 0.2, 0.4)}), Solid(Cylinder{0.3, 0.2})})
    for (const bool one : {false, true}) {
      World world({.sleep_after = never_asleep});
      std::vector<BodyId> carriers;
      for (const double side : one ? std::vector{0.0} : std::vector{-1.0, 1.0}) {
        BodySettings carrier{.shape = {Box{Vec3(1, 0.5, 1)}}, .friction = 0.5, .fixed = true};
        carrier.motion.pose.position = Vec3(side, -0.5, 0);
        carriers.push_back(world.add(carrier));
      }
      BodySettings body = solid_body(solid, 2, 0.5, 0);
      body.motion.pose.position = Vec3(0, 0.2, 0);
      const BodyId id = world.add(body);
      for (int i = 0; i < 120; ++i) world.step(1.0 / 60);
      CHECK(world.motion(id).pose.position.y() == doctest::Approx(0.2).epsilon(1e-3));
      CHECK(world.twist(id).linear.norm() < 1e-6);
      CHECK(world.twist(id).angular.norm() < 1e-6);
      for (const BodyId carrier : carriers) world.remove(carrier);
      const double before = world.motion(id).pose.position.y();
      for (int i = 0; i < 20; ++i) world.step(1.0 / 60);
      CHECK(before - world.motion(id).pose.position.y() == doctest::Approx(0.5 * 9.81 / 9).epsilon(1e-9));
    }
}

TEST_CASE("what comes from beside a plane takes what lay in it along") {
  World world({.gravity = Vec3::Zero(), .sleep_after = never_asleep});
  const BodyId box = world.add(solid_body(Box{Vec3(0.5, 0.5, 0.5)}, 1, 0, 1));
  BodySettings ball = solid_body(Sphere{0.5}, 1, 0, 1);
  ball.motion.pose.position = Vec3(0, 0, -2);
  ball.motion.twist.linear = Vec3(0, 0, 3);
  const BodyId thrown = world.add(ball);
  for (int i = 0; i < 60; ++i) world.step(1.0 / 60);
  // Equal masses exchange their velocities.
  CHECK((world.twist(box).linear - Vec3(0, 0, 3)).norm() < 1e-9);
  CHECK(world.twist(thrown).linear.norm() < 1e-9);
}

TEST_CASE("a chain on hinges about the normal of a plane that strikes boxes in it stays in it") {
  test::Random random(23);
  for (const PlaneToTry& tried : planes_to_try()) {
    CAPTURE(tried.name);
    World world({.gravity = tried.turn * Vec3(0, -9.81, 0), .sleep_after = never_asleep});
    world.add({.shape = {Plane{tried.turn * Vec3(0, 1, 0)}}, .fixed = true});
    BodiesInPlane plane(world, tried.turn);
    BodyId before;
    for (int i = 0; i < 5; ++i) {
      BodySettings link = solid_body(Capsule{0.06, 0.15}, 1, 0.5, 0.2);
      link.motion.pose.position = Vec3(0.2 + 0.4 * i, 2.2, 0);
      const BodyId id = plane.add(link, Vec3(0, 0, 1), 0.5 * std::numbers::pi);
      const Pose here = world.motion(id).pose, last = i == 0 ? Pose{} : world.motion(before).pose;
      const JointFrames frames =
          joint_frames(last, here, tried.turn * Vec3(0.4 * i, 2.2, 0), tried.turn * Vec3(0, 0, 1));
      world.add_joint({.a = before, .b = id, .frame_a = frames.a, .frame_b = frames.b, .kind = HingeJoint{}});
      before = id;
    }
    for (int i = 0; i < 6; ++i) {
      const double angle = random.between(-1, 1);
      BodySettings box = solid_body(Box{Vec3(0.2, 0.15, 0.3)}, 0.5, 0.5, 0.2);
      box.motion.pose.position = Vec3(-1 + 0.5 * (i % 3), 0.4 + 0.5 * (i / 3), 0);
      plane.add(box, Vec3(0, 0, 1), angle);
    }
    for (int i = 0; i < 360; ++i) world.step(1.0 / 120);
    CHECK(plane.farthest() < 1e-9);
  }
}

TEST_CASE("a box that spins about its middle axis alone, however the axis points, keeps spinning so") {
  for (const PlaneToTry& tried : planes_to_try()) {
    CAPTURE(tried.name);
    World world({.gravity = Vec3::Zero(), .sleep_after = never_asleep});
    BodiesInPlane plane(world, tried.turn);
    BodySettings box = solid_body(Box{Vec3(0.1, 0.4, 0.25)}, 1, 0, 0);
    box.motion.twist.angular = Vec3(0, 0, 10);
    plane.add(box, Vec3(0, 0, 1), 0.3);
    for (int i = 0; i < 1200; ++i) world.step(1.0 / 60);
    CHECK(plane.farthest() < 1e-9);
  }
}

TEST_CASE("a heap in a plane that is askew goes on in the same bits after it was copied, or saved and loaded") {
  const Quat turn = Quat(0.3, -0.5, 0.7, 0.4).normalized();
  World world({.gravity = turn * Vec3(0, -9.81, 0)});
  world.add({.shape = {Plane{turn * Vec3(0, 1, 0)}}, .fixed = true});
  BodiesInPlane plane(world, turn);
  for (int i = 0; i < 6; ++i) {
    BodySettings body = solid_body(i % 2 == 0 ? Solid(Cylinder{0.2, 0.3}) : Solid(Capsule{0.2, 0.2}), 1, 0.5, 0.3);
    body.motion.pose.position = Vec3(0.2 * i, 0.5 + 0.6 * i, 0);
    plane.add(body, Vec3(0, 0, 1), 0.4 * i);
  }
  World copied, loaded;
  for (int i = 0; i < 240; ++i) {
    if (i % 40 == 0) {
      copied = world;
      loaded.load(world.save());
    }
    for (World* one : {&world, &copied, &loaded}) one->step(1.0 / 60);
    REQUIRE(copied.state_hash() == world.state_hash());
    REQUIRE(loaded.state_hash() == world.state_hash());
  }
  CHECK(plane.farthest() < 1e-9);
}
