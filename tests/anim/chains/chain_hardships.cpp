// All solvers and springs of chains: sizes from micrometers to thousands of kilometers, without memory allocation.

#include "anim/chains/chain_support.h"
#include "curves/counted_allocations.h"

#include <tweenfall/anim/foot_placement.h>
#include <tweenfall/anim/jiggle.h>
#include <tweenfall/anim/joint_chain.h>
#include <tweenfall/anim/look_at.h>
#include <tweenfall/anim/skinning.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr Sample<double> entirely{1, 0, 0};

JointChainSettings all_links(std::size_t count, ChainMethod method, const JointLimit& limit) {
  JointChainSettings settings{.links = {}, .method = method};
  for (std::size_t i = 0; i < count; ++i) settings.links.push_back({i, i + 1 < count ? limit : JointLimit{}});
  return settings;
}

}  // namespace

TEST_CASE("chains of any size solve as those of a meter do") {
  Random random(1);
  for (const double size : {1e-6, 1e-3, 1e3, 1e6}) {
    CAPTURE(size);
    const Hierarchy nodes = straight_chain(5, size);
    const TwoBoneChain two(nodes, {0, 1, 2, Vec3(1, 0, 0)});
    const LookAtChain looking(nodes, {.joints = {{1, 0.5}, {3}}, .eye = {0.1 * size, 0, 0}});
    const JointChain free(nodes, all_links(5, ChainMethod::fabrik, {}));
    const JointChain hinged(nodes, all_links(5, ChainMethod::ccd, ConeLimit{1.2, -0.5, 0.5}));
    for (int i = 0; i < 20; ++i) {
      const Vec3 near_by = size * random.vector(0.9) + size * Vec3(0, 0.5, 0);
      std::vector<Motion> pose = rest_pose(nodes);
      reach(two, {.target = still(near_by)}, entirely, pose);
      CHECK((world_of_node(nodes, 2, pose).motion.pose.position - near_by).norm() < 1e-12 * size);
      pose = rest_pose(nodes);
      reach(free, still(near_by), entirely, pose);
      CHECK((world_of_node(nodes, 4, pose).motion.pose.position - near_by).norm() < 1e-12 * size);
      pose = rest_pose(nodes);
      const Vec3 ahead = size * Vec3(random.between(-1, 1), random.between(2, 3), random.between(-1, 1));
      reach(hinged, still(ahead), entirely, pose);
      CHECK((world_of_node(nodes, 4, pose).motion.pose.position - ahead).norm() < 1e-9 * size);
      pose = rest_pose(nodes);
      const Vec3 far_off = random.rotation() * Vec3(20 * size, 0, 0);
      look_at(looking, {.target = still(far_off)}, entirely, pose);
      const WorldMotion head = world_of_node(nodes, 3, pose);
      const Vec3 sight = (far_off - head.point(looking.eye())).normalized();
      CHECK((head.motion.pose.rotation * looking.forward()).cross(sight).norm() < 1e-12);
    }
  }
}

TEST_CASE("long chains by descent do not flip where their target passes near the limit of their reach") {
  Random random(8);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    CAPTURE(i);
    Hierarchy nodes;
    double length = 0;
    for (std::size_t k = 0; k < 13; ++k) {
      Node node{.name = std::to_string(k), .parent = k == 0 ? no_node : k - 1};
      node.rest.rotation = random.rotation();
      if (k > 0) node.rest.position = random.rotation() * Vec3(random.between(0.2, 2), 0, 0);
      length += node.rest.position.norm();
      nodes.add(node);
    }
    const JointChain chain(nodes, all_links(13, ChainMethod::ccd, {}));
    const Vec3 from = random.vector(0.7 * length), to = random.vector(0.7 * length);
    const auto reached = [&](double share) {
      std::vector<Motion> pose = rest_pose(nodes);
      reach(chain, still(from + share * (to - from)), entirely, pose);
      return pose;
    };
    constexpr int steps = 50;
    std::vector<Motion> before = reached(0);
    for (int k = 0; k < steps; ++k) {
      double low = static_cast<double>(k) / steps, high = static_cast<double>(k + 1) / steps;
      std::vector<Motion> after = reached(high), next = after;
      for (int halved = 0; halved < 30 && difference_of(before, after) > 0.02; ++halved) {
        const double middle = (low + high) / 2;
        std::vector<Motion> there = reached(middle);
        const bool is_low = difference_of(before, there) > difference_of(there, after);
        (is_low ? high : low) = middle;
        (is_low ? after : before) = std::move(there);
      }
      worst = std::max(worst, difference_of(before, after));
      before = std::move(next);
    }
  }
  CHECK(worst <= 0.02);
}

TEST_CASE("a chain far from the origin reaches as well as coordinates there can tell") {
  Hierarchy nodes = straight_chain(4);
  const JointChain chain(nodes, all_links(4, ChainMethod::fabrik, {}));
  const TwoBoneChain two(nodes, {0, 1, 2, Vec3(1, 0, 0)});
  std::vector<Motion> pose = rest_pose(nodes);
  const Vec3 away(1e6, -1e6, 1e6);
  pose[0].pose.position = away;
  reach(chain, still(away + Vec3(1, 1, 1)), entirely, pose);
  CHECK((world_of_node(nodes, 3, pose).motion.pose.position - away - Vec3(1, 1, 1)).norm() < 1e-9);
  reach(two, {.target = still(away + Vec3(1, 1, 0))}, entirely, pose);
  CHECK((world_of_node(nodes, 2, pose).motion.pose.position - away - Vec3(1, 1, 0)).norm() < 1e-9);
}

TEST_CASE("nothing that chains, springs and skins do for a pose asks for memory") {
  const Hierarchy nodes = straight_chain(6);
  const TwoBoneChain two(nodes, {0, 1, 2, Vec3(1, 0, 0)});
  const LookAtChain looking(nodes, {.joints = {{1, 0.5}, {3}}, .limit = 1});
  const JointChain fabrik(nodes, all_links(6, ChainMethod::fabrik, {}));
  const JointChain limited(nodes, all_links(6, ChainMethod::ccd, HingeLimit{{1, 0, 0}, -0.5, 0.5}));
  const FootPlacement feet(nodes, {.pelvis = 0, .feet = {{.leg = {1, 2, 3, Vec3(1, 0, 0)}}}});
  const GroundAt ground = [](const Sample<Vec3>&) { return Ground{.height = 0.1}; };
  const NodeSpring spring(nodes, {.node = 3, .position = SpringSettings{}, .rotation = SpringSettings{}});
  const JiggleChain tail(nodes, {.joints = {1, 2, 3, 4, 5}});
  const PoseAt script = [&](double t, std::span<Motion> pose) {
    for (std::size_t i = 0; i < pose.size(); ++i) {
      pose[i].pose = nodes[i].rest;
      pose[i].pose.position.x() += t;
    }
  };
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 1, 0}};
  mesh.normals = {{1, 0, 0}, {1, 0, 0}};
  mesh.influences.add({{0, 1}});
  mesh.influences.add({{0, 0.5}, {1, 0.5}});
  const Skin skin{{0, 1}, {{}, {}}};
  const SkinBounds bounds(mesh, 2);
  std::vector<WorldMotion> world(nodes.size());
  std::vector<SkinJoint> joints(2);
  std::vector<Vec3> positions(2), normals(2);
  NodeSpringState spring_state = spring.at_rest(0);
  JiggleState tail_state = tail.at_rest(0);
  std::vector<Motion> pose = rest_pose(nodes), scratch(tail.scratch_size());

  const std::size_t before = allocations();
  for (int i = 0; i < 5; ++i) {
    const double t = 0.1 * i;
    const Sample<Vec3> target{{1 + t, 1, 4}, {1, 0, 0}, {0, 0, 0}};
    reach(two, {.target = target, .pole = target}, {0.5, 1, 0}, pose);
    look_at(looking, {.target = target, .up = target}, {0.5, 1, 0}, pose);
    reach(fabrik, target, {0.5, 1, 0}, pose);
    reach(limited, target, {0.5, 1, 0}, pose);
    place_feet(feet, ground, {0, 0, 0}, entirely, {}, pose);
    follow(spring, spring_state, t, script, entirely, scratch, pose);
    jiggle(tail, tail_state, t, script, entirely, scratch, pose);
    nodes.world_motions(pose, world);
    skin_joints(skin, world, joints);
    deform(mesh, joints, {.blend = SkinBlend::dual_quaternion}, {.positions = positions, .normals = normals});
    (void)bounds.world(joints);
  }
  CHECK(allocations() == before);
  CHECK(finite(pose));
}
