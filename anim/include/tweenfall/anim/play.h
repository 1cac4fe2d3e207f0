#pragma once

/// Playing: from stage time to clip time, analytically.
///
/// A play has no state. The time of its clock, its speed and the events between two moments are determined by the stage
/// time alone, so a stage can be evaluated at any time in any order.
///
/// What it shows before its start and after its end is its `Fill`: usually the first frame, where no play below drives
/// the same, and the last. What changes while it runs is a `Player`'s (player.h).

#include <tweenfall/anim/clip.h>
#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/ease.h>

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

/// How fast a play runs, in clip seconds per stage second: one number, or a curve over the play's own time. The clip
/// time that has passed is the curve's integral, and the curve itself is the exact rate.
class PlaySpeed {
 public:
  PlaySpeed(double speed = 1) noexcept : constant_(speed) {}  // NOLINT(google-explicit-constructor): a number is one

  /// @param speed over seconds since the play's start; it must hold its values outside its
  /// knots
  /// @throws std::invalid_argument for a curve that has no end, or that does anything else outside its knots
  explicit PlaySpeed(const Curve<double>& speed);

  [[nodiscard]] bool is_constant() const noexcept { return !warp_; }
  /// The speed. @param own seconds since the play's start, here and below
  [[nodiscard]] double at(double own, Side side = Side::out) const noexcept;
  /// Clip seconds run since the start.
  [[nodiscard]] double way(double own) const noexcept;
  /// 1 where it runs forwards just after `own` (or before, for `Side::in`), -1 backwards, 0 where it rests.
  [[nodiscard]] int direction(double own, Side side = Side::out) const noexcept;
  /// The direction between one of `turns` and the next. @param turn number of turns before
  [[nodiscard]] int direction_after(std::size_t turn) const noexcept;
  /// The first direction that is not 0; 0 for a play that never runs.
  [[nodiscard]] int first_direction() const noexcept;
  /// Times after 0, in order, between which the direction does not change; empty for a constant.
  [[nodiscard]] std::span<const double> turns() const noexcept;
  /// Greatest absolute value.
  [[nodiscard]] double greatest() const noexcept;
  /// The curve, if it was made from one.
  [[nodiscard]] std::optional<Curve<double>> curve() const;

 private:
  struct Warp;
  double constant_ = 1;
  std::shared_ptr<const Warp> warp_;
};

/// A transition from one weight to another.
struct Fade {
  double seconds = 0;  ///< >= 0
  Ease ease = Ease::linear();

  bool operator==(const Fade&) const = default;
};

/// What a play shows outside the time in which it runs: before its start the first frame that it will show, after its
/// end the last. Where it shows nothing, its nodes are what lies below makes of them: at its very start it shows, at
/// its very end no more. The words are those of CSS; "before" and "after" are stage time, whichever way the clock runs.
///
/// Source: Web Animations Level 1, section 4.6.8 ("Fill behavior").
enum class Fill {
  yielding,   ///< the last frame; the first one where no play below drives the same
  none,       ///< nothing
  forwards,   ///< the last frame
  backwards,  ///< the first frame
  both
};

/// What they are called in documents, in order.
inline constexpr std::array<std::string_view, 5> fill_words{"yielding", "none", "forwards", "backwards", "both"};

[[nodiscard]] constexpr bool fills_before(Fill fill) noexcept {
  return fill == Fill::backwards || fill == Fill::both;
}
[[nodiscard]] constexpr bool fills_after(Fill fill) noexcept {
  return fill != Fill::none && fill != Fill::backwards;
}

/// One clip being played.
struct Play {
  std::size_t clip = 0;             ///< index of the clip
  double at = 0;                    ///< stage time at which it starts, s
  PlaySpeed speed = 1;              ///< over its own time; if negative at first, the play starts at the end
  Curve<double> weight{1.0};        ///< over its own time, seconds since `at`; 0 to 1; its rate enters the blend
  std::vector<std::string> mask{};  ///< names or patterns ("arm/*") of the nodes it drives; empty: all

  std::string name{};          ///< the name used to change it while it runs; empty: the clip's
  double from = 0;             ///< the section of the clip that is played, clip seconds
  std::optional<double> to{};  ///< absent: the clip's end
  double offset = 0;           ///< seconds of all rounds already played when it starts; >= 0
  bool reverse = false;        ///< each round from its end to its start
  std::optional<Loop> loop{};  ///< absent: the clip's own
  Fade fade_in{};              ///< of the weight, over stage seconds from the start
  Fade fade_out{};             ///< the same to the end of the play, where it has one
  Fill fill = Fill::yielding;  ///< what it shows before its start and after its end
};

/// The faults of a play of this clip, one sentence each; empty if there are none.
[[nodiscard]] std::vector<std::string> problems_of(const Play& play, const Clip& clip);

/// Runs plays by a clock other than the stage's, for example after a hand-back: all moved together, or only one clip.
struct ClockOverride {
  static constexpr std::size_t every_clip = static_cast<std::size_t>(-1);

  double stage = 0;               ///< at this stage time, s, ...
  double timeline = 0;            ///< ... the plays and their weights are as they would be at this one, s
  std::size_t clip = every_clip;  ///< if given, only this clip, at full weight over all its nodes
  double starts_by = 0;           ///< timeline time at which `clip` begins if no play has begun it, s

  [[nodiscard]] double timeline_at(double stage_time) const noexcept { return timeline + (stage_time - stage); }
  [[nodiscard]] double stage_at(double timeline_time) const noexcept { return stage + (timeline_time - timeline); }

  bool operator==(const ClockOverride&) const = default;
};

/// The clock of a play at one time.
struct ClipClock {
  double time = 0;  ///< clip time after looping, s
  double rate = 0;  ///< d(clip time)/d(stage time); 0 before the start and after the end: a pose that holds is at rest
  int cycle = 0;    ///< number of whole rounds completed; multiplies the offset where it `climbs`
  bool started = false;  ///< stage time has reached `at`
  bool ended = false;    ///< all counted rounds are over
  Side side =
      Side::out;  ///< the side on which to sample the tracks, so that a clock running backwards arrives from above
  bool climbs = false;      ///< each round starts from where the one before ended
  double from = 0, to = 0;  ///< the section of each round, clip seconds
};

/// The clock at a stage time. At a seam `Side::in` is the end of the round before, `Side::out` the start of the next.
[[nodiscard]] ClipClock clock_at(const Play& play, const Clip& clip, double stage_time, Side side = Side::out) noexcept;

/// The same for a play that has only a start, in stage time, and a speed.
[[nodiscard]] ClipClock clock_at(double at, double speed, const Clip& clip, double stage_time, Side side) noexcept;

/// An event as it happened on the stage.
struct FiredEvent {
  double time = 0;  ///< stage time, s
  std::string name;
  std::string data;
  std::size_t clip = 0;  ///< index of the clip
  using Kind = EventKind;
  Kind kind = Kind::moment;
};

/// Events in (from, to] of stage time, in order, each once, also across loops; in [from, to] if `from_start` (a play's
/// first advance), so that an event at 0 fires. Outside the time of the play nothing fires.
///
/// A clock fires the events that it reaches: running forwards those in (t0, t1] of the clip, backwards those in [t1,
/// t0), at rest none; where it starts to move, also those at its own time. Begins and ends of intervals come in pairs:
/// an interval begins where the clock enters it, and ends where the clock leaves it, or where the play ends inside it.
/// @throws std::length_error naming the clip where a tiny loop makes more than a million of them.
[[nodiscard]] std::vector<FiredEvent> events_between(const Play& play, const Clip& clip, double from, double to,
                                                     bool from_start = false);

/// Why some stretch of `seconds` or less has more events than `most`, in a text that names the clip; empty where none
/// has. A million is what `events_between` accepts. The events are counted from above, up to twice as many.
/// @param seconds  >= 0
[[nodiscard]] std::string too_many_events(const Play& play, const Clip& clip, double seconds, double most = 1e6);

/// How many of them a stage accepts in one step, since it keeps all: 20,000, and of a clip with many events those of a
/// few rounds, up to a million.
[[nodiscard]] double most_events_in_step(const Clip& clip) noexcept;

/// The first of these events, not counting ends of intervals: of any or of one name. Fast, however many follow.
[[nodiscard]] std::optional<FiredEvent> first_event(const Play& play, const Clip& clip, double from, double to,
                                                    bool from_start = false,
                                                    std::optional<std::string_view> name = std::nullopt);

/// Stage time at which the play is over: when its clock first reaches the end of all its rounds. Infinity for an
/// endless one.
[[nodiscard]] double end_time(const Play& play, const Clip& clip) noexcept;
/// The same for a play that has only a start, in stage time, and a speed.
[[nodiscard]] double end_time(double at, double speed, const Clip& clip) noexcept;

}  // namespace tweenfall
