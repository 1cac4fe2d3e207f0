#include "graph/log.h"

#include <tweenfall/curves/settle.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::graphs {

namespace {

const Setting& setting_at(const Record<Setting>& settings, double time, Side side) noexcept {
  const auto later = [&](double t, const Setting& each) { return side == Side::out ? t < each.time : t <= each.time; };
  const auto next = std::upper_bound(settings.begin(), settings.end(), time, later);
  return next == settings.begin() ? settings.front() : *std::prev(next);
}

/// Whether the value that poses see has come to the one that was set. After so many half-lives less than 2^-58 of the
/// way is left, which is less than the rounding of the values on it.
bool has_arrived(const Setting& setting, double half_life, double time) noexcept {
  constexpr double half_lives = 32;
  return (setting.offset == 0 && setting.rate == 0) || time - setting.time >= half_lives * half_life;
}

Sample<double> sample_of(const Setting& setting, double half_life, double time) noexcept {
  if (has_arrived(setting, half_life, time)) return {setting.value, 0, 0};
  Sample<double> sample = SpringDecay{setting.offset, setting.rate, half_life}.sample(time - setting.time);
  sample.value += setting.value;
  return sample;
}

// The value that poses see continues with its value and rate, whatever it follows from now on.
void add(Record<Setting>& settings, double half_life, Setting setting) {
  setting.offset = setting.rate = 0;
  if (half_life >= shortest_change && !settings.empty()) {
    const Sample<double> before = sample_of(settings.back(), half_life, setting.time);
    setting.offset = before.value - setting.value;
    setting.rate = before.rate;
  }
  settings.push_back(setting);
}

void forget_from(JumpMark& mark, double time) noexcept {
  if (mark.instant >= time) mark = {};
  if (mark.searched >= time) mark.searched = std::nextafter(time, -1.0);
  if (mark.jump >= time) mark.jump = std::numeric_limits<double>::infinity();
}

/// Index of the first entry for which `is_late` holds; it must not hold for entries before `time`.
template <class T, class Late>
std::size_t first_late(const Record<T>& list, double time, const Late& is_late) {
  const auto from = std::ranges::lower_bound(list, time, {}, &T::time);
  return static_cast<std::size_t>(std::find_if(from, list.end(), is_late) - list.begin());
}

/// @param is_late must not hold for entries before `time`
template <class Late>
void forget(Log& log, const GraphDescription& description, double time, const Late& is_late) {
  for (std::size_t p = 0; p < log.settings.size(); ++p) {
    Record<Setting>& settings = log.settings[p];
    const std::size_t first = first_late(settings, time, is_late);
    if (first == settings.size()) continue;
    for (const Setting& each : settings.take_from(first))
      if (!is_late(each)) add(settings, description.parameters[p].half_life, each);
  }
  if (const std::size_t first = first_late(log.sent, time, is_late); first < log.sent.size())
    for (Sending& each : log.sent.take_from(first))
      if (!is_late(each)) log.sent.push_back(std::move(each));
  forget_marks(log, time);
  if (log.known < time) return;
  for (Record<Passage>& passages : log.passages)
    passages.truncate(
        static_cast<std::size_t>(std::ranges::lower_bound(passages, time, {}, &Passage::time) - passages.begin()));
  std::erase_if(log.stops, [&](const GraphStop& stop) { return stop.time >= time; });
  log.instants.truncate(static_cast<std::size_t>(std::ranges::lower_bound(log.instants, time) - log.instants.begin()));
  log.known = time > 0 ? std::nextafter(time, -1.0) : -1;
}

}  // namespace

// How far phases, springs and root motion have come until `time` does not depend on what is later.
void forget_marks(const Log& log, double time) noexcept {
  for (PhaseTrails& trails : log.phases) trails.forget_after(time);
  for (TravelTrails& trails : log.travels) trails.forget_after(time);
  for (KnownPhases& known : log.known_phases) known.forget_from(time);
  for (RecentPoses& recent : log.recent) recent.forget_from(time);
  for (SwingMemory& memory : log.swings)
    for (SwingCourse& course : memory.courses) {
      for (SwingMark& mark : course.latest)
        if (mark.instant >= time) mark.time = mark.instant = -1;
      while (course.marked > 0 && course.markers[course.marked - 1].instant >= time) --course.marked;
      for (JumpMark& mark : course.jumps) forget_from(mark, time);
      if (course.start >= time) course.start = -1;
    }
}

Log fresh_log(const GraphDescription& description, const LogSizes& sizes) {
  Log log;
  log.phases.resize(sizes.phases);
  log.known_phases.resize(sizes.phases);
  log.swings.resize(sizes.swings);
  log.travels.resize(sizes.travels);
  log.recent.resize(sizes.recent);
  for (RecentPoses& each : log.recent) each.make_room(sizes.nodes);
  log.passages.resize(sizes.machines);
  for (const GraphParameter& parameter : description.parameters)
    log.settings.emplace_back().push_back({.time = 0, .value = parameter.start, .origin = Origin::description});
  for (const GraphInput& input : description.inputs) {
    if (!input.value) {
      send(log, input.time, input.name, Origin::description);
      continue;
    }
    for (std::size_t p = 0; p < description.parameters.size(); ++p)
      if (description.parameters[p].name == input.name)
        set(log, description, p, input.time, *input.value, Origin::description);
  }
  return log;
}

void let_go(Record<Passage>& passages, bool all) {
  constexpr std::size_t kept_pages = 4;
  for (std::size_t count = passages.full_pages(); count > kept_pages; --count) {
    const std::size_t i = count - kept_pages - 1;
    if (std::ranges::any_of(passages.page(i), [](const Passage& passage) { return passage.offsets != nullptr; })) {
      std::vector<Passage> page = passages.page(i);
      for (Passage& passage : page) passage.offsets = nullptr;
      passages.replace_page(i, std::move(page));
    }
    if (!all) return;
  }
}

void set(Log& log, const GraphDescription& description, std::size_t parameter, double time, double value,
         Origin origin) {
  forget_marks(log, time);
  Record<Setting>& settings = log.settings[parameter];
  const auto place = std::ranges::upper_bound(settings, time, {}, &Setting::time);
  const double half_life = description.parameters[parameter].half_life;
  const std::vector<Setting> later = settings.take_from(static_cast<std::size_t>(place - settings.begin()));
  add(settings, half_life, {.time = time, .value = value, .origin = origin});
  for (const Setting& each : later) add(settings, half_life, each);
}

void send(Log& log, double time, std::string_view event, Origin origin) {
  const auto place = std::ranges::upper_bound(log.sent, time, {}, &Sending::time);
  std::vector<Sending> later = log.sent.take_from(static_cast<std::size_t>(place - log.sent.begin()));
  log.sent.push_back({time, std::string(event), origin});
  for (Sending& each : later) log.sent.push_back(std::move(each));
}

void forget_course(Log& log, const GraphDescription& description, double time) {
  forget(log, description, time, [&](const auto& each) { return each.time >= time && each.origin == Origin::event; });
  // Springs whose clock began before may have followed a base that is different from then on.
  for (SwingMemory& memory : log.swings)
    for (SwingCourse& course : memory.courses) {
      for (SwingMark& mark : course.latest)
        if (mark.time >= time) mark.time = mark.instant = -1;
      while (course.marked > 0 && course.markers[course.marked - 1].time >= time) --course.marked;
    }
}

void forget_after(Log& log, const GraphDescription& description, double time) {
  forget(log, description, time, [&](const auto& each) {
    return (each.time >= time && each.origin == Origin::event) || (each.time > time && each.origin == Origin::outside);
  });
}

double value_of(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
                Side side) noexcept {
  if (const auto& curve = description.parameters[parameter].curve) return curve->sample(time, side).value;
  const Sight sight = seen(log, time, side);
  return setting_at(log.settings[parameter], sight.time, sight.side).value;
}

Sample<double> sample_of(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
                         Side side) noexcept {
  const GraphParameter& described = description.parameters[parameter];
  if (described.curve) return described.curve->sample(time, side);
  const Sight sight = seen(log, time, side);
  return sample_of(setting_at(log.settings[parameter], sight.time, sight.side), described.half_life, time);
}

bool changes(const Curve<double>& curve, double time) noexcept {
  const bool waits = time < curve.start() && curve.before() == Outside::hold;
  return !waits && !(time >= curve.end() && curve.after() == Outside::hold);
}

double round_of(const Curve<double>& curve) noexcept {
  const bool comes_around = curve.after() != Outside::hold && curve.after() != Outside::linear;
  return comes_around && curve.end() > curve.start() ? curve.end() - curve.start()
                                                     : std::numeric_limits<double>::infinity();
}

double first_change(const Curve<double>& curve, double after) noexcept {
  const bool waits = after < curve.start() && curve.before() == Outside::hold && curve.end() > curve.start();
  return waits ? curve.start() : std::numeric_limits<double>::infinity();
}

bool flows(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
           Side side) noexcept {
  const GraphParameter& described = description.parameters[parameter];
  if (described.curve) return changes(*described.curve, time);
  const Sight sight = seen(log, time, side);
  return !has_arrived(setting_at(log.settings[parameter], sight.time, sight.side), described.half_life, time);
}

namespace {

template <class List>
double last_in(const List& list, double time, bool with, double least) noexcept {
  const auto is_before = [&](const auto& each) { return each.time < time || (with && each.time == time); };
  const auto end = std::ranges::partition_point(list, is_before);
  return end == list.begin() ? least : std::max(least, std::prev(end)->time);
}

template <class List>
double next_in(const List& list, double after) noexcept {
  const auto is_past = [&](const auto& each) { return each.time <= after; };
  const auto next = std::ranges::partition_point(list, is_past);
  return next == list.end() ? std::numeric_limits<double>::infinity() : next->time;
}

}  // namespace

double last_instant(const Log& log, double start, double time, Side side) noexcept {
  const Sight sight = seen(log, time, side);
  double last = start;
  for (const Record<Setting>& settings : log.settings)
    last = last_in(settings, sight.time, sight.side == Side::out, last);
  for (const Record<Passage>& passages : log.passages)
    last = last_in(passages, sight.time, sight.side == Side::out, last);
  return last;
}

double next_instant(const Log& log, double after) noexcept {
  double next = std::numeric_limits<double>::infinity();
  for (const Record<Setting>& settings : log.settings) next = std::min(next, next_in(settings, after));
  for (const Record<Passage>& passages : log.passages) next = std::min(next, next_in(passages, after));
  return next;
}

double last_sure(const Log& log) noexcept {
  if (!std::isfinite(log.until)) return log.until;
  const double hidden = next_instant(log, log.until);
  return std::isfinite(hidden) ? std::nextafter(hidden, -1.0) : hidden;
}

}  // namespace tweenfall::graphs
