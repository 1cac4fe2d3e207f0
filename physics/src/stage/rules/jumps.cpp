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

/// Calls `visit(curve, accumulates)` with each curve of a clip that moves bodies: whether a loop with offset adds to
/// it.
template <class Visit>
bool for_each_carrying(const StageState& state, const std::vector<char>& carriers, const Clip& clip,
                       const Visit& visit) {
  bool any = false;
  for (const Track& track : clip.tracks) {
    // What moves no body may jump as it likes: physics need not know.
    const auto node = state.nodes->find(track.node);
    if (!node || *node >= carriers.size() || !carriers[*node]) continue;
    const auto component = component_named(track.property);
    const Property property = component ? component->property : property_named(track.property);
    if (property != Property::position && property != Property::rotation && property != Property::scale) continue;
    any = true;
    // A parent's scale moves its children.
    const bool accumulates = property != Property::scale;
    if (const auto* number = std::get_if<Curve<double>>(&track.curve)) visit(*number, accumulates);
    if (const auto* vector = std::get_if<Curve<Vec3>>(&track.curve)) visit(*vector, accumulates);
    if (const auto* rotation = std::get_if<Curve<Quat>>(&track.curve)) visit(*rotation, accumulates);
  }
  return any;
}

/// Clip times at which a curve is not continuous.
template <class T>
void collect(const Curve<T>& curve, const Clip& clip, std::vector<ClipEvent>& jumps) {
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

/// By player, where its loop begins anew and some curve is elsewhere then.
void add_seams(const StageState& state, Jumps& jumps) {
  jumps.seams.clear();
  for (const Player& player : state.animation->players()) {
    const Play& play = player.play();
    const Clip& clip = state.animation->clips()[play.clip];
    const LoopMode mode = play.loop.value_or(clip.loop).mode;
    const double from = play.from, to = play.to.value_or(clip.duration);
    Clip seam;
    seam.duration = clip.duration;
    seam.loop = clip.loop;
    bool any = false;
    if ((mode == LoopMode::repeat || mode == LoopMode::repeat_offset) && std::isfinite(to) &&
        jumps.carries_body[play.clip])
      for_each_carrying(state, jumps.carriers, clip, [&](const auto& curve, bool accumulates) {
        if (mode == LoopMode::repeat || !accumulates)
          any = any || differ(curve.value(to, Side::in), curve.value(from, Side::out));
      });
    if (any) seam.events.push_back({.from = from, .to = from, .name = {}, .data = {}});
    jumps.seams.push_back(std::move(seam));
  }
}

/// First stage time in (from, to] at which the animation, as it runs by `clock`, may make a body jump.
double first_jump_by(const StageState& state, const ClockOverride& clock, double from, double to) {
  double first = infinity;
  const auto consider = [&](double time) {
    if (time > from && time <= to) first = std::min(first, time);
  };
  const std::span<const Player> players = state.animation->players();
  state.animation->for_each_play(clock, no_node, [&](const RunningPlay& play) {
    const std::size_t clip = play.play().clip;
    if (!state.jumps->carries_body[clip]) return;
    // Where a play begins it may replace what was below it, and where it is stopped give it free.
    consider(play.at());
    if (play.player->is_gone(play.player->end())) consider(play.end());
    consider(play.first_weight_jump(from, to));
    const auto look_at = [&](const Clip& jumps) {
      if (const auto jump = play.first_event(jumps, from, to)) first = std::min(first, jump->time);
    };
    look_at(state.jumps->clips[clip]);
    const auto place = static_cast<std::size_t>(play.player - players.data());
    if (place < state.jumps->seams.size()) look_at(state.jumps->seams[place]);
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
    const bool moves = for_each_carrying(state, jumps->carriers, clip,
                                         [&](const auto& curve, bool) { collect(curve, clip, shadow.events); });
    jumps->clips.push_back(std::move(shadow));
    jumps->carries_body.push_back(moves);
  }
  add_seams(state, *jumps);
  return jumps;
}

std::shared_ptr<const Jumps> jumps_of_plays(const StageState& state) {
  auto jumps = std::make_shared<Jumps>(*state.jumps);
  add_seams(state, *jumps);
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
