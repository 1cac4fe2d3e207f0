#include <tweenfall/curves/number_text.h>

#include "clip/life.h"

#include <stdexcept>

namespace tweenfall {

namespace clips {
namespace {

/// More events than this between two moments are an error.
constexpr double most_events = 1'000'000;

/// The part of an interval inside the section that is played, from its start; empty where there is none.
struct Inside {
  double from, to;
};
std::optional<Inside> clipped(const Rounds& rounds, const ClipEvent& event) {
  const double from = std::max(event.from - rounds.from, 0.0), to = std::min(event.to - rounds.from, rounds.length);
  return from < to ? std::optional(Inside{from, to}) : std::nullopt;
}
/// The phases in which an interval lies in one round, the lower first.
Inside phases_of(const Rounds& rounds, double round, const Inside& interval) {
  const double a = rounds.phase_of(round, interval.from), b = rounds.phase_of(round, interval.to);
  return {std::min(a, b), std::max(a, b)};
}

/// Whether a phase is a turn of a ping-pong, where the clock stays at a time of the clip and an interval goes on.
bool is_turn(const Rounds& rounds, double phase) {
  if (!rounds.loops() || rounds.mode != LoopMode::pingpong || !(rounds.low < phase && phase < rounds.total))
    return false;
  return phase == std::round(phase / rounds.length) * rounds.length;
}
/// An interval with the phases between which the clock stays in it, across the turns of a ping-pong that it touches.
struct Passage {
  double round;  ///< that in which it begins; 0 if it never leaves the interval
  Inside phases;
};
/// Empty where the interval goes on from the round before.
std::optional<Passage> passage_of(const Rounds& rounds, double round, const Inside& interval) {
  const bool everywhere = interval.from == 0 && interval.to == rounds.length;
  if (rounds.loops() && rounds.mode == LoopMode::pingpong && everywhere)
    return Passage{0, {rounds.low, std::ceil(rounds.total / rounds.length) * rounds.length}};
  Inside phases = phases_of(rounds, round, interval);
  if (is_turn(rounds, phases.from)) return {};
  if (is_turn(rounds, phases.to)) phases.to = phases_of(rounds, round + 1, interval).to;
  return Passage{round, phases};
}

/// The place of a moment inside the section.
std::optional<double> place_of(const Rounds& rounds, const ClipEvent& event) {
  const double inside = event.from - rounds.from;
  return inside >= 0 && inside <= rounds.length ? std::optional(inside) : std::nullopt;
}

struct Span {
  double first = 0, last = -1;
};
/// The rounds that may contain phases from `low` to `high`. They are iterated by count, because for very large round
/// numbers adding 1 changes nothing.
Span rounds_between(const Rounds& rounds, double low, double high) {
  if (!rounds.loops()) return {0, 0};
  Span span{std::floor(low / rounds.length) - 1, std::floor(high / rounds.length) + 1};
  if (std::isfinite(rounds.total)) {
    const double ending = std::ceil(rounds.total / rounds.length) - 1;
    span.first = std::max(span.first, -rounds.left_out);
    span.last = std::min(span.last, rounds.left_out > 0 ? ending : std::max(0.0, ending));
  }
  return span;
}

/// The round into which a clock moves from a phase; at a seam there are two.
double round_ahead(const Rounds& rounds, double phase, double direction) {
  const double place = phase / rounds.length;
  return direction > 0 ? std::floor(place) : std::ceil(place) - 1;
}

/// Whether a phase is the turn of a ping-pong, already handled with the round before: the clip is there once, not
/// twice.
bool is_turn_again(const Rounds& rounds, double round, double phase) {
  const bool first = std::isfinite(rounds.total) && round == -rounds.left_out;
  return rounds.loops() && rounds.mode == LoopMode::pingpong && phase == round * rounds.length && !first;
}

/// The events of one stretch of one play, in the order in which its clock meets them.
class StretchWalk {
 public:
  /// @param goes_on  whether the clock runs on the same way where the stretch is cut off
  StretchWalk(const Rounds& rounds, const Clip& clip, std::size_t index, const Stretch& stretch, bool goes_on)
      : rounds_(rounds), clip_(clip), index_(index), stretch_(stretch), goes_on_(goes_on) {}

  template <class TimeOf>
  void tell_round(double round, const TimeOf& time_of, std::vector<FiredEvent>& fired) const {
    const bool up = stretch_.direction > 0;
    const auto fire = [&](double phase, const ClipEvent& event, FiredEvent::Kind kind) {
      fired.push_back({time_of(phase), event.name, event.data, index_, kind});
    };
    for (const ClipEvent& event : clip_.events) {
      if (!event.is_interval()) {
        if (const std::optional<double> place = place_of(rounds_, event))
          if (const double phase = rounds_.phase_of(round, *place); meets(round, phase))
            fire(phase, event, FiredEvent::Kind::moment);
        continue;
      }
      const std::optional<Inside> inside = clipped(rounds_, event);
      if (!inside) continue;
      const auto [low, high] = phases_of(rounds_, round, *inside);
      const double entry = up ? low : high, exit = up ? high : low;
      if (!is_turn(rounds_, entry) && enters(entry)) fire(entry, event, FiredEvent::Kind::begin);
      if (!is_turn(rounds_, exit) && reaches(exit)) fire(exit, event, FiredEvent::Kind::end);
    }
  }

 private:
  [[nodiscard]] double along(double phase) const { return stretch_.direction * phase; }
  [[nodiscard]] bool reaches(double phase) const {
    return along(stretch_.phase_from) < along(phase) && along(phase) <= along(stretch_.phase_to);
  }
  /// Whether the clock runs on from a phase: from the first one, unless a change has told what begins there, and from
  /// the last one, if it goes on.
  [[nodiscard]] bool enters(double phase) const {
    const double from = along(stretch_.phase_from), to = along(stretch_.phase_to), at = along(phase);
    return (stretch_.told ? from < at : from <= at) && (goes_on_ ? at <= to : at < to);
  }
  [[nodiscard]] bool meets(double round, double phase) const {
    const bool begins_here = stretch_.first && !stretch_.sought && phase == stretch_.phase_from;
    if (rounds_.loops() && begins_here) return round == round_ahead(rounds_, phase, stretch_.direction);
    return !is_turn_again(rounds_, round, phase) && (begins_here || reaches(phase));
  }

  const Rounds& rounds_;
  const Clip& clip_;
  std::size_t index_;
  const Stretch& stretch_;
  bool goes_on_;
};

/// Why the events of a clip are refused.
std::string refusal(const Play& play, const Clip& clip, double most, const std::string& stretch) {
  const Rounds rounds = rounds_of(play, clip);
  const bool around = rounds.mode != LoopMode::once;
  return "clip \"" + clip.name + "\" " +
         (around ? "goes around every " + number_text(rounds.length / play.speed.greatest()) + " s and " : "") +
         "has more than " + (most == most_events ? "a million" : number_text(most)) + " events " + stretch + ": " +
         (around ? "lengthen its loop or " : "") + "leave out its events";
}

}  // namespace

std::vector<OpenInterval> open_intervals(const Rounds& rounds, const Clip& clip, double phase, int direction) {
  std::vector<OpenInterval> open;
  const Span span = rounds_between(rounds, phase, phase);
  for (double passed = 0; passed <= span.last - span.first; ++passed) {
    const double round = span.first + passed;
    for (std::size_t i = 0; i < clip.events.size(); ++i) {
      if (!clip.events[i].is_interval()) continue;
      const std::optional<Inside> inside = clipped(rounds, clip.events[i]);
      if (!inside) continue;
      const std::optional<Passage> passage = passage_of(rounds, round, *inside);
      if (!passage) continue;
      const auto [low, high] = passage->phases;
      const OpenInterval interval{i, passage->round};
      if ((low < phase && phase < high) || (direction > 0 && phase == low) || (direction < 0 && phase == high))
        if (std::ranges::find(open, interval) == open.end()) open.push_back(interval);
    }
  }
  return open;
}

std::vector<FiredEvent> passed_events(const Rounds& rounds, const Clip& clip, std::size_t index, double from, double to,
                                      Past past, double time, std::vector<OpenInterval>& open) {
  std::vector<std::pair<double, FiredEvent>> passed;
  const double direction = to < from ? -1 : 1, begin = direction * from, end = direction * to;
  const auto pass = [&](double way, const ClipEvent& event, FiredEvent::Kind kind) {
    passed.push_back({way, {time, event.name, event.data, index, kind}});
  };
  const auto pass_interval = [&](const OpenInterval& interval, const Inside& phases) {
    const ClipEvent& event = clip.events[interval.event];
    const double entry = direction * (direction > 0 ? phases.from : phases.to);
    const double exit = direction * (direction > 0 ? phases.to : phases.from);
    const auto known = std::ranges::find(open, interval);
    bool is_open = known != open.end();
    if (!is_open && entry < end && (past == Past::moved ? entry >= begin : exit > begin)) {
      pass(std::max(entry, begin), event, FiredEvent::Kind::begin);
      open.push_back(interval);
      is_open = true;
    }
    if (!is_open || !(exit < end)) return;
    pass(exit, event, FiredEvent::Kind::end);
    std::erase(open, interval);
  };
  const Span span = rounds_between(rounds, std::min(from, to), std::max(from, to));
  for (double count = 0; count <= span.last - span.first; ++count) {
    const double round = direction > 0 ? span.first + count : span.last - count;
    for (std::size_t i = 0; i < clip.events.size(); ++i) {
      const ClipEvent& event = clip.events[i];
      if (event.is_interval()) {
        if (const std::optional<Inside> inside = clipped(rounds, event))
          if (const std::optional<Passage> passage = passage_of(rounds, round, *inside))
            pass_interval({i, passage->round}, passage->phases);
        continue;
      }
      const std::optional<double> place = place_of(rounds, event);
      if (!place) continue;
      const double phase = rounds.phase_of(round, *place), way = direction * phase;
      const bool stands =
          past == Past::rested && phase == from && (!rounds.loops() || round == round_ahead(rounds, from, direction));
      const bool passes = way > begin && way <= end && !is_turn_again(rounds, round, phase);
      if (stands || passes) pass(way, event, FiredEvent::Kind::moment);
    }
  }
  std::ranges::stable_sort(passed, {}, &std::pair<double, FiredEvent>::first);
  std::vector<FiredEvent> events;
  events.reserve(passed.size());
  for (auto& [way, event] : passed) events.push_back(std::move(event));
  return events;
}

}  // namespace clips

void Player::visit_events(const Clip& clip, double from, double to, bool from_start,
                          const std::function<bool(FiredEvent&&)>& visit) const {
  if (clip.events.empty() && latest_->told.empty() && !latest_->before) return;
  // Each life gives the events of its own time: from where it took over to where the next did.
  std::vector<const Life*> lives;
  for (const Life* life = latest_.get(); life; life = life->before.get()) {
    if (life->since <= to) lives.push_back(life);
    if (life->met < from) break;
  }
  bool goes_on = true;
  const auto tell = [&](FiredEvent&& event) {
    const bool inside = event.time <= to && (event.time > from || (from_start && event.time == from));
    if (inside) goes_on = visit(std::move(event));
    return goes_on;
  };
  for (std::size_t i = lives.size(); i-- > 0 && goes_on;) {
    const Life& life = *lives[i];
    for (const FiredEvent& event : life.told)
      if (!tell(FiredEvent(event))) return;
    // Nothing comes before what had been told when it took over.
    const auto tell_later = [&](FiredEvent&& event) {
      event.time = std::max(event.time, life.met);
      return tell(std::move(event));
    };
    if (!clip.events.empty()) visit_run(life, clip, from, to, i > 0 ? lives[i - 1]->met : clips::infinity, tell_later);
  }
}

/// What a life's clock meets as it runs, until a change at `last`, that instant included.
/// @param tell  returns false to end
template <class Tell>
void Player::visit_run(const Life& life, const Clip& clip, double from, double to, double last, const Tell& tell) {
  bool goes_on = true;
  std::vector<FiredEvent> fired;
  const std::size_t index = life.play.clip;
  const clips::Rounds& rounds = life.rounds;
  const auto tell_open = [&](double phase, double time, FiredEvent::Kind kind) {
    const int direction = kind == FiredEvent::Kind::end && life.begin() == time ? life.direction(time) : 0;
    for (const clips::OpenInterval& open : clips::open_intervals(rounds, clip, phase, direction)) {
      const ClipEvent& event = clip.events[open.event];
      goes_on = goes_on && tell(FiredEvent{time, event.name, event.data, index, kind});
    }
  };
  life.visit_stretches(from, to, std::min(last, life.stopped), [&](const clips::Stretch& stretch) {
    if (stretch.from >= life.stopped) return true;
    if (stretch.first && !stretch.told && life.over() > stretch.from)
      tell_open(stretch.phase_from, stretch.from, FiredEvent::Kind::begin);
    const bool goes_on_after = stretch.to == last && last < life.over() && last < stretch.turn;
    const clips::StretchWalk walk(rounds, clip, index, stretch, goes_on_after);
    const auto phase_at = [&](double time) {
      return time <= stretch.from ? stretch.phase_from : time >= stretch.to ? stretch.phase_to : life.phase(time);
    };
    const double a = phase_at(from), b = phase_at(to);
    const clips::Span span = clips::rounds_between(rounds, std::min(a, b), std::max(a, b));
    for (double passed = 0; goes_on && passed <= span.last - span.first; ++passed) {
      fired.clear();
      walk.tell_round(
          stretch.direction < 0 ? span.last - passed : span.first + passed,
          [&](double phase) { return life.time_of(phase, stretch); }, fired);
      std::ranges::stable_sort(fired, {}, &FiredEvent::time);
      for (FiredEvent& event : fired) goes_on = goes_on && tell(std::move(event));
    }
    return goes_on;
  });
  // Intervals that are open when the life is over end then. Where it had no time to run, those that a change began do.
  const double over = life.over();
  if (goes_on && over > life.since && over <= last && over >= from && over <= to &&
      (life.moved || life.first_move < over))
    tell_open(life.held_phase(over), over, FiredEvent::Kind::end);
}

std::vector<FiredEvent> Player::events_between(const Clip& clip, double from, double to, bool from_start) const {
  double bound = 0;
  for (const Life* life = latest_.get(); life; life = life->before.get()) {
    if (life->begin() <= to && !clip.events.empty()) {
      const double begin = std::max(from, life->begin());
      const clips::Rounds& rounds = life->rounds;
      const double way = std::min(to - begin, life->over() - life->begin()) * life->play.speed.greatest();
      const double rounds_met = rounds.loops() ? std::max(0.0, way) / rounds.length + 3 : 1;
      const double counted =
          std::isfinite(rounds.total) && rounds.loops() ? (rounds.total - rounds.low) / rounds.length + 1 : rounds_met;
      bound += 2 * std::min(rounds_met, life->play.speed.is_constant() ? counted : rounds_met) *
               static_cast<double>(clip.events.size());
    }
    if (bound > clips::most_events)
      throw std::length_error(clips::refusal(life->play, clip, clips::most_events,
                                             "from " + number_text(from) + " s to " + number_text(to) + " s"));
    if (life->met < from) break;
  }
  std::vector<FiredEvent> fired;
  visit_events(clip, from, to, from_start, [&](FiredEvent&& event) {
    fired.push_back(std::move(event));
    return true;
  });
  if (!std::ranges::is_sorted(fired, {}, &FiredEvent::time)) std::ranges::stable_sort(fired, {}, &FiredEvent::time);
  return fired;
}

std::optional<FiredEvent> Player::first_event(const Clip& clip, double from, double to, bool from_start,
                                              std::optional<std::string_view> name) const {
  std::optional<FiredEvent> first;
  const bool told = latest_->before || !latest_->told.empty();
  if (name && !told && std::ranges::find(clip.events, *name, &ClipEvent::name) == clip.events.end()) return first;
  // Skips lives without such an event, whose rounds would all be searched in vain.
  const auto tells = [&](const Life& life) {
    return std::ranges::any_of(clip.events, [&](const ClipEvent& event) {
      if (name && event.name != *name) return false;
      return event.is_interval() ? clips::clipped(life.rounds, event).has_value()
                                 : clips::place_of(life.rounds, event).has_value();
    });
  };
  for (const Life* life = latest_.get(); life && !tells(*life); life = life->before.get()) to = std::min(to, life->met);
  visit_events(clip, from, to, from_start, [&](FiredEvent&& event) {
    if (event.kind == FiredEvent::Kind::end || (name && event.name != *name)) return true;
    first = std::move(event);
    return false;
  });
  return first;
}

template <class ClipOf>
std::optional<PlayMeeting> Player::first_met(double from, double to, const ClipOf& clip_of) const {
  std::optional<PlayMeeting> first;
  visit_clocks(from, to, [&](const Life& life, double begin, double end) {
    const Clip& clip = clip_of(life);
    // Else its rounds would all be searched in vain.
    const auto is_played = [&](const ClipEvent& moment) { return clips::place_of(life.rounds, moment).has_value(); };
    if (std::ranges::none_of(clip.events, is_played)) return;
    visit_run(life, clip, from, to, end, [&](FiredEvent&& moment) {
      if (!(moment.time > from && moment.time >= begin)) return true;
      if (moment.time <= std::min(to, end) && !(first && first->moment.time <= moment.time))
        first = PlayMeeting{std::move(moment), &clip, &life};
      return false;
    });
  });
  return first;
}

std::optional<PlayMeeting> Player::first_meeting(const Clip& clip, double from, double to) const {
  return first_met(from, to, [&](const Life&) -> const Clip& { return clip; });
}

std::optional<PlayMeeting> Player::first_meeting(std::span<const Clip> clips, double from, double to) const {
  return first_met(from, to, [&](const Life& life) -> const Clip& { return clips[life.section]; });
}

std::span<const PlaySection> Player::sections() const noexcept {
  return *latest_->sections;
}

std::vector<FiredEvent> events_between(const Play& play, const Clip& clip, double from, double to, bool from_start) {
  return Player(play, clip).events_between(clip, from, to, from_start);
}

std::optional<FiredEvent> first_event(const Play& play, const Clip& clip, double from, double to, bool from_start,
                                      std::optional<std::string_view> name) {
  return Player(play, clip).first_event(clip, from, to, from_start, name);
}

double most_events_in_step(const Clip& clip) noexcept {
  return std::clamp(10.0 * static_cast<double>(clip.events.size()), 2e4, clips::most_events);
}

std::string too_many_events(const Play& play, const Clip& clip, double seconds, double most) {
  const double speed = play.speed.greatest();
  if (clip.events.empty() || speed == 0) return {};
  double plays = 1;
  if (const clips::Rounds rounds = clips::rounds_of(play, clip); rounds.loops()) {
    // The stretch may lie anywhere: it touches one more round at each end, as many are searched beside these, and far
    // from the start the number of the first is rounded.
    plays = 1.001 * seconds * speed / rounds.length + 4;
    if (const double count = play.loop.value_or(clip.loop).count; count > 0 && play.speed.is_constant())
      plays = std::min(plays, std::ceil(count) + 1);
  }
  if (2 * plays * static_cast<double>(clip.events.size()) <= most) return {};
  return clips::refusal(play, clip, most, "within " + brief_text(seconds) + " s");
}

}  // namespace tweenfall
