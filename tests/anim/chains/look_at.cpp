#include "anim/chains/chain_support.h"

#include <tweenfall/anim/look_at.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr Sample<double> looks{1, 0, 0};

Hierarchy torso() {
  return Hierarchy({{.name = "hips", .rest = {{0.2, 1, 0}, exp_map({0.1, 0.4, -0.2}), Vec3(1.5, 1.5, 1.5)}},
                    {.name = "spine", .parent = 0, .rest = {{0, 0.2, 0}, exp_map({0.1, 0, 0})}},
                    {.name = "chest", .parent = 1, .rest = {{0, 0.2, 0.02}, exp_map({0, 0.1, 0})}},
                    {.name = "neck", .parent = 2, .rest = {{0, 0.2, 0}}},
                    {.name = "head", .parent = 3, .rest = {{0, 0.1, 0.03}, exp_map({-0.1, 0, 0})}}});
}

struct Seen {
  Vec3 eye, forward, up;
};

Seen seen(const Hierarchy& nodes, const LookAtChain& chain, std::span<const Motion> pose) {
  const WorldMotion head = world_of_node(nodes, chain.joints().back().node, pose);
  const Quat& turn = head.motion.pose.rotation;
  return {head.point(chain.eye()), turn * chain.forward(), turn * chain.up()};
}

double off(const Seen& seen, const Vec3& target) {
  return seen.forward.cross((target - seen.eye).normalized()).norm();
}

}  // namespace

TEST_CASE("the last joint of a look-at chain looks at its target from its eye, with what is up up") {
  Random random(1);
  const Hierarchy nodes = torso();
  const LookAtChain alone(nodes, {.joints = {{"head"}}, .forward = {0, 0, 2}, .eye = {0.03, 0.05, 0.1}});
  const LookAtChain shared(nodes, {.joints = {{"spine", 0.2}, {"neck", 0.4}, {"head"}},
                                   .forward = {1, 0.2, 2},
                                   .up = {0, 3, 0.5},
                                   .eye = {-0.03, 0.05, 0.1}});
  for (int i = 0; i < 400; ++i) {
    const LookAtChain& chain = i % 2 == 0 ? alone : shared;
    std::vector<Motion> pose = SwingingPose(random, nodes, 0.02, 0.5).at(random.between(0, 9));
    const Vec3 target = random.rotation() * Vec3(random.between(2, 50), 0, 0), up = random.vector(1);
    LookAtGoal goal{.target = still(target)};
    if (i % 3 == 0) goal.up = still(up);
    look_at(chain, goal, looks, pose);
    const Seen now = seen(nodes, chain, pose);
    CHECK(off(now, target) < 1e-13);
    CHECK(now.forward.dot(target - now.eye) > 0);
    const double across = up.normalized().cross(now.forward).norm();
    if (i % 3 == 0 && across > 0.05) {
      CHECK(std::abs(now.up.dot(now.forward.cross(up))) < 1e-12);
      CHECK(now.up.dot(up) > 0);
    }
  }
}

TEST_CASE("the joints before the last take their shares of the turning on themselves") {
  const Hierarchy nodes = straight_chain(3, 0.001);
  const LookAtChain chain(nodes, {.joints = {{0, 0.25}, {1, 0.5}, {2}}});
  std::vector<Motion> pose = rest_pose(nodes);
  look_at(chain, {.target = still({1e6, 0, 1e6})}, looks, pose);
  const double way = pi / 4;
  CHECK(near(log_map(pose[0].pose.rotation), Vec3(0, way / 4, 0), 1e-8));
  CHECK(near(log_map(pose[1].pose.rotation), Vec3(0, way * 3 / 8, 0), 1e-8));
  CHECK(near(log_map(pose[2].pose.rotation), Vec3(0, way * 3 / 8, 0), 1e-8));
}

TEST_CASE("a limit holds, is eased into, and lets go of what comes directly behind") {
  const Hierarchy nodes = straight_chain(1);
  const double limit = 1.2, ease = 0.3;
  const LookAtChain chain(nodes, {.joints = {{0}}, .limit = limit, .ease = ease});
  double last = 0;
  for (double angle = 0; angle < 2 * pi; angle += 1e-3) {
    CAPTURE(angle);
    std::vector<Motion> pose = rest_pose(nodes);
    look_at(chain, {.target = still({5 * std::sin(angle), 0, 5 * std::cos(angle)})}, looks, pose);
    const double turned = log_map(pose[0].pose.rotation).y();
    CHECK(std::abs(turned) < limit);
    CHECK(std::abs(turned - last) < 2.5e-3);
    if (angle <= limit - ease) CHECK(turned == doctest::Approx(angle));
    if (angle > limit - ease && angle < pi - 1)
      CHECK(turned == doctest::Approx(limit - ease * std::exp((limit - ease - angle) / ease)));
    last = turned;
  }
  std::vector<Motion> pose = rest_pose(nodes);
  look_at(chain, {.target = moving({0, 0, -5}, {1, 2, 3})}, looks, pose);
  CHECK(finite(pose));
  CHECK(difference_of(pose, rest_pose(nodes)) < 1e-12);
}

TEST_CASE("the rates of a look-at chain are the derivatives of its rotations") {
  Random random(4);
  const Hierarchy nodes = torso();
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    CAPTURE(i);
    const LookAtChain chain(nodes, {.joints = {{"spine", 0.3}, {"chest", 0.2}, {"head", i % 7 == 0 ? 0.7 : 1}},
                                    .eye = {0, 0.05, 0.1},
                                    .limit = i % 2 == 0 ? pi : 0.9});
    const SwingingPose swing(random, nodes, 0.02, 0.3);
    const SwingingVector target = swinging(random, random.rotation() * Vec3(3, 0, 0), 0.2);
    const SwingingVector up = swinging(random, random.vector(1), 0.1);
    const Swing weight{0.5, 0.4, 2, 0};
    const auto solved = [&](double t) {
      std::vector<Motion> pose = swing.at(t);
      LookAtGoal goal{.target = target.at(t)};
      if (i % 3 == 0) goal.up = up.at(t);
      look_at(chain, goal, i % 5 == 0 ? weight.at(t) : looks, pose);
      return pose;
    };
    const double error = worst_rate(solved, 1, 5e-4);
    CHECK(error < 1e-7);
    worst = std::max(worst, error);
  }
  MESSAGE("largest error of a rate: ", worst);
}

TEST_CASE("joints that share the turning do not flip where an up is opposite that of the pose") {
  Random random(6);
  const Hierarchy nodes = torso();
  double worst = 0;
  for (int i = 0; i < 300; ++i) {
    CAPTURE(i);
    const LookAtChain chain(nodes, {.joints = {{"spine", 0.3}, {"chest", 0.2}, {"neck", 0.5}, {"head"}},
                                    .forward = random.vector(1),
                                    .up = random.vector(1)});
    const std::vector<Motion> pose = SwingingPose(random, nodes, 0.02, 3).at(1);
    const Vec3 from = random.vector(5), to = random.vector(5), up = random.vector(1);
    const auto looked = [&](double share) {
      std::vector<Motion> turned = pose;
      look_at(chain, {.target = still(from + share * (to - from)), .up = still(up)}, looks, turned);
      return turned;
    };
    // Halves a stretch in which much happens, until nothing may.
    constexpr int steps = 40;
    for (int k = 0; k < steps; ++k) {
      double low = static_cast<double>(k) / steps, high = static_cast<double>(k + 1) / steps;
      const Vec3 way = from + low * (to - from) - world_of_node(nodes, 4, pose).motion.pose.position;
      if (way.cross(up).norm() < 0.2 * way.norm() * up.norm()) continue;
      for (int halved = 0; halved < 34; ++halved) {
        const double middle = (low + high) / 2;
        const std::vector<Motion> there = looked(middle);
        (difference_of(looked(low), there) > difference_of(there, looked(high)) ? high : low) = middle;
      }
      worst = std::max(worst, difference_of(looked(low), looked(high)));
    }
  }
  CHECK(worst < 1e-5);
}

TEST_CASE("odd targets and ups leave a look-at chain with numbers") {
  const Hierarchy nodes = torso();
  const LookAtChain chain(nodes, {.joints = {{"neck", 0.5}, {"head"}}, .eye = {0, 0.1, 0.1}, .limit = 0.5});
  const LookAtChain free(nodes, {.joints = {{"neck", 0.5}, {"head"}}, .eye = {0, 0.1, 0.1}});
  for (const LookAtChain* each : {&chain, &free}) {
    const std::vector<Motion> rest = rest_pose(nodes);
    const WorldMotion head = world_of_node(nodes, 4, rest), neck = world_of_node(nodes, 3, rest);
    const Vec3 eye = head.point(chain.eye()), ahead = head.motion.pose.rotation * Vec3(0, 0, 1);
    for (const Vec3& target : {eye, Vec3(head.motion.pose.position), Vec3(neck.motion.pose.position), Vec3(eye - ahead),
                               Vec3(eye + ahead), Vec3(eye + 1e-12 * ahead), Vec3(1e12, 0, 0)}) {
      for (const Vec3& up : {Vec3(0, 0, 0), Vec3(target - eye), Vec3(0, -1, 0)}) {
        std::vector<Motion> pose = rest;
        look_at(*each, {.target = moving(target, {1, 1, 1}), .up = moving(up, {1, 0, 0})}, looks, pose);
        CHECK(finite(pose));
      }
    }
  }
}

TEST_CASE("without weight a look-at chain leaves the pose's bits") {
  Random random(5);
  const Hierarchy nodes = torso();
  const LookAtChain chain(nodes, {.joints = {{"neck", 0.5}, {"head"}}});
  std::vector<Motion> pose = SwingingPose(random, nodes, 0.1, 1).at(2);
  const std::vector<Motion> before = pose;
  look_at(chain, {.target = still({1, 0, 0})}, {0, 0, 0}, pose);
  CHECK(same_bits(before, pose));
}

TEST_CASE("what is wrong with a look-at chain is told all at once") {
  const Hierarchy nodes = torso();
  CHECK_THROWS_WITH_AS(LookAtChain(nodes, {}), "look-at chain: it has no joint; it needs at least the one that looks",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(
      LookAtChain(nodes, {.joints = {{"head", 2}, {"nek"}, {"neck"}, {"head"}, {"spine"}}, .limit = -1}),
      "look-at chain: joint 2 is \"nek\", and there is no such node; did you mean \"neck\"?\n"
      "look-at chain: joint 5 (\"spine\") must be below the joint before it (\"head\")\n"
      "look-at chain: share of joint 1 is 2; it must be from 0 to 1\n"
      "look-at chain: limit is -1; it must be from 0 to 3.141592653589793",
      std::invalid_argument);
  CHECK_THROWS_WITH_AS(LookAtChain(nodes, {.joints = {{"head"}}, .forward = {0, 2, 0}}),
                       "look-at chain: up is along forward; it must be across it", std::invalid_argument);
}
