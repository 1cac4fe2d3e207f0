// What chains with limits do for targets that they cannot reach, against closed forms and a search of all poses.

#include "anim/chains/chain_support.h"

#include <tweenfall/anim/joint_chain.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr Sample<double> in_full{1, 0, 0};

double miss_of(const JointChain& chain, std::span<const Motion> pose, const Vec3& target) {
  return (world_of_node(chain.nodes(), chain.end(), pose).motion.pose.position - target).norm();
}

/// Three hinges about z that bend one way, and where their end is by the sines and cosines of their angles.
struct Finger {
  double bones[3], low[3], high[3];

  explicit Finger(Random& random) {
    for (int i = 0; i < 3; ++i) {
      bones[i] = random.between(0.5, 1);
      low[i] = random.between(-0.3, 0);
      high[i] = random.between(0.5, 1.6);
    }
  }
  [[nodiscard]] JointChain chain(ChainMethod method, bool leaps) const {
    Hierarchy nodes;
    JointChainSettings settings{.links = {}, .method = method, .leaps = leaps};
    for (std::size_t i = 0; i < 4; ++i) {
      Node node{.name = std::to_string(i), .parent = i == 0 ? no_node : i - 1};
      if (i > 0) node.rest.position = {bones[i - 1], 0, 0};
      nodes.add(node);
      settings.links.push_back({i, i < 3 ? JointLimit(HingeLimit{{0, 0, 1}, low[i], high[i]}) : JointLimit{}});
    }
    return JointChain(nodes, settings);
  }
  [[nodiscard]] Vec3 end(const double (&angles)[3]) const {
    Vec3 at(0, 0, 0);
    double direction = 0;
    for (int i = 0; i < 3; ++i) {
      direction += angles[i];
      at += bones[i] * Vec3(std::cos(direction), std::sin(direction), 0);
    }
    return at;
  }
  /// The least distance from `target` over all poses of a grid.
  [[nodiscard]] double nearest(const Vec3& target) const {
    constexpr int steps = 40;
    const auto angle = [&](int i, int step) { return low[i] + (high[i] - low[i]) * step / steps; };
    double least = INFINITY;
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; j <= steps; ++j)
        for (int k = 0; k <= steps; ++k)
          least = std::min(least, (end({angle(0, i), angle(1, j), angle(2, k)}) - target).norm());
    return least;
  }
};

}  // namespace

TEST_CASE("a chain that may leap comes as near to every target as the best pose of its limits") {
  Random random(21);
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    const Finger finger(random);
    const JointChain chain = finger.chain(i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd, true);
    const double far = i % 3 == 0 ? random.between(3, 100) : random.between(0, 3);
    const Vec3 target = far * (exp_map(Vec3(0, 0, random.between(0, 2 * pi))) * Vec3(1, 0, 0));
    std::vector<Motion> pose = rest_pose(chain.nodes());
    reach(chain, still(target), in_full, pose);
    CHECK(miss_of(chain, pose, target) < finger.nearest(target) + 1e-6);
  }
}

TEST_CASE("no small turn within the limits brings a chain that may leap nearer to what it does not reach") {
  Random random(22);
  int missed = 0;
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const Finger finger(random);
    const JointChain chain = finger.chain(i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd, true);
    const double far = random.between(0, 5);
    const Vec3 target = far * (exp_map(Vec3(0, 0, random.between(0, 2 * pi))) * Vec3(1, 0, 0));
    std::vector<Motion> pose = rest_pose(chain.nodes());
    reach(chain, still(target), in_full, pose);
    const double miss = miss_of(chain, pose, target);
    if (miss < 1e-6) continue;
    ++missed;
    double angles[3];
    for (std::size_t k = 0; k < 3; ++k) angles[k] = log_map(pose[k].pose.rotation).z();
    double nearest = miss;
    for (int k = 0; k < 500; ++k) {
      double near_by[3];
      for (int j = 0; j < 3; ++j)
        near_by[j] = std::clamp(angles[j] + random.between(-0.01, 0.01), finger.low[j], finger.high[j]);
      nearest = std::min(nearest, (finger.end(near_by) - target).norm());
    }
    CHECK(miss < nearest + 1e-6);
  }
  CHECK(missed > 100);
}

TEST_CASE("sockets that open little bend all the way toward a target far aside") {
  Random random(23);
  for (int i = 0; i < 100; ++i) {
    CAPTURE(i);
    const double swing = random.between(0.03, 0.3), aside = random.between(5 * swing, 2);
    constexpr std::size_t bones = 4;
    const Hierarchy nodes = straight_chain(bones + 1);
    JointChainSettings settings{.links = {}, .method = i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd};
    for (std::size_t k = 0; k <= bones; ++k)
      settings.links.push_back({k, k < bones ? JointLimit(ConeLimit{swing, -0.2, 0.2}) : JointLimit{}});
    const JointChain chain(nodes, settings);
    std::vector<Motion> pose = SwingingPose(random, nodes, 0, 0.2).at(1);
    const Quat around = exp_map(Vec3(0, random.between(0, 2 * pi), 0));
    const Vec3 target = 1000 * (around * Vec3(std::sin(aside), std::cos(aside), 0));
    reach(chain, still(target), in_full, pose);
    // For a target that far away, each joint bends toward it by its whole limit.
    Vec3 end(0, 0, 0);
    for (std::size_t k = 1; k <= bones; ++k) {
      const double lean = swing * static_cast<double>(k);
      end += around * Vec3(std::sin(lean), std::cos(lean), 0);
    }
    CHECK(miss_of(chain, pose, target) < (end - target).norm() + 1e-6);
  }
}
