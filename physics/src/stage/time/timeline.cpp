#include "stage/time/timeline.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "stage/time/in_order.h"
#include "stage/time/twins.h"

namespace tweenfall::staging {

Timeline::Timeline(StageDescription described)
    : description(std::move(described)), initial_(initial_state(description)), from_(initial_), to_(initial_) {
  take(to_);
}

void Timeline::take(StageState& state) {
  take(state, commands_, happenings_, arrived_);
}

void Timeline::take(StageState& state, std::span<const Command> commands, std::vector<Happening>& happenings,
                    std::optional<StageState>& arrived) const {
  try {
    take_piece(state, description.step, commands, happenings, arrived);
  } catch (const NodeNotFinite&) {
    throw;
  } catch (const NotFinite& fault) {
    const std::size_t index = fault.body.index;
    const NodeId node = index < state.node_of.size() ? state.node_of[index] : no_node;
    throw NodeNotFinite(node, node == no_node ? std::string("a body") : (*state.nodes)[node].name, fault);
  }
}

void Timeline::keep_told() {
  happenings_.erase(happenings_.begin(), happenings_.begin() + static_cast<std::ptrdiff_t>(told_));
  told_ = 0;
  of_piece_ = happenings_.size();
}

void Timeline::next_piece() {
  keep_told();
  std::erase_if(to_come_again_, [this](const Happening& each) { return each.time < to_.time; });
  from_ = to_;
  try {
    take(to_);
  } catch (...) {
    // As before the piece, at its beginning: going on meets the same fault.
    to_ = from_;
    now_ = std::max(now_, to_.time);
    happenings_.resize(of_piece_);
    throw;
  }
}

namespace {

/// Whether two tell the same, of which one was found in a longer piece.
bool is_same(const Happening& a, const Happening& b) {
  if (a.what.index() != b.what.index()) return false;
  if (const auto* event = std::get_if<StageEvent>(&a.what)) {
    const auto& other = std::get<StageEvent>(b.what);
    return event->time == other.time && event->name == other.name && event->nodes == other.nodes;
  }
  const auto &handoff = std::get<HandOff>(a.what), &other = std::get<HandOff>(b.what);
  return handoff.time == other.time && handoff.node == other.node && handoff.to == other.to &&
         handoff.cause == other.cause;
}

}  // namespace

/// Whether the caller was told of it before, in a piece that came again.
bool Timeline::was_told(const Happening& happening) {
  const auto twin =
      std::ranges::find_if(to_come_again_, [&](const Happening& each) { return is_same(each, happening); });
  if (twin == to_come_again_.end()) return false;
  to_come_again_.erase(twin);
  return true;
}

void Timeline::tell(bool aloud, double until) {
  struct Telling {
    bool& flag;
    const bool before = std::exchange(flag, true);
    ~Telling() { flag = before; }
  } guard{telling_};
  while (!abandoned && told_ < happenings_.size() && happenings_[told_].time <= until) {
    const Happening happening = happenings_[told_++];
    now_ = std::max(now_, happening.time);
    scene.forget();
    const bool calls = !was_told(happening) && aloud;
    // Copies of the callbacks, as they may replace themselves.
    if (const auto* handoff = std::get_if<HandOff>(&happening.what)) {
      handoffs.push_back(*handoff);
      const auto callback = on_handoff;
      if (calls && callback) callback(*handoff);
    } else {
      const StageEvent& event = std::get<StageEvent>(happening.what);
      events.push_back(event);
      const auto callback = event.name == "contact" && !event.nodes.empty() ? on_contact : on_event;
      if (calls && callback) callback(event);
    }
  }
}

void Timeline::run_to(double target, bool aloud) {
  for (;;) {
    tell(aloud, target);
    scene.forget();
    if (abandoned || to_.time >= target) break;
    next_piece();
  }
  now_ = std::max(now_, target);
}

void Timeline::pass_blows(int count) {
  while (!abandoned && to_.time <= now_ && to_.at_once < count) {
    next_piece();
    tell(true, now_);
  }
  scene.forget();
}

/// Makes `to_` the state on which a change at `now` acts, and forgets its future.
/// @return what the piece has told that still comes if it ends now; empty if that is all of it
std::optional<std::vector<Happening>> Timeline::reach_now() {
  const double end = static_cast<double>(to_.steps) * description.step;
  if (now_ >= to_.time || (to_.time == end && now_ >= end - sliver)) return {};
  const std::size_t kept = std::max(told_, of_piece_);
  if (now_ <= from_.handled) {
    happenings_.resize(kept);
    std::swap(from_, to_);
    // The whole piece comes again, and tells what is then to tell.
    return told_ > of_piece_ ? std::optional(std::vector<Happening>()) : std::nullopt;
  }
  StageState piece = from_;
  std::vector<Happening> again;
  const std::vector<Command> stop{{now_, change::None{}}};
  std::optional<StageState> unchanged;
  while (piece.time < now_) take(piece, stop, again, unchanged);
  // What the piece has told stays told, and is not told again, unless it does not come now.
  std::vector<Happening> told;
  if (told_ > of_piece_)
    told.assign(happenings_.begin() + static_cast<std::ptrdiff_t>(of_piece_),
                happenings_.begin() + static_cast<std::ptrdiff_t>(told_));
  std::vector<Happening> lost = told;
  take_out_twins(lost, std::span<const Happening>(again), is_same);
  take_out_twins(again, std::span<const Happening>(told), is_same);
  take_out_twins(told, std::span<const Happening>(lost), is_same);
  happenings_.resize(kept);
  happenings_.insert(happenings_.end(), std::make_move_iterator(again.begin()), std::make_move_iterator(again.end()));
  to_ = std::move(piece);
  return lost.empty() ? std::nullopt : std::optional(std::move(told));
}

/// Of what the piece has told, leaves what still comes: a contact that frees a body from the beginning of the piece on,
/// for example, may come no more. The rest is not told again if it comes after all.
void Timeline::leave_told(std::vector<Happening> still_told) {
  const auto first = happenings_.begin() + static_cast<std::ptrdiff_t>(of_piece_),
             last = happenings_.begin() + static_cast<std::ptrdiff_t>(told_);
  const auto handed = static_cast<std::size_t>(
      std::count_if(first, last, [](const Happening& each) { return std::holds_alternative<HandOff>(each.what); }));
  handoffs.resize(handoffs.size() - handed);
  events.resize(events.size() - (told_ - of_piece_ - handed));
  for (const Happening& each : still_told) {
    if (const auto* handoff = std::get_if<HandOff>(&each.what))
      handoffs.push_back(*handoff);
    else
      events.push_back(std::get<StageEvent>(each.what));
  }
  std::vector<Happening> taken_back(first, last);
  take_out_twins(taken_back, std::span<const Happening>(still_told), is_same);
  to_come_again_.insert(to_come_again_.end(), std::make_move_iterator(taken_back.begin()),
                        std::make_move_iterator(taken_back.end()));
  told_ = of_piece_ + still_told.size();
  happenings_.insert(happenings_.erase(first, last), std::make_move_iterator(still_told.begin()),
                     std::make_move_iterator(still_told.end()));
}

void Timeline::command(Change change) {
  scene.forget();
  // If the change turns out to be impossible, what is not reported yet comes as it would have.
  const auto untold = happenings_.begin() + static_cast<std::ptrdiff_t>(told_);
  const std::vector<Happening> coming(untold, happenings_.end());
  const bool ahead = now_ < to_.time;
  const std::shared_ptr<const StageState> aside = ahead ? std::make_shared<const StageState>(to_) : nullptr;
  const double began = from_.time;
  std::optional<std::vector<Happening>> still_told = reach_now();
  Command command{now_, std::move(change), to_.at_once};
  std::vector<Happening> caused;
  try {
    make_change(to_, command, description.step, caused);
  } catch (...) {
    if (ahead) {
      if (from_.time != began) std::swap(from_, to_);
      to_ = *aside;
    }
    happenings_.resize(told_);
    happenings_.insert(happenings_.end(), coming.begin(), coming.end());
    throw;
  }
  if (still_told) leave_told(*std::move(still_told));
  // A change made in the past begins another future.
  const auto is_to_come = [this](const Command& other) {
    return other.time > to_.handled || (other.time > to_.since && other.at_once > to_.at_once);
  };
  while (!commands_.empty() && is_to_come(commands_.back())) commands_.pop_back();
  commands_.insert(std::ranges::upper_bound(commands_, now_, {}, &Command::time), std::move(command));
  to_.jumped = true;
  put_in(std::move(caused));
  // A moment after the instant on which it acted, what is shown lies in the piece that begins there.
  if (!telling_) run_to(now_, true);
}

/// Among what is not told yet, each behind all that is not later.
void Timeline::put_in(std::vector<Happening> caused) {
  bring_in_order(caused, &Happening::time);
  const double last = of_piece_ > told_ ? happenings_[of_piece_ - 1].time : -infinity;
  of_piece_ += static_cast<std::size_t>(std::ranges::lower_bound(caused, last, {}, &Happening::time) - caused.begin());
  const auto count = static_cast<std::ptrdiff_t>(happenings_.size());
  happenings_.insert(happenings_.end(), std::make_move_iterator(caused.begin()), std::make_move_iterator(caused.end()));
  std::ranges::inplace_merge(happenings_.begin() + static_cast<std::ptrdiff_t>(told_), happenings_.begin() + count,
                             happenings_.end(), {}, &Happening::time);
}

std::vector<TimedInput> Timeline::inputs() const {
  std::vector<TimedInput> inputs;
  const auto name = [&](NodeId node) { return (*current().nodes)[node].name; };
  for (const Command& command : commands_) {
    if (command.time > now_) break;
    const auto add = [&](Input what) { inputs.push_back({command.time, std::move(what), command.at_once}); };
    if (const auto* ask = std::get_if<change::Ask>(&command.change)) add(input::Ask{ask->play, ask->action});
    if (const auto* tell = std::get_if<change::Tell>(&command.change)) {
      if (tell->value)
        add(input::Set{tell->graph, tell->name, *tell->value});
      else
        add(input::Send{tell->graph, tell->name});
    }
    if (const auto* release = std::get_if<change::Release>(&command.change))
      add(input::Release{name(release->node), release->settings});
    if (const auto* recover = std::get_if<change::Recover>(&command.change))
      add(input::Recover{name(recover->node), recover->settings});
    if (const auto* handed = std::get_if<change::HandOver>(&command.change))
      add(input::HandOver{name(handed->node), handed->change});
    if (const auto* push = std::get_if<change::Push>(&command.change))
      add(input::Push{name(push->node), push->impulse, push->point});
    if (const auto* told = std::get_if<change::Control>(&command.change))
      add(input::Control{told->vehicle, told->control});
  }
  return inputs;
}

void Timeline::restart() {
  scene.forget();
  from_ = initial_;
  to_ = initial_;
  happenings_.clear();
  events.clear();
  handoffs.clear();
  to_come_again_.clear();
  told_ = of_piece_ = 0;
  now_ = 0;
  next_piece();
}

std::pair<const StageState*, const StageState*> Timeline::around() const noexcept {
  const double end = static_cast<double>(to_.steps) * description.step;
  if (now_ >= to_.time || (to_.time == end && now_ >= end - sliver)) return {&to_, &to_};
  return {&from_, arrived_ ? &*arrived_ : &to_};
}

void Timeline::require_not_telling(const char* what) const {
  if (telling_) throw std::logic_error(std::string("a callback cannot ") + what + " the stage that called it");
}

}  // namespace tweenfall::staging
