#include "anim/chains/chain_support.h"

#include <tweenfall/anim/joint_chain.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr Sample<double> wholly{1, 0, 0};

JointChainSettings links(std::size_t count, ChainMethod method, const JointLimit& limit = {}) {
  JointChainSettings settings{.links = {}, .method = method};
  for (std::size_t i = 0; i < count; ++i) settings.links.push_back({i, i + 1 < count ? limit : JointLimit{}});
  return settings;
}

double missed(const JointChain& chain, std::span<const Motion> pose, const Vec3& target) {
  return (world_of_node(chain.nodes(), chain.end(), pose).motion.pose.position - target).norm();
}

/// A chain whose nodes are turned, scaled and of different lengths at rest.
Hierarchy odd_chain(Random& random, std::size_t count) {
  Hierarchy nodes;
  for (std::size_t i = 0; i < count; ++i) {
    Node node{.name = std::to_string(i), .parent = i == 0 ? no_node : i - 1};
    node.rest.rotation = exp_map(random.vector(0.4));
    const double size = random.between(0.9, 1.1);
    node.rest.scale = Vec3(size, size, size);
    if (i > 0) node.rest.position = random.rotation() * Vec3(random.between(0.3, 1), 0, 0);
    nodes.add(node);
  }
  return nodes;
}

/// Whether a joint keeps its limit, computed from its own angles.
void check_limit(const JointChain::Joint& joint, const Quat& local, double tolerance) {
  const Quat turn = joint.rest.conjugate() * local;
  if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit)) {
    const Vec3 r = log_map(turn);
    CHECK(r.cross(hinge->axis).norm() < tolerance);
    CHECK(r.dot(hinge->axis) > hinge->low - tolerance);
    CHECK(r.dot(hinge->axis) < hinge->high + tolerance);
  } else if (const auto* cone = std::get_if<ConeLimit>(&joint.limit)) {
    const Vec3 bone = turn * joint.bone;
    CHECK(std::atan2(bone.cross(joint.bone).norm(), bone.dot(joint.bone)) < cone->swing + tolerance);
    const double twist = std::remainder(2 * std::atan2(turn.vec().dot(joint.bone), turn.w()), 2 * pi);
    CHECK(twist > cone->twist_low - tolerance);
    CHECK(twist < cone->twist_high + tolerance);
  }
}

/// A rotation of a joint within its limits.
Quat allowed(Random& random, const JointChain::Joint& joint) {
  if (const auto* hinge = std::get_if<HingeLimit>(&joint.limit))
    return joint.rest * exp_map(random.between(hinge->low, hinge->high) * hinge->axis);
  if (const auto* cone = std::get_if<ConeLimit>(&joint.limit)) {
    const Vec3 across = joint.bone.cross(random.vector(1)).normalized();
    const double swing = random.between(0, cone->swing), twist = random.between(cone->twist_low, cone->twist_high);
    return joint.rest * exp_map(swing * across) * exp_map(twist * joint.bone);
  }
  return random.rotation();
}

/// Joints of which `hinges` have a random hinge, and the others a random cone.
JointChainSettings limited_links(Random& random, std::size_t count, double hinges) {
  JointChainSettings settings = links(count, ChainMethod::fabrik);
  for (std::size_t joint = 0; joint + 1 < count; ++joint) {
    const Vec3 axis = random.vector(1);
    const double low = random.between(-2, 0), high = random.between(0, 2), swing = random.between(0.3, 1.5);
    if (random.unit() < hinges)
      settings.links[joint].limit = HingeLimit{axis, low, high};
    else
      settings.links[joint].limit = ConeLimit{swing, low, high};
  }
  return settings;
}

/// Where the end of a chain is in some pose within its limits.
Vec3 reachable(Random& random, const JointChain& chain) {
  std::vector<Motion> pose = test::rest_pose(chain.nodes());
  for (const JointChain::Joint& joint : chain.joints()) pose[joint.node].pose.rotation = allowed(random, joint);
  return world_of_node(chain.nodes(), chain.end(), pose).motion.pose.position;
}

}  // namespace

TEST_CASE("chains of joints without limits reach every target within reach to 1e-12 of their length") {
  Random random(1);
  double worst = 0;
  for (int i = 0; i < 600; ++i) {
    const std::size_t count = 3 + static_cast<std::size_t>(i) % 9;
    const Hierarchy nodes = odd_chain(random, count);
    const JointChain chain(nodes, links(count, i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd));
    std::vector<Motion> pose = SwingingPose(random, nodes, 0, 1).at(random.between(0, 9));
    // Where the end of another pose of the same lengths is.
    const Vec3 target = world_of_node(nodes, chain.end(), SwingingPose(random, nodes, 0, 3).at(random.between(0, 9)))
                            .motion.pose.position;
    reach(chain, still(target), wholly, pose);
    CAPTURE(count);
    const double error = missed(chain, pose, target) / static_cast<double>(count);
    CHECK(error < 1e-12);
    worst = std::max(worst, error);
  }
  MESSAGE("largest error: ", worst);
}

TEST_CASE("a chain without limits stretches to what is too far, and folds before what is too near") {
  for (const ChainMethod method : {ChainMethod::fabrik, ChainMethod::ccd}) {
    Hierarchy nodes = straight_chain(4);
    std::vector<Motion> pose = rest_pose(nodes);
    const JointChain chain(nodes, links(4, method));
    for (const Vec3& way : {Vec3(3, 0, 0), Vec3(0, -3.0000001, 0), Vec3(1e6, 1e6, 0)}) {
      reach(chain, moving(way, {1, 2, 3}), wholly, pose);
      CHECK(finite(pose));
      CHECK(missed(chain, pose, way) == doctest::Approx(way.norm() - 3).epsilon(1e-9));
    }
    // Bones of 1, 3 and 1 get no nearer than 1.
    pose[2].pose.position = {0, 3, 0};
    for (const Vec3& way : {Vec3(0.5, 0, 0), Vec3(0, -0.2, 0.1), Vec3(0, 0, 0)}) {
      reach(chain, moving(way, {1, 2, 3}), wholly, pose);
      CHECK(finite(pose));
      CHECK(missed(chain, pose, way) == doctest::Approx(1 - way.norm()).epsilon(1e-9));
    }
  }
}

TEST_CASE("a chain without limits reaches what lies just before its reach, and what it must fold up for") {
  Random random(7);
  double worst = 0;
  for (int i = 0; i < 3000; ++i) {
    const std::size_t count = 3 + static_cast<std::size_t>(i) % 11;
    const bool even = i % 2 == 0;
    const Hierarchy nodes = even ? straight_chain(count) : odd_chain(random, count);
    const JointChain chain(nodes, links(count, i % 4 < 2 ? ChainMethod::fabrik : ChainMethod::ccd));
    std::vector<Motion> pose = rest_pose(nodes);
    for (Motion& motion : pose) motion.pose.rotation = random.rotation();
    double reach_of = 0, longest = 0, scale = 1;
    for (std::size_t k = 1; k < count; ++k) {
      scale *= nodes[k - 1].rest.scale.x();
      const double bone = scale * nodes[k].rest.position.norm();
      reach_of += bone;
      longest = std::max(longest, bone);
    }
    const double nearest = std::max(0.0, 2 * longest - reach_of), share = std::pow(10, random.between(-9, -1));
    const double far = nearest + (i % 3 == 0 ? share : 1 - share) * (reach_of - nearest);
    const Vec3 target = far * (random.rotation() * Vec3(1, 0, 0));
    CAPTURE(count);
    CAPTURE(share);
    reach(chain, still(target), wholly, pose);
    const double error = missed(chain, pose, target) / reach_of;
    CHECK(error < 1e-7);
    worst = std::max(worst, error);
  }
  MESSAGE("largest error: ", worst);
}

TEST_CASE("a chain that lies straight on the line to its target bends to reach it") {
  for (const ChainMethod method : {ChainMethod::fabrik, ChainMethod::ccd}) {
    for (const std::size_t count : {3, 5, 10, 40}) {
      const Hierarchy nodes = straight_chain(count);
      const JointChain chain(nodes, links(count, method));
      const double length = static_cast<double>(count) - 1;
      for (const double share : {0.999999, 0.99, 0.5, 0.1, 0.0, -0.5, -0.999}) {
        CAPTURE(count);
        CAPTURE(share);
        std::vector<Motion> pose = rest_pose(nodes);
        const Vec3 target(0, share * length, 0);
        reach(chain, still(target), wholly, pose);
        CHECK(missed(chain, pose, target) < 1e-10 * length);
      }
    }
  }
}

TEST_CASE("chains with hinges and cones that may leap reach what their limits let them, and keep to these") {
  Random random(3);
  for (const double hinges : {0.5, 1.0}) {
    int reached = 0, tried = 0;
    for (int i = 0; i < 1500; ++i) {
      const std::size_t count = 4 + static_cast<std::size_t>(i) % 5;
      const Hierarchy nodes = odd_chain(random, count);
      JointChainSettings settings = limited_links(random, count, hinges);
      settings.method = i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd;
      settings.leaps = true;
      const JointChain chain(nodes, settings);
      const Vec3 target = reachable(random, chain);
      std::vector<Motion> pose = SwingingPose(random, nodes, 0, 1).at(1);
      reach(chain, still(target), wholly, pose);
      REQUIRE(finite(pose));
      for (const JointChain::Joint& joint : chain.joints()) check_limit(joint, pose[joint.node].pose.rotation, 1e-9);
      ++tried;
      if (missed(chain, pose, target) < 1e-6 * static_cast<double>(count)) ++reached;
    }
    MESSAGE("share of hinges ", hinges, ": reached ", reached, " of ", tried);
    CHECK(reached == tried);
  }
}

TEST_CASE("chains of sockets reach what their limits let them without leaping, and others nearly all of it") {
  Random random(13);
  for (const double hinges : {0.0, 0.5}) {
    int missed_ones = 0;
    for (int i = 0; i < 400; ++i) {
      const std::size_t count = 4 + static_cast<std::size_t>(i) % 5;
      const Hierarchy nodes = odd_chain(random, count);
      JointChainSettings settings = limited_links(random, count, hinges);
      settings.method = i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd;
      settings.leaps = false;
      const JointChain chain(nodes, settings);
      const Vec3 target = reachable(random, chain);
      std::vector<Motion> pose = SwingingPose(random, nodes, 0, 1).at(1);
      reach(chain, still(target), wholly, pose);
      for (const JointChain::Joint& joint : chain.joints()) check_limit(joint, pose[joint.node].pose.rotation, 1e-9);
      if (missed(chain, pose, target) > 1e-6 * static_cast<double>(count)) ++missed_ones;
    }
    MESSAGE("share of hinges ", hinges, ": missed ", missed_ones, " of 400");
    CHECK(missed_ones <= (hinges > 0 ? 4 : 0));
  }
}

TEST_CASE("long chains of sockets reach what their limits let them without leaping") {
  Random random(96);
  for (const std::size_t count : {30, 65})
    for (int i = 0; i < 60; ++i) {
      CAPTURE(count);
      CAPTURE(i);
      const Hierarchy nodes = odd_chain(random, count);
      JointChainSettings settings = limited_links(random, count, 0);
      settings.method = i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd;
      settings.leaps = false;
      const JointChain chain(nodes, settings);
      const Vec3 target = reachable(random, chain);
      std::vector<Motion> pose = SwingingPose(random, nodes, 0, 1).at(1);
      reach(chain, still(target), wholly, pose);
      CHECK(missed(chain, pose, target) < 1e-6 * static_cast<double>(count));
    }
}

TEST_CASE("chains with hinges and cones that do not leap hardly ever flip on a line, within reach and beyond") {
  Random random(11);
  int flips = 0;
  for (int line = 0; line < 60; ++line) {
    CAPTURE(line);
    const std::size_t count = 4 + static_cast<std::size_t>(line) % 5;
    const Hierarchy nodes = odd_chain(random, count);
    JointChainSettings settings = limited_links(random, count, 0.5 * (line / 5 % 2));
    settings.method = line % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd;
    settings.leaps = false;
    const JointChain chain(nodes, settings);
    const Vec3 from = reachable(random, chain), to = reachable(random, chain);
    const Vec3 way = line % 3 == 0 ? Vec3(to - from) : line % 3 == 1 ? Vec3(2 * (to - from)) : random.vector(2);
    const std::vector<Motion> before =
        line % 4 < 2 ? rest_pose(nodes) : std::vector<Motion>(SwingingPose(random, nodes, 0, 0.6).at(1));
    const auto solved = [&](double share) {
      std::vector<Motion> pose = before;
      reach(chain, still(from + share * way), wholly, pose);
      return pose;
    };
    constexpr int parts = 80;
    std::vector<Motion> last = solved(0);
    for (int i = 1; i <= parts; ++i) {
      double low = (i - 1.0) / parts, high = i * 1.0 / parts;
      std::vector<Motion> a = last, b = solved(high);
      last = b;
      // If much happens between two places, it must not happen at once.
      if (difference_of(a, b) < 0.03) continue;
      while (high - low > 1e-9) {
        const double middle = 0.5 * (low + high);
        std::vector<Motion> between = solved(middle);
        if (difference_of(a, between) > difference_of(between, b)) {
          high = middle;
          b = std::move(between);
        } else {
          low = middle;
          a = std::move(between);
        }
      }
      if (difference_of(a, b) > 2e-3) ++flips;
    }
  }
  // What is nearest may itself change sides; compilers draw other chains, for they evaluate arguments in other orders.
  CHECK(flips <= 2);
}

TEST_CASE("the rates of a chain with limits are the derivatives of its rotations, within reach and beyond") {
  Random random(15);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    const std::size_t count = 4 + static_cast<std::size_t>(i) % 4;
    const Hierarchy nodes = odd_chain(random, count);
    JointChainSettings settings = limited_links(random, count, 0.3);
    settings.method = i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd;
    const JointChain chain(nodes, settings);
    const SwingingPose swing(random, nodes, 0.02, 0.2);
    const SwingingVector target = swinging(random, reachable(random, chain) * (i % 3 == 0 ? 2 : 1), 0.02);
    const auto solved = [&](double t) {
      std::vector<Motion> pose = swing.at(t);
      reach(chain, target.at(t), wholly, pose);
      return pose;
    };
    const double error = worst_rate(solved, 1, 2e-5);
    CHECK(error < 1e-6);
    worst = std::max(worst, error);
  }
  MESSAGE("largest error of a rate: ", worst);
}

TEST_CASE("a limited chain comes as near to what it cannot reach as any pose of its limits") {
  Random random(4);
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const std::size_t count = 4;
    const Hierarchy nodes = straight_chain(count);
    JointChainSettings settings = links(count, i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd);
    for (std::size_t joint = 0; joint + 1 < count; ++joint) settings.links[joint].limit = ConeLimit{0.3, -0.2, 0.2};
    const JointChain chain(nodes, settings);
    const Vec3 target = random.rotation() * Vec3(random.between(2, 5), 0, 0);
    std::vector<Motion> pose = rest_pose(nodes);
    reach(chain, still(target), wholly, pose);
    double nearest = INFINITY;
    for (int k = 0; k < 3000; ++k) {
      std::vector<Motion> other = rest_pose(nodes);
      for (const JointChain::Joint& joint : chain.joints()) other[joint.node].pose.rotation = allowed(random, joint);
      nearest = std::min(nearest, missed(chain, other, target));
    }
    worst = std::max(worst, missed(chain, pose, target) - nearest);
  }
  CHECK(worst < 1e-6);
}

TEST_CASE("the rates of a joint chain are the derivatives of its rotations") {
  Random random(5);
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    const std::size_t count = 3 + static_cast<std::size_t>(i) % 5;
    const Hierarchy nodes = odd_chain(random, count);
    const JointChain chain(nodes, links(count, i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd));
    const SwingingPose swing(random, nodes, 0.05, 0.4);
    const double bend = i % 3 == 0 ? 3 : 0.9;
    const Vec3 place =
        world_of_node(nodes, chain.end(), SwingingPose(random, nodes, 0, bend).at(1)).motion.pose.position;
    const SwingingVector target = swinging(random, place * (i % 7 == 0 ? 10 : 0.9), 0.05);
    const Swing weight{0.5, 0.4, 2, 0};
    const auto solved = [&](double t) {
      std::vector<Motion> pose = swing.at(t);
      reach(chain, target.at(t), i % 5 == 0 ? weight.at(t) : wholly, pose);
      return pose;
    };
    const double error = worst_rate(solved, 1, 2e-4);
    CHECK(error < 1e-6);
    worst = std::max(worst, error);
  }
  MESSAGE("largest error of a rate: ", worst);
}

TEST_CASE("the end of a chain with limits moves with its target, and joints at their limits stand") {
  Random random(6);
  for (int i = 0; i < 40; ++i) {
    const Hierarchy nodes = straight_chain(6);
    JointChainSettings settings = links(6, i % 2 == 0 ? ChainMethod::fabrik : ChainMethod::ccd);
    for (std::size_t joint = 0; joint < 5; ++joint) {
      if (joint % 2 == 0)
        settings.links[joint].limit = ConeLimit{0.6, -0.3, 0.3};
      else
        settings.links[joint].limit = HingeLimit{{1, 0, 0.2}, 0, 0.9};
    }
    const JointChain chain(nodes, settings);
    std::vector<Motion> other = rest_pose(nodes);
    for (const JointChain::Joint& joint : chain.joints()) other[joint.node].pose.rotation = allowed(random, joint);
    const SwingingVector target = swinging(random, world_of_node(nodes, 5, other).motion.pose.position * 0.95, 0.02);
    const SwingingPose swing(random, nodes, 0, 0.2);
    const auto solved = [&](double t) {
      std::vector<Motion> pose = swing.at(t);
      reach(chain, target.at(t), wholly, pose);
      return pose;
    };
    const std::vector<Motion> pose = solved(1);
    if (missed(chain, pose, target.at(1).value) > 1e-9) continue;
    CHECK(near(world_of_node(nodes, 5, pose).motion.twist.linear, target.at(1).rate, 1e-8));
  }
}

TEST_CASE("no two close frames of a joint chain differ much while its target goes round") {
  for (const ChainMethod method : {ChainMethod::fabrik, ChainMethod::ccd}) {
    const Hierarchy nodes = straight_chain(6);
    const JointChain chain(nodes, links(6, method));
    std::vector<Motion> last;
    double widest = 0;
    for (double t = 0; t < 2 * pi; t += 1e-3) {
      std::vector<Motion> pose = rest_pose(nodes);
      reach(chain, still({3 * std::sin(t), 2 + 2.5 * std::cos(t), 1}), wholly, pose);
      if (!last.empty()) widest = std::max(widest, difference_of(last, pose));
      last = pose;
    }
    CHECK(widest < 0.05);
  }
}

TEST_CASE("bones of a joint chain do not twist at once where the target leaves what can be reached") {
  Random random(5);
  for (const ChainMethod method : {ChainMethod::fabrik, ChainMethod::ccd})
    for (const std::size_t joints : {3U, 4U, 6U, 8U}) {
      const Hierarchy nodes = odd_chain(random, joints);
      const JointChain chain(nodes, links(joints, method));
      const std::vector<Motion> before = SwingingPose(random, nodes, 0.1, 1).at(1);
      double length = 0, longest = 0;
      const auto places = [&](const std::vector<Motion>& pose, std::size_t i) {
        return world_of_node(nodes, i, pose).motion.pose.position;
      };
      for (std::size_t i = 0; i + 1 < joints; ++i) {
        const double bone = (places(before, i + 1) - places(before, i)).norm();
        length += bone;
        longest = std::max(longest, bone);
      }
      const Vec3 ahead = random.vector(1).normalized();
      std::vector<double> limits{length};
      if (2 * longest > length) limits.push_back(2 * longest - length);
      for (const double limit : limits) {
        std::vector<Motion> inside = before, outside = before;
        const double hair = (limit == length ? 1e-12 : -1e-12) * length;
        reach(chain, still(places(before, 0) + (limit - hair) * ahead), wholly, inside);
        reach(chain, still(places(before, 0) + (limit + hair) * ahead), wholly, outside);
        // A chain straightens like the square root of what is missing.
        CHECK(difference_of(inside, outside) < 1e-4);
      }
    }
}

TEST_CASE("solving a joint chain twice gives the same bits, and without weight the pose's own") {
  Random random(7);
  const Hierarchy nodes = odd_chain(random, 6);
  const JointChain chain(nodes, links(6, ChainMethod::fabrik));
  const std::vector<Motion> before = SwingingPose(random, nodes, 0.1, 1).at(1);
  std::vector<Motion> pose = before, again = before, none = before;
  reach(chain, moving({0.5, 0.5, 0}, {1, 0, 0}), wholly, pose);
  reach(chain, moving({0.5, 0.5, 0}, {1, 0, 0}), wholly, again);
  reach(chain, still({0.5, 0.5, 0}), {0, 0, 0}, none);
  CHECK(same_bits(pose, again));
  CHECK(same_bits(before, none));
}

TEST_CASE("bones without length, and targets in odd places, leave numbers") {
  for (const ChainMethod method : {ChainMethod::fabrik, ChainMethod::ccd}) {
    const Hierarchy nodes = straight_chain(5);
    const JointChain chain(nodes, links(5, method));
    const JointChain hinges(nodes, links(5, method, HingeLimit{{1, 0, 0}, -1, 1}));
    for (const JointChain* each : {&chain, &hinges}) {
      for (const Vec3& target :
           {Vec3(0, 0, 0), Vec3(0, 1, 0), Vec3(0, 4, 0), Vec3(0, -4, 0), Vec3(1e-200, 0, 0), Vec3(1e9, 0, 0)}) {
        std::vector<Motion> pose = rest_pose(nodes);
        pose[2].pose.position = {0, 0, 0};
        reach(*each, moving(target, {1, 1, 1}), wholly, pose);
        CHECK(finite(pose));
        for (std::size_t i = 1; i < 5; ++i) pose[i].pose.position = {0, 0, 0};
        reach(*each, moving(target, {1, 1, 1}), wholly, pose);
        CHECK(finite(pose));
      }
    }
  }
}

TEST_CASE("a chain of one joint is refused, and what else is wrong is told all at once") {
  const Hierarchy nodes = straight_chain(4);
  CHECK_THROWS_WITH_AS(JointChain(nodes, {.links = {{1}}}),
                       "joint chain: it has 1 joint; it needs at least one that turns and the end that it carries",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(
      JointChain(nodes, {.links = {{2, HingeLimit{{0, 0, 0}, 1, 0}}, {1, ConeLimit{4, 0, 9}}, {"3", ConeLimit{}}},
                         .sweeps = -1}),
      "joint chain: sweeps is -1; it must be from 0 to 1000\n"
      "joint chain: joint 2 (\"1\") must be below the joint before it (\"2\")\n"
      "joint chain: axis of joint 1 (\"2\") is zero\n"
      "joint chain: high of joint 1 (\"2\") is 0; it must be from 1 to 3.141592653589793\n"
      "joint chain: swing of joint 2 (\"1\") is 4; it must be from 0 to 3.1\n"
      "joint chain: twist_high of joint 2 (\"1\") is 9; it must be from 0 to 3.141592653589793\n"
      "joint chain: joint 3 (\"3\") is the end, which does not turn; it takes no limit",
      std::invalid_argument);
}
