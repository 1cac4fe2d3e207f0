#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/handoff/path.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tweenfall {

namespace handing_over {
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

/// The clock of a body that comes back at `time` to plays that ran by `before` when it left them at `released_at`.
ClockOverride recovered_clock(const Animation& animation, const ClockOverride& before, double time,
                              const HandBack& settings, double released_at) {
  ClockOverride clock = before;
  const double now = before.timeline_at(time);
  if (!settings.clip.empty()) {
    const auto clips = animation.clips();
    const auto found = std::ranges::find(clips, settings.clip, &Clip::name);
    if (found == clips.end()) throw std::invalid_argument("there is no clip \"" + settings.clip + "\" to hand back to");
    // A clip asked for by name is followed entirely, however it was faded or masked.
    const auto clip = static_cast<std::size_t>(found - clips.begin());
    if (clock.clip != clip) clock.starts_by = now;
    clock.clip = clip;
  }
  if (settings.clock == HandBack::Clock::hold) {
    clock.timeline = before.timeline_at(released_at);
    clock.stage = time;
    clock.starts_by = std::min(clock.starts_by, clock.timeline);
  }
  if (settings.clock == HandBack::Clock::restart) {
    double first = now;
    const bool alone = clock.clip != ClockOverride::every_clip;
    for (const Player& player : animation.players())
      if (!alone || player.play().clip == clock.clip)
        first = std::min({first, player.first_at(), alone ? clock.starts_by : player.first_at()});
    // All together, so that what overlapped still does.
    clock.timeline = first;
    clock.stage = time;
  }
  return clock;
}

}  // namespace
}  // namespace handing_over

WorldMotion carried(const WorldMotion& world, const Motion& to) noexcept {
  const Motion& from = world.motion;
  const Mat3 turn = (to.pose.rotation * from.pose.rotation.conjugate()).toRotationMatrix();
  WorldMotion result;
  result.motion = to;
  result.motion.pose.scale = from.pose.scale;
  result.motion.scale_rate = from.scale_rate;
  result.linear = turn * world.linear;
  // linear = R M: the rotation is replaced, the deformation stays.
  const Mat3 deforming = world.linear_rate - handing_over::cross_matrix(from.twist.angular) * world.linear;
  result.linear_rate = turn * deforming + handing_over::cross_matrix(to.twist.angular) * result.linear;
  return result;
}

Path::Path(std::shared_ptr<const Animation> animation, std::size_t node, double since)
    : animation_(std::move(animation)), node_(node), since_(since) {}

WorldMotion Path::authored(double stage_time, Side side) const noexcept {
  return animation_->world(node_, stage_time, side_at(stage_time, side), clock_);
}

WorldMotion Path::anchored(const WorldMotion& authored) const noexcept {
  if (!anchor_) return authored;
  Motion moved = authored.motion;
  moved.pose.position = anchor_->rotation * authored.motion.pose.position + anchor_->position;
  moved.pose.rotation = anchor_->rotation * authored.motion.pose.rotation;
  moved.twist.linear = anchor_->rotation * authored.motion.twist.linear;
  moved.twist.angular = anchor_->rotation * authored.motion.twist.angular;
  return carried(authored, moved);
}

WorldMotion Path::world(double stage_time, Side side) const noexcept {
  return world(stage_time, authored(stage_time, side));
}

WorldMotion Path::world(double stage_time, const WorldMotion& authored) const noexcept {
  const WorldMotion path = anchored(authored);
  return carried(path, settle_.apply(stage_time, path.motion));
}

Motion Path::at(double stage_time, Side side) const noexcept {
  return at(stage_time, authored(stage_time, side));
}

Motion Path::at(double stage_time, const WorldMotion& authored) const noexcept {
  return settle_.apply(stage_time, anchored(authored).motion);
}

Path Path::rebound(std::shared_ptr<const Animation> animation) const {
  Path other = *this;
  other.animation_ = std::move(animation);
  return other;
}

Path Path::recovered(double time, const HandBack& settings, const Motion& body, double released_at,
                     const Path* leader) const {
  Path path(animation_, node_, time);
  path.clock_ = handing_over::recovered_clock(*animation_, clock_, time, settings, released_at);

  if (settings.anchor == HandBack::Anchor::keep) {
    path.anchor_ = anchor_;
  } else if (leader) {
    path.anchor_ = leader->anchor_;
  } else {
    path.anchor_ = handing_over::anchor_onto(path.authored(time, Side::out).motion.pose, body.pose, settings.anchor);
  }
  path.settle_ = SettleOffset(settings.settle, time, path.anchored(path.authored(time, Side::out)).motion, body);
  return path;
}

}  // namespace tweenfall
