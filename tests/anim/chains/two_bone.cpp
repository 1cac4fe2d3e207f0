#include "anim/chains/chain_support.h"

#include <tweenfall/anim/two_bone.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr Sample<double> fully{1, 0, 0};

// hip (turned, scaled and away from the origin) > thigh > shin > foot, bent at rest about x.
Hierarchy leg(double thigh = 0.5, double shin = 0.4, double size = 1) {
  return Hierarchy({{.name = "hip", .rest = {{0.3, 1, -0.2}, exp_map({0.3, -0.5, 0.2}), Vec3(size, size, size)}},
                    {.name = "thigh", .parent = 0, .rest = {{0.1, -0.1, 0}, exp_map({0.2, 0.1, 0})}},
                    {.name = "shin", .parent = 1, .rest = {{0, -thigh, 0}, exp_map({0.3, 0, 0})}},
                    {.name = "foot", .parent = 2, .rest = {{0, -shin, 0}}}});
}

double distance_to(const Hierarchy& nodes, std::span<const Motion> pose, const Vec3& target) {
  return (world_of_node(nodes, 3, pose).motion.pose.position - target).norm();
}

}  // namespace

TEST_CASE("a two-bone chain reaches every target within reach to 1e-12 of its length") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double thigh = random.between(0.1, 2), shin = random.between(0.1, 2), size = random.between(0.3, 3);
    const Hierarchy nodes = leg(thigh, shin, size);
    const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
    const SwingingPose swing(random, nodes, 0, 1);
    std::vector<Motion> pose = swing.at(random.between(0, 10));
    if (i % 3 == 0) pose[2].pose.position = exp_map({0.2, 0, 0.3}) * pose[2].pose.position;  // away from its rest
    const Vec3 start = world_of_node(nodes, 1, pose).motion.pose.position;
    const double near_end = std::abs(thigh - shin) * size, far_end = (thigh + shin) * size;
    const Vec3 way = random.rotation() * Vec3(random.between(near_end, far_end), 0, 0);
    TwoBoneGoal goal{.target = still(start + way)};
    if (i % 2 == 0) goal.pole = still(random.vector(1));
    reach(chain, goal, fully, pose);
    CHECK(distance_to(nodes, pose, start + way) < 1e-12 * far_end);
  }
}

TEST_CASE("a two-bone chain goes as far as it can toward what is too far, and away from what is too near") {
  Random random(2);
  const Hierarchy nodes = leg();
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  for (const double distance :
       {0.9, 0.9 + 1e-15, 0.9000001, 1.0, 1e6, 0.1, 0.1 - 1e-16, 0.0999, 1e-9, 1e-15, 1e-300, 0.0}) {
    CAPTURE(distance);
    std::vector<Motion> pose = rest_pose(nodes);
    const Vec3 start = world_of_node(nodes, 1, pose).motion.pose.position;
    const Vec3 way = random.rotation() * Vec3(distance, 0, 0);
    reach(chain, {.target = moving(start + way, {1, 2, 3}), .pole = still({0, 0, 1})}, fully, pose);
    REQUIRE(finite(pose));
    const double least = distance > 0.5 ? std::max(distance - 0.9, 0.0) : std::max(0.1 - distance, 0.0);
    CHECK(distance_to(nodes, pose, start + way) == doctest::Approx(least).epsilon(1e-12));
  }
}

TEST_CASE("the middle of a two-bone chain goes to the pole's side, in the plane of start, target and pole") {
  Random random(3);
  const Hierarchy nodes = leg();
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  for (int i = 0; i < 200; ++i) {
    std::vector<Motion> pose = SwingingPose(random, nodes, 0.1, 1).at(1);
    const Vec3 start = world_of_node(nodes, 1, pose).motion.pose.position;
    const Vec3 way = random.rotation() * Vec3(0.6, 0, 0), pole = random.vector(1);
    reach(chain, {.target = still(start + way), .pole = still(pole)}, fully, pose);
    const Vec3 knee = world_of_node(nodes, 2, pose).motion.pose.position - start;
    CHECK(knee.dot(way.cross(pole)) == doctest::Approx(0).epsilon(1e-12));
    const Vec3 side = pole - pole.dot(way) / way.squaredNorm() * way;
    CHECK(knee.dot(side) > 0);
  }
}

TEST_CASE("a target where the end is leaves a chain that bends about its axis as it is") {
  const Hierarchy nodes = leg();
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  std::vector<Motion> pose = rest_pose(nodes);
  const std::vector<Motion> before = pose;
  reach(chain, {.target = still(world_of_node(nodes, 3, pose).motion.pose.position)}, fully, pose);
  CHECK(difference_of(before, pose) < 1e-13);
}

TEST_CASE("the rates of a two-bone chain are the derivatives of its rotations") {
  Random random(4);
  const Hierarchy nodes = leg(0.5, 0.4, 1.3);
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  double worst = 0;
  for (int i = 0; i < 60; ++i) {
    const SwingingPose swing(random, nodes, i % 7 < 3 ? 0 : 0.05, 0.5);
    const Vec3 around = random.vector(i % 3 == 0 ? 3 : 0.4) + nodes[0].rest.position;
    const SwingingVector target = swinging(random, around, 0.1);
    const SwingingVector pole = swinging(random, random.vector(2), 0.3);
    const Swing weight{0.5, 0.4, 2, 0};
    const auto solved = [&](double t) {
      std::vector<Motion> pose = swing.at(t);
      TwoBoneGoal goal{.target = target.at(t), .softness = i % 4 == 0 ? 0.2 : 0};
      if (i % 2 == 0) goal.pole = pole.at(t);
      reach(chain, goal, i % 5 == 0 ? weight.at(t) : fully, pose);
      return pose;
    };
    const double error = worst_rate(solved, 1, 1e-3);
    // If the differences straddle the border of reach, they say nothing.
    const auto at_border = [&](double t) {
      const Vec3 start = world_of_node(nodes, 1, swing.at(t)).motion.pose.position;
      const double d = (target.at(t).value - start).norm();
      return std::min(std::abs(d - 0.9 * 1.3), std::abs(d - 0.1 * 1.3)) < 0.03;
    };
    if (at_border(1)) continue;
    CAPTURE(i);
    CHECK(error < 2e-8);
    worst = std::max(worst, error);
  }
  MESSAGE("largest error of a rate: ", worst);
}

TEST_CASE("bones that do not change their lengths are solved as those that hardly do") {
  Random random(10);
  const Hierarchy nodes = leg(0.5, 0.4, 1.3);
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  for (int i = 0; i < 200; ++i) {
    std::vector<Motion> stiff = SwingingPose(random, nodes, 0, 0.7).at(1), soft = stiff;
    soft[3].twist.linear = {1e-200, 0, 0};
    const Vec3 place = random.vector(1) + nodes[0].rest.position, velocity = random.vector(1);
    TwoBoneGoal goal{.target = moving(place, velocity), .softness = i % 3 == 0 ? 0.1 : 0};
    if (i % 2 == 0) goal.pole = moving({0.1, 0.2, 1}, {0, 1, 0});
    reach(chain, goal, fully, stiff);
    reach(chain, goal, fully, soft);
    CHECK(difference_of(stiff, soft) < 1e-13);
    for (const std::size_t node : {1, 2}) CHECK(near(stiff[node].twist.angular, soft[node].twist.angular, 1e-9));
  }
}

TEST_CASE("the end of a two-bone chain moves with its target") {
  Random random(5);
  const Hierarchy nodes = leg();
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  const SwingingPose swing(random, nodes, 0.05, 0.5);
  for (int i = 0; i < 50; ++i) {
    std::vector<Motion> pose = swing.at(0.1 * i);
    const WorldMotion start = world_of_node(nodes, 1, pose);
    const Vec3 place = start.motion.pose.position + random.rotation() * Vec3(0.5, 0, 0), velocity = random.vector(2);
    const Sample<Vec3> target = moving(place, velocity);
    reach(chain, {.target = target}, fully, pose);
    CHECK(near(world_of_node(nodes, 3, pose).motion.twist.linear, target.rate, 1e-11));
  }
}

TEST_CASE("two bones between which other nodes stand reach as if they were not there") {
  Random random(6);
  const Hierarchy nodes({{.name = "thigh", .rest = {{0, 1, 0}}},
                         {.name = "twist", .parent = 0, .rest = {{0, -0.3, 0.01}, exp_map({0, 0.4, 0})}},
                         {.name = "shin", .parent = 1, .rest = {{0, -0.2, 0}, exp_map({0.5, 0, 0})}},
                         {.name = "calf", .parent = 2, .rest = {{0, -0.2, 0}, exp_map({0, 0.2, 0.1})}},
                         {.name = "foot", .parent = 3, .rest = {{0, -0.25, 0}}}});
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  for (int i = 0; i < 50; ++i) {
    const SwingingPose swing(random, nodes, 0.01, 0.3);
    const SwingingVector target = swinging(random, random.vector(0.3) + Vec3(0, 0.5, 0), 0.03);
    const auto solved = [&](double t) {
      std::vector<Motion> pose = swing.at(t);
      reach(chain, {.target = target.at(t)}, fully, pose);
      return pose;
    };
    const Vec3 foot = world_of_node(nodes, 4, solved(1)).motion.pose.position;
    CHECK((foot - target.at(1).value).norm() < 1e-12);
    CHECK(worst_rate(solved, 1, 1e-3) < 1e-8);
  }
}

TEST_CASE("a softened chain never stretches wholly, and stretches evenly as its target goes away") {
  const Hierarchy nodes = leg();
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  double last = 0.5;
  for (double distance = 0.5; distance < 2; distance += 0.01) {
    std::vector<Motion> pose = rest_pose(nodes);
    const Vec3 start = world_of_node(nodes, 1, pose).motion.pose.position;
    reach(chain, {.target = still(start + Vec3(0, -distance, 0)), .softness = 0.1}, fully, pose);
    const double length = (world_of_node(nodes, 3, pose).motion.pose.position - start).norm();
    // The published curve of a soft reach: linear to the share, from there 1 - exp.
    const double soft = 0.09, from = 0.81;
    const double expected = distance < from ? distance : from + soft * (1 - std::exp((from - distance) / soft));
    CHECK(length == doctest::Approx(expected).epsilon(1e-12));
    CHECK(length < 0.9);
    CHECK(length - last <= 0.0100001);
    last = length;
  }
}

TEST_CASE("no two close frames of a two-bone chain differ much, though its pole goes through the line to the target") {
  const Hierarchy nodes = leg();
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  for (const double beside : {0.0, 1e-12, 1e-6, 1e-3}) {
    CAPTURE(beside);
    std::vector<Motion> last;
    for (double x = -0.1; x <= 0.1; x += 1e-5) {
      std::vector<Motion> pose = rest_pose(nodes);
      const Vec3 start = world_of_node(nodes, 1, pose).motion.pose.position;
      const Vec3 way(0, -0.6, 0);
      reach(chain, {.target = still(start + way), .pole = still({x, -1, beside})}, fully, pose);
      REQUIRE(finite(pose));
      CHECK((world_of_node(nodes, 3, pose).motion.pose.position - start - way).norm() < 1e-12);
      if (!last.empty()) CHECK(difference_of(last, pose) < 0.02);
      last = pose;
    }
  }
}

TEST_CASE("a chain of equal bones folds onto its start and opens again without a flip") {
  const Hierarchy nodes = leg(0.5, 0.5);
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  std::vector<Motion> last;
  for (double x = 0.3; x >= 0; x -= 1e-3) {
    std::vector<Motion> pose = rest_pose(nodes);
    const Vec3 start = world_of_node(nodes, 1, pose).motion.pose.position;
    reach(chain, {.target = still(start + Vec3(x < 5e-4 ? 0 : x, 0, 0)), .pole = still({0, 0, 1})}, fully, pose);
    REQUIRE(finite(pose));
    CHECK(distance_to(nodes, pose, start + Vec3(x < 5e-4 ? 0 : x, 0, 0)) < 1e-12);
    if (!last.empty() && x > 5e-4) CHECK(difference_of(last, pose) < 0.01);
    last = pose;
  }
}

TEST_CASE("straight, folded, collapsed and overbent poses are all answered") {
  for (const double bend : {0.0, 3.141592653589793, -0.4, -3.0, 1e-9, -1e-9}) {
    for (const double thigh : {0.5, 0.0, 1e-200, 1e150}) {
      for (const double shin : {0.4, 0.0, 1e-200}) {
        CAPTURE(bend);
        CAPTURE(thigh);
        CAPTURE(shin);
        Hierarchy nodes = leg();
        const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
        std::vector<Motion> pose = rest_pose(nodes);
        pose[2].pose.rotation = exp_map({bend, 0, 0});
        pose[2].pose.position = {0, -thigh, 0};
        pose[3].pose.position = {0, -shin, 0};
        const Vec3 start = world_of_node(nodes, 1, pose).motion.pose.position;
        const double length = thigh + shin;
        const Vec3 way(0.3 * length, 0.2 * length, 0);
        reach(chain, {.target = moving(start + way, {1, 0, 0}), .pole = moving({0, 0, 0}, {1, 0, 0})}, fully, pose);
        if (thigh < 1e100) CHECK(finite(pose));
        if (thigh == 0.5 && shin == 0.4) CHECK(distance_to(nodes, pose, start + way) < 1e-12);
      }
    }
  }
}

TEST_CASE("bones of any lengths fold up toward a target that is too near, and reach one just beyond that") {
  Random random(31);
  for (const double ratio : {1e-6, 1e-5, 1e-4, 9.4e-4, 3e-3, 0.02, 0.3, 0.9, 1.1, 4., 70., 333., 2e4, 1e6})
    for (int i = 0; i < 40; ++i) {
      const double thigh = random.between(0.1, 1), shin = ratio * thigh, least = std::abs(thigh - shin);
      const Hierarchy nodes({{"thigh", no_node, {}},
                             {"shin", 0, {.position = {0, -thigh, 0}}},
                             {"foot", 1, {.position = {0, -shin, 0}}}});
      const TwoBoneChain chain(nodes, {"thigh", "shin", "foot", Vec3(1, 0, 0)});
      const Vec3 way = random.vector(1).normalized();
      CAPTURE(ratio);
      for (const double part : {0., 0.3, 0.999999, 1., 1.0000001}) {
        if (part > 1 && part * least > thigh + shin) continue;
        std::vector<Motion> pose = rest_pose(nodes);
        reach(chain, {.target = still(part * least * way)}, fully, pose);
        const Vec3 foot = world_of_node(nodes, 2, pose).motion.pose.position;
        CHECK(std::abs(foot.norm() - std::max(part, 1.) * least) < 1e-10 * (thigh + shin));
        // At the border itself the bend turns by the square root of the rounding of the lengths.
        const double error = (part == 1 ? 1e-6 : 1e-10) * (thigh + shin);
        if (part > 0) CHECK(near(foot, std::max(part, 1.) * least * way, error));
      }
    }
}

TEST_CASE("a bone without length leaves the other to point at the target") {
  const Hierarchy nodes = leg();
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  for (const std::size_t without : {2, 3}) {
    std::vector<Motion> pose = rest_pose(nodes);
    pose[without].pose.position = {0, 0, 0};
    const Vec3 start = world_of_node(nodes, 1, pose).motion.pose.position;
    reach(chain, {.target = still(start + Vec3(0.7, 0, 0.7))}, fully, pose);
    const Vec3 way = world_of_node(nodes, 3, pose).motion.pose.position - start;
    CHECK(near(way.normalized(), Vec3(1, 0, 1).normalized(), 1e-12));
  }
}

TEST_CASE("without weight a two-bone chain leaves the pose's bits, and a weight that sets out gives its rate") {
  Random random(9);
  const Hierarchy nodes = leg();
  const TwoBoneChain chain(nodes, {"thigh", "shin", "foot"});
  std::vector<Motion> pose = SwingingPose(random, nodes, 0.1, 1).at(2);
  const std::vector<Motion> before = pose;
  reach(chain, {.target = still({1, 0, 0})}, {0, 0, 0}, pose);
  CHECK(same_bits(before, pose));
  reach(chain, {.target = still({1, 0, 0})}, {0, 2, 0}, pose);
  CHECK(difference_of(before, pose) < 1e-15);
  CHECK_FALSE(near(pose[1].twist.angular, before[1].twist.angular, 1e-3));
}

TEST_CASE("what is wrong with a two-bone chain is told all at once") {
  const Hierarchy nodes = leg();
  CHECK_THROWS_WITH_AS(TwoBoneChain(nodes, {"thight", "hip", 17}),
                       "two-bone chain: start is \"thight\", and there is no such node; did you mean \"thigh\"?\n"
                       "two-bone chain: end is number 17, and there is no such node",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(TwoBoneChain(nodes, {"thigh", "thigh", "hip", Vec3(1, NAN, 0)}),
                       "two-bone chain: middle (\"thigh\") must be below start (\"thigh\")\n"
                       "two-bone chain: end (\"hip\") must be below middle (\"thigh\")\n"
                       "two-bone chain: axis must be finite",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(TwoBoneChain(nodes, {"thigh", "shin", "foot", Vec3(0, 3, 0)}),
                       "two-bone chain: axis is along the bone from start to middle; it must be across it",
                       std::invalid_argument);
  const Hierarchy straight = straight_chain(3);
  CHECK_THROWS_AS(TwoBoneChain(straight, {0, 1, 2}), std::invalid_argument);
  const TwoBoneChain told(straight, {0, 1, 2, Vec3(0, 5, 2)});
  std::vector<Motion> pose = rest_pose(straight);
  reach(told, {.target = still({0, 1, 0.3})}, fully, pose);
  CHECK((world_of_node(straight, 2, pose).motion.pose.position - Vec3(0, 1, 0.3)).norm() < 1e-12);
}
