#include <tweenfall/anim/graph_player.h>

#include <algorithm>
#include <cmath>

#include "stage/rules/played_tracks.h"
#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

void tell(std::vector<FiredEvent> fired, std::vector<Happening>& happenings) {
  std::ranges::stable_sort(fired, {}, &FiredEvent::time);
  for (FiredEvent& event : fired) {
    Happening& happening = happenings.emplace_back();
    happening.time = event.time;
    happening.what = StageEvent{.time = event.time, .name = event.name, .data = event.data, .nodes = {}};
  }
}

}  // namespace

void report_events(const StageState& state, double from, double to, std::vector<Happening>& happenings) {
  std::vector<FiredEvent> fired;
  for (const Player& player : state.animation->players()) {
    const Clip& clip = state.animation->clips()[player.play().clip];
    std::vector<FiredEvent> more = player.events_between(clip, std::max(from, 0.0), to, from < 0);
    fired.insert(fired.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  for (GraphEvent& event : state.animation->graph_events(from, to))
    fired.push_back({event.time, std::move(event.name), std::move(event.data), event.clip});
  tell(std::move(fired), happenings);
}

void change_play(StageState& state, const PlayChange& change, double step, std::vector<Happening>& happenings) {
  state.animation = std::make_shared<const Animation>(state.animation->with_change(change));
  for (StagedBody& body : state.bodies) body.path = body.path.rebound(state.animation);
  state.jumps = jumps_of_plays(state);
  state.jumped = true;
  // What it fires at its own instant, which has been handled: told now, and rules wait for it, too.
  const Player& player = state.animation->players()[state.animation->player_named(change.play)];
  tell(player.events_of_change(state.animation->clips()[player.play().clip]), happenings);
  fire_rules(state, std::nextafter(change.time, -infinity), step, happenings);
  follow_played_tracks(state, step, happenings);
}

}  // namespace tweenfall::staging
