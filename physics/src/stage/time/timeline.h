#pragma once

#include "queries/scene.h"
#include "stage/stage_data.h"
#include "state/lazily_made.h"

namespace tweenfall::staging {

/// The stage in time. What the caller reads lies between two states without an instant between them: the world is
/// simulated to the first instant at or after `now`. A change by the caller repeats that piece, up to `now`, and
/// acts on the state there; it is kept, so that going back finds it again. However many instants a step has, at most
/// two states are held.
class Timeline {
 public:
  explicit Timeline(StageDescription described);

  /// @param aloud  whether callbacks are called
  void run_to(double target, bool aloud);
  void restart();
  /// Goes on at `now` until so many of the blows that fall there have fallen, or no more come.
  void pass_blows(int count);
  /// Makes a change at exactly `now`. If it throws, nothing has changed.
  void command(Change change);

  /// The changes until `now` that are input.
  [[nodiscard]] std::vector<TimedInput> inputs() const;

  [[nodiscard]] std::vector<std::byte> save() const;
  /// @throws std::invalid_argument; nothing has changed then
  void load(std::span<const std::byte> saved);

  [[nodiscard]] double now() const noexcept { return now_; }
  /// The two states between which `now` lies; the same one twice if `now` is exactly there.
  [[nodiscard]] std::pair<const StageState*, const StageState*> around() const noexcept;
  [[nodiscard]] const StageState& current() const noexcept { return *around().first; }
  /// The state at the end of the piece in which `now` lies.
  [[nodiscard]] const StageState& ahead() const noexcept { return to_; }
  /// Throws std::logic_error inside a callback: it cannot do `what`.
  void require_not_telling(const char* what) const;

  const StageDescription description;
  std::vector<StageEvent> events;
  std::vector<HandOff> handoffs;
  std::function<void(const StageEvent&)> on_event, on_contact;
  std::function<void(const HandOff&)> on_handoff;
  state::LazilyMade<queries::Scene> scene;  ///< of the bodies at `now`, for queries
  bool abandoned = false;                   ///< the stage was destroyed inside a callback: nothing more is reported

 private:
  void take(StageState& state);
  /// @throws NodeNotFinite
  void take(StageState& state, std::span<const Command> commands, std::vector<Happening>& happenings,
            std::optional<StageState>& arrived) const;
  void next_piece();
  [[nodiscard]] bool was_told(const Happening& happening);
  void tell(bool aloud, double until);
  void keep_told();
  void put_in(std::vector<Happening> caused);
  std::optional<std::vector<Happening>> reach_now();
  void leave_told(std::vector<Happening> still_told);

  StageState initial_;
  StageState from_, to_;
  std::optional<StageState> arrived_;     ///< `to_` before the caller's changes there
  std::vector<Command> commands_;         ///< in order of time
  std::vector<Happening> happenings_;     ///< not all reported yet
  std::size_t told_ = 0;                  ///< how many of them have been reported
  std::size_t of_piece_ = 0;              ///< index of the first that belongs to the current piece
  std::vector<Happening> to_come_again_;  ///< told, and taken back until their piece comes again
  double now_ = 0;
  bool telling_ = false;
};

}  // namespace tweenfall::staging
