#include "state.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {

namespace {

/// More splits than this in one step are handled together at its end.
constexpr std::size_t most_splits = 256;
/// Freeing one struck body may strike the next; this many passes are made over them.
constexpr int most_passes = 8;

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

/// The hardest blow on `body` in the last step.
struct Blow {
  double impulse = 0, speed = 0;
  std::string_view other;
};
std::optional<Blow> pulled_by(const StageState& state, const Rule& rule, BodyId body) {
  std::optional<Blow> hardest;
  for (const Contact& contact : state.world.contacts()) {
    if (contact.a != body && contact.b != body) continue;
    const Blow blow{contact.impulse, contact.approach_speed, name_of(state, contact.a == body ? contact.b : contact.a)};
    if (struck(rule, blow.impulse, blow.speed, blow.other) && (!hardest || blow.impulse > hardest->impulse))
      hardest = blow;
  }
  return hardest;
}

bool has_contact_trigger(const Rule& rule) {
  return std::ranges::any_of(rule.when.triggers,
                             [](const Trigger& t) { return std::holds_alternative<when::ContactHit>(t); });
}

/// Moves the world to `end`. A keyed body that is struck hard enough, judged by the impulse that it would take if it
/// were free, is freed at the start of the piece and the piece is solved again: otherwise what struck it would bounce
/// off an infinite mass and the difference in momentum would vanish.
void move_world(StageState& state, double end, double step, std::vector<Happening>& happenings) {
  const double length = end - state.time;
  set_targets(state, end);
  const bool watched = std::ranges::any_of(
      state.armed, [&](const ArmedRule& armed) { return !armed.done && has_contact_trigger(state.rules[armed.rule]); });
  if (!watched) {
    state.world.step(length);
    return;
  }

  const World before = state.world;
  state.world.step(length);
  for (int pass = 0; pass < most_passes; ++pass) {
    bool freed = false;
    for (std::size_t i = 0; i < state.armed.size(); ++i) {
      ArmedRule& armed = state.armed[i];
      const Rule rule = state.rules[armed.rule];
      const StagedBody& body = state.bodies[armed.body];
      if (armed.done || !has_contact_trigger(rule) || state.world.drive(body.id) == rule.to) continue;
      if (!pulled_by(state, rule, body.id)) continue;
      if (state.world.owner(body.id) == Owner::keyed) {
        StageState trial = state;
        trial.world = before;
        std::vector<Happening> tried;
        change_owner(trial, armed.body, rule.to, Cause::contact, rule.take_over, rule.hand_back, step, tried);
        trial.world.step(length);
        if (!pulled_by(trial, rule, trial.bodies[armed.body].id)) continue;
        if (rule.when.all || rule.when.triggers.size() > 1) {
          for (std::size_t t = 0; t < rule.when.triggers.size(); ++t)
            if (std::holds_alternative<when::ContactHit>(rule.when.triggers[t])) armed.latched[t] = 1;
          if (rule.when.all) continue;
        }
        // Kept, and the next blow is judged from here.
        trial.armed[i].done = rule.once;
        std::ranges::fill(trial.armed[i].latched, 0);
        happenings.insert(happenings.end(), tried.begin(), tried.end());
        state = std::move(trial);
        freed = true;
        break;
      }
      for (std::size_t t = 0; t < rule.when.triggers.size(); ++t)
        if (std::holds_alternative<when::ContactHit>(rule.when.triggers[t])) armed.latched[t] = 1;
    }
    if (!freed) return;
  }
}

void report_contacts(const StageState& state, std::vector<Happening>& happenings) {
  for (const Contact& contact : state.world.contacts()) {
    if (!contact.began) continue;
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
    handle_instant(state, from, step, commands, happenings);
    if (to < end) splits.push_back(state);
  }
  ++state.steps;
}

}  // namespace tweenfall
