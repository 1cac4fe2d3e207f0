#pragma once

/// Playing: from stage time to clip time, analytically.
///
/// A play has no state. Where its clock stands, how fast it runs and which events lie between two
/// moments follow from the stage time alone, so a stage can be evaluated at any time in any order.

#include <tweenfall/anim/clip.h>
#include <tweenfall/curves/curve.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

/// One clip being played.
struct Play {
  std::size_t clip = 0;       ///< index of the clip
  double at = 0;              ///< stage time at which clip time is `start` (0), s
  double speed = 1;           ///< clip seconds per stage second; 0 pauses, negative runs backwards from the clip's end
  Curve<double> weight{1.0};  ///< over stage time, 0 to 1; its rate enters the blend
  std::vector<std::string> mask{};  ///< names or patterns ("arm/*") of the nodes it drives; empty: all
};

/// Plays that run by another clock than the stage's, as after a hand-back: all moved together, or one clip alone.
struct ClockOverride {
  static constexpr std::size_t every_clip = static_cast<std::size_t>(-1);

  double stage = 0;               ///< at this stage time, s, ...
  double timeline = 0;            ///< ... the plays and their weights are where they were to be at this one, s
  std::size_t clip = every_clip;  ///< when given, this clip alone, at full weight over all its nodes
  double starts_by = 0;           ///< of `clip`, on the timeline, s: here it begins where no play has begun it

  [[nodiscard]] double timeline_at(double stage_time) const noexcept { return timeline + (stage_time - stage); }
  [[nodiscard]] double stage_at(double timeline_time) const noexcept { return stage + (timeline_time - timeline); }

  bool operator==(const ClockOverride&) const = default;
};

/// Where a play's clock stands.
struct ClipClock {
  double time = 0;  ///< clip time after looping, s
  double rate = 0;  ///< d(clip time)/d(stage time); 0 before the start and after the end: a pose that holds is at rest
  int cycle = 0;    ///< how many whole plays lie behind, from 0
  bool started = false;  ///< stage time has reached `at`
  bool ended = false;    ///< all counted plays are over
  Side side =
      Side::out;  ///< the side on which to sample the tracks, so that a clock running backwards arrives from above
};

/// The clock at a stage time. At a seam `Side::in` is the end of the play before, `Side::out` the start of the next.
[[nodiscard]] ClipClock clock_at(const Play& play, const Clip& clip, double stage_time, Side side = Side::out) noexcept;

/// The same of a play of which only this matters: the stage time at which it starts, and its speed.
[[nodiscard]] ClipClock clock_at(double at, double speed, const Clip& clip, double stage_time, Side side) noexcept;

/// An event as it happened on the stage.
struct FiredEvent {
  double time = 0;  ///< stage time, s
  std::string name;
  std::string data;
  std::size_t clip = 0;                                        ///< index of the clip
  enum class Kind { moment, begin, end } kind = Kind::moment;  ///< `begin` and `end` of an interval
};

/// Events in (from, to] of stage time, in order, each once, also across loops; [from, to] when
/// `from_start` (a play's first advance), so that an event at 0 fires. Moments outside the plays are silent.
/// @throws std::length_error naming the clip where a tiny loop makes more than a million of them.
[[nodiscard]] std::vector<FiredEvent> events_between(const Play& play, const Clip& clip, double from, double to,
                                                     bool from_start = false);

/// Why `events_between` would refuse some stretch of `seconds` or less, in words that name the clip; empty where it
/// takes every one. A stage is refused for it before it runs.
/// @param seconds  >= 0
[[nodiscard]] std::string too_many_events(const Play& play, const Clip& clip, double seconds);

/// The first of these, ends of intervals left out: of any name, or of the one given. At once, however many follow.
[[nodiscard]] std::optional<FiredEvent> first_event(const Play& play, const Clip& clip, double from, double to,
                                                    bool from_start = false,
                                                    std::optional<std::string_view> name = std::nullopt);

/// Stage time at which the play is over; infinity for an endless one.
[[nodiscard]] double end_time(const Play& play, const Clip& clip) noexcept;

}  // namespace tweenfall
