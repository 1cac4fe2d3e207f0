#include <tweenfall/anim/jump_search.h>

#include "clip/formula_jumps.h"
#include "clip/life.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace tweenfall {

namespace clips {
namespace {

/// A clip without tracks that has events at these times, named by their numbers.
Clip shadow_of(const Clip& clip, const std::vector<double>& times) {
  Clip shadow;
  shadow.duration = clip.duration;
  shadow.loop = clip.loop;
  for (const double time : times)
    shadow.events.push_back({.from = time, .to = time, .name = std::to_string(shadow.events.size()), .data = {}});
  return shadow;
}

/// The clip time of a moment of such a clip.
double clip_time_of(const PlayMeeting& met) {
  return met.clip->events[std::stoul(met.moment.name)].from;
}

/// The first time at which a clock of a play is behind a clip time that it reaches at about `told`.
double behind(const RunningPlay& play, const Course& course, double moment, double told) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr int most = 16;
  const auto clock_at = [&](double time) { return course.clock(play.own_time(time), Side::out); };
  const ClipClock after = clock_at(told + 1e-9 * (1 + std::abs(told)));
  const auto is_there = [&](double time) {
    const ClipClock clock = clock_at(time);
    return clock.cycle == after.cycle && (after.rate < 0 ? clock.time <= moment : clock.time >= moment);
  };
  double time = told;
  for (int i = 0; i < most && is_there(std::nextafter(time, -infinity)); ++i) time = std::nextafter(time, -infinity);
  for (int i = 0; i < most && !is_there(time); ++i) time = std::nextafter(time, infinity);
  return is_there(time) && !is_there(std::nextafter(time, -infinity)) ? time : told;
}

}  // namespace
}  // namespace clips

JumpSearch::JumpSearch(const Animation& animation, const TrackFilter& counts) {
  for (const Clip& clip : animation.clips()) {
    clips_.push_back(clips::shadow_of(clip, jumps_of(clip, counts)));
    formulas_.push_back(clips::FormulaJumps::of(clip, counts));
    follows_.push_back(std::ranges::any_of(clip.tracks, [&](const Track& track) { return !counts || counts(track); }));
  }
  *this = with_plays_of(animation, counts);
}

JumpSearch JumpSearch::with_plays_of(const Animation& animation, const TrackFilter& counts) const {
  JumpSearch search = *this;
  search.seams_.clear();
  for (const Player& player : animation.players()) {
    const std::size_t played = player.play().clip;
    const Clip& clip = animation.clips()[played];
    std::vector<Clip>& seams = search.seams_.emplace_back();
    for (const PlaySection& section : player.sections()) {
      const bool jumps_there = follows_[played] && jumps_at_seam(clip, section.mode, section.from, section.to, counts);
      seams.push_back(clips::shadow_of(clip, jumps_there ? std::vector{section.from} : std::vector<double>()));
    }
  }
  return search;
}

// @param told  calls with a play, a clip whose events are jumps, and the stretch; returns the first of them, or
// infinity
template <class Told>
double JumpSearch::first_of(const Animation& animation, double from, double to, const ClockOverride& clock,
                            const Told& told) const {
  double first = std::numeric_limits<double>::infinity();
  const auto consider = [&](double time) {
    if (time > from && time <= to) first = std::min(first, time);
  };
  const std::span<const Player> players = animation.players();
  animation.for_each_play(clock, no_node, [&](const RunningPlay& play) {
    const std::size_t clip = play.play().clip;
    if (!follows_[clip]) return;
    // Where a play begins it may replace what was below it; where it is stopped, or over and not held, that shows
    // again.
    consider(play.first_begin_or_end(from, to));
    consider(play.first_weight_jump(from, to));
    const auto look_at = [&](const auto& moments) { first = std::min(first, told(play, moments)); };
    look_at(clips_[clip]);
    if (formulas_[clip]) {
      const auto [low, high] = play.reach(from, to);
      if (const std::vector<double> leaps = formulas_[clip]->between(low, high); !leaps.empty())
        look_at(clips::shadow_of(*play.clip, leaps));
    }
    const auto place = static_cast<std::size_t>(play.player - players.data());
    if (place < seams_.size()) look_at(std::span<const Clip>(seams_[place]));
  });
  if (clock == ClockOverride{})
    if (const auto instant = animation.first_graph_instant(from, to)) first = std::min(first, *instant);
  return first;
}

double JumpSearch::first(const Animation& animation, double from, double to, const ClockOverride& clock) const {
  return first_of(animation, from, to, clock, [&](const RunningPlay& play, const auto& moments) {
    const auto met = play.first_meeting(moments, from, to);
    return met ? met->moment.time : std::numeric_limits<double>::infinity();
  });
}

double JumpSearch::first_behind(const Animation& animation, double from, double to) const {
  return first_of(animation, from, to, {}, [&](const RunningPlay& play, const auto& moments) {
    // One told of just before may be just behind.
    double told = from - 1e-12 * (1 + std::abs(from));
    while (const auto met = play.first_meeting(moments, told, to)) {
      told = met->moment.time;
      const double time = clips::behind(play, *met->clock, clips::clip_time_of(*met), told);
      if (time > from) return time;
    }
    return std::numeric_limits<double>::infinity();
  });
}

}  // namespace tweenfall
