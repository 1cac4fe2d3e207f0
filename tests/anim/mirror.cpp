#include <tweenfall/anim/mirror.h>

#include "anim/moving_pose.h"
#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

// A figure that is symmetrical about x = 0 (or nearly, by `uneven`), with arbitrary axes for its joints.
Hierarchy mirrored_figure(bool random_axes, double uneven = 0) {
  Random random(3);
  struct Place {
    const char* name;
    std::size_t parent;
    Vec3 at;
  };
  const std::vector<Place> places{{"root", no_node, {0, 0, 0}},        {"hips", 0, {0, 1, 0.1}},
                                  {"chest", 1, {0, 1.4, 0}},           {"arm.L", 2, {0.2, 1.4, 0.05}},
                                  {"hand.L", 3, {0.7, 1.2, 0.15}},     {"arm.R", 2, {-0.2, 1.4, 0.05}},
                                  {"hand.R", 5, {-0.7, 1.2, 0.15}},    {"thumb.R", 6, {-0.75, 1.1, 0.2}},
                                  {"thumb.L", 4, {0.75, 1.1, 0.2}},    {"LeftLegTip", 1, {0.1, 0.1, 0.3}},
                                  {"RightLegTip", 1, {-0.1, 0.1, 0.3}}};
  std::vector<Quat> axes;
  std::vector<Node> nodes;
  for (const Place& place : places) {
    const Quat own = random.rotation();
    const Vec3 away = random.vector(1);
    axes.push_back(random_axes ? own : Quat(1, 0, 0, 0));
    Node node{.name = place.name, .parent = place.parent};
    const bool root = place.parent == no_node;
    const Quat back = root ? Quat(1, 0, 0, 0) : Quat(axes[place.parent].conjugate());
    node.rest.rotation = (back * axes.back()).normalized();
    node.rest.position = back * Vec3(place.at - (root ? Vec3(0, 0, 0) : places[place.parent].at)) + uneven * away;
    nodes.push_back(node);
  }
  return Hierarchy(nodes);
}

const std::vector<MirrorPair> sides{{"*.L", "*.R"}, {"Left*", "Right*"}};

std::vector<Motion> moved_figure(const Hierarchy& nodes, std::uint64_t seed, double t) {
  std::vector<Motion> pose = moving_pose(seed, nodes.size(), t);
  for (Motion& motion : pose) {
    motion.pose.scale = {1, 1, 1};
    motion.scale_rate = {0, 0, 0};
  }
  return pose;
}

Vec3 across(const Vec3& v) {
  return {-v[0], v[1], v[2]};
}
Vec3 turned_across(const Vec3& v) {
  return {v[0], -v[1], -v[2]};
}

}  // namespace

TEST_CASE("the mirrored pose is the mirror image in the figure's space, rates too, however the joints' axes lie") {
  for (const bool random_axes : {false, true}) {
    const Hierarchy nodes = mirrored_figure(random_axes);
    const Mirror mirror(nodes, sides);
    const std::vector<Motion> pose = moved_figure(nodes, 5, 0.2);
    std::vector<Motion> rest(nodes.size()), out(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) rest[i].pose = nodes[i].rest;
    mirror.apply(pose, out);
    std::vector<WorldMotion> before(nodes.size()), after(nodes.size()), resting(nodes.size());
    nodes.world_motions(pose, before);
    nodes.world_motions(out, after);
    nodes.world_motions(rest, resting);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      CAPTURE(nodes[i].name);
      const Motion &image = after[i].motion, &original = before[mirror.partner(i)].motion;
      CHECK(near(image.pose.position, across(original.pose.position), 1e-13));
      CHECK(near(image.twist.linear, across(original.twist.linear), 1e-12));
      CHECK(near(image.twist.angular, turned_across(original.twist.angular), 1e-12));
      // What the joint carries: a point at rest stays at rest at its image.
      const Vec3 point(0.3, -0.2, 0.5);
      const Vec3 own = resting[i].motion.pose.rotation.conjugate() * point,
                 theirs = resting[mirror.partner(i)].motion.pose.rotation.conjugate() * across(point);
      CHECK(near(after[i].point(own), across(before[mirror.partner(i)].point(theirs)), 1e-13));
    }
  }
}

TEST_CASE(
    "the mirror of a mirrored pose is the pose: bit for bit with symmetrical axes, to rounding with any, in place") {
  for (const bool random_axes : {false, true})
    for (const double uneven : {0.0, 0.2}) {
      const Hierarchy nodes = mirrored_figure(random_axes, uneven);
      const std::vector<Motion> pose = moving_pose(6, nodes.size(), 0.2);
      for (const Vec3& normal : {Vec3(1, 0, 0), Vec3(0.3, 0.1, -1), Vec3(1, 1, 1)}) {
        const Mirror mirror(nodes, sides, normal);
        const bool even = !random_axes && uneven == 0 && normal.y() == 0;
        std::vector<Motion> out = pose;
        mirror.apply(out, out);
        for (std::size_t i = 0; i < nodes.size(); ++i) CHECK_FALSE(near(out[i], pose[i], 1e-3));
        mirror.apply(out, out);
        for (std::size_t i = 0; i < nodes.size(); ++i)
          CHECK((even ? same_bits(out[i], pose[i]) : near(out[i], pose[i], 1e-13)));
      }
    }
}

TEST_CASE(
    "the rest pose of an uneven figure is its own mirror image, and a mirrored pose has the derivatives of its way") {
  const Hierarchy nodes = mirrored_figure(true, 0.2);
  const Mirror mirror(nodes, sides, {0.3, 0.1, -1});
  std::vector<Motion> rest(nodes.size()), out(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) rest[i].pose = nodes[i].rest;
  mirror.apply(rest, out);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    CHECK(near(out[i], rest[i], 1e-13));
    check_rates(
        [&](double t) {
          std::vector<Motion> at(nodes.size());
          mirror.apply(moving_pose(7, nodes.size(), t), at);
          return at[i];
        },
        0.1);
  }
}

TEST_CASE("scales go to the axes that are each other's images") {
  // The right arm's own x lies along the left arm's y.
  std::vector<Node> nodes{{"root"}, {"arm.L", 0, {.position = {1, 0, 0}}}, {"arm.R", 0, {.position = {-1, 0, 0}}}};
  nodes[2].rest.rotation = exp_map({0, 0, pi / 2});
  nodes[2].rest.scale = {2, 1, 1};
  const Hierarchy figure(nodes);
  const std::vector<MirrorPair> arms{{"*.L", "*.R"}};
  const Mirror mirror(figure, arms);
  std::vector<Motion> pose(3), out(3);
  for (std::size_t i = 0; i < 3; ++i) pose[i].pose = nodes[i].rest;
  pose[1].pose.scale = {3, 5, 7};
  pose[1].scale_rate = {0.5, 0.25, 0};
  mirror.apply(pose, out);
  CHECK(out[2].pose.scale == Vec3(10, 3, 7));
  CHECK(out[2].scale_rate == Vec3(0.5, 0.5, 0));
  CHECK(out[1].pose.scale == Vec3(1, 1, 1));
  // Leaning by 30 degrees, its x is still nearest to the other's y.
  nodes[2].rest.rotation = exp_map({0.1, 0.2, pi / 3});
  Mirror(Hierarchy(nodes), arms).apply(pose, out);
  CHECK(out[2].pose.scale == Vec3(10, 3, 7));
}

TEST_CASE("the usual ways of naming sides are found, and only those that the figure uses") {
  const auto found = usual_sides(mirrored_figure(false));
  REQUIRE(found.size() == 2);
  CHECK(found[0].left == "*.L");
  CHECK(found[1].left == "*Left*");
  const Hierarchy mixamo(
      {{"mixamorig:Hips"}, {"mixamorig:LeftUpLeg", 0}, {"mixamorig:RightUpLeg", 0}, {"leftover", 0}});
  const auto pairs = usual_sides(mixamo);
  REQUIRE(pairs.size() == 1);
  CHECK(Mirror(mixamo, pairs).partner(1) == 2);
  CHECK(Mirror(mixamo, pairs).partner(3) == 3);
  const Hierarchy biped({{"Bip01"}, {"Bip01 L Hand", 0}, {"Bip01 R Hand", 0}});
  CHECK(Mirror(biped, usual_sides(biped)).partner(2) == 1);
}

TEST_CASE("a mirror lists all that is wrong with its pairs") {
  const Hierarchy nodes({{"hips"}, {"arm.L", 0}, {"arm.R", 0}, {"hand.L", 1}, {"hand.R", 0}, {"foot.L", 0}});
  const std::vector<MirrorPair> pairs{{"*.L", "*.R"}, {"wing*", "fin*"}, {"*a*", "*"}, {"arm.L", "hips"}};
  CHECK_THROWS_WITH_AS(Mirror(nodes, pairs, {0, 0, 0}),
                       "a mirror does not fit its joints:\n"
                       "  the normal of its plane must have a length, and be finite\n"
                       "  \"foot.L\" has no partner, for there is no \"foot.R\"\n"
                       "  no joint matches \"wing*\" or \"fin*\"\n"
                       "  \"*a*\" and \"*\" must have the same number of *\n"
                       "  \"arm.L\" has two partners, \"arm.R\" and \"hips\"",
                       std::invalid_argument);
  const std::vector<MirrorPair> uneven{{"arm.L", "arm.R"}, {"hand.L", "hand.R"}};
  CHECK_THROWS_WITH_AS(
      Mirror(nodes, uneven),
      "a mirror does not fit its joints:\n"
      "  \"hand.L\" is below \"arm.L\" and its partner \"hand.R\" below \"hips\", which are not partners",
      std::invalid_argument);
}

TEST_CASE("a figure that rests bent is mirrored evenly from its stance") {
  const Hierarchy even = mirrored_figure(true), bent = mirrored_figure(true, 0.3);
  std::vector<Pose> stance;
  for (const Node& node : even.nodes()) stance.push_back(node.rest);
  const auto pose = moved_figure(even, 5, 0.2);
  std::vector<Motion> out(pose.size()), expected(pose.size());
  Mirror(bent, sides, {1, 0, 0}, stance).apply(pose, out);
  Mirror(even, sides).apply(pose, expected);
  for (std::size_t i = 0; i < pose.size(); ++i) CHECK(same_bits(out[i], expected[i]));
  stance.pop_back();
  CHECK_THROWS_WITH_AS(
      Mirror(bent, sides, {1, 0, 0}, stance),
      "a mirror does not fit its joints:\n  its stance needs a pose for each of the 11 joints; it has 10",
      std::invalid_argument);
}

TEST_CASE("mirroring asks for no memory") {
  const Hierarchy nodes = mirrored_figure(true);
  const Mirror mirror(nodes, sides);
  std::vector<Motion> pose = moved_figure(nodes, 1, 0);
  const std::size_t before = allocations();
  mirror.apply(pose, pose);
  CHECK(allocations() == before);
}
