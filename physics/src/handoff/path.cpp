#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/handoff/path.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

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

Motion without_size(Motion motion) {
  motion.pose.scale = Vec3(1, 1, 1);
  motion.scale_rate.setZero();
  return motion;
}

/// The motion of one thing in the axes of another, whatever their sizes.
Motion seen_from(const Motion& other, const Motion& motion) {
  return relative_to(without_size(other), without_size(motion));
}

bool is_below(const Hierarchy& nodes, std::size_t node, std::size_t above) {
  for (node = nodes[node].parent; node != no_node && node > above;) node = nodes[node].parent;
  return node == above;
}

/// A motion with its offset, as seen from another thing that is shown where it is not led.
Motion along(const SettleOffset& offset, double time, const Motion& motion, const Motion& led, const Motion& shown) {
  Motion settling = compose(without_size(shown), offset.apply(time, seen_from(led, motion)));
  settling.pose.rotation.normalize();
  settling.pose.scale = motion.pose.scale;
  settling.scale_rate = motion.scale_rate;
  return settling;
}

/// The world motion of a node below another, given that one's. @param local_of  the local motion of a node
template <class LocalOf>
WorldMotion descended(const Hierarchy& nodes, std::size_t node, std::size_t above, WorldMotion world,
                      const LocalOf& local_of) {
  std::vector<std::size_t> way;
  for (; node != above; node = nodes[node].parent) way.push_back(node);
  for (auto it = way.rbegin(); it != way.rend(); ++it) world = child_of(world, local_of(*it));
  return world;
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

bool Path::settled(double stage_time) const noexcept {
  return settle().over(stage_time) && (!above_ || above_->settled(stage_time));
}

Motion Path::settling(double stage_time, const Motion& anchored, Side side) const noexcept {
  if (!above_) return settle().apply(stage_time, anchored);
  if (settled(stage_time)) return anchored;
  std::vector<const Path*> above;  // up to the topmost, or to one that is where it belongs
  for (const Path* path = above_.get(); path; path = path->above_.get()) {
    above.push_back(path);
    if (path->settled(stage_time)) break;
  }
  // From there down, so that the animation is sampled once and not anew for each.
  WorldMotion scripted;
  Motion led, shown;
  const Path* last = nullptr;
  for (auto it = above.rbegin(); it != above.rend(); last = *it, ++it) {
    const Path& path = **it;
    const Side own = path.side_at(stage_time, side);
    const bool same = last && path.animation_ == last->animation_ && path.clock_ == last->clock_ &&
                      own == last->side_at(stage_time, side);
    scripted = same ? handing_over::descended(path.animation_->nodes(), path.node_, last->node_, scripted,
                                              [&](std::size_t node) {
                                                return path.animation_->sample_node(node, stage_time, own, path.clock_);
                                              })
                    : path.authored(stage_time, side);
    const Motion follows = path.anchored(scripted).motion;
    shown = last ? handing_over::along(path.settle(), stage_time, follows, led, shown)
                 : path.settle().apply(stage_time, follows);
    led = follows;
  }
  return handing_over::along(settle(), stage_time, anchored, led, shown);
}

WorldMotion Path::world(double stage_time, Side side) const noexcept {
  return world(stage_time, authored(stage_time, side), side);
}

WorldMotion Path::world(double stage_time, const WorldMotion& authored, Side side) const noexcept {
  const WorldMotion path = anchored(authored);
  return carried(path, settling(stage_time, path.motion, side_at(stage_time, side)));
}

Motion Path::at(double stage_time, Side side) const noexcept {
  return at(stage_time, authored(stage_time, side), side);
}

Motion Path::at(double stage_time, const WorldMotion& authored, Side side) const noexcept {
  return settling(stage_time, anchored(authored).motion, side_at(stage_time, side));
}

Path Path::rebound(std::shared_ptr<const Animation> animation) const {
  Path other = *this;
  if (above_) other.above_ = std::make_shared<const Path>(above_->rebound(animation));
  other.animation_ = std::move(animation);
  return other;
}

/// Few paths have one.
const SettleOffset& Path::settle() const noexcept {
  static const SettleOffset none;
  return settle_ ? *settle_ : none;
}

void Path::settle_from(const Motion& body, const Settle& settle, const Path* above) {
  const Motion wanted = anchored(authored(since_, Side::out)).motion;
  if (!above) {
    settle_ = std::make_shared<const SettleOffset>(settle, since_, wanted, body);
    return;
  }
  if (!handing_over::is_below(animation_->nodes(), node_, above->node_))
    throw std::invalid_argument("a path can settle only as seen from that of a node above its own");
  above_ = std::make_shared<const Path>(*above);
  const Motion led = above->anchored(above->authored(since_, Side::out)).motion;
  settle_ = std::make_shared<const SettleOffset>(settle, since_, handing_over::seen_from(led, wanted),
                                                 handing_over::seen_from(above->at(since_), body));
}

Path Path::recovered(double time, const HandBack& settings, const Motion& body, double released_at, const Path* leader,
                     const Path* above) const {
  Path path(animation_, node_, time);
  path.clock_ = handing_over::recovered_clock(*animation_, clock_, time, settings, released_at);

  if (settings.anchor == HandBack::Anchor::keep) {
    path.anchor_ = anchor_;
  } else if (leader) {
    path.anchor_ = leader->anchor_;
  } else {
    path.anchor_ = handing_over::anchor_onto(path.authored(time, Side::out).motion.pose, body.pose, settings.anchor);
  }
  path.settle_from(body, settings.settle, above);
  return path;
}

Path Path::along(const Path& above) const {
  Path path = *this;
  path.settle_from(at(since_), this->settle().settle(), &above);
  return path;
}

}  // namespace tweenfall
