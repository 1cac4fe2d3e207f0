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

Log fresh_log(const GraphDescription& description, std::size_t machines, std::size_t phases) {
  Log log;
  log.marks.resize(phases);
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
  if (log.known < time) return;
  const auto follows = [&](const auto& each) { return each.time >= time; };
  for (std::vector<Passage>& passages : log.passages) std::erase_if(passages, follows);
  std::erase_if(log.stops, follows);
  log.known = time > 0 ? std::nextafter(time, -1.0) : -1;
}

double value_of(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
                Side side) noexcept {
  if (const auto& curve = description.parameters[parameter].curve) return curve->sample(time, side).value;
  return setting_at(log.settings[parameter], time, side).value;
}

Sample<double> sample_of(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
                         Side side) noexcept {
  const GraphParameter& described = description.parameters[parameter];
  if (described.curve) return described.curve->sample(time, side);
  return sample_of(setting_at(log.settings[parameter], time, side), described.half_life, time);
}

}  // namespace tweenfall::graphs
