// Figures with joints whose scale mirrors what is below them, checked by the matrices of the whole chain.

#include <tweenfall/anim/foot_placement.h>
#include <tweenfall/anim/jiggle.h>
#include <tweenfall/anim/joint_chain.h>
#include <tweenfall/anim/look_at.h>
#include <tweenfall/anim/mirror.h>
#include <tweenfall/anim/node_spring.h>
#include <tweenfall/anim/retarget.h>
#include <tweenfall/anim/root_motion.h>
#include <tweenfall/anim/two_bone.h>

#include "anim/moving_pose.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

struct ReflectedJoint {
  const char* name;
  std::size_t parent;
  Vec3 at;     // in the figure's space
  Vec3 scale;  // +-1 times a number
};

/// Joints at these places, with arbitrary axes.
Hierarchy reflected_figure(std::uint64_t seed, const std::vector<ReflectedJoint>& joints) {
  Random random(seed);
  Hierarchy nodes;
  std::vector<Mat3> linear;
  for (const ReflectedJoint& joint : joints) {
    const bool root = joint.parent == no_node;
    const Mat3 above = root ? Mat3(Mat3::Identity()) : linear[joint.parent];
    const Vec3 from = root ? Vec3(0, 0, 0) : joints[joint.parent].at;
    const Pose rest{above.inverse() * Vec3(joint.at - from), random.rotation(), joint.scale};
    linear.push_back(above * rest.rotation.toRotationMatrix() * rest.scale.asDiagonal());
    nodes.add({joint.name, joint.parent, rest});
  }
  return nodes;
}

/// A random pose that moves, with the scales of the rest pose.
std::vector<Motion> moved_at_rest_scale(const Hierarchy& nodes, std::uint64_t seed, double t) {
  std::vector<Motion> pose = moving_pose(seed, nodes.size(), t);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    pose[i].pose.scale = nodes[i].rest.scale;
    pose[i].scale_rate = {0, 0, 0};
  }
  return pose;
}

std::vector<WorldMotion> world_of(const Hierarchy& nodes, std::span<const Motion> local) {
  std::vector<WorldMotion> world(nodes.size());
  nodes.world_motions(local, world);
  return world;
}

std::vector<WorldMotion> rest_world_of(const Hierarchy& nodes) {
  std::vector<Motion> local(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) local[i].pose = nodes[i].rest;
  return world_of(nodes, local);
}

Mat3 turn_from(const WorldMotion& rest, const WorldMotion& now) {
  return now.linear * rest.linear.inverse();
}
/// The cross-product matrix of the angular velocity.
Mat3 spin_of(const WorldMotion& now) {
  return now.linear_rate * now.linear.inverse();
}

double far(const Mat3& a, const Mat3& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

const Vec3 plain(1, 1, 1);

}  // namespace

TEST_CASE("poses go to and from skeletons with mirrored joints: turns in the figure's space are the same") {
  const auto source_of = [](const Vec3& root, const Vec3& spine, const Vec3& inner, const Vec3& arm) {
    return reflected_figure(1, {{"root", no_node, {0, 0, 0}, root},
                                {"hips", 0, {0, 1, 0.1}, plain},
                                {"spine1", 1, {0, 1.2, 0}, spine},
                                {"spine2", 2, {0, 1.4, 0}, inner},
                                {"arm", 3, {0.2, 1.5, 0}, arm},
                                {"hand", 4, {0.7, 1.4, 0}, plain}});
  };
  const auto target_of = [](const Vec3& root, const Vec3& chest, const Vec3& twist, const Vec3& arm) {
    return reflected_figure(2, {{"Armature", no_node, {0, 0.1, 0}, root},
                                {"Hips", 0, {0, 0.5, 0}, plain},
                                {"Chest", 1, {0, 0.8, 0}, chest},
                                {"Twist", 2, {0.1, 0.85, 0}, twist},
                                {"Arm", 3, {0.2, 0.85, 0.05}, arm},
                                {"Hand", 4, {0.35, 0.7, 0.05}, plain}});
  };
  const std::vector<RetargetPair> pairs{{"hips", "Hips"}, {"spine2", "Chest"}, {"arm", "Arm"}, {"hand", "Hand"}};
  const Vec3 x(-1, 1, 1), y(1, -1, 1), all(-1, -1, -1), small(-0.01, 0.01, 0.01), turned(-1, -1, 1);
  struct Case {
    Hierarchy source, target;
  };
  for (const Case& each : {Case{source_of(plain, plain, plain, plain), target_of(plain, plain, plain, x)},
                           Case{source_of(plain, x, plain, plain), target_of(plain, plain, plain, plain)},
                           Case{source_of(x, y, all, x), target_of(plain, plain, plain, plain)},
                           Case{source_of(plain, plain, plain, plain), target_of(small, x, y, all)},
                           Case{source_of(y, x, turned, all), target_of(small, y, x, turned)}}) {
    const Quat turn = exp_map({0.3, 1, -0.4});
    const Mat3 across = turn.toRotationMatrix();
    const Retarget retarget(each.source, each.target, pairs, {.scale = 0.5, .turn = turn});
    const auto result = [&](double t) {
      std::vector<Motion> out(retarget.size());
      retarget.apply(moved_at_rest_scale(each.source, 3, t), out);
      return out;
    };
    const auto before = world_of(each.source, moved_at_rest_scale(each.source, 3, 0.2)),
               source_rest = rest_world_of(each.source), target_rest = rest_world_of(each.target);
    const auto local = result(0.2);
    const auto after = world_of(each.target, local);
    for (std::size_t i = 0; i < each.target.size(); ++i) {
      CHECK(local[i].pose.scale == each.target[i].rest.scale);
      const std::size_t from = retarget.source_of(i);
      if (from == no_node) continue;
      CAPTURE(each.target[i].name);
      const Mat3 theirs = across * turn_from(source_rest[from], before[from]) * across.transpose();
      CHECK(far(turn_from(target_rest[i], after[i]), theirs) < 1e-12);
      CHECK(far(spin_of(after[i]), across * spin_of(before[from]) * across.transpose()) < 1e-11);
    }
    const auto way = [](const WorldMotion& rest, const WorldMotion& now) {
      return Vec3(now.motion.pose.position - rest.motion.pose.position);
    };
    CHECK(near(way(target_rest[1], after[1]), Vec3(0.5 * (turn * way(source_rest[1], before[1]))), 1e-12));
    CHECK(near(after[1].motion.twist.linear, Vec3(0.5 * (turn * before[1].motion.twist.linear)), 1e-11));
    for (std::size_t i = 0; i < retarget.size(); ++i) check_rates([&](double t) { return result(t)[i]; }, 0.2);
  }
}

TEST_CASE("a figure one of whose sides was made by a scale of -1 is mirrored as any other") {
  const auto figure = [](const Vec3& root, const Vec3& left, const Vec3& elbow, const Vec3& right) {
    return reflected_figure(4, {{"root", no_node, {0, 0, 0}, root},
                                {"hips", 0, {0, 1, 0.1}, plain},
                                {"arm.L", 1, {0.2, 1.4, 0.05}, left},
                                {"hand.L", 2, {0.7, 1.2, 0.15}, elbow},
                                {"arm.R", 1, {-0.2, 1.4, 0.05}, right},
                                {"hand.R", 4, {-0.7, 1.2, 0.15}, plain},
                                {"thumb.R", 5, {-0.75, 1.1, 0.2}, plain},
                                {"thumb.L", 3, {0.75, 1.1, 0.2}, plain}});
  };
  const Vec3 x(-1, 1, 1), y(1, -1, 1), all(-1, -1, -1);
  const Mat3 image = Vec3(-1, 1, 1).asDiagonal();
  for (const Hierarchy& nodes :
       {figure(plain, x, plain, plain), figure(plain, plain, y, all), figure(x, all, y, x), figure(y, y, y, y)}) {
    const Mirror mirror(nodes, {{{"*.L", "*.R"}}});
    const auto mirrored = [&](double t) {
      std::vector<Motion> out(nodes.size());
      mirror.apply(moved_at_rest_scale(nodes, 6, t), out);
      return out;
    };
    const auto before = world_of(nodes, moved_at_rest_scale(nodes, 6, 0.2)), after = world_of(nodes, mirrored(0.2)),
               rest = rest_world_of(nodes);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const std::size_t other = mirror.partner(i);
      CAPTURE(nodes[i].name);
      CHECK(near(after[i].motion.pose.position, Vec3(image * before[other].motion.pose.position), 1e-12));
      CHECK(near(after[i].motion.twist.linear, Vec3(image * before[other].motion.twist.linear), 1e-11));
      CHECK(far(turn_from(rest[i], after[i]), image * turn_from(rest[other], before[other]) * image) < 1e-12);
      check_rates([&](double t) { return mirrored(t)[i]; }, 0.2);
    }
    std::vector<Motion> twice(nodes.size());
    mirror.apply(mirrored(0.2), twice);
    for (std::size_t i = 0; i < nodes.size(); ++i) CHECK(near(twice[i], moved_at_rest_scale(nodes, 6, 0.2)[i], 1e-11));
  }
}

TEST_CASE("root motion is taken out below mirrored joints: what it carries is where it was") {
  const Vec3 small(-0.01, 0.01, 0.01), y(1, -1, 1);
  const Hierarchy nodes = reflected_figure(5, {{"Armature", no_node, {0.1, 0.2, 0}, small},
                                               {"group", 0, {0, 0.5, 0}, y},
                                               {"hips", 1, {0, 1, 0.1}, plain},
                                               {"arm", 2, {0.3, 1, 0.1}, plain}});
  for (const auto turn : {RootParts::Turn::none, RootParts::Turn::yaw, RootParts::Turn::all}) {
    const RootMotion root(nodes, "hips", {.horizontal = true, .vertical = true, .turn = turn});
    const auto taken = [&](double t, std::vector<Motion>& pose) {
      pose = moved_at_rest_scale(nodes, 7, t);
      return root.take_out(pose);
    };
    std::vector<Motion> pose;
    const Motion frame = taken(0.2, pose);
    const auto before = world_of(nodes, moved_at_rest_scale(nodes, 7, 0.2)), after = world_of(nodes, pose);
    for (const std::size_t i : {2U, 3U}) {
      CHECK(far(before[i].linear, frame.pose.rotation.toRotationMatrix() * after[i].linear) < 1e-12);
      CHECK(near(before[i].motion.pose.position,
                 Vec3(frame.pose.rotation * after[i].motion.pose.position + frame.pose.position), 1e-12));
    }
    // At rest the frame is the identity, so a turn of the whole is a turn of the frame.
    if (turn == RootParts::Turn::all)
      CHECK(far(frame.pose.rotation.toRotationMatrix(), turn_from(rest_world_of(nodes)[2], before[2])) < 1e-12);
    check_rates([&](double t) { return taken(t, pose); }, 0.2);
    check_rates(
        [&](double t) {
          taken(t, pose);
          return pose[2];
        },
        0.2, 1e-7);
    const Motion again = taken(0.2, pose);
    root.put_back(pose, again);
    CHECK(near(pose[2], moved_at_rest_scale(nodes, 7, 0.2)[2], 1e-10));
  }
}

namespace {

/// The same figure without mirrored joints: every joint is at the same place in every pose made by `as_plain`.
Vec3 signs_above(const Hierarchy& nodes, std::size_t node) {
  Vec3 signs(1, 1, 1);
  for (std::size_t i = nodes[node].parent; i != no_node; i = nodes[i].parent)
    signs = signs.cwiseProduct(nodes[i].rest.scale.cwiseSign());
  return signs;
}
Pose plain_pose(const Pose& pose, const Vec3& signs) {
  const Mat3 turn = signs.asDiagonal() * pose.rotation.toRotationMatrix() * signs.asDiagonal();
  return {signs.cwiseProduct(pose.position), Quat(turn), pose.scale.cwiseAbs()};
}
Hierarchy plain_figure(const Hierarchy& nodes) {
  Hierarchy plain_nodes;
  for (std::size_t i = 0; i < nodes.size(); ++i)
    plain_nodes.add({nodes[i].name, nodes[i].parent, plain_pose(nodes[i].rest, signs_above(nodes, i))});
  return plain_nodes;
}
std::vector<Motion> as_plain(const Hierarchy& nodes, std::vector<Motion> pose) {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 signs = signs_above(nodes, i);
    pose[i].pose = plain_pose(pose[i].pose, signs);
    pose[i].twist.linear = signs.cwiseProduct(pose[i].twist.linear);
    pose[i].twist.angular = signs.prod() * signs.cwiseProduct(pose[i].twist.angular);
  }
  return pose;
}

/// A limb with joints between its bones.
Hierarchy reflected_limb(const Vec3& root, const Vec3& thigh, const Vec3& between, const Vec3& shin) {
  return reflected_figure(11, {{"root", no_node, {0, 1, 0}, root},
                               {"group", 0, {0.05, 1.05, 0}, thigh},
                               {"thigh", 1, {0.1, 0.9, 0}, thigh},
                               {"twist", 2, {0.12, 0.7, 0.03}, between},
                               {"shin", 3, {0.1, 0.45, 0.05}, shin},
                               {"foot", 4, {0.1, 0.05, 0}, plain},
                               {"toe", 5, {0.1, 0, 0.1}, plain}});
}

std::vector<Hierarchy> reflected_limbs() {
  const Vec3 x(-1, 1, 1), y(1, -1, 1), all(-1, -1, -1), half(-0.5, 0.5, -0.5);
  return {reflected_limb(plain, x, plain, plain), reflected_limb(x, y, plain, plain), reflected_limb(y, plain, all, x),
          reflected_limb(half, x, y, all), reflected_limb(plain, plain, plain, y)};
}

/// Poses near rest, with velocities.
std::vector<Motion> bent_limb(const Hierarchy& nodes, double t) {
  Random random(12);
  std::vector<Motion> pose(nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec3 away = random.vector(0.2), spin = random.vector(0.5);
    pose[i].pose = nodes[i].rest;
    pose[i].pose.rotation = exp_map(t * spin) * nodes[i].rest.rotation * exp_map(away);
    pose[i].twist.angular = spin;
  }
  return pose;
}

/// Whether a change to poses of both figures leaves their joints at the same places, with the same velocities.
template <class Change, class PlainChange>
void check_same_places(const Hierarchy& nodes, const Change& change, const PlainChange& plain_change) {
  const Hierarchy plain_nodes = plain_figure(nodes);
  std::vector<Motion> pose = bent_limb(nodes, 0.2), plain_motions = as_plain(nodes, pose);
  const std::vector<WorldMotion> before = world_of(nodes, pose), told = world_of(plain_nodes, plain_motions);
  change(nodes, pose);
  plain_change(plain_nodes, plain_motions);
  const std::vector<WorldMotion> after = world_of(nodes, pose), expected = world_of(plain_nodes, plain_motions);
  double moved = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    CAPTURE(nodes[i].name);
    CHECK(near(before[i].motion.pose.position, told[i].motion.pose.position, 1e-14));
    CHECK(near(before[i].motion.twist.linear, told[i].motion.twist.linear, 1e-13));
    CHECK(near(after[i].motion.pose.position, expected[i].motion.pose.position, 1e-10));
    CHECK(near(after[i].motion.twist.linear, expected[i].motion.twist.linear, 1e-9));
    moved = std::max(moved, (after[i].motion.pose.position - before[i].motion.pose.position).norm());
  }
  CHECK(moved > 0.02);
}

template <class Change>
void check_same_places(const Hierarchy& nodes, const Change& change) {
  check_same_places(nodes, change, change);
}

}  // namespace

TEST_CASE("limbs with mirrored joints bend, stand and look as the same limbs without") {
  for (const Hierarchy& nodes : reflected_limbs()) {
    const Vec3 hip = rest_world_of(nodes)[2].motion.pose.position, foot = rest_world_of(nodes)[5].motion.pose.position;
    const Sample<Vec3> target{hip + 0.7 * (foot - hip) + Vec3(0.1, 0.05, 0.1), {0.3, 0.2, -0.1}, {0, 0, 0}};
    for (const double weight : {1.0, 0.4}) {
      for (const bool pole : {false, true})
        check_same_places(nodes, [&](const Hierarchy& of, std::vector<Motion>& pose) {
          TwoBoneGoal goal{.target = target};
          if (pole) goal.pole = Sample<Vec3>{{0.3, 0.1, 1}, {0.1, 0, 0.2}, {0, 0, 0}};
          reach(TwoBoneChain(of, {"thigh", "shin", "foot"}), goal, {weight, 0.2, 0}, pose);
        });
      check_same_places(nodes, [&](const Hierarchy& of, std::vector<Motion>& pose) {
        place_feet(
            FootPlacement(of, {.pelvis = "group", .feet = {{.leg = {"thigh", "shin", "foot"}}}}),
            [](const Sample<Vec3>&) {
              return Ground{.height = 0.2, .normal = {0.2, 1, 0.1}};
            },
            {0, 0, 0}, {weight, 0, 0}, {}, pose);
      });
      const Vec3 forward(0.3, -1, 0.2), up(0, 0.1, 1), eye(0.02, 0.01, 0.03);
      const auto looking = [&](const Vec3& signs) {
        return [&, signs](const Hierarchy& of, std::vector<Motion>& pose) {
          const LookAtSettings settings{.joints = {{"thigh", 0.4}, {"twist", 0.7}, {"shin", 1}},
                                        .forward = signs.cwiseProduct(forward),
                                        .up = signs.cwiseProduct(up),
                                        .eye = signs.cwiseProduct(eye)};
          LookAtGoal goal{.target = {{2, 0.5, 1.5}, {0.3, 0.1, 0}, {0, 0, 0}}};
          goal.up = Sample<Vec3>{{0.1, 0, 1}, {0, 0, 0}, {0, 0, 0}};
          look_at(LookAtChain(of, settings), goal, {weight, 0.2, 0}, pose);
        };
      };
      check_same_places(nodes, looking(plain),
                        looking(signs_above(nodes, 4).cwiseProduct(nodes[4].rest.scale.cwiseSign())));
    }
  }
}

TEST_CASE("chains with mirrored joints reach their targets, at the rates of their motion") {
  for (const Hierarchy& nodes : reflected_limbs()) {
    const Vec3 hip = rest_world_of(nodes)[2].motion.pose.position, foot = rest_world_of(nodes)[5].motion.pose.position;
    const Vec3 place = hip + 0.7 * (foot - hip) + Vec3(0.1, 0.05, 0.1), velocity(0.3, 0.2, -0.1);
    for (const ChainMethod method : {ChainMethod::fabrik, ChainMethod::ccd})
      for (const bool between : {false, true})
        for (const double weight : {1.0, 0.4}) {
          JointChainSettings settings{.links = {{"thigh"}, {"shin"}, {"foot"}}, .method = method};
          if (between) settings.links.insert(settings.links.begin() + 1, {"twist"});
          const JointChain chain(nodes, settings);
          const auto shown = [&](double t) {
            std::vector<Motion> pose = bent_limb(nodes, t);
            reach(chain, {place + t * velocity, velocity, {0, 0, 0}}, {weight, 0, 0}, pose);
            return world_of(nodes, pose);
          };
          const std::vector<WorldMotion> now = shown(0.2);
          if (weight == 1) {
            CHECK(near(now[5].motion.pose.position, Vec3(place + 0.2 * velocity), 1e-12));
            CHECK(near(now[5].motion.twist.linear, velocity, 1e-11));
          }
          for (std::size_t i = 3; i < nodes.size(); ++i)
            CHECK(near(now[i].motion.twist.linear,
                       slope([&](double t) { return Vec3(shown(t)[i].motion.pose.position); }, 0.2, 1e-3), 1e-7));
        }
  }
}

TEST_CASE("chains with mirrored joints swing, and springs lag behind, as the same ones without") {
  for (const Hierarchy& nodes : reflected_limbs()) {
    for (const bool swings : {true, false}) {
      const auto follow_script = [&](const Hierarchy& of, bool is_plain, std::vector<Motion>& pose) {
        std::vector<Motion> scratch(2 * of.size());
        const auto script = [&](double t, std::span<Motion> out) {
          const std::vector<Motion> own = is_plain ? as_plain(nodes, bent_limb(nodes, t)) : bent_limb(nodes, t);
          std::ranges::copy(own, out.begin());
        };
        if (swings) {
          const JiggleChain chain(of, {.joints = {"thigh", "shin", "foot", "toe"},
                                       .spring = {.hz = 2, .damping = 0.3, .gravity = {3, -5, 2}}});
          JiggleState state = chain.at_rest(0);
          jiggle(chain, state, 0.2, script, {0.8, 0.1, 0}, scratch, pose);
        } else {
          const SpringSettings place{.hz = 2, .damping = 0.3, .gravity = {3, -5, 2}}, turn{.hz = 1, .damping = 0.2};
          const NodeSpring spring(of, {"shin", place, turn});
          NodeSpringState state = spring.at_rest(0);
          follow(spring, state, 0.2, script, {0.8, 0.1, 0}, scratch, pose);
        }
      };
      check_same_places(
          nodes, [&](const Hierarchy& of, std::vector<Motion>& pose) { follow_script(of, false, pose); },
          [&](const Hierarchy& of, std::vector<Motion>& pose) { follow_script(of, true, pose); });
    }
  }
}

TEST_CASE("joints below scales that mirror keep their limits, and a given axis is the joint's own") {
  const Vec3 x(-1, 1, 1), y(1, -1, 1);
  for (const Hierarchy& nodes : {reflected_limb(plain, x, plain, plain), reflected_limb(x, y, x, y)}) {
    const Vec3 hip = rest_world_of(nodes)[2].motion.pose.position, foot = rest_world_of(nodes)[5].motion.pose.position;
    const Sample<Vec3> target{hip + 0.6 * (foot - hip) + Vec3(0.2, 0.1, 0.1), {0, 0, 0}, {0, 0, 0}};
    const Vec3 axis = Vec3(0.3, 0.5, -0.7).normalized();
    for (const bool up : {false, true}) {
      const JointChain chain(nodes, {.links = {{"thigh", HingeLimit{axis, up ? 0.1 : -0.5, up ? 0.5 : -0.1}},
                                               {"shin", ConeLimit{0.4, up ? 0.05 : -0.3, up ? 0.3 : -0.05}},
                                               {"foot"}}});
      std::vector<Motion> pose = bent_limb(nodes, 0);
      reach(chain, target, {1, 0, 0}, pose);
      const Vec3 turned = log_map(nodes[2].rest.rotation.conjugate() * pose[2].pose.rotation);
      CHECK(near(turned, Vec3(turned.dot(axis) * axis), 1e-12));
      CHECK(turned.dot(axis) * (up ? 1 : -1) >= 0.1 - 1e-12);
      CHECK(turned.dot(axis) * (up ? 1 : -1) <= 0.5 + 1e-12);
      // The twist of the shin about its bone: half its tangent is the part of the quaternion along it.
      const Vec3 bone = nodes[4].rest.scale.cwiseProduct(nodes[5].rest.position).normalized();
      const Quat swung = nodes[4].rest.rotation.conjugate() * pose[4].pose.rotation;
      const double twist = 2 * std::atan2(swung.vec().dot(bone), swung.w()) * (up ? 1 : -1);
      CHECK(twist >= 0.05 - 1e-12);
      CHECK(twist <= 0.3 + 1e-12);
      CHECK(std::acos(bone.dot(swung * bone)) <= 0.4 + 1e-12);
    }
  }
}
