#include "graph/log.h"

#include <tweenfall/curves/settle.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::graphs {

namespace {

const Setting& setting_at(const std::vector<Setting>& settings, double time, Side side) noexcept {
  const auto later = [&](double t, const Setting& each) { return side == Side::out ? t < each.time : t <= each.time; };
  const auto next = std::upper_bound(settings.begin(), settings.end(), time, later);
  return next == settings.begin() ? settings.front() : *std::prev(next);
}

Sample<double> sample_of(const Setting& setting, double half_life, double time) noexcept {
  if (setting.offset == 0 && setting.rate == 0) return {setting.value, 0, 0};
  Sample<double> sample = SpringDecay{setting.offset, setting.rate, half_life}.sample(time - setting.time);
  sample.value += setting.value;
  return sample;
}

// What is seen goes on from where it is, in value and rate, whatever it follows from there.
void follow(std::vector<Setting>& settings, double half_life, std::size_t from) {
  if (half_life == 0) return;
  for (std::size_t i = std::max<std::size_t>(from, 1); i < settings.size(); ++i) {
    const Sample<double> before = sample_of(settings[i - 1], half_life, settings[i].time);
    settings[i].offset = before.value - settings[i].value;
    settings[i].rate = before.rate;
  }
}

}  // namespace

Log fresh_log(const GraphDescription& description, std::size_t machines, std::size_t phases, std::size_t swings) {
  Log log;
  log.marks.resize(phases);
  log.swings.resize(swings);
  log.passages.resize(machines);
  for (const GraphParameter& parameter : description.parameters)
    log.settings.push_back({{.time = 0, .value = parameter.start, .given = true}});
  for (const GraphInput& input : description.inputs) {
    if (!input.value) {
      send(log, input.time, input.name, true);
      continue;
    }
    for (std::size_t p = 0; p < description.parameters.size(); ++p)
      if (description.parameters[p].name == input.name) set(log, description, p, input.time, *input.value, true);
  }
  return log;
}

void set(Log& log, const GraphDescription& description, std::size_t parameter, double time, double value, bool given) {
  std::vector<Setting>& settings = log.settings[parameter];
  const auto place = std::ranges::upper_bound(settings, time, {}, &Setting::time);
  const auto index = static_cast<std::size_t>(place - settings.begin());
  settings.insert(place, {.time = time, .value = value, .given = given});
  follow(settings, description.parameters[parameter].half_life, index);
}

void send(Log& log, double time, std::string_view event, bool given) {
  const auto place = std::ranges::upper_bound(log.sent, time, {}, &Sending::time);
  log.sent.insert(place, {time, std::string(event), given});
}

void forget_after(Log& log, const GraphDescription& description, double time) {
  const auto is_late = [&](const auto& each) { return each.time > time && !each.given; };
  for (std::size_t p = 0; p < log.settings.size(); ++p)
    if (std::erase_if(log.settings[p], is_late) > 0) follow(log.settings[p], description.parameters[p].half_life, 1);
  std::erase_if(log.sent, is_late);
  for (auto& marks : log.marks) marks.fill({});
  for (SwingMemory& memory : log.swings)
    for (SwingCourse& course : memory.courses) {
      for (SwingMark& mark : course.latest)
        if (mark.instant >= time) mark.time = mark.instant = -1;
      while (course.marked > 0 && course.markers[course.marked - 1].instant >= time) --course.marked;
      if (course.start >= time) course.start = -1;
    }
  if (log.known < time) return;
  const auto follows = [&](const auto& each) { return each.time >= time; };
  for (std::vector<Passage>& passages : log.passages) std::erase_if(passages, follows);
  std::erase_if(log.stops, follows);
  log.known = time > 0 ? std::nextafter(time, -1.0) : -1;
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
  for (const std::vector<Setting>& settings : log.settings)
    last = last_in(settings, sight.time, sight.side == Side::out, last);
  for (const std::vector<Passage>& passages : log.passages)
    last = last_in(passages, sight.time, sight.side == Side::out, last);
  return last;
}

double next_instant(const Log& log, double after) noexcept {
  double next = std::numeric_limits<double>::infinity();
  for (const std::vector<Setting>& settings : log.settings) next = std::min(next, next_in(settings, after));
  for (const std::vector<Passage>& passages : log.passages) next = std::min(next, next_in(passages, after));
  return next;
}

}  // namespace tweenfall::graphs
