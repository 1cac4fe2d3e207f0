#include <tweenfall/anim/jump_search.h>

#include <algorithm>
#include <limits>

namespace tweenfall {

namespace clips {
namespace {

/// A clip without tracks that has events at these times.
Clip shadow_of(const Clip& clip, const std::vector<double>& times) {
  Clip shadow;
  shadow.duration = clip.duration;
  shadow.loop = clip.loop;
  for (const double time : times) shadow.events.push_back({.from = time, .to = time, .name = {}, .data = {}});
  return shadow;
}

}  // namespace
}  // namespace clips

JumpSearch::JumpSearch(const Animation& animation, const TrackFilter& counts) {
  for (const Clip& clip : animation.clips()) {
    clips_.push_back(clips::shadow_of(clip, jumps_of(clip, counts)));
    follows_.push_back(std::ranges::any_of(clip.tracks, [&](const Track& track) { return !counts || counts(track); }));
  }
  *this = with_plays_of(animation, counts);
}

JumpSearch JumpSearch::with_plays_of(const Animation& animation, const TrackFilter& counts) const {
  JumpSearch search = *this;
  search.seams_.clear();
  for (const Player& player : animation.players()) {
    const Play& play = player.play();
    const Clip& clip = animation.clips()[play.clip];
    const double from = play.from, to = play.to.value_or(clip.duration);
    const bool jumps_there =
        follows_[play.clip] && jumps_at_seam(clip, play.loop.value_or(clip.loop).mode, from, to, counts);
    search.seams_.push_back(clips::shadow_of(clip, jumps_there ? std::vector{from} : std::vector<double>()));
  }
  return search;
}

double JumpSearch::first(const Animation& animation, double from, double to, const ClockOverride& clock) const {
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
    consider(play.at());
    if (play.player->is_gone(play.player->end())) consider(play.end());
    consider(play.first_weight_jump(from, to));
    const auto look_at = [&](const Clip& jumps) {
      if (const auto jump = play.first_event(jumps, from, to)) first = std::min(first, jump->time);
    };
    look_at(clips_[clip]);
    const auto place = static_cast<std::size_t>(play.player - players.data());
    if (place < seams_.size()) look_at(seams_[place]);
  });
  if (clock == ClockOverride{})
    if (const auto instant = animation.first_graph_instant(from, to)) first = std::min(first, *instant);
  return first;
}

}  // namespace tweenfall
