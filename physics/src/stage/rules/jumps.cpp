#include <tweenfall/anim/component.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

bool differ(double a, double b) {
  return (a - b) * (a - b) > 1e-18 * (1 + a * a);
}
bool differ(const Vec3& a, const Vec3& b) {
  return (a - b).squaredNorm() > 1e-18 * (1 + a.squaredNorm());
}
bool differ(const Quat& a, const Quat& b) {
  return (hemisphere_aligned(a, b).coeffs() - b.coeffs()).squaredNorm() > 1e-18;
}

/// Clip times at which a curve is not continuous; 0 stands for the seam of a loop.
template <class T>
void collect(const Curve<T>& curve, const Clip& clip, bool accumulates, std::vector<ClipEvent>& jumps) {
  const auto add = [&](double time) { jumps.push_back({.from = time, .to = time, .name = {}, .data = {}}); };
  for (const double knot : curve.knots())
    if (knot > 0 && knot < clip.duration && differ(curve.value(knot, Side::in), curve.value(knot, Side::out)))
      add(knot);
  // A track that repeats within its clip jumps at each of its own seams.
  const double length = curve.duration();
  if (std::isfinite(length) && length > 0 && differ(curve.value(curve.end(), Side::in), curve.value(curve.start()))) {
    constexpr int most = 1000;
    const auto plays = [](const auto& rule, int k) {
      return rule.rule == Outside::repeat && k < most && (rule.plays == 0 || k < rule.plays);
    };
    for (int k = 0; plays(curve.rule_after(), k) && curve.end() + k * length < clip.duration; ++k)
      add(curve.end() + k * length);
    for (int k = 0; plays(curve.rule_before(), k) && curve.start() - k * length > 0; ++k)
      add(curve.start() - k * length);
  }
  const bool wraps = clip.loop.mode == LoopMode::repeat || (clip.loop.mode == LoopMode::repeat_offset && !accumulates);
  if (wraps && std::isfinite(clip.duration) &&
      differ(curve.value(clip.duration, Side::in), curve.value(0.0, Side::out)))
    add(0);
}

/// By node: whether it or something below it has a body that can move.
std::vector<char> carriers(const StageState& state) {
  std::vector<char> carries(state.nodes->size(), 0);
  for (NodeId node = carries.size(); node-- > 0;) {
    const StagedBody* body = state.body(node);
    if (body && !state.world.is_fixed(body->id)) carries[node] = 1;
    const std::size_t parent = (*state.nodes)[node].parent;
    if (carries[node] && parent != no_node) carries[parent] = 1;
  }
  return carries;
}

/// First stage time in (from, to] at which the animation, as it runs by `clock`, may make a body jump.
double first_jump_by(const StageState& state, const ClockOverride& clock, double from, double to) {
  double first = infinity;
  const auto consider = [&](double time) {
    if (time > from && time <= to) first = std::min(first, time);
  };
  state.animation->for_each_play(clock, no_node, [&](const Play& play) {
    if (!state.jumps->carries_body[play.clip]) return;
    // Where a play begins it may replace what was below it.
    consider(play.at);
    for (const double knot : play.weight.knots())
      if (play.weight.value(knot, Side::in) != play.weight.value(knot)) consider(clock.stage_at(knot));
    if (const auto jump = first_event(play, state.jumps->clips[play.clip], from, to))
      first = std::min(first, jump->time);
  });
  if (clock == ClockOverride{})
    if (const auto instant = state.animation->first_graph_instant(from, to)) first = std::min(first, *instant);
  return first;
}

}  // namespace

std::shared_ptr<const Jumps> find_jumps(const StageState& state) {
  auto jumps = std::make_shared<Jumps>();
  jumps->carriers = carriers(state);
  for (const Clip& clip : state.animation->clips()) {
    Clip shadow;
    shadow.duration = clip.duration;
    shadow.loop = clip.loop;
    bool moves = false;
    for (const Track& track : clip.tracks) {
      // What moves no body may jump as it likes: physics need not know.
      const auto node = state.nodes->find(track.node);
      if (!node || !jumps->carriers[*node]) continue;
      if (const auto component = component_named(track.property)) {
        if (component->property == Property::color) continue;
        if (const auto* curve = std::get_if<Curve<double>>(&track.curve))
          collect(*curve, clip, component->property != Property::scale, shadow.events);
        moves = true;
        continue;
      }
      const Property property = property_named(track.property);
      if (property == Property::position || property == Property::scale) {
        // A parent's scale moves its children.
        if (const auto* curve = std::get_if<Curve<Vec3>>(&track.curve))
          collect(*curve, clip, property == Property::position, shadow.events);
        moves = true;
      } else if (property == Property::rotation) {
        if (const auto* curve = std::get_if<Curve<Quat>>(&track.curve)) collect(*curve, clip, true, shadow.events);
        moves = true;
      }
    }
    jumps->clips.push_back(std::move(shadow));
    jumps->carries_body.push_back(moves);
  }
  return jumps;
}

bool carries_more(const StageState& state, NodeId node) {
  const std::vector<char>& known = state.jumps->carriers;
  for (NodeId i = node; i != no_node && !(i < known.size() && known[i]); i = (*state.nodes)[i].parent)
    if (state.animation->has_tracks(i)) return true;
  return false;
}

double first_jump(const StageState& state, double from, double to) {
  double first = first_jump_by(state, {}, from, to);
  ClockOverride asked;  // bodies that come back together run by the same clock
  for (const StagedBody& body : state.bodies)
    if (body.present && body.path.clock() != asked && body.path.clock() != ClockOverride{}) {
      asked = body.path.clock();
      first = std::min(first, first_jump_by(state, asked, from, to));
    }
  return first;
}

}  // namespace tweenfall::staging
