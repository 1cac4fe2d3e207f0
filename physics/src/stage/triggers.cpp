#include "stage/stage_data.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {

namespace {

/// First time in (from, to] at which a play of `animation` fires an event of this name; infinity for none.
/// @param node  when given, only plays that move the node count
double first_event(const Animation& animation, const std::string& name, NodeId node, double from, double to) {
  double first = infinity;
  const auto plays = animation.plays();
  for (std::size_t p = 0; p < plays.size(); ++p) {
    if (node != no_node && !animation.moved_by(node, p)) continue;
    const bool from_start = from < 0;
    for (const FiredEvent& event :
         events_between(plays[p], animation.clips()[plays[p].clip], std::max(from, 0.0), to, from_start))
      if (event.name == name && event.kind != FiredEvent::Kind::end) first = std::min(first, event.time);
  }
  return first;
}

/// End of the last play that moves the node; infinity while one has no end, or when none does.
double path_end(const Path& path) {
  const Animation& animation = path.animation();
  double last = -infinity;
  for (std::size_t p = 0; p < animation.plays().size(); ++p)
    if (animation.moved_by(path.node(), p))
      last = std::max(last, end_time(animation.plays()[p], animation.clips()[animation.plays()[p].clip]));
  return last == -infinity ? infinity : last;
}

bool inside(double time, double from, double to) {
  return time > from && time <= to;
}

/// The exact time of an instant in (from, to], infinity for none; conditions have none.
double instant_of(const Trigger& trigger, const StageState& state, const StagedBody& body, double from, double to) {
  double time = infinity;
  if (const auto* at = std::get_if<when::At>(&trigger)) time = at->time;
  if (const auto* marker = std::get_if<when::Marker>(&trigger))
    time = first_event(body.path.animation(), marker->name, body.node, from, to);
  if (const auto* event = std::get_if<when::Event>(&trigger))
    time = first_event(*state.animation, event->name, no_node, from, to);
  if (std::holds_alternative<when::ClipEnd>(trigger)) time = path_end(body.path);
  return inside(time, from, to) ? time : infinity;
}

bool waits(const StageState& state, const ArmedRule& armed) {
  if (armed.done) return false;
  const Drive& to = state.rules[armed.rule].to;
  return state.world.drive(state.bodies[armed.body].id) != to;
}

Cause cause_of(const Trigger& trigger) {
  constexpr Cause causes[] = {Cause::at, Cause::marker, Cause::event, Cause::clip_end, Cause::contact, Cause::asleep};
  static_assert(std::variant_size_v<Trigger> == std::size(causes));
  return causes[trigger.index()];
}

/// Whether the rule fires now, and through which trigger.
std::optional<Cause> fires(const StageState& state, ArmedRule& armed, double from) {
  const StagedBody& body = state.bodies[armed.body];
  const When& when = state.rules[armed.rule].when;
  std::optional<Cause> cause;
  std::size_t holding = 0;
  for (std::size_t i = 0; i < when.triggers.size(); ++i) {
    const Trigger& trigger = when.triggers[i];
    bool holds = std::isfinite(instant_of(trigger, state, body, from, state.time));
    if (holds && when.all) armed.latched[i] = 1;
    if (std::holds_alternative<when::ContactHit>(trigger) && armed.latched[i]) {
      holds = true;
      if (!when.all) armed.latched[i] = 0;
    }
    if (const auto* asleep = std::get_if<when::Asleep>(&trigger))
      holds = state.world.owner(body.id) == Owner::free && state.world.still_for(body.id) >= asleep->seconds;
    if (holds || armed.latched[i]) ++holding;
    if (holds) cause = cause_of(trigger);
  }
  const bool is_true = when.all ? holding == when.triggers.size() : cause.has_value();
  const bool rising = is_true && !armed.was_true;
  armed.was_true = is_true && !state.rules[armed.rule].once;
  if (!rising || !cause) return std::nullopt;
  return cause;
}

}  // namespace

bool struck(const when::ContactHit& hit, double impulse, double speed, std::string_view other) {
  return impulse > 0 && impulse >= hit.impulse && speed >= hit.speed && (hit.with.empty() || matches(hit.with, other));
}

double next_instant(const StageState& state, double from, double to) {
  double next = next_jump(state, *state.animation, from, to);
  for (const StagedBody& body : state.bodies)
    if (body.present && &body.path.animation() != state.animation.get())
      next = std::min(next, next_jump(state, body.path.animation(), from, to));
  for (const ArmedRule& armed : state.armed) {
    if (!waits(state, armed)) continue;
    for (const Trigger& trigger : state.rules[armed.rule].when.triggers)
      next = std::min(next, instant_of(trigger, state, state.bodies[armed.body], from, to));
  }
  return std::min(next, to);
}

void fire_rules(StageState& state, double from, double step, std::vector<Happening>& happenings) {
  for (std::size_t i = 0; i < state.armed.size(); ++i) {
    if (!waits(state, state.armed[i])) {
      std::ranges::fill(state.armed[i].latched, 0);
      continue;
    }
    const std::optional<Cause> cause = fires(state, state.armed[i], from);
    if (!cause) continue;
    const Rule rule = state.rules[state.armed[i].rule];
    if (rule.once) state.armed[i].done = true;
    std::ranges::fill(state.armed[i].latched, 0);
    change_owner(state, state.armed[i].body, rule.to, *cause, rule.take_over, rule.hand_back, step, happenings);
  }
}

}  // namespace tweenfall
