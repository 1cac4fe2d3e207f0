#include "stage/stage_data.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {

namespace {

/// More splits than this in one step are handled together at its end.
constexpr std::size_t most_splits = 256;

Motion rigid(Motion motion) {
  motion.pose.scale = Vec3(1, 1, 1);
  motion.scale_rate.setZero();
  return motion;
}

std::string_view name_of(const StageState& state, BodyId body) {
  return (*state.nodes)[state.node_of[body.index]].name;
}

/// Keyed and driven bodies are told where their paths want them at `end`.
void set_targets(StageState& state, double end) {
  for (StagedBody& body : state.bodies) {
    if (!body.present || state.world.is_fixed(body.id)) continue;
    const Owner owner = state.world.owner(body.id);
    if (owner == Owner::free) continue;
    if (state.jumped && owner == Owner::keyed) {
      const Motion leaving = rigid(body.path.at(state.time));
      const Motion here = state.world.motion(body.id);
      if (!leaving.pose.position.isApprox(here.pose.position, 1e-12) ||
          std::abs(leaving.pose.rotation.dot(here.pose.rotation)) < 1 - 1e-15)
        state.world.set_motion(body.id, leaving);
    }
    state.world.set_target(body.id, rigid(body.path.at(end, Side::in)));
  }
  state.jumped = false;
}

/// Whether a contact of the last step pulls the trigger on `body`.
bool pulled(const StageState& state, const Trigger& trigger, BodyId body) {
  const auto* hit = std::get_if<when::ContactHit>(&trigger);
  return hit && std::ranges::any_of(state.world.contacts(), [&](const Contact& contact) {
           if (contact.a != body && contact.b != body) return false;
           return struck(*hit, contact.impulse, contact.approach_speed,
                         name_of(state, contact.a == body ? contact.b : contact.a));
         });
}

bool any_pulled(const StageState& state, const Rule& rule, BodyId body) {
  return std::ranges::any_of(rule.when.triggers, [&](const Trigger& t) { return pulled(state, t, body); });
}

bool has_contact_trigger(const Rule& rule) {
  return std::ranges::any_of(rule.when.triggers,
                             [](const Trigger& t) { return std::holds_alternative<when::ContactHit>(t); });
}

/// Remembers which of the rule's contact triggers were pulled; whether that is enough for it to fire.
bool latch(ArmedRule& armed, const Rule& rule, const StageState& state) {
  const BodyId body = state.bodies[armed.body].id;
  bool any = false;
  for (std::size_t t = 0; t < rule.when.triggers.size(); ++t)
    if (pulled(state, rule.when.triggers[t], body)) {
      armed.latched[t] = 1;
      any = true;
    }
  return any && (!rule.when.all || std::ranges::all_of(armed.latched, [](char latched) { return latched != 0; }));
}

/// Moves the world to `end`. A keyed body that is struck hard enough, judged by the impulse that it would take if it
/// were free, is freed at the start of the piece and the piece is solved again: otherwise what struck it would bounce
/// off an infinite mass and the difference in momentum would vanish. Freeing one may strike the next, so this goes on
/// until no more are freed; each rule frees its body once.
void move_world(StageState& state, double end, double step, std::vector<Happening>& happenings) {
  const double length = end - state.time;
  set_targets(state, end);
  const bool watched = std::ranges::any_of(
      state.armed, [&](const ArmedRule& armed) { return !armed.done && has_contact_trigger(state.rules[armed.rule]); });
  if (!watched) {
    state.world.step(length);
    return;
  }

  World start = state.world;  // at the start of the piece, with whoever has been freed there
  state.world.step(length);
  std::vector<char> judged(state.armed.size(), 0);
  for (bool freed = true; freed;) {
    freed = false;
    for (std::size_t i = 0; i < state.armed.size() && !freed; ++i) {
      const Rule& rule = state.rules[state.armed[i].rule];
      const BodyId body = state.bodies[state.armed[i].body].id;
      if (judged[i] || state.armed[i].done || !has_contact_trigger(rule) || state.world.drive(body) == rule.to)
        continue;
      if (!any_pulled(state, rule, body)) continue;
      if (state.world.owner(body) != Owner::keyed) {
        static_cast<void>(latch(state.armed[i], rule, state));  // fired at the end of the piece, with all others
        continue;
      }
      StageState trial = state;
      trial.world = start;
      std::vector<Happening> tried;
      change_owner(trial, state.armed[i].body, rule.to, Cause::contact, rule.take_over, rule.hand_back, step, tried);
      World trial_start = trial.world;
      trial.world.step(length);
      if (!latch(trial.armed[i], rule, trial)) {
        state.armed[i].latched = trial.armed[i].latched;  // of an `all`: this one has come, others have not
        continue;
      }
      trial.armed[i].done = rule.once;
      std::ranges::fill(trial.armed[i].latched, 0);
      happenings.insert(happenings.end(), tried.begin(), tried.end());
      state = std::move(trial);
      start = std::move(trial_start);
      judged[i] = 1;
      freed = true;
    }
  }
}

void report_contacts(const StageState& state, std::vector<Happening>& happenings) {
  for (const Contact& contact : state.world.contacts()) {
    if (!contact.began || !(contact.impulse > 0)) continue;
    StageEvent event;
    event.time = state.time;
    event.name = "contact";
    event.nodes = {state.node_of[contact.a.index], state.node_of[contact.b.index]};
    event.impulse = contact.impulse;
    happenings.push_back({state.time, std::move(event)});
  }
}

void report_events(const StageState& state, double from, std::vector<Happening>& happenings) {
  std::vector<FiredEvent> fired;
  const auto plays = state.animation->plays();
  for (const Play& play : plays) {
    const Clip& clip = state.animation->clips()[play.clip];
    std::vector<FiredEvent> more = events_between(play, clip, std::max(from, 0.0), state.time, from < 0);
    fired.insert(fired.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
  std::ranges::stable_sort(fired, {}, &FiredEvent::time);
  for (FiredEvent& event : fired)
    happenings.push_back(
        {event.time, StageEvent{.time = event.time, .name = event.name, .data = event.data, .nodes = {}}});
}

/// All that is due in (from, state.time]: events told, rules fired, the caller's changes made.
void handle_instant(StageState& state, double from, double step, std::span<const Command> commands,
                    std::vector<Happening>& happenings) {
  report_events(state, from, happenings);
  fire_rules(state, from, step, happenings);
  for (const Command& command : commands)
    if (command.time > from && command.time <= state.time) command.run(state, happenings);
  state.jumped = true;
}

}  // namespace

void take_step(StageState& state, double step, std::span<const Command> commands, std::vector<StageState>& splits,
               std::vector<Happening>& happenings) {
  if (state.steps < 0) {
    handle_instant(state, -1, step, commands, happenings);
    state.steps = 0;
    return;
  }
  const double end = static_cast<double>(state.steps + 1) * step;
  while (state.time < end) {
    const double from = state.time;
    double to = end;
    if (splits.size() < most_splits) {
      to = next_instant(state, from, end);
      for (const Command& command : commands)
        if (command.time > from && command.time < to) to = command.time;
    }
    move_world(state, to, step, happenings);
    state.time = to;
    report_contacts(state, happenings);
    // What is read before a change by the caller must not know of it.
    const auto due = [&](const Command& command) { return command.time > from && command.time <= to; };
    if (std::ranges::any_of(commands, due)) splits.push_back(state);
    handle_instant(state, from, step, commands, happenings);
    if (to < end) splits.push_back(state);
  }
  ++state.steps;
}

}  // namespace tweenfall
