#pragma once

/// `Player`: a play and what has been asked of it while it ran, each at its exact time. Clock, weight and events at any
/// time are functions of both, before the changes as after them.

#include <tweenfall/anim/play.h>

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tweenfall {

/// A key of a weight or a speed: plain data, so that what was asked can be kept and asked again.
struct PlayKey {
  double time = 0;  ///< seconds from when it is asked for
  double value = 0;
  Ease ease = Ease::smooth_clamped();

  bool operator==(const PlayKey&) const = default;
};
/// One key is a constant.
using PlayKeys = std::vector<PlayKey>;

/// What may be asked of a play. Where nothing else is said, what it does not name goes on: value and rate.
namespace playing {
/// It begins, now; where it runs already, again.
struct Start {
  std::string clip{};  ///< by its name; empty: again as it was given, and nothing else is read
  double from = 0;     ///< as of a play, all of these
  std::optional<double> to{};
  double offset = 0;
  bool reverse = false;
  std::optional<Loop> loop{};
  PlayKeys speed{{0, 1}}, weight{{0, 1}};
  Fade fade_in{}, fade_out{};
  std::vector<std::string> mask{};

  bool operator==(const Start&) const = default;
};
/// It is over, and has no say any more once it has faded.
struct Stop {
  double seconds = 0;          ///< of fading
  std::optional<Ease> ease{};  ///< absent: the weight's value and rate go on, and it comes to rest

  bool operator==(const Stop&) const = default;
};
/// Its weight goes to another.
struct FadeTo {
  double weight = 1;  ///< 0 to 1
  double seconds = 0;
  std::optional<Ease> ease{};

  bool operator==(const FadeTo&) const = default;
};
/// Its weight is another from now on, `fade_in` included; a jump, unless the new one begins where the old one is.
struct Weigh {
  PlayKeys weight{{0, 1}};

  bool operator==(const Weigh&) const = default;
};
/// Its clock goes on from where it is, at another speed.
struct SetSpeed {
  PlayKeys speed{{0, 1}};
  double seconds = 0;  ///< in which the speed goes there, evenly, from what it is; of one key alone

  bool operator==(const SetSpeed&) const = default;
};
/// Its clock is at another time of the clip, within its section. A play that was over goes on.
struct Seek {
  double time = 0;      ///< clip time, s
  bool events = false;  ///< whether what lies between fires, all of it now
  double fade = 0;  ///< s in which the pose of the clock as it was, which runs on, fades into the new one; 0: a jump

  bool operator==(const Seek&) const = default;
};
}  // namespace playing

using PlayAction =
    std::variant<playing::Start, playing::Stop, playing::FadeTo, playing::Weigh, playing::SetSpeed, playing::Seek>;

/// A play asked for something, at a time.
struct PlayChange {
  double time = 0;   ///< stage time, s
  std::string play;  ///< its name, or that of its clip
  PlayAction action;

  bool operator==(const PlayChange&) const = default;
};

/// @throws std::invalid_argument for keys that make no curve
[[nodiscard]] Curve<double> curve_of(const PlayKeys& keys);

/// The play that `start` asks for. @param clip  index of its clip
/// @throws std::invalid_argument for keys that make no curve
[[nodiscard]] Play play_of(const playing::Start& start, std::size_t clip);

/// A clock of a play, and its say.
struct PlayVoice {
  ClipClock clock;
  Sample<double> weight;
};
/// All that a play shows at a time, the lowest first: one, and below it, while a seek fades, what it was before.
struct PlayVoices {
  static constexpr std::size_t most = 8;  ///< beyond which the oldest is heard no more
  std::array<PlayVoice, most> list{};
  std::size_t count = 0;
};

class Player {
 public:
  // Moving copies: it is as cheap, and what was moved from stays what it was.
  Player(const Player&) noexcept = default;
  Player& operator=(const Player&) noexcept = default;

  /// @throws std::invalid_argument listing what is wrong with the play
  Player(const Play& play, const Clip& clip);

  /// The play as it is after all changes.
  [[nodiscard]] const Play& play() const noexcept;
  /// When the play that runs now began, s.
  [[nodiscard]] double at() const noexcept;
  /// When it first did.
  [[nodiscard]] double first_at() const noexcept;

  /// The same player, asked for something at `time`, which is not before the last change.
  /// @param clip  its own
  /// @throws std::invalid_argument for what cannot be
  [[nodiscard]] Player changed(const Clip& clip, double time, const PlayAction& action) const;

  [[nodiscard]] ClipClock clock(double time, Side side = Side::out) const noexcept;
  /// Of its say: with its fades; 0 once it was stopped.
  [[nodiscard]] Sample<double> weight(double time, Side side = Side::out) const noexcept;
  /// Clock and weight, while a seek fades of each pose that shows: laid over each other they have the play's weight.
  [[nodiscard]] PlayVoices voices(double time, Side side = Side::out) const noexcept;
  /// Whether it was stopped and has no say.
  [[nodiscard]] bool is_gone(double time, Side side = Side::out) const noexcept;
  /// When the play that runs now is over, or stopped, s; infinity for never.
  [[nodiscard]] double end() const noexcept;
  /// First time in (from, to] at which the weight of the play that runs now jumps by a key of its own; infinity for
  /// none.
  [[nodiscard]] double first_weight_jump(double from, double to) const noexcept;

  /// As for plays, of `clip`, which may be another one of the same length.
  [[nodiscard]] std::vector<FiredEvent> events_between(const Clip& clip, double from, double to,
                                                       bool from_start = false) const;
  [[nodiscard]] std::optional<FiredEvent> first_event(const Clip& clip, double from, double to, bool from_start = false,
                                                      std::optional<std::string_view> name = std::nullopt) const;
  /// What the last change itself fires, at its very time: what starts on an event, what a leap enters and leaves.
  [[nodiscard]] std::vector<FiredEvent> events_of_change(const Clip& clip) const;
  /// Calls `visit` with each of these events until it returns false.
  void visit_events(const Clip& clip, double from, double to, bool from_start,
                    const std::function<bool(FiredEvent&&)>& visit) const;

 private:
  struct Life;
  explicit Player(std::shared_ptr<Life> latest);
  [[nodiscard]] const Life& at_time(double time, Side side) const noexcept;
  std::shared_ptr<Life> latest_;
};

/// A player as a clock lets it run, told on the stage's time.
struct RunningPlay {
  const Player* player = nullptr;
  const Clip* clip = nullptr;
  ClockOverride clock_override{};
  double lead = 0;     ///< how far it is beyond its own time, s
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
  /// First time in (from, to] at which its weight jumps; infinity for none.
  [[nodiscard]] double first_weight_jump(double from, double to) const noexcept;
  /// As for plays. @param events  those of its own clip, or of another one of the same length
  [[nodiscard]] std::optional<FiredEvent> first_event(const Clip& events, double from, double to,
                                                      bool from_start = false,
                                                      std::optional<std::string_view> name = std::nullopt) const;
};

}  // namespace tweenfall
