#include <tweenfall/anim/retarget.h>

#include "anim/moving_pose.h"
#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

// A figure with joints at given places, with arbitrary axes.
Hierarchy figure_of(std::uint64_t seed, const std::vector<std::tuple<std::string, std::size_t, Vec3>>& places) {
  Random random(seed);
  std::vector<Node> nodes;
  std::vector<Quat> axes;
  for (const auto& [name, parent, at] : places) {
    axes.push_back(random.rotation());
    const Quat back = parent == no_node ? Quat(1, 0, 0, 0) : Quat(axes[parent].conjugate());
    const Vec3 from = parent == no_node ? Vec3(0, 0, 0) : std::get<2>(places[parent]);
    nodes.push_back(
        {name, parent, {.position = back * Vec3(at - from), .rotation = (back * axes.back()).normalized()}});
  }
  return Hierarchy(nodes);
}

Hierarchy actor() {
  return figure_of(1, {{"root", no_node, {0, 0, 0}},
                       {"hips", 0, {0, 1, 0.1}},
                       {"spine1", 1, {0, 1.2, 0}},
                       {"spine2", 2, {0, 1.4, 0}},
                       {"arm", 3, {0.2, 1.5, 0}},
                       {"hand", 4, {0.7, 1.4, 0}},
                       {"tail", 1, {0, 0.8, -0.4}}});
}

// Shorter, with one spine joint, two more in the arm, and a hat.
Hierarchy dwarf() {
  return figure_of(2, {{"Armature", no_node, {0, 0.1, 0}},
                       {"Hips", 0, {0, 0.5, 0}},
                       {"Chest", 1, {0, 0.8, 0}},
                       {"Twist", 2, {0.1, 0.85, 0}},
                       {"Arm", 3, {0.2, 0.85, 0.05}},
                       {"Sleeve", 4, {0.3, 0.8, 0.05}},
                       {"Hand", 5, {0.35, 0.7, 0.05}},
                       {"Hat", 2, {0, 1.1, 0}}});
}

const std::vector<RetargetPair> to_dwarf{{"hips", "Hips"}, {"spine2", "Chest"}, {"arm", "Arm"}, {"hand", "Hand"}};

std::vector<Motion> unscaled(std::uint64_t seed, std::size_t count, double t) {
  std::vector<Motion> pose = moving_pose(seed, count, t);
  for (Motion& motion : pose) {
    motion.pose.scale = {1, 1, 1};
    motion.scale_rate = {0, 0, 0};
  }
  return pose;
}

std::vector<Motion> at_rest(const Hierarchy& nodes) {
  std::vector<Motion> pose(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) pose[i].pose = nodes[i].rest;
  return pose;
}

std::vector<Motion> in_figure(const Hierarchy& nodes, std::span<const Motion> local) {
  std::vector<WorldMotion> world(nodes.size());
  nodes.world_motions(local, world);
  std::vector<Motion> motions;
  for (const WorldMotion& node : world) motions.push_back(node.motion);
  return motions;
}

std::vector<Motion> retargeted(const Retarget& retarget, std::span<const Motion> pose) {
  std::vector<Motion> out(retarget.size());
  retarget.apply(pose, out);
  return out;
}

}  // namespace

TEST_CASE("a retargeted joint turns from rest as its source does in the figure's space, angular velocity too") {
  const Hierarchy source = actor(), target = dwarf();
  for (const Quat& turn : {Quat(1, 0, 0, 0), exp_map({-pi / 2, 0, 0}), exp_map({0.3, 1, -0.4})}) {
    const Retarget retarget(source, target, to_dwarf, {.scale = 0.6, .turn = turn});
    const auto pose = unscaled(3, source.size(), 0.2);
    const auto before = in_figure(source, pose), source_rest = in_figure(source, at_rest(source));
    const auto local = retargeted(retarget, pose);
    const auto after = in_figure(target, local), target_rest = in_figure(target, at_rest(target));
    int mapped = 0;
    for (std::size_t i = 0; i < target.size(); ++i) {
      const std::size_t from = retarget.source_of(i);
      if (from == no_node) {
        CHECK(same_bits(local[i], at_rest(target)[i]));
        continue;
      }
      ++mapped;
      const Quat turned = before[from].pose.rotation * source_rest[from].pose.rotation.conjugate();
      const Quat own = after[i].pose.rotation * target_rest[i].pose.rotation.conjugate();
      CHECK(near(own, Quat(turn * turned * turn.conjugate()), 1e-13));
      CHECK(near(after[i].twist.angular, Vec3(turn * before[from].twist.angular), 1e-12));
      if (i > 1) CHECK(local[i].pose.position == target[i].rest.position);
    }
    CHECK(mapped == 4);
  }
}

TEST_CASE("the hips go the source's way, scaled by the hip heights, whatever carries them") {
  const Hierarchy source = actor(), target = dwarf();
  const Retarget retarget(source, target, to_dwarf);
  CHECK(near(retarget.scale(), 0.5, 1e-14));
  const auto pose = unscaled(4, source.size(), 0.3);
  const auto before = in_figure(source, pose), after = in_figure(target, retargeted(retarget, pose));
  const Vec3 way = before[1].pose.position - in_figure(source, at_rest(source))[1].pose.position;
  CHECK(near(after[1].pose.position, Vec3(in_figure(target, at_rest(target))[1].pose.position + 0.5 * way), 1e-13));
  CHECK(near(after[1].twist.linear, 0.5 * before[1].twist.linear, 1e-13));
}

TEST_CASE("a skeleton's pose retargeted to itself is the pose, and to a copy of twice the size the same one larger") {
  const Hierarchy source = actor();
  const auto pose = unscaled(5, source.size(), 0.1);
  std::vector<RetargetPair> all{{"*", "*", true}};
  const auto same = retargeted(Retarget(source, source, all), pose);
  for (std::size_t i = 0; i < source.size(); ++i) CHECK(near(same[i], pose[i], 1e-13));

  std::vector<Node> larger(source.nodes().begin(), source.nodes().end());
  for (Node& node : larger) node.rest.position *= 2;
  const auto twice = retargeted(Retarget(source, Hierarchy(larger), all), pose);
  for (std::size_t i = 0; i < source.size(); ++i) {
    CHECK(near(twice[i].pose.position, 2 * pose[i].pose.position, 1e-13));
    CHECK(near(twice[i].twist.linear, 2 * pose[i].twist.linear, 1e-13));
    CHECK(near(twice[i].pose.rotation, pose[i].pose.rotation, 1e-13));
  }
}

TEST_CASE("a figure made in centimeters below a scaled root goes the same way as one in meters") {
  const Hierarchy source = actor();
  std::vector<Node> small(source.nodes().begin(), source.nodes().end());
  for (std::size_t i = 1; i < small.size(); ++i) small[i].rest.position *= 100;
  small[0].rest.scale = {0.01, 0.01, 0.01};
  const Hierarchy target(small);
  const std::vector<RetargetPair> hips{{"hips", "hips"}, {"hand", "hand"}};
  const auto pose = unscaled(5, source.size(), 0.1);
  for (const bool back : {false, true}) {
    const Retarget retarget(back ? target : source, back ? source : target, hips);
    CHECK(near(retarget.scale(), 1, 1e-14));
    auto given = pose;
    if (back) {
      for (std::size_t i = 1; i < given.size(); ++i) {
        given[i].pose.position *= 100;
        given[i].twist.linear *= 100;
      }
      given[0].pose.scale = {0.01, 0.01, 0.01};
    }
    const auto before = in_figure(back ? target : source, given),
               after = in_figure(back ? source : target, retargeted(retarget, given));
    CHECK(near(after[1].pose.position, before[1].pose.position, 1e-13));
    CHECK(near(after[1].twist.linear, before[1].twist.linear, 1e-12));
  }
}

TEST_CASE("where rest poses do not stand alike, stances do: the one gives the other") {
  const Hierarchy source = actor(), target = dwarf();
  std::vector<Pose> source_stance, target_stance;
  Random random(8);
  for (const Node& node : source.nodes()) source_stance.push_back(node.rest);
  for (const Node& node : target.nodes()) target_stance.push_back(node.rest);
  source_stance[4].rotation = source_stance[4].rotation * exp_map({0, 0, 0.7});
  target_stance[6].rotation = target_stance[6].rotation * exp_map({0.5, 0, 0});
  const Retarget retarget(source, target, to_dwarf, {.source_stance = source_stance, .target_stance = target_stance});
  std::vector<Motion> pose = at_rest(source);
  for (std::size_t i = 0; i < pose.size(); ++i) pose[i].pose = source_stance[i];
  const auto out = retargeted(retarget, pose);
  for (std::size_t i = 0; i < out.size(); ++i) {
    CHECK(near(out[i].pose.rotation, target_stance[i].rotation, 1e-14));
    CHECK(near(out[i].pose.position, target_stance[i].position, 1e-14));
  }
}

TEST_CASE("the rates of a retargeted pose are the derivatives of its poses, with a joint of the source left out") {
  const Hierarchy source = actor(), target = dwarf();
  const Retarget retarget(source, target, to_dwarf, {.turn = exp_map({0.2, 0.5, 0.1})});
  for (std::size_t i = 0; i < target.size(); ++i)
    check_rates([&](double t) { return retargeted(retarget, moving_pose(11, source.size(), t))[i]; }, 0.1);
}

TEST_CASE("all that is wrong with a map between skeletons is listed") {
  const Hierarchy source = actor(), target = dwarf();
  const std::vector<RetargetPair> pairs{{"hip", "Hips"}, {"arm", "Arme"}, {"spine1", "Chest"}, {"spine2", "Chest"},
                                        {"arm", "Arm"},  {"arm", "Hand"}, {"x*", "*"},         {"*", "hat"},
                                        {"t*", "T*"},    {"arm", "Arm"}};
  CHECK_THROWS_WITH_AS(Retarget(source, target, pairs, {.target_stance = {Pose{}}}),
                       "poses cannot be transferred to the other skeleton:\n"
                       "  in the source no joint is named \"hip\"; did you mean \"hips\"?\n"
                       "  in the target no joint is named \"Arme\"; did you mean \"Arm\"?\n"
                       "  \"Chest\" is mapped twice, to \"spine1\" and to \"spine2\"\n"
                       "  \"arm\" is mapped twice, to \"Arm\" and to \"Hand\"\n"
                       "  in the source no joint matches \"x*\"\n"
                       "  \"*\" and \"hat\" must have the same number of *\n"
                       "  in the target no joint is named by \"T*\" as those of the source by \"t*\"\n"
                       "  \"Arm\" is mapped twice, both times to \"arm\"\n"
                       "  the stance of the target needs a pose for each of its 8 joints; it has 1",
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS(Retarget(source, target, {}),
                       "poses cannot be transferred to the other skeleton:\n  no joints are mapped",
                       std::invalid_argument);
  const std::vector<RetargetPair> crossed{{"arm", "Chest"}, {"spine2", "Arm"}};
  CHECK_THROWS_WITH_AS(Retarget(source, target, crossed),
                       "poses cannot be transferred to the other skeleton:\n"
                       "  \"Arm\" is below \"Chest\", but its source \"spine2\" is not below \"arm\"",
                       std::invalid_argument);
  const std::vector<RetargetPair> low{{"root", "Armature"}};
  CHECK_THROWS_WITH_AS(
      Retarget(source, target, low),
      "poses cannot be transferred to the other skeleton:\n"
      "  the hips \"Armature\" stand 0.1 above the ground, and those of the source 0; unless both are above "
      "it, a scale must be given",
      std::invalid_argument);
  CHECK_THROWS_AS(Retarget(source, target, to_dwarf, {.scale = -1}), std::invalid_argument);
  CHECK_THROWS_AS(Retarget(source, target, to_dwarf, {.turn = Quat(0, 0, 0, 0)}), std::invalid_argument);
}

TEST_CASE("retargeting asks for no memory") {
  const Hierarchy source = actor(), target = dwarf();
  const Retarget retarget(source, target, to_dwarf);
  const auto pose = unscaled(3, source.size(), 0.2);
  std::vector<Motion> out(target.size());
  const std::size_t before = allocations();
  retarget.apply(pose, out);
  CHECK(allocations() == before);
}
