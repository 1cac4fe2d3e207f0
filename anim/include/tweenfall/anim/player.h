#pragma once

/// `Player`: a play and the changes made to it while it ran, each at its exact time. Clock, weight and events at any
/// time, before a change as well as after it, are functions of both.

#include <tweenfall/anim/play.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace tweenfall {

/// A key of a weight or a speed: plain data, so that a change can be saved and repeated.
struct PlayKey {
  double time = 0;  ///< seconds since the change
  double value = 0;
  Ease ease = Ease::smooth_clamped();

  bool operator==(const PlayKey&) const = default;
};
/// One key is a constant.
using PlayKeys = std::vector<PlayKey>;

/// The changes to a play. Unless stated otherwise, quantities that a change does not name continue with value and rate.
namespace playing {
/// The play begins now; if it runs already, it begins again.
struct Start {
  std::string clip{};  ///< its name; empty: the play as it was given, nothing else is read; or a new play of its name
  double from = 0;     ///< this and the following as in `Play`
  std::optional<double> to{};
  double offset = 0;
  bool reverse = false;
  std::optional<Loop> loop{};
  PlayKeys speed{{0, 1}}, weight{{0, 1}};
  Fade fade_in{}, fade_out{};
  std::vector<std::string> mask{};
  Fill fill = Fill::yielding;

  bool operator==(const Start&) const = default;
};
/// The play ends, and has no weight any more once it has faded.
struct Stop {
  double seconds = 0;          ///< of fading
  std::optional<Ease> ease{};  ///< absent: the weight continues with its value and rate, and comes to rest

  bool operator==(const Stop&) const = default;
};
/// The play's weight fades to another.
struct FadeTo {
  double weight = 1;  ///< 0 to 1
  double seconds = 0;
  std::optional<Ease> ease{};

  bool operator==(const FadeTo&) const = default;
};
/// The play's weight is replaced from now on, `fade_in` included; it jumps unless the new one begins at the old value.
struct Weigh {
  PlayKeys weight{{0, 1}};

  bool operator==(const Weigh&) const = default;
};
/// The play's clock continues from its present time at another speed.
struct SetSpeed {
  PlayKeys speed{{0, 1}};
  double seconds = 0;  ///< in which the speed changes linearly from its present value; only for a single key

  bool operator==(const SetSpeed&) const = default;
};
/// The play's clock jumps to another time of the clip, within its section. A play that was over continues.
struct Seek {
  double time = 0;      ///< clip time, s
  bool events = false;  ///< whether the events in between fire, all of them now
  double fade = 0;      ///< s in which the pose by the old clock, which runs on, fades into the new one; 0: a jump

  bool operator==(const Seek&) const = default;
};
}  // namespace playing

using PlayAction =
    std::variant<playing::Start, playing::Stop, playing::FadeTo, playing::Weigh, playing::SetSpeed, playing::Seek>;

/// A change to a play, at a time.
struct PlayChange {
  double time = 0;   ///< stage time, s
  std::string play;  ///< its name, or that of its clip
  PlayAction action;

  bool operator==(const PlayChange&) const = default;
};

/// @throws std::invalid_argument for keys that do not make a curve
[[nodiscard]] Curve<double> curve_of(const PlayKeys& keys);

/// The play that `start` describes. @param clip index of its clip
/// @throws std::invalid_argument for keys that do not make a curve
[[nodiscard]] Play play_of(const playing::Start& start, std::size_t clip);

/// A clock of a play, and its weight.
struct PlayVoice {
  ClipClock clock;
  Sample<double> weight;
};
/// All that a play shows at a time, the lowest first: one, and below it, while a seek fades, what it was before; none
/// where it shows nothing.
struct PlayVoices {
  static constexpr std::size_t most = 8;  ///< beyond this the oldest is dropped
  std::array<PlayVoice, most> list{};
  std::size_t count = 0;
};

namespace clips {
class Course;
}

/// What a play goes through, round by round.
struct PlaySection {
  double from = 0, to = 0;  ///< clip seconds
  LoopMode mode = LoopMode::once;

  bool operator==(const PlaySection&) const = default;
};

/// A moment of a clip that a clock meets as it runs.
struct PlayMeeting {
  FiredEvent moment;
  const Clip* clip = nullptr;            ///< the one that has it
  const clips::Course* clock = nullptr;  ///< private to the library
};

class Player {
 public:
  // A move is a copy: that is just as cheap, and the object moved from stays valid.
  Player(const Player&) noexcept = default;
  Player& operator=(const Player&) noexcept = default;

  /// @throws std::invalid_argument listing what is wrong with the play
  Player(const Play& play, const Clip& clip);

  /// The play as it is after all changes.
  [[nodiscard]] const Play& play() const noexcept;
  /// When the current play began, s.
  [[nodiscard]] double at() const noexcept;
  /// When the first play began, s.
  [[nodiscard]] double first_at() const noexcept;

  /// The same player with a change at `time`, which must not be before the last change.
  /// @param clip  its own
  /// @throws std::invalid_argument for an impossible change
  [[nodiscard]] Player changed(const Clip& clip, double time, const PlayAction& action) const;

  [[nodiscard]] ClipClock clock(double time, Side side = Side::out) const noexcept;
  /// Of its say: with its fades; 0 once it was stopped, and where it does not fill.
  [[nodiscard]] Sample<double> weight(double time, Side side = Side::out) const noexcept;
  /// Clock and weight of each pose that shows, several while a seek fades. Layered, they have the play's weight.
  [[nodiscard]] PlayVoices voices(double time, Side side = Side::out) const noexcept;
  /// Whether it shows nothing any more: it was stopped, or is over and does not fill what comes after.
  [[nodiscard]] bool is_gone(double time, Side side = Side::out) const noexcept;
  /// Whether it shows something, though it may yield to what is below: it runs, or fills.
  [[nodiscard]] bool shows(double time, Side side = Side::out) const noexcept;
  /// When the play that runs now is over, or stopped, s; infinity for never.
  [[nodiscard]] double end() const noexcept;
  /// First time in (from, to] at which the weight of the current play jumps at one of its keys; infinity for
  /// none.
  [[nodiscard]] double first_weight_jump(double from, double to) const noexcept;
  /// First time in (from, to] at which a play begins, or is stopped or over and does not hold; infinity for none.
  [[nodiscard]] double first_begin_or_end(double from, double to) const noexcept;
  /// Clip times between which all its clocks run in [from, to], that of the pose before a fading seek included.
  [[nodiscard]] std::pair<double, double> reach(double from, double to) const noexcept;

  /// As for plays, with the events of `clip`, which may be another one of the same length.
  [[nodiscard]] std::vector<FiredEvent> events_between(const Clip& clip, double from, double to,
                                                       bool from_start = false) const;
  [[nodiscard]] std::optional<FiredEvent> first_event(const Clip& clip, double from, double to, bool from_start = false,
                                                      std::optional<std::string_view> name = std::nullopt) const;
  /// The first moment of `clip`, which may be another one of the same length, that a clock meets in (from, to]: also
  /// the clock of the pose before a seek that fades. Nothing counts that a change itself fires.
  [[nodiscard]] std::optional<PlayMeeting> first_meeting(const Clip& clip, double from, double to) const;
  /// All sections that it has played.
  [[nodiscard]] std::span<const PlaySection> sections() const noexcept;
  /// The same, with the moments of a clip for each of `sections()`.
  [[nodiscard]] std::optional<PlayMeeting> first_meeting(std::span<const Clip> clips, double from, double to) const;
  /// Calls `visit` with each event of `events_between` until it returns false.
  void visit_events(const Clip& clip, double from, double to, bool from_start,
                    const std::function<bool(FiredEvent&&)>& visit) const;

 private:
  struct Life;
  explicit Player(std::shared_ptr<Life> latest);
  [[nodiscard]] const Life& at_time(double time, Side side) const noexcept;
  template <class Tell>
  static void visit_run(const Life& life, const Clip& clip, double from, double to, double last, const Tell& tell);
  template <class Visit>
  void visit_clocks(double from, double to, const Visit& visit) const;
  template <class ClipOf>
  [[nodiscard]] std::optional<PlayMeeting> first_met(double from, double to, const ClipOf& clip_of) const;
  std::shared_ptr<Life> latest_;
};

/// A player run by a clock override, with times in stage time.
struct RunningPlay {
  const Player* player = nullptr;
  const Clip* clip = nullptr;
  ClockOverride clock_override{};
  double lead = 0;     ///< how far it is ahead of its own time, s
  bool alone = false;  ///< at full weight over all its nodes

  [[nodiscard]] double own_time(double stage_time) const noexcept {
    return clock_override.timeline_at(stage_time) + lead;
  }
  [[nodiscard]] double stage_time(double own_time) const noexcept { return clock_override.stage_at(own_time - lead); }

  [[nodiscard]] const Play& play() const noexcept { return player->play(); }
  [[nodiscard]] double at() const noexcept { return stage_time(player->at()); }
  [[nodiscard]] double end() const noexcept { return stage_time(player->end()); }
  [[nodiscard]] ClipClock clock(double time, Side side = Side::out) const noexcept {
    return player->clock(own_time(time), side);
  }
  [[nodiscard]] Sample<double> weight(double time, Side side = Side::out) const noexcept {
    return alone ? Sample<double>{1, 0, 0} : player->weight(own_time(time), side);
  }
  [[nodiscard]] PlayVoices voices(double time, Side side = Side::out) const noexcept {
    if (!alone) return player->voices(own_time(time), side);
    PlayVoices one;
    one.list[0] = {clock(time, side), weight(time, side)};
    one.count = 1;
    return one;
  }
  [[nodiscard]] bool is_gone(double time, Side side = Side::out) const noexcept {
    return player->is_gone(own_time(time), side);
  }
  [[nodiscard]] bool shows(double time, Side side = Side::out) const noexcept {
    return player->shows(own_time(time), side);
  }
  /// The following in stage time, as of `Player`.
  [[nodiscard]] double first_weight_jump(double from, double to) const noexcept;
  [[nodiscard]] double first_begin_or_end(double from, double to) const noexcept;
  [[nodiscard]] std::pair<double, double> reach(double from, double to) const noexcept {
    return player->reach(own_time(from), own_time(to));
  }
  [[nodiscard]] std::optional<PlayMeeting> first_meeting(const Clip& moments, double from, double to) const;
  [[nodiscard]] std::optional<PlayMeeting> first_meeting(std::span<const Clip> clips, double from, double to) const;
  /// As for plays. @param events  those of its own clip, or of another one of the same length
  [[nodiscard]] std::optional<FiredEvent> first_event(const Clip& events, double from, double to,
                                                      bool from_start = false,
                                                      std::optional<std::string_view> name = std::nullopt) const;

 private:
  template <class Clips>
  [[nodiscard]] std::optional<PlayMeeting> first_met(const Clips& clips, double from, double to) const;
};

}  // namespace tweenfall
