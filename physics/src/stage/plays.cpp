#include <tweenfall/anim/graph_player.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stage/stage_data.h"
#include "stage/time/in_order.h"
#include "stage/time/twins.h"

namespace tweenfall::staging {

namespace {

void tell(std::vector<FiredEvent> fired, std::vector<Happening>& happenings) {
  bring_in_order(fired, &FiredEvent::time);
  happenings.reserve(happenings.size() + fired.size());
  for (FiredEvent& event : fired) {
    Happening& happening = happenings.emplace_back();
    happening.time = event.time;
    happening.what = StageEvent{.time = event.time,
                                .name = std::move(event.name),
                                .data = std::move(event.data),
                                .nodes = {},
                                .kind = event.kind};
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
    fired.push_back({event.time, std::move(event.name), std::move(event.data), event.clip, event.kind});
  tell(std::move(fired), happenings);
}

namespace {

/// What graphs report at an instant that has been handled, because what they lie on or their input has changed there.
std::vector<FiredEvent> news_of_graphs(const Animation& before, const Animation& after, double instant) {
  const double earlier = std::nextafter(instant, -infinity);
  const std::vector<GraphEvent> told = before.graph_events(earlier, instant);
  std::vector<GraphEvent> now = after.graph_events(earlier, instant);
  take_out_twins(now, std::span<const GraphEvent>(told), [](const GraphEvent& event, const GraphEvent& each) {
    return each.name == event.name && each.data == event.data && each.clip == event.clip && each.kind == event.kind;
  });
  std::vector<FiredEvent> news;
  news.reserve(now.size());
  for (GraphEvent& event : now)
    news.push_back({event.time, std::move(event.name), std::move(event.data), event.clip, event.kind});
  return news;
}

/// Replaces the animation from an instant on that has been handled.
/// @param news  what it reports at that very time: rules wait for it, too
void change_animation(StageState& state, const Animation& animation, double instant, std::vector<FiredEvent> news,
                      double step, std::vector<Happening>& happenings) {
  const auto next = std::make_shared<const Animation>(animation);
  for (FiredEvent& event : news_of_graphs(*state.animation, *next, instant)) news.push_back(std::move(event));
  state.animation = next;
  for (StagedBody& body : state.bodies) body.path = body.path.rebound(next);
  state.jumps = jumps_of_plays(state);
  state.jumped = true;
  tell(std::move(news), happenings);
  // Before the stage has begun, as when one is loaded, only the cast changes.
  if (state.steps >= 0) fire_rules(state, std::nextafter(instant, -infinity), step, happenings);
}

}  // namespace

void change_play(StageState& state, const PlayChange& change, double step, std::vector<Happening>& happenings) {
  const Animation changed = state.animation->with_change(change);
  const std::size_t number = changed.player_named(change.play);
  const Player& player = changed.players()[number];
  const Clip& clip = changed.clips()[player.play().clip];
  const std::string fault = too_many_events(player.play(), clip, step + sliver, most_events_in_step(clip));
  if (!fault.empty()) throw std::invalid_argument(fault);
  const double until = std::max(change.time, state.handled);
  std::vector<FiredEvent> news = player.events_between(clip, change.time, until, true);
  // A play that there was before has told of this instant.
  if (number < state.animation->players().size()) {
    const std::vector<FiredEvent> told =
        state.animation->players()[number].events_between(clip, change.time, until, true);
    take_out_twins(news, std::span<const FiredEvent>(told), [](const FiredEvent& event, const FiredEvent& each) {
      return each.name == event.name && each.data == event.data && each.kind == event.kind;
    });
  }
  change_animation(state, changed, change.time, std::move(news), step, happenings);
}

void tell_graph(StageState& state, const std::string& graph, const GraphInput& input, double step,
                std::vector<Happening>& happenings) {
  change_animation(state, state.animation->with_input(graph, input), input.time, {}, step, happenings);
}

}  // namespace tweenfall::staging
