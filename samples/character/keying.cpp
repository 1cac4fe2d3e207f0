#include "keying.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/quaternion_cubic.h>
#include <tweenfall/curves/rotation.h>

#include <vector>

namespace tweenfall::character {

namespace {

// Wide enough for doubles, narrow enough that the slope is right to about 1e-6, relatively.
constexpr double narrow = 1e-4;  // s

struct KeyedPose {
  double time;
  FigurePose before, at, after;
};

Vec4 parts(const Quat& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

Curve<Quat> rotation_curve(const std::vector<KeyedPose>& poses, Joint joint) {
  std::vector<double> times;
  std::vector<Vec4> values, rates;
  Quat reference = Quat::Identity();
  for (const KeyedPose& pose : poses) {
    reference = hemisphere_aligned(pose.at.turns[joint], reference);
    const Quat before = hemisphere_aligned(pose.before.turns[joint], reference);
    const Quat after = hemisphere_aligned(pose.after.turns[joint], reference);
    times.push_back(pose.time);
    values.push_back(parts(reference));
    rates.push_back((parts(after) - parts(before)) / (2 * narrow));
  }
  return gltf_cubic_rotation(times, rates, values, rates);
}

Curve<Vec3> hips_curve(const std::vector<KeyedPose>& poses) {
  std::vector<Key<Vec3>> keys;
  for (const KeyedPose& pose : poses) {
    const Vec3 rate = (pose.after.hips_position - pose.before.hips_position) / (2 * narrow);
    const Tangent<Vec3> tangent{.kind = Tangent<Vec3>::Kind::given, .rate = rate};
    keys.push_back({.time = pose.time, .value = pose.at.hips_position, .in = tangent, .out = tangent});
  }
  return keyed_curve<Vec3>(keys);
}

bool leaves(const std::vector<KeyedPose>& poses, Joint joint, const Quat& rest) {
  for (const KeyedPose& pose : poses)
    if ((parts(hemisphere_aligned(pose.at.turns[joint], rest)) - parts(rest)).norm() > 1e-9) return true;
  return false;
}

}  // namespace

Clip keyed_clip(const Keying& keying, const PoseOverTime& pose_at) {
  std::vector<KeyedPose> poses;
  for (int i = 0; i <= keying.spans; ++i) {
    const double time = keying.duration * i / keying.spans;
    poses.push_back({time, pose_at(time - narrow), pose_at(time), pose_at(time + narrow)});
  }
  if (keying.is_cyclic) {
    const Vec3 way = poses.back().at.hips_position - poses.front().at.hips_position;
    const double end = poses.back().time;
    poses.back() = poses.front();
    poses.back().time = end;
    for (FigurePose* pose : {&poses.back().before, &poses.back().at, &poses.back().after}) pose->hips_position += way;
  }

  Clip clip;
  clip.name = keying.name;
  clip.duration = keying.duration;
  if (keying.is_cyclic) clip.loop.mode = LoopMode::repeat;
  const FigurePose rest = standing();
  bool hips_move = false;
  for (const KeyedPose& pose : poses)
    hips_move = hips_move || (pose.at.hips_position - rest.hips_position).norm() > 1e-9;
  if (hips_move) clip.tracks.push_back({name_of(hips), "position", hips_curve(poses)});
  for (std::size_t j = 0; j < joint_count; ++j) {
    const Joint joint = static_cast<Joint>(j);
    if (leaves(poses, joint, rest.turns[j]))
      clip.tracks.push_back({name_of(joint), "rotation", rotation_curve(poses, joint)});
  }
  return clip;
}

}  // namespace tweenfall::character
