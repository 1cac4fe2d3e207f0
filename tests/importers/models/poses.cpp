// Operations on whole poses, applied to figures that others made.

#include <tweenfall/anim/mirror.h>
#include <tweenfall/anim/retarget.h>
#include <tweenfall/anim/root_motion.h>

#include "anim/moving_pose.h"
#include "importers/models/model_support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// A figure and one of its clips; empty if the models are absent.
struct Dancer {
  std::shared_ptr<const Hierarchy> nodes;
  std::unique_ptr<Animation> animation;
  double duration = 0;

  Dancer(const std::string& file, const std::string& clip_name) {
    const auto path = models_folder() / file;
    if (!std::filesystem::exists(path)) {
      MESSAGE("SKIPPED: no model " << path.string());
      return;
    }
    const Model model = load_model(path);
    nodes = std::make_shared<const Hierarchy>(model.nodes);
    for (std::size_t i = 0; i < model.clips.size(); ++i)
      if (clip_name.empty() || model.clips[i].name == clip_name) {
        duration = model.clips[i].duration;
        animation = std::make_unique<Animation>(nodes, model.clips, std::vector<Play>{Play{.clip = i}});
        break;
      }
    REQUIRE(animation);
  }
  explicit operator bool() const { return animation != nullptr; }

  [[nodiscard]] std::vector<Motion> at(double time) const {
    std::vector<Motion> pose(nodes->size());
    animation->sample(time, pose);
    return pose;
  }
  [[nodiscard]] std::vector<Motion> rest() const {
    std::vector<Motion> pose(nodes->size());
    for (std::size_t i = 0; i < pose.size(); ++i) pose[i].pose = (*nodes)[i].rest;
    return pose;
  }
  [[nodiscard]] std::vector<WorldMotion> in_figure(std::span<const Motion> pose) const {
    std::vector<WorldMotion> world(nodes->size());
    nodes->world_motions(pose, world);
    return world;
  }
};

Vec3 mirrored_point(const Vec3& v) {
  return {-v[0], v[1], v[2]};
}

// The names of the walk's joints in a robot.
const std::vector<RetargetPair> walk_to_robot{
    {"Hips", "Hips"},           {"Spine", "Abdomen"},           {"Spine1", "Torso#2"},
    {"Neck1", "Neck"},          {"LeftArm", "UpperArm.L"},      {"LeftForeArm", "LowerArm.L"},
    {"RightArm", "UpperArm.R"}, {"RightForeArm", "LowerArm.R"}, {"LeftUpLeg", "UpperLeg.L"},
    {"LeftLeg", "LowerLeg.L"},  {"RightUpLeg", "UpperLeg.R"},   {"RightLeg", "LowerLeg.R"}};

}  // namespace

TEST_CASE("a robot's walk mirrored steps with the other foot, as far as the robot is even") {
  const Dancer robot("gltf/RobotExpressive.glb", "Walking");
  if (!robot) return;
  const Mirror mirror(*robot.nodes, usual_sides(*robot.nodes));
  const auto rest = robot.in_figure(robot.rest());
  for (const std::string name : {"UpperLeg", "LowerLeg", "Foot", "Shoulder"}) {
    const std::size_t left = *robot.nodes->find(name + ".L"), right = *robot.nodes->find(name + ".R");
    REQUIRE(mirror.partner(left) == right);
    const double uneven = (rest[left].motion.pose.position - mirrored_point(rest[right].motion.pose.position)).norm();
    CHECK(uneven < 0.08);  // of 4.5 m
    double strides = 0;
    for (const double t : {0.1, 0.45, 0.8}) {
      const auto pose = robot.at(t);
      std::vector<Motion> across(pose.size()), back(pose.size());
      mirror.apply(pose, across);
      mirror.apply(across, back);
      for (std::size_t i = 0; i < pose.size(); ++i) CHECK(near(back[i], pose[i], 1e-12));
      const auto before = robot.in_figure(pose), after = robot.in_figure(across);
      const Vec3 image = mirrored_point(before[left].motion.pose.position);
      CHECK((after[right].motion.pose.position - image).norm() < 3 * uneven);
      strides = std::max(strides, (before[right].motion.pose.position - image).norm());
    }
    if (name == "Foot") CHECK(strides > 0.5);
  }
}

TEST_CASE("a captured walk goes over to a robot: each limb turns as the walker's, and the hips go its way") {
  const Dancer walker("bvh/cmu_12_01_walk.bvh", ""), robot("gltf/RobotExpressive.glb", "Walking");
  if (!walker || !robot) return;
  const Retarget retarget(*walker.nodes, *robot.nodes, walk_to_robot, {.scale = 0.5});
  const auto walker_rest = walker.in_figure(walker.rest()), robot_rest = robot.in_figure(robot.rest());
  const auto walking = [&](double t) {
    std::vector<Motion> out(robot.nodes->size());
    retarget.apply(walker.at(t), out);
    return out;
  };
  int mapped = 0;
  for (const double t : {0.31, 1.27, 2.03}) {
    const auto before = walker.in_figure(walker.at(t)), after = robot.in_figure(walking(t));
    for (std::size_t i = 0; i < retarget.size(); ++i) {
      const std::size_t from = retarget.source_of(i);
      if (from == no_node) continue;
      ++mapped;
      const Motion &source = before[from].motion, &target = after[i].motion;
      const Quat turned = source.pose.rotation * walker_rest[from].motion.pose.rotation.conjugate();
      CHECK(near(target.pose.rotation, Quat(turned * robot_rest[i].motion.pose.rotation), 1e-9));
      CHECK(near(target.twist.angular, source.twist.angular, 1e-9));
    }
    const std::size_t hips = *robot.nodes->find("Hips"), source_hips = *walker.nodes->find("Hips");
    const Vec3 way = before[source_hips].motion.pose.position - walker_rest[source_hips].motion.pose.position;
    CHECK(near(Vec3(after[hips].motion.pose.position - robot_rest[hips].motion.pose.position), 0.5 * way, 1e-6));
    CHECK(near(after[hips].motion.twist.linear, 0.5 * before[source_hips].motion.twist.linear, 1e-6));
  }
  CHECK(mapped == 36);
}

TEST_CASE("the way of a captured walk is taken out of it and put back, and what stays in place does not go") {
  const Dancer walker("bvh/cmu_12_01_walk.bvh", "");
  if (!walker) return;
  const RootMotion root(*walker.nodes, "Hips");
  double gone = 0;
  for (int k = 0; k <= 20; ++k) {
    const double t = walker.duration * (k + 0.5) / 21;
    const auto original = walker.at(t);
    auto pose = original;
    const Motion frame = root.take_out(pose);
    const WorldMotion hips = walker.in_figure(pose)[root.node()];
    CHECK(near(Vec3(hips.motion.twist.linear.cwiseProduct(Vec3(1, 0, 1))), Vec3(0, 0, 0), 1e-12));
    gone += frame.twist.linear.norm();
    root.put_back(pose, frame);
    for (std::size_t i = 0; i < pose.size(); ++i) CHECK(near(pose[i], original[i], 1e-12));
  }
  CHECK(gone > 0);
}
