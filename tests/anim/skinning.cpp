#include "anim/chains/chain_support.h"

#include <tweenfall/anim/skinning.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A mesh of points about a chain of joints, pulled by up to six of them, with two morph targets.
struct Limb {
  Hierarchy nodes = straight_chain(6, 0.5);
  Mesh mesh;
  Skin skin;

  explicit Limb(Random& random) {
    for (std::size_t i = 0; i < 6; ++i) {
      skin.joints.push_back(5 - i);
      skin.inverse_binds.push_back({Mat3::Identity(), {0, -0.5 * (5.0 - static_cast<double>(i)), 0}});
    }
    mesh.morphs.resize(2);
    for (int vertex = 0; vertex < 40; ++vertex) {
      const Vec3 place(random.between(-0.3, 0.3), random.between(0, 3), random.between(-0.3, 0.3));
      mesh.positions.push_back(place);
      mesh.normals.push_back(random.vector(1).normalized());
      mesh.tangents.emplace_back();
      mesh.tangents.back() << random.vector(1).normalized(), 1;
      for (std::size_t target = 0; target < 2; ++target) {
        mesh.morphs[target].position_offsets.push_back(random.vector(0.1));
        mesh.morphs[target].normal_offsets.push_back(random.vector(0.3));
        mesh.morphs[target].tangent_offsets.push_back(random.vector(0.3));
      }
      std::vector<Influence> pulls;
      double sum = 0;
      const int count = 1 + vertex % 6;
      for (int i = 0; i < count; ++i) {
        const auto joint = static_cast<std::uint32_t>((vertex + i) % 6);
        pulls.push_back({joint, random.unit()});
        sum += pulls.back().weight;
      }
      for (Influence& pull : pulls) pull.weight /= sum;
      mesh.influences.add(pulls);
    }
    mesh.rest_weights = {0, 0};
  }

  [[nodiscard]] std::vector<WorldMotion> world(std::span<const Motion> pose) const {
    std::vector<WorldMotion> motions(nodes.size());
    nodes.world_motions(pose, motions);
    return motions;
  }
  [[nodiscard]] std::vector<SkinJoint> joints(std::span<const Motion> pose) const {
    std::vector<SkinJoint> result(skin.joints.size());
    skin_joints(skin, world(pose), result);
    return result;
  }
};

struct Lists {
  std::vector<Vec3> positions, normals, tangents, velocities, normal_rates, tangent_rates;

  explicit Lists(std::size_t count)
      : positions(count),
        normals(count),
        tangents(count),
        velocities(count),
        normal_rates(count),
        tangent_rates(count) {}
  [[nodiscard]] DeformedMesh all() { return {positions, normals, tangents, velocities, normal_rates, tangent_rates}; }
};

SwingingPose scaled_swing(Random& random, const Hierarchy& nodes) {
  SwingingPose swing(random, nodes, 0.1, 0.8);
  for (SwingingMotion& node : swing.nodes) node.scale = swinging(random, {1, 1.1, 0.9}, 0.2);
  return swing;
}

}  // namespace

TEST_CASE("skinning by joints gives the positions that the joints' world motions give one by one") {
  Random random(1);
  const Limb limb(random);
  const SwingingPose swing = scaled_swing(random, limb.nodes);
  const std::vector<Motion> pose = swing.at(1);
  const std::vector<double> weights{0.3, -0.7};
  Lists lists(limb.mesh.positions.size());
  deform(limb.mesh, limb.joints(pose), {.weights = weights}, {.positions = lists.positions});
  std::vector<Vec3> expected(lists.positions.size());
  deform(limb.mesh, weights, &limb.skin, 0, limb.world(pose), expected);
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(near(lists.positions[i], expected[i], 1e-14));
}

TEST_CASE("velocities and the rates of normals and tangents are the derivatives of what is skinned") {
  Random random(2);
  const Limb limb(random);
  for (const SkinBlend blend : {SkinBlend::linear, SkinBlend::dual_quaternion}) {
    const SwingingPose swing = scaled_swing(random, limb.nodes);
    const Swing first{0.2, 0.5, 2, 0}, second{0, 0.8, 1.5, 1};
    const auto at = [&](double t) {
      Lists lists(limb.mesh.positions.size());
      const Sample<double> a = first.at(t), b = second.at(t);
      const std::vector<double> weights{a.value, b.value}, rates{a.rate, b.rate};
      deform(limb.mesh, limb.joints(swing.at(t)), {.blend = blend, .weights = weights, .weight_rates = rates},
             lists.all());
      return lists;
    };
    const Lists now = at(1);
    double worst = 0;
    for (std::size_t i = 0; i < now.positions.size(); ++i) {
      const auto error = [&](const std::vector<Vec3> Lists::*list, const Vec3& rate) {
        const Vec3 expected = difference([&](double t) -> Vec3 { return (at(t).*list)[i]; }, 1);
        worst = std::max(worst, (expected - rate).norm() / std::max(1.0, expected.norm()));
      };
      error(&Lists::positions, now.velocities[i]);
      error(&Lists::normals, now.normal_rates[i]);
      error(&Lists::tangents, now.tangent_rates[i]);
    }
    CHECK(worst < 1e-9);
  }
}

TEST_CASE("joints in their bind poses leave positions, normals and tangents as they are") {
  Random random(3);
  const Limb limb(random);
  for (const SkinBlend blend : {SkinBlend::linear, SkinBlend::dual_quaternion}) {
    Lists lists(limb.mesh.positions.size());
    deform(limb.mesh, limb.joints(rest_pose(limb.nodes)), {.blend = blend}, lists.all());
    for (std::size_t i = 0; i < lists.positions.size(); ++i) {
      CHECK(near(lists.positions[i], limb.mesh.positions[i], 1e-15));
      CHECK(near(lists.normals[i], limb.mesh.normals[i], 1e-15));
      CHECK(near(lists.tangents[i], limb.mesh.tangents[i].head<3>(), 1e-15));
    }
  }
}

TEST_CASE("a mesh that moves as one moves rigidly under both blends, whatever the signs of the joints' quaternions") {
  Random random(4);
  const Limb limb(random);
  std::vector<Motion> pose = rest_pose(limb.nodes);
  const Quat turn = exp_map({0, 3.1, 0.3});
  pose[0].pose = {{1, 2, 3}, turn, {1, 1, 1}};
  std::vector<SkinJoint> joints = limb.joints(pose);
  for (std::size_t i = 0; i < joints.size(); i += 2) joints[i].rotation.coeffs() *= -1;
  for (const SkinBlend blend : {SkinBlend::linear, SkinBlend::dual_quaternion}) {
    Lists lists(limb.mesh.positions.size());
    deform(limb.mesh, joints, {.blend = blend}, lists.all());
    for (std::size_t i = 0; i < lists.positions.size(); ++i) {
      CHECK(near(lists.positions[i], turn * limb.mesh.positions[i] + Vec3(1, 2, 3), 1e-14));
      CHECK(near(lists.normals[i], turn * limb.mesh.normals[i], 1e-14));
    }
  }
}

TEST_CASE("a limb that twists keeps its radius under dual quaternions and loses it linearly") {
  Mesh mesh;
  mesh.positions = {{0, 0.5, 0.2}};
  mesh.normals = {{0, 0, 1}};
  mesh.influences.add({{0, 0.5}, {1, 0.5}});
  for (const double twist : {0.1, 1.0, 2.0, 3.0}) {
    std::vector<SkinJoint> joints(2);
    WorldMotion turned;
    turned.linear = exp_map({0, twist, 0}).toRotationMatrix();
    joints[1] = skin_joint(turned);
    Lists lists(1);
    deform(mesh, joints, {.blend = SkinBlend::dual_quaternion},
           {.positions = lists.positions, .normals = lists.normals});
    const Vec3 half(std::sin(twist / 2), 0, std::cos(twist / 2));
    CHECK(near(lists.positions[0], Vec3(0, 0.5, 0) + 0.2 * half, 1e-15));
    CHECK(near(lists.normals[0], half, 1e-15));
    deform(mesh, joints, {}, {.positions = lists.positions});
    CHECK(near(lists.positions[0], Vec3(0, 0.5, 0) + 0.2 * std::cos(twist / 2) * half, 1e-15));
  }
}

TEST_CASE("dual quaternions go along the screw between two rigid motions") {
  // Half a turn about z at x = 1, and 4 along it: halfway it is a quarter of a turn there, and 2 along.
  Mesh mesh;
  mesh.positions = {{2, 0, 0}};
  mesh.influences.add({{0, 0.5}, {1, 0.5}});
  std::vector<SkinJoint> joints(2);
  WorldMotion screwed;
  screwed.linear = exp_map({0, 0, pi}).toRotationMatrix();
  screwed.motion.pose.position = {2, 0, 4};
  joints[1] = skin_joint(screwed);
  Lists lists(1);
  deform(mesh, joints, {.blend = SkinBlend::dual_quaternion}, {.positions = lists.positions});
  CHECK(near(lists.positions[0].cwiseAbs(), Vec3(1, 1, 2), 1e-15));
}

TEST_CASE("a joint that hardly pulls on a vertex does not turn the others against each other") {
  const auto about_z = [](double angle) {
    SkinJoint joint;
    joint.rotation = exp_map({0, 0, angle});
    joint.moved.linear = joint.rotation.toRotationMatrix();
    return joint;
  };
  const std::vector<SkinJoint> joints = {about_z(std::numbers::pi), about_z(0.1), about_z(-0.1)};
  Mesh mesh;
  mesh.positions = {{1, 0, 0}};
  mesh.influences.add({{0, 1e-6}, {1, 0.5}, {2, 0.5}});
  std::vector<Vec3> positions(1);
  deform(mesh, joints, {SkinBlend::dual_quaternion}, {.positions = positions});
  CHECK((positions[0] - Vec3(1, 0, 0)).norm() < 1e-5);
}

TEST_CASE("normals stay across a surface that is stretched, sheared or mirrored, and point to the same side of it") {
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    Mesh mesh;
    mesh.positions = {random.vector(1)};
    const Vec3 along = random.vector(1).normalized(), beside = along.cross(random.vector(1)).normalized();
    mesh.normals = {Vec3(along.cross(beside))};
    WorldMotion node;
    for (int column = 0; column < 3; ++column) node.linear.col(column) = random.vector(2);
    const std::vector<SkinJoint> joints{skin_joint(node)};
    Lists lists(1);
    deform(mesh, joints, {}, {.normals = lists.normals});
    CHECK(lists.normals[0].norm() == doctest::Approx(1));
    CHECK(std::abs(lists.normals[0].dot(node.linear * along)) < 1e-13);
    CHECK(std::abs(lists.normals[0].dot(node.linear * beside)) < 1e-13);
    CHECK(lists.normals[0].dot(node.linear * mesh.normals[0]) > 0);
    deform(mesh, joints, {.blend = SkinBlend::dual_quaternion},
           {.positions = lists.positions, .normals = lists.normals});
    CHECK(near(lists.positions[0], node.linear * mesh.positions[0], 1e-13));
    CHECK(std::abs(lists.normals[0].dot(node.linear * along)) < 1e-13);
  }
}

TEST_CASE("the normals of a ball that is stretched to an ellipsoid are those of the ellipsoid") {
  Random random(6);
  Mesh mesh;
  for (int i = 0; i < 50; ++i) mesh.positions.push_back(random.vector(1).normalized());
  mesh.normals = mesh.positions;
  WorldMotion node;
  node.linear = Vec3(2, 0.5, 1.5).asDiagonal();
  const std::vector<SkinJoint> joints{skin_joint(node)};
  Lists lists(mesh.positions.size());
  deform(mesh, joints, {}, {.positions = lists.positions, .normals = lists.normals});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3& p = lists.positions[i];
    CHECK(near(lists.normals[i], Vec3(p.x() / 4, p.y() / 0.25, p.z() / 2.25).normalized(), 1e-14));
  }
}

TEST_CASE("a joint that is shrunk to nothing leaves numbers") {
  Random random(7);
  const Limb limb(random);
  std::vector<Motion> pose = rest_pose(limb.nodes);
  pose[3].pose.scale = {0, 0, 0};
  pose[1].pose.scale = {1, 0, 1};
  for (const SkinBlend blend : {SkinBlend::linear, SkinBlend::dual_quaternion}) {
    Lists lists(limb.mesh.positions.size());
    deform(limb.mesh, limb.joints(pose), {.blend = blend}, lists.all());
    for (std::size_t i = 0; i < lists.positions.size(); ++i) {
      CHECK(lists.positions[i].allFinite());
      CHECK(lists.normals[i].allFinite());
      CHECK(lists.normal_rates[i].allFinite());
      CHECK(lists.tangent_rates[i].allFinite());
    }
  }
}

TEST_CASE("the quick bounds of a skinned mesh hold every vertex of it, and not much more") {
  Random random(8);
  const Limb limb(random);
  const SkinBounds quick(limb.mesh, limb.skin.joints.size());
  const SwingingPose swing = scaled_swing(random, limb.nodes);
  double largest = 0;
  for (int i = 0; i < 200; ++i) {
    const std::vector<SkinJoint> joints = limb.joints(swing.at(0.1 * i));
    const std::vector<double> weights{random.between(-2, 2), random.between(-2, 2)};
    Lists lists(limb.mesh.positions.size());
    deform(limb.mesh, joints, {.weights = weights}, {.positions = lists.positions});
    const MeshBounds bounds = quick.world(joints, weights), exact = bounds_of(lists.positions);
    for (const Vec3& position : lists.positions) CHECK(bounds.contains(position));
    CHECK(bounds.contains(exact.low));
    CHECK(bounds.contains(exact.high));
    CHECK(exact.contains(lists.positions[3]));
    largest = std::max(largest, (bounds.high - bounds.low).norm() / (exact.high - exact.low).norm());
  }
  CHECK(largest < 4);
}

TEST_CASE("the bounds of a mesh without skin are its box, and those of no points are empty") {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 2, 3}, {-1, 0, 1}};
  WorldMotion node;
  node.linear = Vec3(2, 1, -1).asDiagonal();
  node.motion.pose.position = {10, 0, 0};
  const std::vector<SkinJoint> joints{skin_joint(node)};
  const MeshBounds bounds = SkinBounds(mesh, 1).world(joints);
  CHECK(near(bounds.low, Vec3(8, 0, -3), 1e-13));
  CHECK(near(bounds.high, Vec3(12, 2, 0), 1e-13));
  CHECK_FALSE(bounds_of({}).contains({0, 0, 0}));
  Mesh pulled = mesh;
  for (int i = 0; i < 3; ++i) pulled.influences.add({{4, 1}});
  CHECK_THROWS_WITH_AS(SkinBounds(pulled, 4),
                       "skin bounds: vertex 0 is pulled by joint 4 with weight 1; there are 4 joints, and no "
                       "weight is negative",
                       std::invalid_argument);
}

TEST_CASE("weights that sum to less than one, as files round them, stay within the quick bounds") {
  Mesh mesh;
  mesh.positions = {{1, 1, 1}, {1, 1, 1}, {2, 2, 2}};
  mesh.influences.add({{0, 0.999}});
  mesh.influences.add({{0, 1.001}});
  mesh.influences.add(std::initializer_list<Influence>{});
  std::vector<SkinJoint> joints(2);
  joints[0].moved.origin = {5, -5, 0};
  std::vector<Vec3> positions(3);
  deform(mesh, joints, {}, {.positions = positions});
  const MeshBounds bounds = SkinBounds(mesh, 2).world(joints);
  for (const Vec3& position : positions) CHECK(bounds.contains(position));
}

TEST_CASE("a mesh with influences that hangs on a node without skin goes as its node does") {
  Random random(9);
  const Limb limb(random);
  std::vector<WorldMotion> world = limb.world(scaled_swing(random, limb.nodes).at(1));
  const std::vector<SkinJoint> joints{skin_joint(world[3])};
  std::vector<Vec3> expected(limb.mesh.positions.size());
  deform(limb.mesh, {}, nullptr, 3, world, expected);
  const MeshBounds bounds = SkinBounds(limb.mesh, 1).world(joints);
  for (const SkinBlend blend : {SkinBlend::linear, SkinBlend::dual_quaternion}) {
    Lists lists(expected.size());
    deform(limb.mesh, joints, {.blend = blend}, lists.all());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      CHECK(near(lists.positions[i], expected[i], 1e-14));
      CHECK(bounds.contains(expected[i]));
    }
  }
}
