#include "operations/phase.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tweenfall::graphs {

namespace {

constexpr double stops_a_second = 480;

std::variant<BlendLine, BlendPlane, BlendBands> space_of(const SpacePose& described) {
  if (described.by.size() == 2) {
    std::vector<Vec2> places;
    for (const SpacePose::Entry& entry : described.entries) places.push_back(entry.place);
    if (described.bands) return BlendBands(std::move(places));
    return BlendPlane(std::move(places));
  }
  std::vector<double> places;
  for (const SpacePose::Entry& entry : described.entries) places.push_back(entry.place.x());
  return BlendLine(std::move(places));
}

}  // namespace

SpaceWeights::SpaceWeights(const SpacePose& described, std::vector<Number> by)
    : by_(std::move(by)), size_(described.entries.size()), space_(space_of(described)) {}

void SpaceWeights::sample(const Log& log, double time, Side side, std::span<Sample<double>> weights) const noexcept {
  const Sample<double> x = by_[0].sample(log, time, side);
  if (const auto* line = std::get_if<BlendLine>(&space_)) {
    line->weights(x, weights, side);
    return;
  }
  const Sample<double> y = by_[1].sample(log, time, side);
  const Sample<Vec2> at{{x.value, y.value}, {x.rate, y.rate}, {x.acceleration, y.acceleration}};
  if (const auto* bands = std::get_if<BlendBands>(&space_))
    bands->weights(at, weights, side);
  else
    std::get<BlendPlane>(space_).weights(at, weights, side);
}

double SpaceWeights::next_setting(const Log& log, double after) const noexcept {
  double next = std::numeric_limits<double>::infinity();
  for (const Number& number : by_) next = std::min(next, number.next_setting(log, after));
  return next;
}

double SpaceWeights::first_unseen(const Log& log) const noexcept {
  double first = std::numeric_limits<double>::infinity();
  for (const Number& number : by_) first = std::min(first, number.first_unseen(log));
  return first;
}

bool SpaceWeights::flows() const noexcept {
  return std::ranges::any_of(by_, [](const Number& number) { return number.flows(); });
}

Phase::Phase(MarkerSync sync, SpaceWeights weights, std::size_t number)
    : sync_(std::move(sync)), weights_(std::move(weights)), number_(number) {}

double Phase::next_stop(const Log& log, double start, double after) const noexcept {
  double next = weights_.next_setting(log, after);
  if (!weights_.flows()) return next;
  const double passed = std::floor((after - start) * stops_a_second);
  for (double count = std::max(passed, 0.0); count <= passed + 2; ++count)
    if (const double stop = start + count / stops_a_second; stop > after) return std::min(next, stop);
  return next;
}

double Phase::advanced(const Log& log, double phase, double from, double to) const noexcept {
  std::array<Sample<double>, most_blended> samples;
  std::array<double, most_blended> first, last;
  const std::span<Sample<double>> own(samples.data(), weights_.size());
  const auto take = [&](double time, Side side, std::array<double, most_blended>& values) {
    weights_.sample(log, time, side, own);
    for (std::size_t i = 0; i < own.size(); ++i) values[i] = own[i].value;
    return std::span<const double>(values.data(), own.size());
  };
  const std::span<const double> leaving = take(from, Side::out, first);
  if (!weights_.flows()) return sync_.advanced(phase, to - from, leaving);
  return sync_.advanced(phase, to - from, leaving, take(to, Side::in, last));
}

double Phase::at(const Log& log, double start, double time) const noexcept {
  auto& trail = log.phases[number_].since(start);
  // Beyond what is seen, what is marked counts only where nothing was set in between.
  const double sure = std::nextafter(weights_.first_unseen(log), -1.0);
  const auto* const mark = trail.last_mark(std::min(time, sure));
  double here = mark ? mark->time : start, phase = mark ? mark->place : sync_.phase_at(0, 0);
  const double began = here;
  for (double stop = next_stop(log, start, here); stop < time; stop = next_stop(log, start, here)) {
    phase = advanced(log, phase, here, stop);
    here = stop;
    if (here <= sure) trail.pass(here, phase);
  }
  if (here > began && here <= sure) trail.stay(here, phase);
  return time > here ? advanced(log, phase, here, time) : phase;
}

double Phase::way(std::size_t clip, double duration, double phase) const noexcept {
  const SyncedTime at = sync_.time(clip, {phase, 0, 0});
  return at.time.value + at.cycle * duration;
}

void Phase::each_event(const Log& log, std::size_t clip, const Clip& described, double start, double from, double to,
                       const Visit& visit) const {
  if (described.events.empty() || !(to >= start)) return;
  struct Meeting {
    double way;
    const ClipEvent* event;
    GraphEvent::Kind kind;
  };
  std::vector<Meeting> round;
  for (const ClipEvent& event : described.events) {
    round.push_back({event.from, &event, event.is_interval() ? GraphEvent::Kind::begin : GraphEvent::Kind::moment});
    if (event.is_interval()) round.push_back({event.to, &event, GraphEvent::Kind::end});
  }
  std::ranges::stable_sort(round, {}, &Meeting::way);
  const double duration = described.duration;
  double begin = std::max(from, start), phase = at(log, start, begin);
  bool closed = from < start;
  while (begin < to || closed) {
    const double end = std::max(begin, std::min(next_stop(log, start, begin), to));
    const double last = end > begin ? advanced(log, phase, begin, end) : phase;
    const double low = way(clip, duration, phase), high = way(clip, duration, last);
    for (double turn = std::floor(low / duration) - 1; turn * duration <= high; ++turn)
      for (const Meeting& meeting : round) {
        const double met = meeting.way + turn * duration;
        if (met > high || met < low || (met == low && !closed)) continue;
        double before = begin, time = end;  // the way is short of it at the one, and not at the other
        if (met == low) time = begin;
        for (;;) {
          const double middle = before + (time - before) / 2;
          if (!(middle > before && middle < time)) break;
          (way(clip, duration, advanced(log, phase, begin, middle)) < met ? before : time) = middle;
        }
        if (!visit(time, *meeting.event, meeting.kind)) return;
      }
    if (!(end < to)) return;
    begin = end;
    phase = last;
    closed = false;
  }
}

}  // namespace tweenfall::graphs
