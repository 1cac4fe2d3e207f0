#include <algorithm>
#include <cmath>

#include "stage/drive_frame.h"
#include "stage/roster/staged_softs.h"
#include "stage/rules/ramps.h"
#include "stage/rules/sensed.h"
#include "stage/rules/speed_peak.h"
#include "stage/stage_data.h"
#include "stage/time/leaps.h"
#include "stage/whole_pose.h"

namespace tweenfall::staging {

namespace {

/// End of the last play that moves the node; infinity if one has no end, or if none moves it.
double path_end(const Path& path) {
  double last = -infinity;
  path.animation().for_each_play(path.clock(), path.node(),
                                 [&](const RunningPlay& play) { last = std::max(last, play.end()); });
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
    time = event_time(body.path.animation(), body.path.clock(), marker->name, body.node, from, to);
  if (const auto* event = std::get_if<when::Event>(&trigger))
    time = event_time(*state.animation, {}, event->name, no_node, from, to);
  if (std::holds_alternative<when::ClipEnd>(trigger)) time = path_end(body.path);
  if (std::holds_alternative<when::SpeedPeak>(trigger)) time = speed_peak(state, body, from, to);
  return inside(time, from, to) ? time : infinity;
}

Cause cause_of(const Trigger& trigger) {
  constexpr Cause causes[] = {Cause::at,        Cause::marker, Cause::event,     Cause::clip_end,
                              Cause::contact,   Cause::asleep, Cause::enter,     Cause::leave,
                              Cause::saturated, Cause::error,  Cause::speed_peak};
  static_assert(std::variant_size_v<Trigger> == std::size(causes));
  return causes[trigger.index()];
}

/// First instant of the rule in (from, to], infinity for none.
double first_instant(const StageState& state, const ArmedRule& armed, double from, double to) {
  double first = infinity;
  for (const Trigger& trigger : state.rules[armed.rule]->when.triggers)
    first = std::min(first, instant_of(trigger, state, state.bodies[armed.body], from, to));
  return first;
}

/// How far the body's node is from its path, m.
double path_error(const StageState& state, const StagedBody& body) {
  const Motion path = body.path.at(state.time);
  WholePose pose(state, state.time, Side::out);
  const Motion wanted = carried_along(state, body, path, pose, state.time);
  return (state.world.motion(body.id).pose.position - wanted.pose.position).norm();
}

/// Whether the rule fires now, and by which trigger.
std::optional<Cause> fires(const StageState& state, ArmedRule& armed, double from) {
  const StagedBody& body = state.bodies[armed.body];
  const Rule& rule = *state.rules[armed.rule];
  std::optional<Cause> cause;
  std::size_t holding = 0;
  for (std::size_t i = 0; i < rule.when.triggers.size(); ++i) {
    const Trigger& trigger = rule.when.triggers[i];
    bool holds = std::isfinite(instant_of(trigger, state, body, from, state.handled));
    if (holds && rule.when.all) armed.latched[i] = 1;
    if (std::holds_alternative<when::ContactHit>(trigger) && armed.latched[i]) {
      holds = true;
      if (!rule.when.all) armed.latched[i] = 0;
    }
    if (const auto* asleep = std::get_if<when::Asleep>(&trigger)) {
      const double still = state.world.owner(body.id) == Owner::free ? state.world.still_for(body.id) : 0;
      armed.attempt.still = std::max(armed.attempt.still, still);
      holds = state.world.owner(body.id) == Owner::free && still >= asleep->seconds;
    }
    const auto* enter = std::get_if<when::Enter>(&trigger);
    const auto* leave = std::get_if<when::Leave>(&trigger);
    if ((enter && has_entered(state, *enter, body.id)) || (leave && has_left(state, *leave, body.id))) {
      holds = true;
      if (rule.when.all) armed.latched[i] = 1;
    }
    if (const auto* saturated = std::get_if<when::Saturated>(&trigger)) {
      armed.attempt.saturated = std::max(armed.attempt.saturated, body.saturated_for);
      holds = body.saturated_for > 0 && body.saturated_for >= saturated->seconds - sliver;
    }
    if (const auto* error = std::get_if<when::Error>(&trigger)) {
      const double apart = state.world.owner(body.id) == Owner::driven ? path_error(state, body) : 0;
      armed.attempt.error = std::max(armed.attempt.error, apart);
      holds = apart > 0 && apart >= error->distance;
    }
    if (holds || armed.latched[i]) ++holding;
    if (holds) cause = cause_of(trigger);
  }
  const bool is_true = rule.when.all ? holding == rule.when.triggers.size() : cause.has_value();
  const bool rising = is_true && !armed.was_true;
  armed.was_true = is_true && !rule.once;
  if (!rising || !cause) return std::nullopt;
  return cause;
}

}  // namespace

double event_time(const Animation& animation, const ClockOverride& clock, const std::string& name, NodeId node,
                  double from, double to) {
  double first = infinity;
  animation.for_each_play(clock, node, [&](const RunningPlay& play) {
    if (const auto event = play.first_event(*play.clip, std::max(from, 0.0), to, from < 0, name))
      first = std::min(first, event->time);
  });
  if (clock == ClockOverride{})
    if (const auto event = animation.first_graph_event(name, node, from, to)) first = std::min(first, *event);
  return first;
}

bool waits(const StageState& state, const ArmedRule& armed) {
  if (armed.done) return false;
  const StagedBody& body = state.bodies[armed.body];
  const Drive& to = state.rules[armed.rule]->to;
  return body.ramp ? body.ramp->to != to : state.world.drive(body.id) != to;
}

void fire_rule(StageState& state, ArmedRule& armed, Cause cause, double instant, double step,
               std::vector<Happening>& happenings) {
  const std::shared_ptr<const Rule> rule = state.rules[armed.rule];
  armed.attempt.fired = true;
  std::ranges::fill(armed.latched, 0);
  const bool done = change_owner(state, armed.body, rule->change(), cause, instant, step, happenings);
  armed.vetoed = done ? std::nullopt : std::optional(cause);
  if (!done) return;
  if (rule->once) armed.done = true;
  wait_for_next(state, state.bodies[armed.body], armed.rule, 0, instant);
}

double next_instant(const StageState& state, double to) {
  const double from = state.handled;
  double next = std::min(first_jump(state, from, to), next_change(state, from, to));
  for (const ArmedRule& armed : state.armed)
    if (waits(state, armed)) next = std::min(next, first_instant(state, armed, from, std::min(next, to)));
  next = std::min(next, next_leap(state, from, std::min(next, to)));
  next = std::min(next, next_joint_end(state, from, std::min(next, to)));
  return std::min(next, next_pin_end(state, from, std::min(next, to)));
}

void fire_rules(StageState& state, double from, double step, std::vector<Happening>& happenings) {
  // In order of time, then of bodies: one instant may take a body and the next, a moment later, give it back.
  struct Due {
    double instant = 0;
    std::size_t body = 0;
    std::size_t armed = no_body;  // none: a later change of a rule
  };
  std::vector<Due> order;
  order.reserve(state.armed.size());
  for (std::size_t i = 0; i < state.armed.size(); ++i) {
    if (state.armed[i].done) continue;
    const double instant = first_instant(state, state.armed[i], from, state.handled);
    order.push_back({std::isfinite(instant) ? std::max(0.0, instant) : state.time, state.armed[i].body, i});
  }
  for_each_change_due(state, from, [&](std::size_t body, double instant) { order.push_back({instant, body}); });
  std::ranges::stable_sort(order, {}, [](const Due& due) { return std::pair(due.instant, due.body); });
  for (const Due& due : order) {
    if (due.armed == no_body) {
      change_when_due(state, due.body, due.instant, step, happenings);
      continue;
    }
    ArmedRule& armed = state.armed[due.armed];
    if (!waits(state, armed)) {
      std::ranges::fill(armed.latched, 0);
      armed.vetoed.reset();
      continue;
    }
    armed.attempt.waited = true;
    const std::optional<Cause> fired = fires(state, armed, from);
    const std::optional<Cause> cause = fired ? fired : armed.vetoed;
    if (!cause) continue;
    fire_rule(state, armed, *cause, due.instant, step, happenings);
  }
}

}  // namespace tweenfall::staging
