#include "machine/machine.h"

#include <tweenfall/anim/blend.h>

#include "graph/digest.h"
#include "machine/inertia.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tweenfall::graphs {

namespace {

struct ShownPassage {
  const Passage* passage;
  Sample<double> weight;  // over those before it
};
using ShownPassages = std::array<ShownPassage, most_fades_at_once + 1>;

/// Whether a change is over. On arrival at its end it still has its rate.
bool is_done(double seconds, double since, Side side) noexcept {
  return since > seconds || (since == seconds && (side == Side::out || seconds == 0));
}

Sample<double> progress(const GraphChange& change, double since, Side side) noexcept {
  if (is_done(change.seconds, since, side)) return {1, 0, 0};
  const double u = since / change.seconds;
  if (change.ease && change.ease->rule() == Ease::Rule::linear) return {u, 1 / change.seconds, 0};
  if (!change.ease) return {u * u * (3 - 2 * u), 6 * u * (1 - u) / change.seconds, 0};
  Sample<double> sample = change.ease->progress(u, side);
  sample.rate /= change.seconds;
  return sample;
}

/// The passages that show at a time, the latest first, down to one that covers all before it.
std::size_t shown_at(const Passages& passages, double time, Side side, ShownPassages& shown) noexcept {
  std::size_t count = 0;
  for (std::size_t i = passages.count; i-- > 0 && count < shown.size();) {
    const Passage& passage = passages[i];
    // A state that was left at the instant it was entered never showed.
    if (i + 1 < passages.count && passages[i + 1].time == passage.time) continue;
    const bool first = passages[0].time == passage.time;
    const Sample<double> weight =
        first || passage.settles ? Sample<double>{1, 0, 0} : progress(passage.change, time - passage.time, side);
    if (is_nothing(weight)) continue;
    shown[count++] = {&passage, weight};
    if (is_whole(weight)) break;
  }
  return count;
}

/// The passages before a time, or also at it for `Side::out`.
Passages until(const Record<Passage>& passages, double time, Side side) noexcept {
  const auto later = [&](double t, const Passage& each) { return side == Side::out ? t < each.time : t <= each.time; };
  const auto next = std::upper_bound(passages.begin(), passages.end(), time, later);
  return {&passages, std::max<std::size_t>(1, static_cast<std::size_t>(next - passages.begin()))};
}

}  // namespace

Machine::Machine(const GraphDescription& description, std::size_t number, std::vector<const Operation*> states,
                 std::vector<Transition> transitions, std::size_t start)
    : description_(description),
      number_(number),
      states_(std::move(states)),
      transitions_(std::move(transitions)),
      start_(start) {}

void Machine::show(const Log& log, const Passages& passages, const Moment& moment, const Scratch& scratch,
                   std::span<Motion> out) const noexcept {
  ShownPassages shown;
  const std::size_t count = shown_at(passages, moment.time, moment.side, shown);
  for (std::size_t i = count; i-- > 0;) {
    const Passage& passage = *shown[i].passage;
    const bool lowest = i + 1 == count;
    const std::span<Motion> motions = lowest ? out : scratch.pose();
    const Moment own{moment.time, moment.side, passage.time};
    states_[passage.state]->pose(log, own, lowest ? scratch : scratch.rest(), motions);
    const double since = moment.time - passage.time;
    if (passage.settles && since < settling_time(passage.change)) {
      if (passage.offsets)
        settle(passage.change, *passage.offsets, since, motions);
      else
        log.lacks = true;
    }
    if (!lowest) cross_fade(out, motions, shown[i].weight, out);
  }
}

void Machine::pose(const Log& log, const Moment& moment, const Scratch& scratch, std::span<Motion> out) const noexcept {
  const Sight sight = seen(log, moment.time, moment.side);
  show(log, until(log.passages[number_], sight.time, sight.side), moment, scratch, out);
}

void Machine::bearers(const Log& log, const Moment& moment, std::size_t node, const Sample<double>& weight,
                      Bearers& out) const noexcept {
  const Sight sight = seen(log, moment.time, moment.side);
  const Passages passages = until(log.passages[number_], sight.time, sight.side);
  Sample<double> left = weight;
  for (std::size_t i = passages.count; i-- > 0;) {
    const Passage& passage = passages[i];
    if (i + 1 < passages.count && passages[i + 1].time == passage.time) continue;
    // Where a difference settles, the clips before it keep moving the figure for that long.
    GraphChange change = passage.change;
    if (passage.settles) change = {.seconds = std::min(settling_time(change), 4 * change.seconds)};
    const double since = moment.time - passage.time;
    const bool lowest = passages[0].time == passage.time || is_done(change.seconds, since, moment.side);
    const Sample<double> share = lowest ? Sample<double>{1, 0, 0} : progress(change, since, moment.side);
    if (!lowest) out.flow = true;
    if (!is_nothing(share))
      states_[passage.state]->bearers(log, {moment.time, moment.side, passage.time}, node, product(left, share), out);
    if (lowest) return;
    left = product(left, rest_of(share));
  }
}

std::vector<GraphActivity> Machine::activity(const Log& log, double time) const {
  ShownPassages shown;
  const Passages passages = until(log.passages[number_], time, Side::out);
  const std::size_t count = shown_at(passages, time, Side::out, shown);
  std::vector<GraphActivity> out;
  Sample<double> left{1, 0, 0};  // the weight that the ones above leave
  for (std::size_t i = 0; i < count; ++i) {
    const Passage& passage = *shown[i].passage;
    const Sample<double>& weight = shown[i].weight;
    const double since = time - passage.time;
    const bool settles = passage.settles && since < settling_time(passage.change);
    out.push_back({.state = passage.state,
                   .since = passage.time,
                   .weight = {left.value * weight.value, left.rate * weight.value + left.value * weight.rate, 0},
                   .settling = settles ? since : 0});
    left = {left.value * (1 - weight.value), left.rate * (1 - weight.value) - left.value * weight.rate, 0};
  }
  std::ranges::reverse(out);
  return out;
}

namespace {

/// Calls `visit(passage, from, to)` with each stretch in (from, to] in which a state was the latest, until it returns
/// false. The instant at which a state was entered belongs to it too.
template <class Visit>
void for_each_stretch(const Record<Passage>& passages, double from, double to, const Visit& visit) {
  auto passage = std::ranges::upper_bound(passages, from, {}, &Passage::time);
  if (passage != passages.begin()) --passage;
  while (passage != passages.begin() && std::prev(passage)->time == passage->time) --passage;
  for (; passage != passages.end() && passage->time <= to; ++passage) {
    const auto next = std::next(passage);
    const bool left = next != passages.end();
    if (left && next->time == passage->time) continue;
    const double begin = from < passage->time ? std::nextafter(passage->time, -1.0) : from;
    if (!visit(*passage, begin, left ? std::min(to, next->time) : to)) return;
  }
}

}  // namespace

void Machine::events(const Log& log, const Stretch& stretch, std::vector<GraphEvent>& out) const {
  for_each_stretch(log.passages[number_], stretch.from, stretch.to,
                   [&](const Passage& passage, double from, double to) {
                     states_[passage.state]->events(log, {from, to, passage.time}, out);
                     return true;
                   });
}

std::optional<double> Machine::next_event(const Log& log, std::string_view name, double, double after,
                                          double until) const {
  std::optional<double> found;
  for_each_stretch(log.passages[number_], after, until, [&](const Passage& passage, double from, double to) {
    found = states_[passage.state]->next_event(log, name, passage.time, from, to);
    return !found;
  });
  return found;
}

double Machine::end(const Log& log, double) const noexcept {
  return states_[current(log).state]->end(log, current(log).time);
}

std::optional<double> Machine::next_jump(const Log& log, double, const Search& search) const {
  // For all states that show at the start of the search, including fading ones, and all that are entered in it.
  const Record<Passage>& all = log.passages[number_];
  const Passages before = until(all, search.since, Side::out);
  ShownPassages shown;
  const std::size_t count = shown_at(before, search.since, Side::out, shown);
  const double since = count > 0 ? shown[count - 1].passage->time : all.front().time;
  std::optional<double> first;
  for (auto passage = std::ranges::lower_bound(all, since, {}, &Passage::time);
       passage != all.end() && passage->time <= first.value_or(search.until); ++passage)
    if (const auto next = states_[passage->state]->next_jump(
            log, passage->time, search.from(passage->time).up_to(first.value_or(search.until))))
      first = next;
  return first;
}

void Machine::begin(Log& log) const {
  Passage first;
  first.state = start_;
  log.passages[number_].truncate(0);
  log.passages[number_].push_back(first);
}

std::optional<double> Machine::next_instant(const Log& log, double after, double until) const {
  std::optional<double> first;
  for (const Transition& transition : transitions_) {
    if (!transition.from[current(log).state]) continue;
    for (const Condition& condition : transition.when)
      if (const auto next = condition.next(log, description_, standing(log), after, first.value_or(until)))
        first = next;
  }
  return first;
}

std::size_t Machine::transition_at(const Log& log, double time, std::optional<std::string_view> event) const {
  const Standing state = standing(log);
  for (std::size_t i = 0; i < transitions_.size(); ++i) {
    const Transition& transition = transitions_[i];
    if (!transition.from[current(log).state]) continue;
    if (std::ranges::all_of(transition.when, [&](const Condition& condition) {
          return condition.holds(log, description_, state, time, event);
        }))
      return i;
  }
  return GraphPassage::no_transition;
}

Passage Machine::passage(const Log& log, std::size_t index, double time) const {
  const Transition& transition = transitions_[index];
  Passage passage;
  passage.time = time;
  passage.state = transition.to;
  passage.transition = index;
  passage.change = transition.change;
  ShownPassages shown;
  const Record<Passage>& passages = log.passages[number_];
  if (passages.front().time == time) return passage;  // nothing was shown before
  const std::size_t count = shown_at(until(passages, time, Side::in), time, Side::in, shown);
  const bool fades = transition.change.kind == GraphChange::Kind::fade;
  passage.settles = !fades || (count > most_fades_at_once && transition.change.seconds > 0);
  if (passage.settles && fades) passage.change.kind = GraphChange::Kind::quintic;
  return passage;
}

void Machine::measure(const Log& log, Passage& passage, std::span<const Motion> below_in,
                      std::span<const Motion> below_out, const GraphGround* below, Motion* free) const {
  const std::size_t nodes = below_in.size();
  const std::span<Motion> shown(free, nodes), next(free + nodes, nodes);
  Motion* const rest = free + 2 * nodes;
  const double time = passage.time;
  show(log, until(log.passages[number_], time, Side::in), {time, Side::in, time}, {below_in, rest, below}, shown);
  states_[passage.state]->pose(log, {time, Side::out, time}, {below_out, rest, below}, next);
  passage.offsets = std::make_shared<const std::vector<Offset>>(offsets_of(passage.change, shown, next));
  Digest digest;
  for (const Offset& offset : *passage.offsets)
    for (const Vec3* part :
         {&offset.position, &offset.velocity, &offset.turn, &offset.turn_rate, &offset.scale, &offset.scale_rate})
      for (int i = 0; i < 3; ++i) digest.number((*part)[i]);
  passage.trace = digest.value();
}

}  // namespace tweenfall::graphs
