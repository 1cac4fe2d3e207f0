#include "stage/rules/ramps.h"

#include <tweenfall/curves/elementary.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::staging {

namespace {

/// Between a limit and no limit there is no limit.
double even(double from, double to, double share) {
  if (share <= 0 || from == to) return from;
  if (share >= 1) return to;
  return std::isinf(from) || std::isinf(to) ? infinity : from + share * (to - from);
}

double end_of(const Ramp& ramp) {
  return ramp.start + ramp.seconds;
}

Drive drive_at(const Ramp& ramp, double share) {
  // A free or a keyed body has no limits, no damping and no frame of its own.
  const bool from_driven = ramp.from.owner() == Owner::driven, to_driven = ramp.to.owner() == Owner::driven;
  const Drive& from = from_driven ? ramp.from : ramp.to;
  const Drive& to = to_driven ? ramp.to : ramp.from;
  Drive drive = from_driven && to_driven ? ramp.to : from_driven ? ramp.from : ramp.to;
  if (from_driven && to_driven) {
    drive.zeta = even(from.zeta, to.zeta, share);
    drive.max_force = even(from.max_force, to.max_force, share);
    drive.max_torque = even(from.max_torque, to.max_torque, share);
    drive.gravity_compensation = even(from.gravity_compensation, to.gravity_compensation, share);
  }
  drive.hz = hz_between(ramp.from.hz, ramp.to.hz, share);
  return drive;
}

}  // namespace

double hz_between(double from, double to, double share) {
  const double low = elementary::log(std::clamp(from, softest_hz, stiffest_hz));
  const double high = elementary::log(std::clamp(to, softest_hz, stiffest_hz));
  return elementary::exp(low + share * (high - low));
}

Drive drive_at_start(const Ramp& ramp) {
  return drive_at(ramp, 0);
}

Drive drive_on(const Ramp& ramp, double time) {
  return drive_at(ramp, std::clamp((time - ramp.start) / ramp.seconds, 0.0, 1.0));
}

void follow_ramps(StageState& state) {
  if (!state.ramps) return;
  state.ramps = false;
  for (const StagedBody& body : state.bodies) {
    if (!body.present || !body.ramp) continue;
    state.ramps = true;
    // Setting a drive is a change to a body even if it is the same, so it is avoided.
    const Drive drive = drive_on(*body.ramp, state.time);
    if (drive != state.world.drive(body.id)) state.world.set_drive(body.id, drive);
  }
}

void wait_for_next(const StageState& state, StagedBody& body, std::size_t rule, std::size_t place, double began) {
  const std::vector<NextChange>& then = state.rules[rule]->then;
  if (place < then.size()) body.coming = ComingChange{rule, place, began + then[place].after};
}

double change_due(const StagedBody& body) {
  if (!body.present) return infinity;
  return std::min(body.ramp ? end_of(*body.ramp) : infinity, body.coming ? body.coming->due : infinity);
}

double next_change(const StageState& state, double from, double to) {
  double next = infinity;
  for (const StagedBody& body : state.bodies)
    if (const double due = change_due(body); due > from && due <= to) next = std::min(next, due);
  return next;
}

void change_when_due(StageState& state, std::size_t index, double instant, double step,
                     std::vector<Happening>& happenings) {
  StagedBody& body = state.bodies[index];
  if (body.ramp && end_of(*body.ramp) <= instant) {
    const Ramp ramp = *body.ramp;
    const std::optional<ComingChange> coming = body.coming;
    if (ramp.to.owner() == Owner::driven) {
      state.world.set_drive(body.id, ramp.to);
      body.ramp.reset();
    } else {
      static_cast<void>(change_owner(state, index, {.to = ramp.to, .hand_back = {.settle = ramp.settle}}, Cause::ramp,
                                     end_of(ramp), step, happenings));
    }
    body.coming = coming;
  }
  if (!body.coming || body.coming->due > instant) return;
  const ComingChange coming = *body.coming;
  const std::shared_ptr<const Rule> rule = state.rules[coming.rule];
  if (!change_owner(state, index, rule->then[coming.place].change, Cause::then, coming.due, step, happenings)) {
    body.coming->due = state.time + step;  // vetoed: tried again, as a rule is
    return;
  }
  body.coming.reset();
  wait_for_next(state, body, coming.rule, coming.place + 1, coming.due);
}

}  // namespace tweenfall::staging
