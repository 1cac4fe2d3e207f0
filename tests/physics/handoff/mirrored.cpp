// Bodies below nodes whose scale mirrors (a scale of -1 along one axis), against products of 4 x 4 matrices.

#include "physics/handoff/scenes.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/ragdoll/ragdoll.h>

#include <Eigen/Geometry>

#include "stage/roster/scaled_shape.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// The tumbler, below a node that is half of a mirrored pair.
StageDescription mirrored_tumbler(const Vec3& above, const Vec3& own) {
  StageDescription stage = tumbler(1.0 / 60);
  stage.nodes[0].rest.scale = above;
  stage.nodes[1].rest.scale = own;
  stage.world.gravity = {0, -2, 0};
  return stage;
}

Eigen::Affine3d matrix_of(const Pose& pose) {
  return Eigen::Translation3d(pose.position) * Eigen::Quaterniond(pose.rotation) *
         Eigen::Scaling(Eigen::Vector3d(pose.scale));
}

/// Of the body's node, as its curves have it.
Eigen::Affine3d matrix_at(const Animation& animation, double time) {
  return matrix_of(animation.sample_node(0, time).pose) * matrix_of(animation.sample_node(1, time).pose);
}

/// Derivative by differences of the fourth order.
template <class F>
auto rate_of(const F& f, double t) {
  const double h = 2e-4;
  return ((8 * (f(t + h) - f(t - h)) - (f(t + 2 * h) - f(t - 2 * h))) / (12 * h)).eval();
}

/// The angular velocity of a matrix that turns without changing its size.
Vec3 spin_of(const Animation& animation, double time) {
  const Mat3 spin = rate_of([&](double t) { return Mat3(matrix_at(animation, t).linear()); }, time) *
                    matrix_at(animation, time).linear().inverse();
  return {spin(2, 1), spin(0, 2), spin(1, 0)};
}

const Vec3 sizes[] = {{-1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {-1, -1, 1}, {-0.5, -0.5, -0.5}, {2, -2, -2}, {1, 1, 1}};

}  // namespace

TEST_CASE("bodies below mirrored nodes follow, leave and rejoin their paths with the rates of the matrices") {
  const Vec3 at_center(0.3, -0.2, 0.1);
  for (const Vec3& above : sizes)
    for (const Vec3& own : {Vec3(1, 1, 1), Vec3(1, 1, -1), Vec3(-0.5, 0.5, 0.5)}) {
      CAPTURE(above.transpose());
      CAPTURE(own.transpose());
      StageDescription description = mirrored_tumbler(above, own);
      const double released = 0.9137, recovered = 1.2071;
      description.rules = {release_at(released, "body"),
                           recover_at(recovered, "body", {.settle = {Settle::Kind::quintic, 0.4}})};
      Stage stage(description);
      const NodeId body = stage.node("body");
      const Path path = stage.path(body);
      const Animation& animation = path.animation();
      const auto center_at = [&](double t) { return Vec3(matrix_at(animation, t) * at_center); };

      stage.advance_to(0.55);
      CHECK(near(stage.twist(body).linear, rate_of(center_at, 0.55), 1e-7));
      CHECK(near(stage.twist(body).angular, spin_of(animation, 0.55), 1e-7));
      const WorldMotion led = stage.world(body);
      CHECK(near(led.linear, matrix_at(animation, 0.55).linear(), 1e-12));
      CHECK(near(Mat3(led.motion.pose.rotation.toRotationMatrix() * led.motion.pose.scale.asDiagonal()), led.linear,
                 1e-12));

      stage.advance_to(released);
      REQUIRE(stage.handoffs().size() == 1);
      CHECK(near(stage.handoffs()[0].after.twist.linear, rate_of(center_at, released), 1e-7));
      CHECK(near(stage.handoffs()[0].after.twist.angular, spin_of(animation, released), 1e-7));
      CHECK(near(stage.world(body).linear, matrix_at(animation, released).linear(), 1e-12));

      stage.advance_to(recovered);
      REQUIRE(stage.handoffs().size() == 2);
      const HandOff& back = stage.handoffs()[1];
      CHECK(near(back.after.pose.position, back.before.pose.position, 1e-12));
      CHECK(near(back.after.pose.rotation, back.before.pose.rotation, 1e-12));
      CHECK(near(back.after.twist.linear, back.before.twist.linear, 1e-9));
      CHECK(near(back.after.twist.angular, back.before.twist.angular, 1e-9));

      stage.advance_to(1.65);
      CHECK(near(stage.world(body).linear, matrix_at(animation, 1.65).linear(), 1e-12));
      CHECK(near(stage.twist(body).linear, rate_of(center_at, 1.65), 1e-7));
      CHECK(near(stage.twist(body).angular, spin_of(animation, 1.65), 1e-7));
    }
}

TEST_CASE("shapes on mirrored nodes are where the matrices take them") {
  Random random(3);
  const auto any = [&](const auto& list) { return list[static_cast<std::size_t>(random.unit() * std::size(list))]; };
  for (int round = 0; round < 200; ++round) {
    CAPTURE(round);
    Hierarchy nodes;
    Eigen::Affine3d matrix = Eigen::Affine3d::Identity();
    std::vector<Motion> local;
    for (std::size_t i = 0; i < 4; ++i) {
      const Pose rest{random.vector(1), random.rotation(), any(sizes)};
      nodes.add({"node" + std::to_string(i), i == 0 ? no_node : i - 1, rest});
      local.push_back({.pose = rest});
      matrix = matrix * matrix_of(rest);
    }
    const Pose node = nodes.world_motion(3, [&](std::size_t i) { return local[i]; }).motion.pose;
    const Vec3 scale = staging::rest_scale(staging::rest_axes(nodes, 3));
    CHECK(near(scale, node.scale, 1e-14));
    const Pose rigid{node.position, node.rotation}, offset{random.vector(0.5), random.rotation()};
    const double size = std::abs(scale.x());
    const auto placed = [&](const Vec3& point) { return Vec3(matrix * (offset.position + offset.rotation * point)); };

    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) corners.push_back({i & 1 ? 0.3 : -0.3, i & 2 ? 0.2 : -0.2, i & 4 ? 0.1 : -0.1});
    const auto extent = [&](const std::vector<Vec3>& points, const std::vector<double>& radii) {
      Bounds found{placed(points[0]), placed(points[0])};
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Vec3 around = Vec3::Constant(radii[i] * size);
        found.low = found.low.cwiseMin(placed(points[i]) - around);
        found.high = found.high.cwiseMax(placed(points[i]) + around);
      }
      return found;
    };
    const auto check_at = [&](const Solid& solid, const Bounds& expected) {
      CAPTURE(solid.index());
      const Bounds found = bounds(staging::scaled({solid, offset}, scale), rigid);
      CHECK(near(found.low, expected.low, 1e-12));
      CHECK(near(found.high, expected.high, 1e-12));
    };
    check_at(Box{{0.3, 0.2, 0.1}}, extent(corners, std::vector<double>(8, 0)));
    corners.erase(corners.begin() + 2);
    check_at(Hull{ConvexHull(corners)}, extent(corners, std::vector<double>(7, 0)));
    check_at(TaperedCapsule{0.2, 0.1, 0.3}, extent({{0, -0.3, 0}, {0, 0.3, 0}}, {0.2, 0.1}));
    check_at(Capsule{0.1, 0.3}, extent({{0, -0.3, 0}, {0, 0.3, 0}}, {0.1, 0.1}));

    const Vec3 normal = Vec3(random.vector(1) + Vec3(0, 2, 0)).normalized();
    const Shape plane = staging::scaled({Plane{normal, 0.4}, offset}, scale);
    const Plane& moved = std::get<Plane>(plane.solid);
    const auto height = [&](const Vec3& point) {  // above the plane
      const Vec3 on_node = rigid.rotation.conjugate() * Vec3(point - rigid.position);
      return moved.normal.dot(plane.offset.rotation.conjugate() * Vec3(on_node - plane.offset.position)) - moved.offset;
    };
    const Vec3 along = normal.unitOrthogonal(), across = normal.cross(along);
    for (const Vec3& point : {Vec3(0, 0, 0), along, across})
      for (const double above : {0.0, 0.5})
        CHECK(near(height(placed((0.4 + above) * normal + point)), above * size, 1e-12));
  }
}

TEST_CASE("a figure of bodies with mirrored joints gives back the pose that it was made of") {
  Random random(8);
  for (int round = 0; round < 20; ++round) {
    Hierarchy nodes;
    std::vector<Motion> local;
    std::vector<RagdollBone> bones;
    for (std::size_t i = 0; i < 5; ++i) {
      const Vec3 scale = sizes[static_cast<std::size_t>(random.unit() * std::size(sizes))];
      nodes.add({"node" + std::to_string(i), i == 0 ? no_node : i - 1, {random.vector(1), random.rotation(), scale}});
      local.push_back({.pose = {nodes[i].rest.position, random.rotation(), scale},
                       .twist = {i == 0 ? random.vector(1) : Vec3(0, 0, 0), random.vector(1)}});
      bones.push_back({.node = i, .parent = i == 0 ? no_bone : i - 1, .shape = {Sphere{0.01}}, .mass = 1});
    }
    std::vector<WorldMotion> world(nodes.size());
    nodes.world_motions(local, world);
    World simulated;
    const Ragdoll ragdoll(simulated, bones, world);
    std::vector<Motion> given = local;
    for (Motion& motion : given) motion.pose.rotation = random.rotation();
    ragdoll.pose(simulated, nodes, given);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      CHECK(near(given[i].pose.rotation, local[i].pose.rotation, 1e-13));
      CHECK(near(given[i].pose.position, local[i].pose.position, 1e-12));
      CHECK(near(given[i].twist.angular, local[i].twist.angular, 1e-12));
    }
  }
}
