// Motions in the world below nodes whose scale mirrors, against products of 4 x 4 matrices.

#include <tweenfall/anim/hierarchy.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "anim/moving_pose.h"
#include "pose/frame_kernels.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A local motion that is a smooth function of time; its scale is uniform but for signs.
Motion mirrored_joint(Random& random, double time) {
  Motion motion = moving_joint(random, time);
  const double rate = random.between(-0.2, 0.2), size = random.between(0.7, 1.3) + time * rate;
  for (int i = 0; i < 3; ++i) {
    const double sign = random.unit() < 0.3 ? -1 : 1;
    motion.pose.scale[i] = sign * size;
    motion.scale_rate[i] = sign * rate;
  }
  return motion;
}

std::vector<Motion> mirrored_pose(std::uint64_t seed, std::size_t count, double time) {
  Random random(seed);
  std::vector<Motion> pose;
  for (std::size_t i = 0; i < count; ++i) pose.push_back(mirrored_joint(random, time));
  return pose;
}

Hierarchy random_tree(std::uint64_t seed, std::size_t count) {
  Random random(seed);
  Hierarchy nodes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto parent = static_cast<std::size_t>(random.unit() * static_cast<double>(i));
    nodes.add({"node" + std::to_string(i), i == 0 || random.unit() < 0.1 ? no_node : parent, {}});
  }
  return nodes;
}

}  // namespace

TEST_CASE("below nodes that mirror, rotation and scale in the world are the factors of the product of all matrices") {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    CAPTURE(seed);
    const Hierarchy nodes = random_tree(seed, 12);
    const auto world_at = [&](double time) {
      std::vector<WorldMotion> world(nodes.size());
      nodes.world_motions(mirrored_pose(seed, nodes.size(), time), world);
      return world;
    };
    const std::vector<Motion> local = mirrored_pose(seed, nodes.size(), 0.2);
    const std::vector<WorldMotion> world = world_at(0.2);
    std::vector<Eigen::Affine3d> product;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const Eigen::Affine3d own = Eigen::Translation3d(local[i].pose.position) *
                                  Eigen::Quaterniond(local[i].pose.rotation) *
                                  Eigen::Scaling(Eigen::Vector3d(local[i].pose.scale));
      const std::size_t parent = nodes[i].parent;
      product.push_back(parent == no_node ? own : Eigen::Affine3d(product[parent] * own));
      const Motion& motion = world[i].motion;
      const Mat3 turned = motion.pose.rotation.toRotationMatrix();
      CHECK(near(world[i].linear, product[i].linear(), 1e-13));
      CHECK(near(motion.pose.position, product[i].translation(), 1e-13));
      CHECK(near(Mat3(turned * motion.pose.scale.asDiagonal()), product[i].linear(), 1e-13));

      // M' = [w]x M + R S', so that what is left of the rate is the scale's.
      Mat3 spin;
      const Vec3& w = motion.twist.angular;
      spin << 0, -w.z(), w.y(), w.z(), 0, -w.x(), -w.y(), w.x(), 0;
      const Mat3 rate = spin * world[i].linear + turned * motion.scale_rate.asDiagonal();
      CHECK(near(world[i].linear_rate, rate, 1e-12));
      CHECK(near(world[i].linear_rate, slope([&](double t) { return Mat3(world_at(t)[i].linear); }, 0.2), 1e-8));
      check_rates([&](double t) { return world_at(t)[i].motion; }, 0.2, 1e-8);

      // From local to world and back.
      const Motion above = parent == no_node ? Motion{} : world[parent].motion;
      CHECK(near(relative_to(above, motion), local[i], 1e-11));
      CHECK(near(compose(above, local[i]), motion, 1e-12));
    }
  }
}

TEST_CASE("every instruction set gives the same bits below nodes that mirror") {
  const Hierarchy nodes = random_tree(5, 67);
  std::vector<std::uint32_t> parents;
  for (const Node& node : nodes.nodes())
    parents.push_back(node.parent == no_node ? pose::no_parent : static_cast<std::uint32_t>(node.parent));
  const std::vector<Motion> local = mirrored_pose(6, nodes.size(), 0.1);
  std::vector<WorldMotion> plain(nodes.size()), fastest(nodes.size());
  pose::plain_frame_kernels().motions(parents.data(), nodes.size(), local.data(), plain.data());
  pose::fastest_frame_kernels().motions(parents.data(), nodes.size(), local.data(), fastest.data());
  CHECK(std::ranges::equal(std::as_bytes(std::span(plain)), std::as_bytes(std::span(fastest))));
}
