#include "stage/record/jump_record.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

#include "handoff/arrival.h"

namespace tweenfall::staging {

namespace {

constexpr int most_instants = 16;            // looked at in one frame
constexpr std::size_t most_jumps = 100'000;  // of one recording
constexpr double sameness = 1e-9;            // of what rounding alone moves

bool differs(const Motion& a, const Motion& b) {
  const Quat turn = hemisphere_aligned(a.pose.rotation, b.pose.rotation);
  return !((a.pose.position - b.pose.position).norm() <= sameness * (1 + a.pose.position.norm()) &&
           (turn.coeffs() - b.pose.rotation.coeffs()).norm() <= sameness &&
           (a.pose.scale - b.pose.scale).norm() <= sameness * (1 + a.pose.scale.norm()));
}

bool differs(const std::optional<Sample<Color>>& a, const std::optional<Sample<Color>>& b) {
  return a && b && !((a->value.rgba - b->value.rgba).norm() <= sameness * (1 + a->value.rgba.norm()));
}

bool differs(const std::vector<Sample<double>>& a, const std::vector<Sample<double>>& b) {
  return !std::ranges::equal(a, b, [](const Sample<double>& one, const Sample<double>& other) {
    return std::abs(one.value - other.value) <= sameness * (1 + std::abs(one.value));
  });
}

}  // namespace

void JumpRecorder::follow(const Animation& animation) {
  const auto are_same = [](auto a, auto b) { return a.data() == b.data() && a.size() == b.size(); };
  if (animation_ && are_same(animation_->players(), animation.players())) {
    animation_ = animation;
    return;
  }
  const bool knows_clips = animation_ && are_same(animation_->clips(), animation.clips());
  animation_ = animation;
  search_ = knows_clips ? search_.with_plays_of(animation) : JumpSearch(animation);
}

void JumpRecorder::take(const Stage& stage, double from, std::span<const TimedInput> given, Recording& recording) {
  const std::size_t count = stage.nodes().size();
  NodeId present = 0;
  while (present < count && !stage.contains(present)) ++present;
  if (present == count || recording.jumps.size() > most_jumps) return;
  follow(stage.path(present).animation());
  known_.clear();
  const auto add = [&](double time, NodeId node, JumpRecord::Kind kind) {
    bool& is_known = known_[node][static_cast<std::size_t>(kind)];
    if (!is_known) recording.jumps.push_back({time, node, kind});
    is_known = true;
  };
  for (int i = 0; i < most_instants; ++i) {
    double time = search_.first(*animation_, from, stage.time());
    const auto next = std::ranges::find_if(given, [&](const TimedInput& input) { return input.time > from; });
    if (next != given.end()) time = std::min(time, next->time);
    if (!std::isfinite(time)) return;
    known_.resize(count);
    arriving_.resize(count);
    leaving_.resize(count);
    // At its own instant, rounded, a clock may already be behind a jump.
    const double before = handing_over::just_before(time);
    animation_->sample(before, arriving_, Side::in);
    for (Motion& motion : arriving_) motion = handing_over::carried_on(motion, time - before);
    animation_->sample(time, leaving_, Side::out);
    for (NodeId node = 0; node < count; ++node) {
      if (!stage.contains(node)) continue;
      const bool follows =
          !stage.has_body(node) || (stage.owner(node) == Owner::keyed && stage.path(node).clock() == ClockOverride{});
      if (follows && differs(arriving_[node], leaving_[node])) add(time, node, JumpRecord::Kind::motion);
      const NodeLook in = animation_->look(node, before, Side::in), out = animation_->look(node, time);
      if (differs(in.color, out.color)) add(time, node, JumpRecord::Kind::color);
      if (differs(in.weights, out.weights)) add(time, node, JumpRecord::Kind::weights);
    }
    from = time;
  }
}

}  // namespace tweenfall::staging
