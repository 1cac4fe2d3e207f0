#include <tweenfall/anim/play.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace tweenfall {

namespace clips {
namespace {

/// More events than this between two moments are an error and no list.
constexpr double most_events = 1'000'000;

/// Of a loop with more counted plays, an even number is left out of the reckoning, so that no digits are lost to it.
constexpr double most_counted = 0x1p30;

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Plays left out of the reckoning at the start of one that runs backwards.
double plays_left_out(const Clip& clip, double speed) noexcept {
  const double count = clip.loop.count;
  if (speed >= 0 || clip.loop.mode == LoopMode::once || !(count > most_counted)) return 0;
  return 2 * std::floor(count / 2);
}

/// Clip seconds that all plays together last, but for those left out.
double total_length(const Clip& clip, double left_out = 0) noexcept {
  if (clip.loop.mode == LoopMode::once) return clip.duration;
  return clip.loop.count > 0 ? clip.duration * (clip.loop.count - left_out) : infinity;
}

/// Where in all plays the clock stands: 0 at their start, `total_length` at their end. Running backwards starts at
/// the end; where there is none, at the end of one play.
double phase_at(double at, double speed, const Clip& clip, double stage_time) noexcept {
  const double run = (stage_time - at) * speed;
  if (speed >= 0) return run;
  const double total = total_length(clip, plays_left_out(clip, speed));
  if (std::isfinite(total)) return total + run;
  return (std::isfinite(clip.duration) ? clip.duration : 0) + run;
}

/// The events of one play of the clip after another, as the clock meets them.
class EventWalk {
 public:
  EventWalk(const Play& play, const Clip& clip, double from, double to, bool from_start)
      : play_(play), clip_(clip), from_(from), to_(to), from_start_(from_start), backwards_(play.speed < 0) {
    left_out_ = plays_left_out(clip, play.speed);
    total_ = total_length(clip, left_out_);
    loops_ = clip.loop.mode != LoopMode::once && clip.duration > 0 && std::isfinite(clip.duration);
    base_ = phase(play.at);
    if (clip.events.empty() || play.speed == 0 || to < play.at) return;
    const double begin = phase(std::max(from, play.at)), end = phase(to);
    const double lowest = std::isfinite(total_) ? -left_out_ * clip.duration : -infinity;
    const double low = std::clamp(std::min(begin, end), lowest, total_);
    const double high = std::clamp(std::max(begin, end), lowest, total_);
    first_ = loops_ ? std::floor(low / clip.duration) - 1 : 0;
    last_ = loops_ ? std::floor(high / clip.duration) + 1 : 0;
    if (std::isfinite(total_) && loops_) {
      first_ = std::max(first_, -left_out_);
      const double ending = std::ceil(total_ / clip.duration) - 1;
      last_ = std::min(last_, left_out_ > 0 ? ending : std::max(0.0, ending));
    } else if (loops_ && !backwards_) {
      first_ = std::max(first_, 0.0);
    }
  }

  /// At most so many events.
  [[nodiscard]] double bound() const noexcept {
    return first_ <= last_ ? (last_ - first_ + 1) * 2 * static_cast<double>(clip_.events.size()) : 0;
  }

  /// Calls `visit` with each event in order of time, until it returns false.
  template <class Visit>
  void walk(const Visit& visit) const {
    std::vector<FiredEvent> fired;
    for (double passed = 0; passed <= last_ - first_; ++passed) {
      fired.clear();
      tell_cycle(backwards_ ? last_ - passed : first_ + passed, fired);
      std::ranges::stable_sort(fired, {}, &FiredEvent::time);
      for (FiredEvent& event : fired)
        if (!visit(std::move(event))) return;
    }
  }

 private:
  [[nodiscard]] double phase(double stage_time) const noexcept {
    return phase_at(play_.at, play_.speed, clip_, stage_time);
  }
  // The left end is open, save where the play itself begins there.
  [[nodiscard]] bool inside(double time) const noexcept {
    return time <= to_ && (time > from_ || (from_start_ && time == from_) || (time == play_.at && from_ < play_.at));
  }

  void tell(double phase, const ClipEvent& event, FiredEvent::Kind kind, std::vector<FiredEvent>& fired) const {
    const bool in_plays = (phase >= -left_out_ * clip_.duration || !std::isfinite(total_)) && phase <= total_;
    const double time = play_.at + (phase - base_) / play_.speed;
    if (in_plays && time >= play_.at && inside(time)) fired.push_back({time, event.name, event.data, play_.clip, kind});
  }

  void tell_cycle(double cycle, std::vector<FiredEvent>& fired) const {
    const bool pingpong = clip_.loop.mode == LoopMode::pingpong;
    const bool flip = loops_ && pingpong && std::fmod(cycle, 2.0) != 0;
    const double start = loops_ ? cycle * clip_.duration : 0;
    for (const ClipEvent& event : clip_.events) {
      const auto phase_of = [&](double clip_time) { return start + (flip ? clip_.duration - clip_time : clip_time); };
      if (event.is_interval()) {
        const bool entered_at_end = flip != backwards_;
        tell(phase_of(entered_at_end ? event.to : event.from), event, FiredEvent::Kind::begin, fired);
        tell(phase_of(entered_at_end ? event.from : event.to), event, FiredEvent::Kind::end, fired);
      } else if (!(pingpong && cycle > -left_out_ && phase_of(event.from) == start)) {
        // At the turn of a ping-pong the clip is in one place once, not twice.
        tell(phase_of(event.from), event, FiredEvent::Kind::moment, fired);
      }
    }
  }

  const Play& play_;
  const Clip& clip_;
  double from_, to_;
  bool from_start_, backwards_, loops_ = false;
  double left_out_ = 0, total_ = 0, base_ = 0;
  double first_ = 0, last_ = -1;  // plays that may be met; none
};

/// Why a clip cannot tell its events.
std::string refusal(const Play& play, const Clip& clip, const std::string& stretch) {
  const bool around = clip.loop.mode != LoopMode::once;
  return "clip \"" + clip.name + "\" " +
         (around ? "goes around every " + number_text(clip.duration / std::abs(play.speed)) + " s and " : "") +
         "has more than a million events " + stretch + ": " + (around ? "lengthen its loop or " : "") +
         "leave out its events";
}

}  // namespace
}  // namespace clips

ClipClock clock_at(const Play& play, const Clip& clip, double stage_time, Side side) noexcept {
  return clock_at(play.at, play.speed, clip, stage_time, side);
}

ClipClock clock_at(double at, double speed, const Clip& clip, double stage_time, Side side) noexcept {
  ClipClock clock;
  const double left_out = clips::plays_left_out(clip, speed), total = clips::total_length(clip, left_out);
  const double first = -left_out * clip.duration;  // the start of the first play; zero but for those left out
  const bool backwards = speed < 0;
  double phase = clips::phase_at(at, speed, clip, stage_time);
  clock.started = side == Side::out ? stage_time >= at : stage_time > at;

  // Which end of the phase the clock comes from and goes to; a clock at rest belongs to what it shows.
  const bool from_below = (side == Side::in) != backwards;
  bool running = clock.started && speed != 0;
  if (!clock.started) phase = clips::phase_at(at, speed, clip, at);
  const bool past_end = from_below ? phase > total : phase >= total;
  const bool past_start = from_below ? phase <= first : phase < first;
  if (!backwards && past_end && clock.started) {
    clock.ended = true;
    running = false;
  }
  if (backwards && past_start && std::isfinite(total) && clock.started) {
    clock.ended = true;
    running = false;
  }
  phase = std::min(phase, total);
  if (std::isfinite(total)) phase = std::max(phase, left_out > 0 ? first : 0.0);

  double time = phase;
  bool flip = false;
  if (clip.duration > 0 && std::isfinite(clip.duration) && clip.loop.mode != LoopMode::once) {
    const double plays = phase / clip.duration;
    double cycle = std::floor(plays);
    const bool at_seam = phase == cycle * clip.duration;
    const bool at_very_end = std::isfinite(total) && phase >= total;
    const bool arriving = from_below && running && (cycle > -left_out || (backwards && !std::isfinite(total)));
    if (at_seam && (arriving || (at_very_end && cycle > -left_out))) cycle -= 1;
    time = std::clamp(phase - cycle * clip.duration, 0.0, clip.duration);
    flip = clip.loop.mode == LoopMode::pingpong && std::fmod(cycle, 2.0) != 0;
    clock.cycle = static_cast<int>(std::clamp(cycle + left_out, -2e9, 2e9));
  }
  if (clip.duration == 0) time = 0;
  clock.time = flip ? clip.duration - time : time;
  clock.rate = running ? (flip ? -speed : speed) : 0;
  if (running) clock.side = (from_below != flip) ? Side::in : Side::out;
  if (!running) clock.side = clock.ended && !backwards && !flip ? Side::in : Side::out;
  return clock;
}

double end_time(const Play& play, const Clip& clip) noexcept {
  const double total = clips::total_length(clip);
  if (!std::isfinite(total) || play.speed == 0) return clips::infinity;
  return play.at + total / std::abs(play.speed);
}

std::vector<FiredEvent> events_between(const Play& play, const Clip& clip, double from, double to, bool from_start) {
  const clips::EventWalk walk(play, clip, from, to, from_start);
  if (walk.bound() > clips::most_events) {
    throw std::length_error(
        clips::refusal(play, clip, "from " + number_text(from) + " s to " + number_text(to) + " s"));
  }
  std::vector<FiredEvent> fired;
  walk.walk([&](FiredEvent&& event) {
    fired.push_back(std::move(event));
    return true;
  });
  std::ranges::stable_sort(fired, {}, &FiredEvent::time);
  return fired;
}

std::string too_many_events(const Play& play, const Clip& clip, double seconds) {
  if (clip.events.empty() || play.speed == 0) return {};
  double plays = 1;
  if (clip.loop.mode != LoopMode::once && clip.duration > 0 && std::isfinite(clip.duration)) {
    // The stretch may lie anywhere: it touches a play more at each end, as many are looked at beside these, and far
    // from the start the number of the first is rounded.
    plays = 1.001 * seconds * std::abs(play.speed) / clip.duration + 4;
    if (clip.loop.count > 0) plays = std::min(plays, std::ceil(clip.loop.count) + 1);
  }
  if (2 * plays * static_cast<double>(clip.events.size()) <= clips::most_events) return {};
  return clips::refusal(play, clip, "within " + brief_text(seconds) + " s");
}

std::optional<FiredEvent> first_event(const Play& play, const Clip& clip, double from, double to, bool from_start,
                                      std::optional<std::string_view> name) {
  std::optional<FiredEvent> first;
  if (name && std::ranges::find(clip.events, *name, &ClipEvent::name) == clip.events.end()) return first;
  clips::EventWalk(play, clip, from, to, from_start).walk([&](FiredEvent&& event) {
    if (event.kind == FiredEvent::Kind::end || (name && event.name != *name)) return true;
    first = std::move(event);
    return false;
  });
  return first;
}

}  // namespace tweenfall
