#include <tweenfall/anim/clip_jumps.h>

#include <algorithm>

#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

/// Whether a track moves a body: what moves none may jump as it likes, for physics need not know.
TrackFilter carrying(const StageState& state, const std::vector<char>& carriers) {
  return [&nodes = *state.nodes, &carriers](const Track& track) {
    const auto node = nodes.find(track.node);
    return node && *node < carriers.size() && carriers[*node];
  };
}

/// A clip without tracks whose events are these.
Clip shadow_of(const Clip& clip, const std::vector<double>& times) {
  Clip shadow;
  shadow.duration = clip.duration;
  shadow.loop = clip.loop;
  for (const double time : times) shadow.events.push_back({.from = time, .to = time, .name = {}, .data = {}});
  return shadow;
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
    const double from = play.from, to = play.to.value_or(clip.duration);
    const bool jumps_there = jumps.carries_body[play.clip] && jumps_at_seam(clip, play.loop.value_or(clip.loop).mode,
                                                                            from, to, carrying(state, jumps.carriers));
    jumps.seams.push_back(shadow_of(clip, jumps_there ? std::vector{from} : std::vector<double>()));
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
    const TrackFilter counts = carrying(state, jumps->carriers);
    jumps->clips.push_back(shadow_of(clip, jumps_of(clip, counts)));
    jumps->carries_body.push_back(
        std::ranges::any_of(clip.tracks, [&](const Track& track) { return moves_its_node(track) && counts(track); }));
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
