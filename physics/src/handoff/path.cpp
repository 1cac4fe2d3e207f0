#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/handoff/path.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tweenfall {

namespace {

Mat3 cross_matrix(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

/// A rigid pose `anchor` for which anchor * path is at `body`.
Pose anchor_onto(const Pose& path, const Pose& body, HandBack::Anchor kind) {
  Pose anchor;
  anchor.rotation = body.rotation * path.rotation.conjugate();
  if (kind == HandBack::Anchor::ground) {
    // The twist about the vertical alone. Source: swing-twist decomposition, Dobrowolski 2015.
    Quat heading(anchor.rotation.w(), 0, anchor.rotation.y(), 0);
    const double size = std::sqrt(heading.w() * heading.w() + heading.y() * heading.y());
    anchor.rotation = size > 1e-12 ? Quat(heading.w() / size, 0, heading.y() / size, 0) : Quat(1, 0, 0, 0);
  }
  anchor.rotation.normalize();
  anchor.position = body.position - anchor.rotation * path.position;
  if (kind == HandBack::Anchor::ground) anchor.position.y() = 0;
  return anchor;
}

}  // namespace

WorldMotion carried(const WorldMotion& world, const Motion& to) noexcept {
  const Motion& from = world.motion;
  const Mat3 turn = (to.pose.rotation * from.pose.rotation.conjugate()).toRotationMatrix();
  WorldMotion result;
  result.motion = to;
  result.motion.pose.scale = from.pose.scale;
  result.motion.scale_rate = from.scale_rate;
  result.linear = turn * world.linear;
  // linear = R M: what turns is replaced, what deforms stays.
  const Mat3 deforming = world.linear_rate - cross_matrix(from.twist.angular) * world.linear;
  result.linear_rate = turn * deforming + cross_matrix(to.twist.angular) * result.linear;
  return result;
}

Path::Path(std::shared_ptr<const Animation> animation, std::size_t node, double since)
    : animation_(std::move(animation)), node_(node), since_(since) {}

WorldMotion Path::anchored(double stage_time, Side side) const noexcept {
  if (stage_time <= since_) side = Side::out;
  const WorldMotion authored = animation_->world(node_, stage_time, side);
  if (!anchor_) return authored;
  Motion moved = authored.motion;
  moved.pose.position = anchor_->rotation * authored.motion.pose.position + anchor_->position;
  moved.pose.rotation = anchor_->rotation * authored.motion.pose.rotation;
  moved.twist.linear = anchor_->rotation * authored.motion.twist.linear;
  moved.twist.angular = anchor_->rotation * authored.motion.twist.angular;
  return carried(authored, moved);
}

WorldMotion Path::world(double stage_time, Side side) const noexcept {
  const WorldMotion authored = anchored(stage_time, side);
  return carried(authored, settle_.apply(stage_time, authored.motion));
}

Motion Path::at(double stage_time, Side side) const noexcept {
  return settle_.apply(stage_time, anchored(stage_time, side).motion);
}

Path Path::rebound(std::shared_ptr<const Animation> animation) const {
  Path other = *this;
  other.animation_ = std::move(animation);
  return other;
}

Path Path::recovered(double time, const HandBack& settings, const Motion& body, double released_at) const {
  Path path(animation_, node_, time);
  std::vector<Play> plays(animation_->plays().begin(), animation_->plays().end());

  if (!settings.clip.empty()) {
    const auto clips = animation_->clips();
    std::size_t clip = 0;
    while (clip < clips.size() && clips[clip].name != settings.clip) ++clip;
    if (clip == clips.size()) throw std::invalid_argument("there is no clip \"" + settings.clip + "\" to hand back to");
    std::erase_if(plays, [&](const Play& play) { return play.clip != clip; });
    if (plays.empty()) {
      Play play;
      play.clip = clip;
      play.at = time;
      plays.push_back(std::move(play));
    }
    // Asked for by name, the clip is followed wholly, however it was faded or masked.
    for (Play& play : plays) {
      play.weight = Curve<double>(1.0);
      play.mask.clear();
      if (play.at > time) play.at = time;
    }
  }
  double first = time;
  for (const Play& play : plays) first = std::min(first, play.at);
  for (Play& play : plays) {
    if (settings.clock == HandBack::Clock::hold) play.at += time - released_at;
    if (settings.clock == HandBack::Clock::restart)
      play.at += time - first;  // all together: what overlapped still does
  }
  if (!settings.clip.empty() || settings.clock != HandBack::Clock::run)
    path.animation_ = std::make_shared<const Animation>(animation_->with_plays(std::move(plays)));

  if (settings.anchor == HandBack::Anchor::keep) {
    path.anchor_ = anchor_;
  } else {
    path.anchor_ = anchor_onto(path.animation_->world(node_, time).motion.pose, body.pose, settings.anchor);
  }
  path.settle_ = SettleOffset(settings.settle, time, path.anchored(time, Side::out).motion, body);
  return path;
}

}  // namespace tweenfall
