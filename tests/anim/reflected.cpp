// Figures with joints whose scale mirrors what is below them, checked by the matrices of the whole chain.

#include <tweenfall/anim/mirror.h>
#include <tweenfall/anim/retarget.h>
#include <tweenfall/anim/root_motion.h>

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
    root.put_back(pose, taken(0.2, pose));
    CHECK(near(pose[2], moved_at_rest_scale(nodes, 7, 0.2)[2], 1e-10));
  }
}
