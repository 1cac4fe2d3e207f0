#include "operations/phase.h"

#include "blending/phase_course.h"
#include "blending/rising_root.h"
#include "operations/first_reached.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace tweenfall::graphs {

namespace {

constexpr double stops_per_second = 480;

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

double SpaceWeights::first_change(double after) const noexcept {
  double first = std::numeric_limits<double>::infinity();
  for (const Number& number : by_) first = std::min(first, number.first_change(after));
  return first;
}

double SpaceWeights::last_change(const Log& log, double time) const noexcept {
  double last = -std::numeric_limits<double>::infinity();
  for (const Number& number : by_) last = std::max(last, number.last_change(log, time));
  return last;
}

double SpaceWeights::round() const noexcept {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Number& number : by_) shortest = std::min(shortest, number.round());
  return shortest;
}

double SpaceWeights::next_setting(const Log& log, double after) const noexcept {
  double next = std::numeric_limits<double>::infinity();
  for (const Number& number : by_)
    next = std::min(next, std::min(number.next_setting(log, after), number.first_change(after)));
  return next;
}

double SpaceWeights::first_unseen(const Log& log) const noexcept {
  double first = std::numeric_limits<double>::infinity();
  for (const Number& number : by_) first = std::min(first, number.first_unseen(log));
  return first;
}

bool SpaceWeights::flows(const Log& log, double time, Side side) const noexcept {
  return std::ranges::any_of(by_, [&](const Number& number) { return number.flows(log, time, side); });
}

/// From one stop to the next, with the course of the shares until then as if there were no more settings, so that later
/// settings change nothing before them.
class Phase::Step {
 public:
  Step(const Phase& phase, const Log& log, double start, const Stop& from) noexcept
      : phase_(phase), sync_(phase.sync_), from_(from), size_(phase.weights_.size()) {
    std::array<Sample<double>, most_blended> first, last;
    phase.weights_.sample(log, from.time, Side::out, {first.data(), size_});
    const double end = phase.next_beat(log, start, from.time);
    if (std::isfinite(end)) {
      length_ = end - from.time;
      const Blinkers blinkers(log, from.time);
      phase.weights_.sample(log, end, Side::in, {last.data(), size_});
    } else {
      from_.place.haste = 0;  // weights that stay have no step in which it could decay
    }
    // A cubic lies between its four Bezier values: while none of them is below 0, no share is.
    double bend = 1;
    std::array<std::array<double, 2>, most_blended> bends;
    for (std::size_t i = 0; i < size_; ++i) {
      const double a = std::max(first[i].value, 0.0), b = length_ > 0 ? std::max(last[i].value, 0.0) : a;
      const double third = (b - a) / 3;
      shares_[i] = {a, a + third, b - third, b};
      if (!(length_ > 0)) continue;
      bends[i] = {first[i].rate * length_ / 3 - third, third - last[i].rate * length_ / 3};
      for (const std::size_t k : {0U, 1U}) {
        const double straight = shares_[i][k + 1], by = bends[i][k];
        if (!std::isfinite(by)) bend = 0;
        if (straight + by < 0) bend = std::min(bend, straight / -by);
      }
    }
    for (std::size_t i = 0; i < size_; ++i) {
      if (bend > 0 && length_ > 0)
        for (const std::size_t k : {0U, 1U}) shares_[i][k + 1] = std::max(shares_[i][k + 1] + bend * bends[i][k], 0.0);
      for (const double value : shares_[i]) steady_ = steady_ && value == shares_[i][0];
    }
  }

  [[nodiscard]] double at(double time) const noexcept {
    const double passed = time - from_.time, phase = from_.place.phase;
    if ((steady_ && from_.place.haste == 0) || is_blur()) {
      std::array<double, most_blended> held;
      for (std::size_t i = 0; i < size_; ++i) held[i] = share(i, 0.5).value;
      return sync_.advanced(phase, passed, {held.data(), size_});
    }
    const auto pace = [&](double seconds, double at) noexcept {
      std::array<double, most_blended> shares;
      const double part = seconds / length_, left = 1 - part;
      for (std::size_t i = 0; i < size_; ++i) shares[i] = share(i, part).value;
      return 1 / (sync_.rate(at, {shares.data(), size_}) * (1 + from_.place.haste * left * left));
    };
    const double wrapped = phase - std::floor(phase / sync_.period()) * sync_.period();
    const blending::PhaseCourse course(pace, passed);
    return phase + (course.until({wrapped, 0}, std::numeric_limits<double>::infinity()).phase - wrapped);
  }

  [[nodiscard]] Sample<double> sample(double time) const noexcept {
    std::array<Sample<double>, most_blended> shares;
    const double part = steady_ ? 0 : (time - from_.time) / length_;
    for (std::size_t i = 0; i < size_; ++i) shares[i] = share(i, part);
    if (from_.place.haste == 0) return sync_.running(at(time), {shares.data(), size_});
    const double left = 1 - (time - from_.time) / length_, factor = 1 + from_.place.haste * left * left;
    for (Sample<double>& each : std::span(shares.data(), size_)) each.rate /= factor;
    Sample<double> phase = sync_.running(at(time), {shares.data(), size_});
    phase.acceleration = phase.acceleration * factor * factor - phase.rate * from_.place.haste * 2 * left / length_;
    phase.rate *= factor;
    return phase;
  }

  /// The stop at its end, where the next step begins.
  /// @param phase  the phase there, if it is known
  [[nodiscard]] Stop stop_at(const Log& log, double time, std::optional<double> phase = std::nullopt) const noexcept {
    if (!(time < from_.time + length_)) return {time, {phase ? *phase : at(time), 0}};
    const Sample<double> planned = sample(time);
    std::array<Sample<double>, most_blended> shares;
    phase_.weights_.sample(log, time, Side::in, {shares.data(), size_});
    const double haste = planned.rate / sync_.running(planned.value, {shares.data(), size_}).rate - 1;
    return {time, {planned.value, std::isfinite(haste) ? haste : 0}};
  }

 private:
  /// Whether so many markers pass that no one could tell where the phase is, nor wait until they are counted.
  [[nodiscard]] bool is_blur() const noexcept {
    constexpr double most_markers = 500;
    std::array<Sample<double>, most_blended> shares;
    double fastest = 0;
    for (const double part : {0.0, 1.0}) {
      for (std::size_t i = 0; i < size_; ++i) shares[i] = share(i, part);
      fastest = std::max(fastest, sync_.running(from_.place.phase, {shares.data(), size_}).rate);
    }
    return fastest * length_ > most_markers;
  }

  [[nodiscard]] Sample<double> share(std::size_t i, double u) const noexcept {
    const std::array<double, 4>& c = shares_[i];
    if (steady_) return {c[0], 0, 0};
    const double v = 1 - u;
    return {v * v * v * c[0] + 3 * u * v * (v * c[1] + u * c[2]) + u * u * u * c[3],
            (3 / length_) * (v * v * (c[1] - c[0]) + 2 * u * v * (c[2] - c[1]) + u * u * (c[3] - c[2])), 0};
  }

  const Phase& phase_;
  const MarkerSync& sync_;
  Stop from_;
  std::size_t size_;
  double length_ = 0;  // s; 0: shares are constant
  bool steady_ = true;
  std::array<std::array<double, 4>, most_blended> shares_;  // Bernstein coefficients
};

Phase::Phase(MarkerSync sync, SpaceWeights weights, std::size_t number)
    : sync_(std::move(sync)), weights_(std::move(weights)), number_(number) {}

double Phase::next_beat(const Log& log, double start, double after) const noexcept {
  if (weights_.flows(log, after)) {
    double per_second = stops_per_second;
    const double since = after - std::max(start, weights_.last_change(log, after));
    const double fewest = steps_per_round / weights_.round();
    for (double reach = 4096; since >= reach && per_second >= 2 * fewest; reach *= 2) per_second /= 2;
    const double passed = std::floor((after - start) * per_second);
    for (double count = std::max(passed, 0.0); count <= passed + 2; ++count)
      if (const double stop = start + count / per_second; stop > after) return stop;
  }
  return std::numeric_limits<double>::infinity();
}

double Phase::next_stop(const Log& log, double start, double after) const noexcept {
  return std::min(weights_.next_setting(log, after), next_beat(log, start, after));
}

Phase::Stop Phase::last_stop(const Log& log, double start, double time, Side side) const noexcept {
  auto& trail = log.phases[number_].since(start);
  // Beyond the visible inputs, a mark counts only if there was no setting in between.
  const double sure = std::nextafter(weights_.first_unseen(log), -1.0), limit = std::min(time, sure);
  const auto* const mark = trail.last_mark(limit, limit < time || side == Side::out);
  Stop here = mark ? Stop{mark->time, mark->place} : Stop{start, {sync_.phase_at(0, 0), 0}};
  const double began = here.time;
  for (;;) {
    const double next = next_stop(log, start, here.time);
    if (next > time || (next == time && side == Side::in)) break;
    here = Step(*this, log, start, here).stop_at(log, next);
    if (next <= sure) trail.pass(next, here.place);
  }
  if (here.time > began && here.time <= sure) trail.stay(here.time, here.place);
  return here;
}

Sample<double> Phase::at(const Log& log, const Moment& moment) const noexcept {
  if (moment.time > moment.start) {
    KnownPhases& known = log.known_phases[number_];
    const KnownPhases::Question question{moment.time, moment.start, std::min(log.until, moment.time), moment.side};
    if (const Sample<double>* const phase = known.recall(question)) return *phase;
    const Stop from = last_stop(log, moment.start, moment.time, moment.side);
    return known.remember(question, Step(*this, log, moment.start, from).sample(moment.time));
  }
  std::array<Sample<double>, most_blended> weights;
  const std::span<Sample<double>> own(weights.data(), weights_.size());
  weights_.sample(log, moment.time, moment.side, own);
  return sync_.running(sync_.phase_at(0, 0), own);
}

double Phase::rounds(const Log& log, std::size_t clip, double duration, double start, double from,
                     double to) const noexcept {
  const double first = at(log, {from, Side::out, start}).value, last = at(log, {to, Side::out, start}).value;
  return (way(clip, duration, last) - way(clip, duration, first)) / duration;
}

double Phase::way(std::size_t clip, double duration, double phase) const noexcept {
  const SyncedTime at = sync_.time(clip, {phase, 0, 0});
  return at.time.value + at.cycle * duration;
}

namespace {

/// The moments of a clip's events, in order within its loop. Moments in order, as where a clip jumps, need no memory of
/// their own.
class Meetings {
 public:
  struct Meeting {
    double way;
    const ClipEvent* event;
    GraphEvent::Kind kind;
  };
  Meetings() = default;
  explicit Meetings(const std::vector<ClipEvent>& all) : all_(&all) {
    if (std::ranges::none_of(all, &ClipEvent::is_interval) && std::ranges::is_sorted(all, {}, &ClipEvent::from)) return;
    for (const ClipEvent& event : all) {
      const bool lasts = event.is_interval();
      sorted_.push_back({event.from, &event, lasts ? GraphEvent::Kind::begin : GraphEvent::Kind::moment});
      if (lasts) sorted_.push_back({event.to, &event, GraphEvent::Kind::end});
    }
    std::ranges::stable_sort(sorted_, {}, &Meeting::way);
  }

  [[nodiscard]] std::size_t size() const noexcept { return sorted_.empty() ? all_->size() : sorted_.size(); }
  [[nodiscard]] Meeting operator[](std::size_t i) const noexcept {
    return sorted_.empty() ? Meeting{(*all_)[i].from, &(*all_)[i], GraphEvent::Kind::moment} : sorted_[i];
  }

 private:
  const std::vector<ClipEvent>* all_ = nullptr;
  std::vector<Meeting> sorted_;
};

}  // namespace

void Phase::each_event(const Log& log, std::span<const Clip* const> clips, double start, double from, double to,
                       const Visit& visit) const {
  if (!(to >= start)) return;
  std::array<Meetings, most_blended> meetings;
  bool any = false;
  for (std::size_t clip = 0; clip < clips.size(); ++clip) {
    if (!clips[clip]) continue;
    meetings[clip] = Meetings(clips[clip]->events);
    any = any || !clips[clip]->events.empty();
  }
  if (!any) return;
  double begin = std::max(from, start);
  bool closed = from < start;
  Stop stop = last_stop(log, start, begin, Side::out);
  for (;;) {
    const Step step(*this, log, start, stop);
    const double next = next_stop(log, start, stop.time), end = std::max(begin, std::min(next, to));
    const double first_phase = step.at(begin), last_phase = step.at(end);
    bool goes_on = true;
    for (std::size_t clip = 0; clip < clips.size(); ++clip) {
      if (!clips[clip] || clips[clip]->events.empty()) continue;
      const double duration = clips[clip]->duration;
      const double low = way(clip, duration, first_phase), high = way(clip, duration, last_phase);
      // Iterated by count: for very large turn numbers adding 1 changes nothing.
      const double first = std::floor(low / duration) - 1;
      bool more = true;
      for (double count = 0; more && count <= high / duration - first + 1; ++count)
        for (std::size_t i = 0; more && i < meetings[clip].size(); ++i) {
          const Meetings::Meeting meeting = meetings[clip][i];
          const double turn = first + count;
          const double met = meeting.way + turn * duration;
          if (met > high || met < low || (met == low && !closed)) continue;
          const auto reached = [&](double time) { return !(way(clip, duration, step.at(time)) < met); };
          const auto over = [&](double time) noexcept {
            const SyncedTime at = sync_.time(clip, step.sample(time));
            return blending::Rise{at.time.value + at.cycle * duration - met, at.time.rate};
          };
          const double even = begin + (end - begin) * ((met - low) / (high - low));
          const double time =
              met == low ? begin : first_reached(begin, end, blending::rising_root(over, begin, end, even), reached);
          more = visit(time, clip, *meeting.event, meeting.kind);
        }
      goes_on = goes_on && more;
    }
    if (!goes_on || !(end < to)) return;
    begin = end;
    stop = step.stop_at(log, end, last_phase);
    closed = false;
  }
}

}  // namespace tweenfall::graphs
