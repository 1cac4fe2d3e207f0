#include "clip/life.h"

#include "clip/landing.h"

#include <tweenfall/curves/keys.h>

#include <cstdint>
#include <utility>

namespace tweenfall {

namespace clips {
namespace {

/// For loops with more rounds than this, an even number of rounds is left out of the phase, so that no digits are lost.
constexpr double most_counted = 0x1p30;

std::optional<Curve<double>> ramp(const Fade& fade, double from, double to) {
  if (!(fade.seconds > 0)) return {};
  return keyed_curve<double>({{.time = 0, .value = from, .ease = fade.ease}, {.time = fade.seconds, .value = to}});
}

/// The product of two numbers that change.
Sample<double> times(const Sample<double>& a, const Sample<double>& b) noexcept {
  return {a.value * b.value, a.rate * b.value + a.value * b.rate,
          a.acceleration * b.value + 2 * a.rate * b.rate + a.value * b.acceleration};
}

void count_rounds(Rounds& rounds, double count, bool backwards) noexcept {
  if (rounds.mode == LoopMode::once) {
    rounds.total = rounds.length;
  } else {
    if (backwards && count > most_counted) rounds.left_out = 2 * std::floor(count / 2);
    rounds.counted = count - rounds.left_out;
    rounds.total = count > 0 ? rounds.length * rounds.counted : infinity;
  }
  rounds.low = !std::isfinite(rounds.total) ? -infinity : rounds.left_out > 0 ? -rounds.left_out * rounds.length : 0;
}

}  // namespace

Rounds rounds_of(const Play& play, const Clip& clip) noexcept {
  const Loop loop = play.loop.value_or(clip.loop);
  Rounds rounds{.from = play.from,
                .length = play.to.value_or(clip.duration) - play.from,
                .mode = loop.mode,
                .reverse = play.reverse,
                .lands = play.to.value_or(clip.duration) == clip.duration && lands_on_last_key(clip)};
  count_rounds(rounds, loop.count, play.speed.first_direction() < 0);
  return rounds;
}

Rounds rounds_of(double duration, const Loop& loop, bool backwards, bool lands) noexcept {
  Rounds rounds{.length = duration, .mode = loop.mode, .lands = lands};
  count_rounds(rounds, loop.count, backwards);
  return rounds;
}

Course::Course(const Rounds& all, const PlaySpeed& pace, double start, double offset) noexcept
    : rounds(all), speed(pace), at(start), speed_from(start) {
  const double round = std::isfinite(rounds.length) ? rounds.length : 0;
  const double last = std::isfinite(rounds.total) ? rounds.total : round;
  set_origin(at, speed.first_direction() < 0 ? last - offset : offset);
  find_end();
}

void Course::set_origin(double time, double at_phase) noexcept {
  origin = time;
  origin_phase = at_phase;
  way_at_origin = speed.is_constant() ? 0 : speed.way(time - speed_from);
}

void Course::find_end() noexcept {
  end = first_move = infinity;
  const double begins = begin();
  const std::span<const double> turns = speed.turns();
  auto next = static_cast<std::size_t>(std::ranges::upper_bound(turns, begins - speed_from) - turns.begin());
  for (double start = begins;; ++next) {
    const bool last = next == turns.size();
    const int direction = speed.direction_after(next);
    const double finish = last ? infinity : speed_from + turns[next];
    if (direction != 0) {
      first_move = std::min(first_move, start);
      const double bound = direction > 0 ? rounds.total : rounds.low;
      const double reached = last ? direction * infinity : phase(finish);
      if (std::isfinite(bound) && direction * (reached - bound) >= 0) {
        Stretch stretch{.from = start, .to = finish, .turn = finish, .direction = direction};
        stretch.phase_from = phase(start);
        // From then on it stands at the bound, whatever its phase rounds to.
        end = direction * (stretch.phase_from - bound) >= 0 ? start : time_of(bound, stretch, 0);
        end_phase = bound;
        return;
      }
    }
    if (last) return;
    start = finish;
  }
}

double Course::time_of(double wanted, const Stretch& stretch, int most) const noexcept {
  const auto is_there = [&](double time) { return stretch.direction * (phase(time) - wanted) >= 0; };
  // Never before the clock is there as it rounds, so that a change at that instant finds it there.
  const auto steadily = [&](double from, double phase_from, double pace) {
    double time = from + (wanted - phase_from) / pace;
    for (int i = 0; i < most && !is_there(time); ++i) time = std::nextafter(time, infinity);
    return std::clamp(time, stretch.from, stretch.to);
  };
  if (speed.is_constant()) return steadily(origin, origin_phase, speed.at(0));
  const std::span<const double> turns = speed.turns();
  const double last_turn = speed_from + turns.back();
  if (stretch.from >= last_turn) return steadily(last_turn, phase(last_turn), speed.at(turns.back()));
  // The first time at which the phase is reached. The bounds are always the turns of the speed, whatever is requested,
  // so that an event has only one time.
  double early = stretch.from, late = stretch.turn;
  if (is_there(early)) late = early;
  while (early < late) {
    const double middle = early + (late - early) / 2;
    if (middle <= early || middle >= late) break;
    (is_there(middle) ? late : early) = middle;
  }
  return std::clamp(late, stretch.from, stretch.to);
}

namespace {

/// How the phase of a play runs at a time.
struct Running {
  double phase = 0;
  int direction = 0;  ///< 0 at rest
  bool backwards = false;
  bool started = false, ended = false;

  /// For a constant speed, the phase tells whether the play has ended.
  void find_ended(const Rounds& rounds, Side side) noexcept {
    const bool below = (side == Side::in) != backwards;
    const bool past_end = below ? phase > rounds.total : phase >= rounds.total;
    const bool past_start = below ? phase <= rounds.low : phase < rounds.low;
    ended = started && (direction > 0 ? past_end : direction < 0 && std::isfinite(rounds.total) && past_start);
  }
};

/// As std::floor, without a call where the processor's own instruction for it cannot be assumed.
double whole_part(double value) noexcept {
  if (!(std::abs(value) < 0x1p51)) return std::floor(value);
  const double cut = static_cast<double>(static_cast<std::int64_t>(value));
  return cut > value ? cut - 1 : cut;
}

/// @param pace_at gives the speed while it runs
template <class PaceAt>
ClipClock clock_of(const Rounds& rounds, const Running& at, Side side, const PaceAt& pace_at) noexcept {
  ClipClock clock;
  clock.started = at.started;
  clock.ended = at.ended;
  clock.climbs = rounds.mode == LoopMode::repeat_offset;
  clock.from = rounds.from;
  clock.to = rounds.from + rounds.length;
  const bool finite = std::isfinite(rounds.total);
  const bool running = at.started && at.direction != 0 && !at.ended;
  // The side from which the clock arrives in phase; a clock at rest belongs to the round that it shows.
  const bool from_below = (side == Side::in) != at.backwards;
  const double at_phase = std::clamp(at.phase, rounds.low, rounds.total);

  double inside = at_phase;
  bool flip = rounds.reverse;
  if (rounds.loops()) {
    double round = whole_part(at_phase / rounds.length);
    const bool at_seam = at_phase == round * rounds.length;
    const bool at_very_end = finite && at_phase >= rounds.total;
    const bool arriving = from_below && running && (round > -rounds.left_out || !finite);
    // Before it starts, a play shows what it starts with.
    const bool starts_from_above = !at.started && at.backwards && (round > -rounds.left_out || !finite);
    if (at_seam && (arriving || starts_from_above || (at_very_end && round > -rounds.left_out))) round -= 1;
    inside = at_phase - round * rounds.length;
    if (at_very_end && rounds.counted > 0) {
      round = std::ceil(rounds.counted) - 1;
      inside = (rounds.counted - round) * rounds.length;
    }
    inside = std::clamp(inside, 0.0, rounds.length);
    flip = rounds.is_flipped(round);
    const double whole = std::clamp(round + rounds.left_out, -2e9, 2e9);
    clock.cycle = static_cast<int>(clock.climbs && rounds.reverse ? -whole : whole);
  }
  if (rounds.length == 0) inside = 0;
  clock.time = rounds.from + (flip ? rounds.length - inside : inside);
  if (running) {
    const double pace = pace_at();
    clock.rate = flip ? -pace : pace;
    clock.side = from_below != flip ? Side::in : Side::out;
  } else {
    const bool landed = rounds.lands && clock.time == clock.to;
    clock.side = at.ended && at.backwards == flip && !landed ? Side::in : Side::out;
  }
  return clock;
}

}  // namespace

ClipClock steady_clock(const Rounds& rounds, double at, double speed, double time, Side side) noexcept {
  const double last = std::isfinite(rounds.total) ? rounds.total : std::isfinite(rounds.length) ? rounds.length : 0;
  Running running;
  running.started = side == Side::out ? time >= at : time > at;
  running.direction = speed > 0 ? 1 : speed < 0 ? -1 : 0;
  running.backwards = speed < 0;
  running.phase = (speed < 0 ? last : 0) + ((running.started ? time : at) - at) * speed;
  running.find_ended(rounds, side);
  return clock_of(rounds, running, side, [&] { return speed; });
}

double next_moment(const Rounds& rounds, std::span<const ClipEvent> moments, double at, double speed,
                   double after) noexcept {
  if (moments.empty() || speed == 0) return infinity;
  const double last = std::isfinite(rounds.total) ? rounds.total : std::isfinite(rounds.length) ? rounds.length : 0;
  const double origin = speed < 0 ? last : 0;
  const double began = origin + (std::max(after, at) - at) * speed;
  const double here = rounds.loops() ? std::floor(began / rounds.length) : 0;
  // Whether the clock is there, as it rounds.
  const auto is_there = [&](double time, double round, double way) {
    const ClipClock clock = steady_clock(rounds, at, speed, time, Side::out);
    const double in = clock.cycle - rounds.left_out;
    if (in != round) return (in > round) == (speed > 0);
    const double inside = rounds.is_flipped(round) ? rounds.length - clock.time : clock.time;
    return speed > 0 ? inside >= way : inside <= way;
  };
  double first = infinity;
  for (const double beside : {-1.0, 0.0, 1.0}) {
    if (!rounds.loops() && beside != 0) continue;
    const double round = here + beside;
    for (const ClipEvent& moment : moments) {
      const double phase = rounds.phase_of(round, moment.from);
      if (!(phase >= rounds.low && phase <= rounds.total)) continue;
      const double way = rounds.is_flipped(round) ? rounds.length - moment.from : moment.from;
      double time = at + (phase - origin) / speed;
      if (time > first || time < after - 1e-12 * (1 + std::abs(after))) continue;
      constexpr int most = 16;
      const auto before = [](double t) { return std::nextafter(t, -infinity); };
      for (int i = 0; i < most && is_there(before(time), round, way); ++i) time = before(time);
      for (int i = 0; i < most && !is_there(time, round, way); ++i) time = std::nextafter(time, infinity);
      if (time > after && time > at) first = std::min(first, time);
    }
  }
  return first;
}

ClipClock Course::clock(double time, Side side) const noexcept {
  const bool steady = speed.is_constant();
  Running running;
  running.started = side == Side::out ? time >= at : time > at;
  running.direction = steady || !running.started ? speed.first_direction() : speed.direction(time - speed_from, side);
  running.backwards = running.direction < 0;
  running.phase = running.started ? phase(time) : phase(at);
  if (steady) {
    running.find_ended(rounds, side);
  } else if (running.started && (side == Side::out ? time >= end : time > end)) {
    running.ended = true;
    running.phase = end_phase;
    running.backwards = end_phase == rounds.low && !(end_phase == rounds.total && running.direction > 0);
  }
  return clock_of(rounds, running, side, [&] { return speed.at(time - speed_from, side); });
}

}  // namespace clips

Player::Life::Life(const Play& played, const Clip& clip, double start, const Life* previous)
    : Course(clips::rounds_of(played, clip), played.speed, start, played.offset),
      play(played),
      given(std::make_shared<const Play>(played)),
      weight_from(start) {
  rise = clips::ramp(play.fade_in, 0, 1);
  fall = clips::ramp(play.fade_out, 1, 0);
  const PlaySection own{rounds.from, rounds.from + rounds.length, rounds.mode};
  std::vector<PlaySection> all = previous ? *previous->sections : std::vector<PlaySection>();
  const auto known = std::ranges::find(all, own);
  section = static_cast<std::size_t>(known - all.begin());
  if (known == all.end()) all.push_back(own);
  sections = previous && all.size() == previous->sections->size()
                 ? previous->sections
                 : std::make_shared<const std::vector<PlaySection>>(std::move(all));
}

Player::Life::~Life() {
  // Freed one after another, so that no number of changes can exhaust the stack.
  std::shared_ptr<Life> next = std::move(before);
  while (next && next.use_count() == 1) next = std::exchange(next->before, nullptr);
}

Sample<double> Player::Life::weight(double time, Side side) const noexcept {
  if (is_stopped(time, side)) return {0, 0, 0};
  Sample<double> weight = play.weight.sample(time - weight_from, side);
  if (fades_in && rise && time - at <= play.fade_in.seconds)
    weight = clips::times(weight, rise->sample(time - at, side));
  if (fall && std::isfinite(end) && time >= end - play.fade_out.seconds)
    weight = clips::times(weight, fall->sample(time - (end - play.fade_out.seconds), side));
  return weight;
}

Sample<double> Player::Life::over_under(double time) const noexcept {
  const double u = (time - under_from) / under_for;
  if (!under || !(u < 1)) return {1, 0, 0};
  if (!(u > 0)) return {0, 0, 6 / (under_for * under_for)};
  return {u * u * (3 - 2 * u), 6 * u * (1 - u) / under_for, (6 - 12 * u) / (under_for * under_for)};
}

PlayVoices Player::voices(double time, Side side) const noexcept {
  const Life* life = &at_time(time, side);
  PlayVoices voices;
  if (!life->shows(time, side)) return voices;
  voices.list[0] = {life->clock(time, side), life->weight(time, side)};
  voices.count = 1;
  // Of a weight w, the new voice has n = w f, and the one below the rest, 1 - (1 - w) / (1 - n), so that what lies
  // under the play shows through as before.
  for (; life->under && voices.count < PlayVoices::most; life = life->under) {
    const Sample<double> part = life->over_under(time);
    if (part.value == 1 && part.rate == 0) break;
    PlayVoice& upper = voices.list[voices.count - 1];
    const Sample<double> whole = upper.weight;
    upper.weight = clips::times(whole, part);
    // What is below the play shows where it showed nothing before; else what ends meanwhile stays until it has faded.
    if (!life->under->shows(life->under_from, Side::out)) break;
    const double left = 1 - whole.value, open = 1 - upper.weight.value;
    if (!(open > 0)) break;
    const double ratio = left / open, rate = (ratio * upper.weight.rate - whole.rate) / open;
    const double acceleration =
        (2 * rate * upper.weight.rate + ratio * upper.weight.acceleration - whole.acceleration) / open;
    voices.list[voices.count++] = {life->under->clock(time, side), {1 - ratio, -rate, -acceleration}};
  }
  std::ranges::reverse(voices.list.begin(), voices.list.begin() + static_cast<std::ptrdiff_t>(voices.count));
  return voices;
}

}  // namespace tweenfall
