#include <tweenfall/anim/player.h>
#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/number_text.h>

#include <stdexcept>
#include <utility>

#include "clip/landing.h"
#include "clip/life.h"

namespace tweenfall {

namespace clips {
namespace {

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

/// From a moving weight to another, where it comes to rest. Where it would overshoot 0 or 1, it starts less steeply.
Curve<double> eased_on(const Sample<double>& from, double to, double seconds) {
  const auto made = [&](double rate) {
    return keyed_curve<double>(
        {{.time = 0, .value = from.value, .out = Tangent<double>{.kind = TangentKind::given, .rate = rate}},
         {.time = seconds, .value = to, .in = Tangent<double>{.kind = TangentKind::flat}}});
  };
  const auto fits = [&](const Curve<double>& curve) {
    const Range extent = range(curve, 0, seconds);
    return extent.low >= std::min({0.0, from.value, to}) && extent.high <= std::max({1.0, from.value, to});
  };
  Curve<double> curve = made(from.rate);
  double least = 0, most = 1;
  for (int i = 0; i < 24 && (i == 0 ? !fits(curve) : true); ++i) {
    const double middle = (least + most) / 2;
    (fits(made(middle * from.rate)) ? least : most) = middle;
    if (i == 23) curve = made(least * from.rate);
  }
  return curve;
}

Curve<double> faded(const Sample<double>& from, double to, double seconds, const std::optional<Ease>& ease) {
  if (!(seconds > 0)) return Curve<double>(to);
  if (!ease) return eased_on(from, to, seconds);
  return keyed_curve<double>({{.time = 0, .value = from.value, .ease = *ease}, {.time = seconds, .value = to}});
}

void require_weight(double weight) {
  if (!(weight >= 0 && weight <= 1)) throw std::invalid_argument("a weight is from 0 to 1, not " + number_text(weight));
}

Curve<double> weight_of(const PlayKeys& keys) {
  for (const PlayKey& key : keys) require_weight(key.value);
  return curve_of(keys);
}

void require_seconds(double seconds) {
  if (!(seconds >= 0) || !std::isfinite(seconds))
    throw std::invalid_argument("a fade takes 0 s or more, not " + number_text(seconds));
}

std::string listed(const std::vector<std::string>& problems) {
  std::string text;
  for (const std::string& problem : problems) text += (text.empty() ? "" : "; ") + problem;
  return text;
}

const Play& valid(const Play& play, const Clip& clip) {
  if (const std::vector<std::string> problems = problems_of(play, clip); !problems.empty())
    throw std::invalid_argument("a play of clip \"" + clip.name + "\": " + listed(problems));
  return play;
}

}  // namespace
}  // namespace clips

std::vector<std::string> problems_of(const Play& play, const Clip& clip) {
  std::vector<std::string> problems;
  const auto require = [&](bool holds, const std::string& problem) {
    if (!holds) problems.push_back(problem);
  };
  const auto seconds = [](double value) { return number_text(value) + " s"; };
  require(std::isfinite(play.at), "its start time is not a finite number");
  require(std::isfinite(play.speed.greatest()), "its speed is not a finite number");
  require(play.from >= 0 && std::isfinite(play.from), "its section cannot start at " + seconds(play.from));
  if (play.to)
    require(*play.to > play.from && std::isfinite(*play.to),
            "its section ends at " + seconds(*play.to) + ", not after its start, " + seconds(play.from));
  const double last = std::max(play.from, play.to.value_or(play.from));
  require(last <= clip.duration,
          "its section reaches to " + seconds(last) + ", and the clip to " + seconds(clip.duration));
  require(play.offset >= 0 && std::isfinite(play.offset), "its offset is " + seconds(play.offset) + ", not 0 or more");
  const bool endless = std::isinf(play.to.value_or(clip.duration));
  require(!(endless && play.reverse), "an endless section cannot run in reverse");
  if (play.loop) {
    require(play.loop->count >= 0 && std::isfinite(play.loop->count), "its loop has no such count");
    require(!(endless && play.loop->mode != LoopMode::once), "an endless section cannot loop");
  }
  for (const Fade* fade : {&play.fade_in, &play.fade_out})
    require(fade->seconds >= 0 && std::isfinite(fade->seconds), "a fade takes 0 s or more");
  return problems;
}

Curve<double> curve_of(const PlayKeys& keys) {
  if (keys.size() == 1 && std::isfinite(keys.front().value)) return Curve<double>(keys.front().value);
  std::vector<Key<double>> made;
  made.reserve(keys.size());
  for (const PlayKey& key : keys) made.push_back({.time = key.time, .value = key.value, .ease = key.ease});
  return keyed_curve<double>(made);
}

Play play_of(const playing::Start& start, std::size_t clip) {
  return {.clip = clip,
          .speed = PlaySpeed(curve_of(start.speed)),
          .weight = clips::weight_of(start.weight),
          .mask = start.mask,
          .from = start.from,
          .to = start.to,
          .offset = start.offset,
          .reverse = start.reverse,
          .loop = start.loop,
          .fade_in = start.fade_in,
          .fade_out = start.fade_out,
          .fill = start.fill};
}

Player::Player(const Play& play, const Clip& clip)
    : latest_(std::make_shared<Life>(clips::valid(play, clip), clip, play.at)) {}

Player::Player(std::shared_ptr<Life> latest) : latest_(std::move(latest)) {}

const Player::Life& Player::at_time(double time, Side side) const noexcept {
  const Life* life = latest_.get();
  while (life->before && (side == Side::out ? time < life->since : time <= life->since)) life = life->before.get();
  return *life;
}

const Play& Player::play() const noexcept {
  return latest_->play;
}
double Player::at() const noexcept {
  return latest_->at;
}
double Player::first_at() const noexcept {
  const Life* life = latest_.get();
  while (life->before) life = life->before.get();
  return life->at;
}
double Player::end() const noexcept {
  return latest_->over();
}

ClipClock Player::clock(double time, Side side) const noexcept {
  return at_time(time, side).clock(time, side);
}
Sample<double> Player::weight(double time, Side side) const noexcept {
  const Life& life = at_time(time, side);
  return life.shows(time, side) ? life.weight(time, side) : Sample<double>{0, 0, 0};
}
bool Player::shows(double time, Side side) const noexcept {
  return at_time(time, side).shows(time, side);
}
bool Player::is_gone(double time, Side side) const noexcept {
  return at_time(time, side).is_gone(time, side);
}

double Player::first_weight_jump(double from, double to) const noexcept {
  double first = clips::infinity;
  double last = clips::infinity;  // when the next life took over
  for (const Life* life = latest_.get(); life; life = life->before.get()) {
    for (const double knot : life->play.weight.knots()) {
      const double time = life->weight_from + knot;
      if (time > from && time <= to && time >= life->since && time < last && time < first &&
          life->play.weight.value(knot, Side::in) != life->play.weight.value(knot))
        first = time;
    }
    if (life->since <= from) break;
    last = life->since;
  }
  return first;
}

double Player::first_begin_or_end(double from, double to) const noexcept {
  double first = clips::infinity;
  double last = clips::infinity;  // when the next life took over
  for (const Life* life = latest_.get(); life; life = life->before.get()) {
    const auto meet = [&](double time) {
      if (time > from && time <= to && time >= life->since && time < last) first = std::min(first, time);
    };
    meet(life->at);
    if (life->is_gone(life->over(), Side::out)) meet(life->over());
    if (life->since <= from) break;
    last = life->since;
  }
  return first;
}

std::pair<double, double> Player::reach(double from, double to) const noexcept {
  double low = clips::infinity, high = 0;
  visit_clocks(from, to, [&](const Life& life, double begin, double end) {
    begin = std::max(begin, from);
    end = std::min(end, to);
    const double first = life.clock(begin, Side::out).time, last = life.clock(end, Side::in).time;
    const double way = life.speed.greatest() * (end - begin);
    low = std::min({low, first - way, last - way});
    high = std::max({high, first + way, last + way});
  });
  return {std::max(low, 0.0), high};
}

Player Player::changed(const Clip& clip, double time, const PlayAction& action) const {
  const Life& old = *latest_;
  if (!std::isfinite(time) || time < old.since)
    throw std::invalid_argument("a play cannot be changed at " + number_text(time) + " s, before its last change");
  const auto started_anew = [&](const playing::Start& start) {
    Play play = start.clip.empty() ? *old.given : play_of(start, old.play.clip);
    play.at = time;
    play.name = old.play.name;
    return std::make_shared<Life>(clips::valid(play, clip), clip, time, &old);
  };
  const auto* start = std::get_if<playing::Start>(&action);
  const std::shared_ptr<Life> next = start ? started_anew(*start) : std::make_shared<Life>(old);
  next->before = latest_;
  next->since = next->met = time;
  next->told.clear();
  const bool leaps =
      !std::holds_alternative<playing::FadeTo>(action) && !std::holds_alternative<playing::Weigh>(action);
  if (leaps) {
    constexpr int most = 10'000;
    int count = 0;
    visit_events(clip, time, time + clips::instant, false, [&](const FiredEvent& event) {
      next->met = std::max(next->met, event.time);
      return ++count < most;
    });
  }
  const double met = next->met;
  next->moved = old.has_moved(met);

  const auto fade_to = [&](double weight, double seconds, const std::optional<Ease>& ease) {
    clips::require_seconds(seconds);
    Sample<double> now = old.weight(time, Side::out);
    if (old.fall) {
      // The fade-out continues by itself, on top of the fade.
      Life bare = old;
      bare.fall.reset();
      now = bare.weight(time, Side::out);
    }
    next->play.weight = clips::faded(now, weight, seconds, ease);
    next->weight_from = time;
    next->fades_in = false;
  };
  const std::size_t index = old.play.clip;
  std::vector<clips::OpenInterval> open = old.open(clip, met);

  std::visit(clips::Overloaded{
                 [&](const playing::Start&) { next->moved = false; },
                 [&](const playing::Stop& stop) {
                   if (time >= old.stopped) return;
                   if (stop.seconds != 0) fade_to(0, stop.seconds, stop.ease);
                   next->stopped = time + stop.seconds;
                 },
                 [&](const playing::FadeTo& fade) {
                   clips::require_weight(fade.weight);
                   fade_to(fade.weight, fade.seconds, fade.ease);
                 },
                 [&](const playing::Weigh& weigh) {
                   next->play.weight = clips::weight_of(weigh.weight);
                   next->weight_from = time;
                   next->fades_in = false;
                 },
                 [&](const playing::SetSpeed& set) {
                   clips::require_seconds(set.seconds);
                   PlaySpeed speed(curve_of(set.speed));
                   if (set.seconds > 0) {
                     if (!speed.is_constant())
                       throw std::invalid_argument(
                           "a speed with several keys takes no time to change: its keys say how it changes");
                     const double now = old.speed.at(std::max(0.0, time - old.speed_from));
                     speed = PlaySpeed(keyed_curve<double>({{.time = 0, .value = now, .ease = Ease::linear()},
                                                            {.time = set.seconds, .value = speed.at(0)}}));
                   }
                   if (met >= old.end) return;  // what is over stays over
                   const double origin = std::max(time, old.at), at_phase = old.held_phase(met);
                   next->speed = next->play.speed = speed;
                   next->speed_from = origin;
                   next->set_origin(origin, at_phase);
                   next->find_end();
                 },
                 [&](const playing::Seek& seek) {
                   clips::require_seconds(seek.fade);
                   next->under = seek.fade > 0 && time > old.at ? latest_.get() : nullptr;
                   next->under_from = time;
                   next->under_for = seek.fade;
                   const clips::Rounds& rounds = old.rounds;
                   const double last = rounds.from + rounds.length;
                   if (!(seek.time >= rounds.from && seek.time <= last))
                     throw std::invalid_argument("\"" + clip.name + "\" has no time " + number_text(seek.time) +
                                                 " s in the section that is played, " + number_text(rounds.from) +
                                                 " s to " + number_text(last) + " s");
                   const double phase = old.held_phase(met);
                   const double wanted = std::clamp(rounds.phase_of(old.round_at(met), seek.time - rounds.from),
                                                    rounds.low, rounds.total);
                   next->set_origin(std::max(time, old.at), wanted);
                   next->find_end();
                   if (wanted == phase) return;
                   if (seek.events && time < old.stopped) {
                     next->told = clips::passed_events(rounds, clip, index, phase, wanted, next->past(), met, open);
                     next->moved = true;
                   }
                   next->sought = true;
                 }},
             action);

  // The intervals that are left and entered.
  const auto tell = [&](const clips::OpenInterval& interval, FiredEvent::Kind kind) {
    const ClipEvent& event = clip.events[interval.event];
    next->told.push_back({met, event.name, event.data, index, kind});
  };
  const std::vector<clips::OpenInterval> after = next->open(clip, time);
  const auto is_in = [](const std::vector<clips::OpenInterval>& list, const clips::OpenInterval& interval) {
    return std::ranges::find(list, interval) != list.end();
  };
  for (const clips::OpenInterval& interval : open)
    if (start || !is_in(after, interval)) tell(interval, FiredEvent::Kind::end);
  for (const clips::OpenInterval& interval : after)
    if (start || !is_in(open, interval)) tell(interval, FiredEvent::Kind::begin);
  return Player(next);
}

double RunningPlay::first_weight_jump(double from, double to) const noexcept {
  if (alone) return clips::infinity;
  const double jump = player->first_weight_jump(own_time(from), own_time(to));
  return std::isfinite(jump) ? stage_time(jump) : jump;
}

double RunningPlay::first_begin_or_end(double from, double to) const noexcept {
  const double time = player->first_begin_or_end(own_time(from), own_time(to));
  return std::isfinite(time) ? stage_time(time) : time;
}

template <class Clips>
std::optional<PlayMeeting> RunningPlay::first_met(const Clips& clips, double from, double to) const {
  if (lead == 0 && clock_override == ClockOverride{}) return player->first_meeting(clips, from, to);
  // As for events: a little around the stretch is searched too.
  const double a = own_time(from), b = own_time(to), around = 1e-12 * (1 + std::abs(a) + std::abs(b));
  double told = a - around;
  while (std::optional<PlayMeeting> met = player->first_meeting(clips, told, b + around)) {
    told = met->moment.time;
    met->moment.time = stage_time(told);
    if (met->moment.time > to) break;
    if (met->moment.time > from) return met;
  }
  return {};
}

std::optional<PlayMeeting> RunningPlay::first_meeting(const Clip& moments, double from, double to) const {
  return first_met(moments, from, to);
}
std::optional<PlayMeeting> RunningPlay::first_meeting(std::span<const Clip> clips, double from, double to) const {
  return first_met(clips, from, to);
}

std::optional<FiredEvent> RunningPlay::first_event(const Clip& events, double from, double to, bool from_start,
                                                   std::optional<std::string_view> name) const {
  if (lead == 0 && clock_override == ClockOverride{}) return player->first_event(events, from, to, from_start, name);
  // An event has one stage time, whatever is requested, so a little around the stretch is searched too.
  const double a = own_time(from), b = own_time(to), around = 1e-12 * (1 + std::abs(a) + std::abs(b));
  std::optional<FiredEvent> first;
  player->visit_events(events, a - around, b + around, from_start, [&](FiredEvent&& event) {
    event.time = stage_time(event.time);
    if (event.time > to) return false;
    const bool inside = event.time > from || (from_start && event.time == from);
    if (!inside || event.kind == FiredEvent::Kind::end || (name && event.name != *name)) return true;
    first = std::move(event);
    return false;
  });
  return first;
}

ClipClock clock_at(const Play& play, const Clip& clip, double stage_time, Side side) noexcept {
  return clips::Course(clips::rounds_of(play, clip), play.speed, play.at, play.offset).clock(stage_time, side);
}

ClipClock clock_at(double at, double speed, const Clip& clip, double stage_time, Side side) noexcept {
  return clips::steady_clock(clips::rounds_of(clip.duration, clip.loop, speed < 0, clips::lands_on_last_key(clip)), at,
                             speed, stage_time, side);
}

double end_time(double at, double speed, const Clip& clip) noexcept {
  return clips::Course(clips::rounds_of(clip.duration, clip.loop, speed < 0, false), speed, at, 0).end;
}

double end_time(const Play& play, const Clip& clip) noexcept {
  return clips::Course(clips::rounds_of(play, clip), play.speed, play.at, play.offset).end;
}

}  // namespace tweenfall
