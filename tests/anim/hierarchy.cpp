#include "support.h"

#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/curves/rotation.h>

#include "pose/frame_kernels.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A local motion that is a smooth function of time, and different for each seed.
Motion moving(std::uint64_t seed, double time) {
  Random random(seed);
  const Vec3 drift = random.vector(2), spin = random.vector(3), stretch = random.vector(0.4);
  const Quat start = random.rotation();
  Motion motion;
  motion.pose.position = random.vector(1) + time * drift;
  motion.pose.rotation = exp_map(time * spin) * start;
  motion.pose.scale = Vec3(1, 1, 1) + time * stretch;
  motion.twist = {drift, spin};
  motion.scale_rate = stretch;
  return motion;
}

Hierarchy chain(std::size_t length) {
  std::vector<Node> nodes;
  for (std::size_t i = 0; i < length; ++i) nodes.push_back({"link" + std::to_string(i), i == 0 ? no_node : i - 1, {}});
  return Hierarchy(std::move(nodes));
}

WorldMotion tip(const Hierarchy& nodes, double time) {
  return nodes.world_motion(nodes.size() - 1, [&](std::size_t i) { return moving(i + 1, time); });
}

}  // namespace

TEST_CASE("the world matrix of a chain is the product of its local matrices") {
  const Hierarchy nodes = chain(5);
  Eigen::Affine3d product = Eigen::Affine3d::Identity();
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Motion local = moving(i + 1, 0.3);
    product = product * Eigen::Translation3d(local.pose.position) * Eigen::Quaterniond(local.pose.rotation) *
              Eigen::Scaling(Eigen::Vector3d(local.pose.scale));
  }
  const WorldMotion world = tip(nodes, 0.3);
  CHECK(near(world.linear, product.linear(), 1e-13));
  CHECK(near(world.motion.pose.position, product.translation(), 1e-13));
}

TEST_CASE("rates of a turning, sliding and stretching chain equal a five-point stencil of its poses") {
  const Hierarchy nodes = chain(5);
  const double time = 0.2, h = 1e-3;
  const WorldMotion world = tip(nodes, time);
  const auto stencil = [&](auto read) {
    return ((8 * (read(tip(nodes, time + h)) - read(tip(nodes, time - h))) -
             (read(tip(nodes, time + 2 * h)) - read(tip(nodes, time - 2 * h)))) /
            (12 * h))
        .eval();
  };
  const Vec3 velocity = stencil([](const WorldMotion& w) { return w.motion.pose.position; });
  const Mat3 linear_rate = stencil([](const WorldMotion& w) { return w.linear; });
  CHECK(near(world.motion.twist.linear, velocity, 1e-9));
  CHECK(near(world.linear_rate, linear_rate, 1e-9));
  const Vec3 local(0.3, -0.2, 0.5);
  const Vec3 point_velocity = stencil([&](const WorldMotion& w) { return w.point(local); });
  CHECK(near(world.point_velocity(local), point_velocity, 1e-9));

  const Quat before = tip(nodes, time - h).motion.pose.rotation, after = tip(nodes, time + h).motion.pose.rotation;
  const Vec3 turned = log_map(after * before.conjugate()) / (2 * h);
  CHECK(near(world.motion.twist.angular, turned, 1e-4));  // the difference is the coarser one
}

TEST_CASE("one node's chain and the whole tree give the same bits") {
  const Hierarchy nodes = chain(200);  // longer than one stretch
  std::vector<Motion> local;
  for (std::size_t i = 0; i < nodes.size(); ++i) local.push_back(moving(i + 1, 0.01));
  std::vector<WorldMotion> world(nodes.size());
  nodes.world_motions(local, world);
  for (const std::size_t node : {std::size_t{0}, std::size_t{63}, std::size_t{64}, std::size_t{65}, std::size_t{199}}) {
    const WorldMotion alone = nodes.world_motion(node, [&](std::size_t i) { return local[i]; });
    CHECK(alone.motion.pose.position == world[node].motion.pose.position);
    CHECK(alone.linear_rate == world[node].linear_rate);
  }
}

TEST_CASE("frames have the bits of the motions, in a tree whose nodes turn, slide and stretch unevenly") {
  std::vector<Node> tree;
  for (std::size_t i = 0; i < 60; ++i) tree.push_back({"node" + std::to_string(i), i % 20 == 0 ? no_node : i / 2, {}});
  const Hierarchy nodes(std::move(tree));
  std::vector<Motion> local;
  for (std::size_t i = 0; i < nodes.size(); ++i) local.push_back(moving(i + 1, 0.1));
  std::vector<WorldMotion> motions(nodes.size());
  std::vector<WorldFrame> frames(nodes.size());
  nodes.world_motions(local, motions);
  nodes.world_frames(local, frames);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    CHECK(frames[i].linear == motions[i].linear);
    CHECK(frames[i].linear_rate == motions[i].linear_rate);
    CHECK(frames[i].origin == motions[i].motion.pose.position);
    CHECK(frames[i].velocity == motions[i].motion.twist.linear);
    const Vec3 local_point(0.3, -0.2, 0.5);
    CHECK(frames[i].point_velocity(local_point) == motions[i].point_velocity(local_point));
  }
}

TEST_CASE("every instruction set gives the same bits from local to world") {
  Random random(9);
  for (const std::size_t size : {1, 2, 67}) {
    std::vector<std::uint32_t> parents;
    std::vector<Motion> local;
    for (std::size_t i = 0; i < size; ++i) {
      const bool is_root = i == 0 || random.unit() < 0.05;
      const std::size_t parent =
          random.unit() < 0.5 ? i - 1 : static_cast<std::size_t>(random.unit() * static_cast<double>(i));
      parents.push_back(is_root ? pose::no_parent : static_cast<std::uint32_t>(parent));
      local.push_back(moving(i + 1, 0.1));
    }
    std::vector<WorldMotion> plain(size), wide(size), single(size);
    std::vector<WorldFrame> plain_frames(size), wide_frames(size);
    pose::plain_frame_kernels().motions(parents.data(), size, local.data(), plain.data());
    pose::fastest_frame_kernels().motions(parents.data(), size, local.data(), wide.data());
    pose::plain_frame_kernels().frames(parents.data(), size, local.data(), plain_frames.data());
    pose::fastest_frame_kernels().frames(parents.data(), size, local.data(), wide_frames.data());
    for (std::size_t i = 0; i < size; ++i)
      pose::plain_frame_kernels().child(parents[i] == pose::no_parent ? WorldMotion{} : single[parents[i]], local[i],
                                        single[i]);
    const auto same = [](const auto& a, const auto& b) {
      return std::ranges::equal(std::as_bytes(std::span(a)), std::as_bytes(std::span(b)));
    };
    CHECK(same(plain, wide));
    CHECK(same(plain, single));
    CHECK(same(plain_frames, wide_frames));
  }
}

TEST_CASE("the rotation of a long chain stays of unit length, also where rests are only nearly so") {
  const Hierarchy nodes = chain(1000);
  for (const double length : {1.0, 1 + 1e-10, 1 + 1e-8, 1.5, 1e-3}) {
    std::vector<Motion> local;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      local.push_back(moving(i + 1, 0));
      local.back().pose.scale = {1, 1, 1};
      local.back().pose.rotation.coeffs() *= length;
    }
    std::vector<WorldMotion> world(nodes.size());
    nodes.world_motions(local, world);
    for (const WorldMotion& node : world) CHECK(std::abs(node.motion.pose.rotation.squaredNorm() - 1) < 1e-15);
  }
}

TEST_CASE("a hierarchy refuses a name twice and a parent that comes later") {
  CHECK_THROWS_WITH_AS(Hierarchy({{"a", no_node, {}}, {"a", no_node, {}}}), "two nodes are named \"a\"",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Hierarchy({{"a", 1, {}}, {"b", no_node, {}}}),
                       "node \"a\" (number 0) has parent number 1; a parent must come before its children",
                       std::invalid_argument);
}

TEST_CASE("copies of a hierarchy grow apart, and each keeps what it had") {
  Hierarchy first = chain(5);
  first.add({"trunk", 0});
  std::vector<Hierarchy> copies(20, first);
  for (std::size_t i = 0; i < copies.size(); ++i)
    for (std::size_t k = 0; k <= i; ++k)
      CHECK(copies[i].add({"branch" + std::to_string(i) + "/" + std::to_string(k), 5 + k}) == 6 + k);
  CHECK(first.size() == 6);
  CHECK_FALSE(first.find("branch0/0"));
  for (std::size_t i = 0; i < copies.size(); ++i) {
    REQUIRE(copies[i].size() == 7 + i);
    for (std::size_t k = 0; k <= i; ++k)
      CHECK(copies[i].find("branch" + std::to_string(i) + "/" + std::to_string(k)) == 6 + k);
    CHECK_FALSE(copies[i].find("branch" + std::to_string(i + 1) + "/0"));
    CHECK(copies[i].find("link4") == 4);
    CHECK(copies[i][5].name == "trunk");
  }
  const Hierarchy moved = std::move(copies[3]);
  CHECK(moved.find("branch3/3") == 9);
  CHECK(copies[3].size() == 0);
  CHECK_FALSE(copies[3].find("link0"));
  CHECK(copies[3].add({"new", no_node}) == 0);
}

TEST_CASE("a thousand nodes added one by one are found by name, and of one name the latest") {
  Hierarchy nodes;
  for (std::size_t i = 0; i < 1000; ++i) {
    REQUIRE(nodes.add({"node" + std::to_string((i * 617) % 1000), i == 0 ? no_node : i / 2}) == i);
    CHECK_THROWS_AS(nodes.add({"node0"}), std::invalid_argument);
  }
  for (std::size_t i = 0; i < 1000; ++i) CHECK(nodes.find("node" + std::to_string((i * 617) % 1000)) == i);
  CHECK_FALSE(nodes.find("node1000"));
  CHECK_FALSE(nodes.find(""));
  for (std::size_t again = 1000; again < 1040; ++again) {
    CHECK(nodes.add_again({"node7", 3}) == again);
    CHECK(nodes.find("node7") == again);
    CHECK(nodes.find("node8").has_value());
  }
  CHECK(nodes[1010].name == "node7");
}
