#include <tweenfall/anim/play.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall {

namespace {

/// A loop so short that it goes around more often than this between two moments tells none of its events.
constexpr double most_cycles = 10'000;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Clip seconds that all plays together last.
double total_length(const Clip& clip) noexcept {
  if (clip.loop.mode == LoopMode::once) return clip.duration;
  return clip.loop.count > 0 ? clip.duration * clip.loop.count : infinity;
}

/// Where in all plays the clock stands: 0 at their start, `total_length` at their end. Running backwards starts at
/// the end; where there is none, at the end of one play.
double phase_at(const Play& play, const Clip& clip, double stage_time) noexcept {
  const double run = (stage_time - play.at) * play.speed;
  if (play.speed >= 0) return run;
  const double total = total_length(clip);
  if (std::isfinite(total)) return total + run;
  return (std::isfinite(clip.duration) ? clip.duration : 0) + run;
}

bool flipped(const Clip& clip, int cycle) noexcept {
  return clip.loop.mode == LoopMode::pingpong && (cycle % 2 != 0);
}

}  // namespace

ClipClock clock_at(const Play& play, const Clip& clip, double stage_time, Side side) noexcept {
  ClipClock clock;
  const double total = total_length(clip);
  const bool backwards = play.speed < 0;
  double phase = phase_at(play, clip, stage_time);
  clock.started = side == Side::out ? stage_time >= play.at : stage_time > play.at;

  // Which end of the phase the clock comes from and goes to; a clock at rest belongs to what it shows.
  const bool from_below = (side == Side::in) != backwards;
  bool running = clock.started && play.speed != 0;
  if (!clock.started) phase = phase_at(play, clip, play.at);
  const bool past_end = from_below ? phase > total : phase >= total;
  const bool past_start = from_below ? phase <= 0 : phase < 0;
  if (!backwards && past_end && clock.started) {
    clock.ended = true;
    running = false;
  }
  if (backwards && past_start && std::isfinite(total) && clock.started) {
    clock.ended = true;
    running = false;
  }
  phase = std::min(phase, total);
  if (std::isfinite(total)) phase = std::max(phase, 0.0);

  double time = phase;
  if (clip.duration > 0 && std::isfinite(clip.duration) && clip.loop.mode != LoopMode::once) {
    const double plays = phase / clip.duration;
    double cycle = std::floor(plays);
    const bool at_seam = phase == cycle * clip.duration;
    const bool at_very_end = std::isfinite(total) && phase >= total;
    const bool arriving = from_below && running && (cycle > 0 || (backwards && !std::isfinite(total)));
    if (at_seam && (arriving || (at_very_end && cycle > 0))) cycle -= 1;
    time = std::clamp(phase - cycle * clip.duration, 0.0, clip.duration);
    clock.cycle = static_cast<int>(std::clamp(cycle, -2e9, 2e9));
  }
  if (clip.duration == 0) time = 0;
  const bool flip = flipped(clip, clock.cycle);
  clock.time = flip ? clip.duration - time : time;
  clock.rate = running ? (flip ? -play.speed : play.speed) : 0;
  if (running) clock.side = (from_below != flip) ? Side::in : Side::out;
  if (!running) clock.side = clock.ended && !backwards && !flip ? Side::in : Side::out;
  return clock;
}

double end_time(const Play& play, const Clip& clip) noexcept {
  const double total = total_length(clip);
  if (!std::isfinite(total) || play.speed == 0) return infinity;
  return play.at + total / std::abs(play.speed);
}

std::vector<FiredEvent> events_between(const Play& play, const Clip& clip, double from, double to, bool from_start) {
  std::vector<FiredEvent> fired;
  if (clip.events.empty() || play.speed == 0 || to < play.at) return fired;
  const bool backwards = play.speed < 0;
  const double total = total_length(clip);
  const double begin_phase = phase_at(play, clip, std::max(from, play.at)), end_phase = phase_at(play, clip, to);
  const double low = std::min(begin_phase, end_phase), high = std::max(begin_phase, end_phase);

  const bool loops = clip.loop.mode != LoopMode::once && clip.duration > 0 && std::isfinite(clip.duration);
  const double base = phase_at(play, clip, play.at);
  const auto stage_time_of = [&](double phase) { return play.at + (phase - base) / play.speed; };
  // The left end is open, save where the play itself begins there.
  const auto inside = [&](double time) {
    return time <= to && (time > from || (from_start && time == from) || (time == play.at && from < play.at));
  };
  const auto fire = [&](double phase, const ClipEvent& event, FiredEvent::Kind kind) {
    const bool in_plays = (phase >= 0 || !std::isfinite(total)) && phase <= total;
    const double time = stage_time_of(phase);
    if (in_plays && time >= play.at && inside(time)) fired.push_back({time, event.name, event.data, play.clip, kind});
  };

  const double first_cycle = loops ? std::floor(low / clip.duration) - 1 : 0;
  const double last_cycle = loops ? std::floor(high / clip.duration) + 1 : 0;
  if (last_cycle - first_cycle > most_cycles) return fired;
  for (double cycle = first_cycle; cycle <= last_cycle; ++cycle) {
    if (std::isfinite(total) && (cycle < 0 || cycle * clip.duration >= std::max(total, 1e-300)) && loops) continue;
    if (!std::isfinite(total) && !backwards && cycle < 0) continue;
    const bool flip = loops && flipped(clip, static_cast<int>(std::fmod(cycle, 2.0)));
    for (const ClipEvent& event : clip.events) {
      const double start = loops ? cycle * clip.duration : 0;
      const auto phase_of = [&](double clip_time) { return start + (flip ? clip.duration - clip_time : clip_time); };
      if (event.is_interval()) {
        const bool entered_at_end = flip != backwards;
        fire(phase_of(entered_at_end ? event.to : event.from), event, FiredEvent::Kind::begin);
        fire(phase_of(entered_at_end ? event.from : event.to), event, FiredEvent::Kind::end);
      } else if (!(clip.loop.mode == LoopMode::pingpong && cycle > 0 && phase_of(event.from) == start)) {
        // At the turn of a ping-pong the clip is in one place once, not twice.
        fire(phase_of(event.from), event, FiredEvent::Kind::moment);
      }
    }
  }
  std::ranges::stable_sort(fired, {}, &FiredEvent::time);
  return fired;
}

}  // namespace tweenfall
