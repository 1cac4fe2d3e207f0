#include <tweenfall/physics/detail.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "stage/actors/particles.h"
#include "stage/actors/vehicles.h"
#include "stage/roster/staged_softs.h"
#include "stage/rules/meetings.h"
#include "stage/rules/overlaps.h"
#include "stage/rules/sensed.h"
#include "stage/rules/strains.h"

namespace tweenfall::staging {

namespace {

bool has_contact_trigger(const Rule& rule) {
  return std::ranges::any_of(rule.when.triggers,
                             [](const Trigger& t) { return std::holds_alternative<when::ContactHit>(t); });
}

/// What a contact did to one body.
struct Touch {
  BodyId other;
  double impulse = 0;
  double speed = 0;
};

/// Which of the world's contacts each body takes part in.
class ContactsByBody {
 public:
  explicit ContactsByBody(const StageState& state) : starts_(state.node_of.size() + 1, 0) {
    const auto contacts = state.world.contacts();
    for (const Contact& contact : contacts)
      for (const BodyId body : {contact.a, contact.b}) ++starts_[body.index];
    std::size_t end = 0;
    for (std::size_t& start : starts_) start = end += start;
    places_.resize(end);
    for (std::size_t i = contacts.size(); i-- > 0;)
      for (const BodyId body : {contacts[i].a, contacts[i].b}) places_[--starts_[body.index]] = i;
  }
  [[nodiscard]] std::span<const std::size_t> of(BodyId body) const {
    return std::span(places_).subspan(starts_[body.index], starts_[body.index + 1] - starts_[body.index]);
  }

 private:
  std::vector<std::size_t> starts_, places_;
};

std::pair<std::uint32_t, std::uint32_t> pair_of(const Blow& blow) {
  return {blow.a.index, blow.b.index};
}

/// The blow that is still going on between two bodies, the one with the smaller index first; null for none.
const Blow* blow_of(const StageState& state, BodyId a, BodyId b) {
  const auto found = std::ranges::lower_bound(state.blows, std::pair(a.index, b.index), {}, pair_of);
  return found != state.blows.end() && found->a == a && found->b == b ? &*found : nullptr;
}

/// Calls `visit` with the contacts of each pair of bodies: several where several parts of them touch.
template <class Visit>
void visit_pairs(std::span<const Contact> contacts, const Visit& visit) {
  for (std::size_t begin = 0, end = 0; begin < contacts.size(); begin = end) {
    while (end < contacts.size() && contacts[end].a == contacts[begin].a && contacts[end].b == contacts[begin].b) ++end;
    visit(contacts.subspan(begin, end - begin));
  }
}

bool pressing(const Contact& contact) {
  return contact.impulse > 0;
}

/// Everything that touched the body in the last piece; a blow that is still going on counts with its impulse so far.
std::vector<Touch> touches(const StageState& state, const ContactsByBody& contacts, BodyId body) {
  std::vector<Touch> found;
  const std::span<const Contact> all = state.world.contacts();
  for (const std::size_t place : contacts.of(body)) {
    const Contact& contact = all[place];
    if (!(contact.impulse > 0)) continue;
    const BodyId other = contact.a == body ? contact.b : contact.a;
    // Contacts of several parts follow one another, and are one touch.
    if (found.empty() || found.back().other != other) found.push_back({other});
    found.back().impulse += contact.impulse;
    found.back().speed = std::max(found.back().speed, contact.approach_speed);
  }
  for (Touch& touch : found) {
    const bool first = body.index < touch.other.index;
    const Blow* blow = blow_of(state, first ? body : touch.other, first ? touch.other : body);
    if (!blow) continue;
    touch.impulse = std::max(touch.impulse, blow->impulse);
    touch.speed = std::max(touch.speed, blow->speed);
  }
  return found;
}

bool pulls(const StageState& state, const Trigger& trigger, const Touch& touch) {
  const auto* hit = std::get_if<when::ContactHit>(&trigger);
  return hit && touch.impulse >= hit->impulse && touch.speed >= hit->speed &&
         (hit->with.empty() || matches(hit->with, state.name_of(touch.other)));
}

/// Latches those of the rule's contact triggers that were pulled. @return whether that is enough for it to fire.
bool latch(ArmedRule& armed, const StageState& state, const ContactsByBody& contacts) {
  const Rule& rule = *state.rules[armed.rule];
  bool any = false;
  for (const Touch& touch : touches(state, contacts, state.bodies[armed.body].id)) {
    bool named = false;
    for (std::size_t t = 0; t < rule.when.triggers.size(); ++t) {
      const auto* hit = std::get_if<when::ContactHit>(&rule.when.triggers[t]);
      named = named || (hit && (hit->with.empty() || matches(hit->with, state.name_of(touch.other))));
      if (!pulls(state, rule.when.triggers[t], touch)) continue;
      armed.latched[t] = 1;
      any = true;
    }
    if (!named) continue;
    armed.attempt.touched = true;
    armed.attempt.impulse = std::max(armed.attempt.impulse, touch.impulse);
    armed.attempt.speed = std::max(armed.attempt.speed, touch.speed);
  }
  return any && (!rule.when.all || std::ranges::all_of(armed.latched, [](char latched) { return latched != 0; }));
}

bool any_pulled(const StageState& state, const ContactsByBody& contacts, const ArmedRule& armed) {
  const std::vector<Touch> all = touches(state, contacts, state.bodies[armed.body].id);
  return std::ranges::any_of(state.rules[armed.rule]->when.triggers, [&](const Trigger& trigger) {
    return std::ranges::any_of(all, [&](const Touch& touch) { return pulls(state, trigger, touch); });
  });
}

/// The state with the body of an armed rule handed over, moved on to `end`: this shows what its blow would be.
StageState tried(const StageState& state, std::size_t armed, double end, double step) {
  const OwnerChange change = state.rules[state.armed[armed].rule]->change();
  StageState trial = state;
  std::vector<Happening> unheard;
  static_cast<void>(change_owner(trial, state.armed[armed].body, change, Cause::contact, state.time, step, unheard));
  set_targets(trial, end);
  trial.blows.clear();
  drive_vehicles(trial, end - trial.time);
  trial.world.step(end - trial.time, step);
  return trial;
}

/// Bodies as they were at the start of a piece, by index of the world's body.
struct PieceStart {
  double time;
  std::vector<Pose> poses;
  std::vector<Twist> twists;  // at the centers of mass

  explicit PieceStart(const StageState& state)
      : time(state.time), poses(state.node_of.size()), twists(state.node_of.size()) {
    for (const StagedBody& body : state.bodies) {
      if (!body.present) continue;
      poses[body.id.index] = state.world.motion(body.id).pose;
      twists[body.id.index] = state.world.twist(body.id);
    }
  }
};

/// How fast a contact closes if its bodies move like this, m/s. @param twist_of  at the center of mass
template <class TwistOf>
double closing_speed(const World& world, const Contact& contact, TwistOf&& twist_of) {
  const auto velocity = [&](BodyId body, const Vec3& point) {
    return velocity_at(twist_of(body), point - center_of(world.motion(body), world.mass(body).center));
  };
  double closing = 0;
  for (int i = 0; i < contact.manifold.count; ++i) {
    const Vec3& point = contact.manifold.points[static_cast<std::size_t>(i)].position;
    const Vec3 apart = velocity(contact.b, point) - velocity(contact.a, point);
    closing = std::max(closing, -contact.manifold.normal.dot(apart));
  }
  return closing;
}

/// If a contact closes faster than this times the length of a piece, it was not its weight that brought it there,
/// m/s^2.
double faster_than_weight(const StageState& state) {
  return 2 * state.gravity.norm() + 1e-4;
}

/// How much of a contact's impulse was the blow. What presses on for the rest of the piece is weight: without the
/// contact the two would have closed at the speed of the impact plus what they would have fallen after it, and the
/// same mass accounts for both parts. If the two part again, nothing was weight.
/// @param contact  presses
double part_of_blow(const StageState& state, const Contact& contact, const std::vector<Twist>& before, double dt) {
  constexpr double parts = 1e-3;  // of the speed at which they met
  const World& world = state.world;
  const double parting = closing_speed(world, contact, [&](BodyId body) {
    const Twist twist = world.twist(body);
    return Twist{-twist.linear, -twist.angular};
  });
  // What lay there from the start was not met; rounding parts it all the same.
  const double least = contact.approach_speed > 0 ? contact.approach_speed : faster_than_weight(state) * dt;
  if (parting > parts * least) return 1;
  const auto falls = [&](BodyId body) {
    return world.owner(body) == Owner::free && !world.is_fixed(body) && state.presses[body.index] == 1;
  };
  const Vec3 apart =
      (falls(contact.b) ? state.gravity : Vec3(0, 0, 0)) - (falls(contact.a) ? state.gravity : Vec3(0, 0, 0));
  const double unhindered = closing_speed(world, contact, [&](BodyId body) { return before[body.index]; }) -
                            contact.manifold.normal.dot(apart) * dt;
  if (!(contact.approach_speed > 0))
    return unhindered > faster_than_weight(state) * dt ? 1 : 0;  // swung in along an arc, or rests
  return unhindered > contact.approach_speed ? contact.approach_speed / unhindered : 1;
}

/// When in the piece two bodies met that touch at its end: their gap at the start closed at speeds between those then
/// and at the impact, as under a constant force.
double time_of_impact(const StageState& state, const Contact& contact, const PieceStart& before) {
  const World& world = state.world;
  const auto pose = [&](BodyId body) -> const Pose& { return before.poses[body.index]; };
  const Manifold apart =
      collide(world.shape(contact.a), pose(contact.a), world.shape(contact.b), pose(contact.b), infinity);
  double time = state.time;
  for (int i = 0; i < apart.count; ++i) {
    const ContactPoint& point = apart.points[static_cast<std::size_t>(i)];
    const auto velocity = [&](BodyId body) {
      const Pose& at = pose(body);
      return velocity_at(before.twists[body.index],
                         point.position - (at.position + at.rotation * world.mass(body).center));
    };
    const double closing =
        contact.approach_speed - contact.manifold.normal.dot(velocity(contact.b) - velocity(contact.a));
    const double gap = std::max(0.0, -point.penetration);
    if (gap == 0) return before.time;
    if (closing > 0) time = std::min(time, before.time + 2 * gap / closing);
  }
  return time;
}

/// Adds the impulses of contacts in the last piece to the blows they belong to, and reports those that are over. A
/// blow that falls on the end of a piece continues in the next: it is over when the bodies no longer close.
///
/// Each has the time at which the bodies met, which may lie in an earlier piece than the one at whose end it is
/// reported.
void follow_blows(StageState& state, const PieceStart& before, double step, std::vector<Happening>& happenings) {
  const double dt = state.time - before.time;
  constexpr double closes = 1e-3;  // of the speed at which they met
  std::vector<Blow> going_on;
  const auto tell = [&](const Blow& blow) {
    StageEvent event;
    event.time = blow.met;
    event.name = "contact";
    event.nodes = {state.node_of[blow.a.index], state.node_of[blow.b.index]};
    event.impulse = blow.impulse;
    Happening& happening = happenings.emplace_back();
    happening.time = state.time;
    happening.what = std::move(event);
  };
  const auto now = [&](BodyId body) { return state.world.twist(body); };
  std::vector<char> met(state.blows.size(), 0);
  visit_pairs(state.world.contacts(), [&](std::span<const Contact> contacts) {
    const Blow* known = blow_of(state, contacts[0].a, contacts[0].b);
    const bool goes_on = known != nullptr, presses = std::ranges::any_of(contacts, pressing);
    if (goes_on) met[static_cast<std::size_t>(known - state.blows.data())] = 1;
    const auto counts = [&](const Contact& contact) { return pressing(contact) && (goes_on || contact.began); };
    if (!goes_on && std::ranges::none_of(contacts, counts)) return;
    Blow blow = goes_on ? *known : Blow{.a = contacts[0].a, .b = contacts[0].b, .began = state.time};
    if (!goes_on)
      blow.met = time_of_impact(state, *std::ranges::max_element(contacts, {}, &Contact::approach_speed), before);
    double closing = 0;
    for (const Contact& contact : contacts) {
      if (counts(contact)) blow.impulse += contact.impulse * part_of_blow(state, contact, before.twists, dt);
      blow.speed = std::max(blow.speed, contact.approach_speed);
      closing = std::max(closing, closing_speed(state.world, contact, now));
    }
    if (blow.impulse > 0) {
      if (state.time - blow.began < 0.999 * step && closing > closes * blow.speed)
        going_on.push_back(blow);
      else
        tell(blow);
    } else if (presses && closing > faster_than_weight(state) * dt) {
      blow.began = state.time;  // only grazed so far: a body that swings in fast strikes in the next piece
      going_on.push_back(blow);
    }
  });
  for (std::size_t i = 0; i < met.size(); ++i)
    if (!met[i] && state.blows[i].impulse > 0 && state.world.contains(state.blows[i].a) &&
        state.world.contains(state.blows[i].b))
      tell(state.blows[i]);
  std::ranges::sort(going_on, {}, pair_of);
  state.blows = std::move(going_on);
}

/// Moves the world to `end`, after its bodies have got their targets.
void step_told_world(StageState& state, double end, double step, std::vector<Happening>& happenings) {
  const PieceStart before(state);
  const ParticleStep particles(state);
  drive_vehicles(state, end - state.time);
  state.world.step(end - state.time, step);
  state.complementarity = std::max(state.complementarity, complementarity_residual(state.world));
  state.time = end;
  particles.take(state);
  state.presses.assign(state.node_of.size(), 0);
  visit_pairs(state.world.contacts(), [&](std::span<const Contact> contacts) {
    if (std::ranges::any_of(contacts, pressing))
      for (const BodyId body : {contacts[0].a, contacts[0].b}) ++state.presses[body.index];
  });
  for (StagedBody& body : state.bodies)
    if (body.present)
      body.saturated_for = state.world.saturated(body.id) ? body.saturated_for + (end - before.time) : 0;
  follow_blows(state, before, step, happenings);
  report_broken_joints(state, happenings);
  report_tears(state, happenings);
  report_sensed(state, happenings);
  report_strains(state, happenings);
  end_passing(state);
}

void step_world(StageState& state, double end, double step, std::vector<Happening>& happenings) {
  set_targets(state, end);
  step_told_world(state, end, step, happenings);
}

/// Moves the world to just before an impact on a keyed body, which then leaves from its own path. The body stands still
/// meanwhile, so that nothing of the blow comes early: contacts are predicted as flat, and near ones may act too early.
void approach(StageState& state, BodyId body, double end, double step, std::vector<Happening>& happenings) {
  const bool presses = std::ranges::any_of(
      state.world.contacts(), [&](const Contact& c) { return (c.a == body || c.b == body) && c.impulse > 0; });
  set_targets(state, end);
  if (!presses) state.world.set_target(body, state.world.motion(body));
  step_told_world(state, end, step, happenings);
}

/// A contact between two bodies that physics does not move: the world does not report it.
void report_touch(const StageState& state, const Meeting& meeting, const Touch& touch,
                  std::vector<Happening>& happenings) {
  StageEvent event;
  event.time = state.time;
  event.name = "contact";
  event.nodes = {state.bodies[meeting.body].node, state.node_of[meeting.other.index]};
  event.impulse = touch.impulse;
  Happening& happening = happenings.emplace_back();
  happening.time = state.time;
  happening.what.emplace<StageEvent>(std::move(event));
}

/// Moves `state` to the first impact before `end` at which a rule frees its keyed body, and fires it there. The rule is
/// judged by the whole blow that the body would take if it were free; otherwise what struck it would bounce off an
/// infinite mass, and the difference in momentum would vanish. @return whether there was one; if not, `state` is as
/// before
bool fire_at_impact(StageState& state, double end, double step, std::vector<Happening>& happenings) {
  std::vector<char> watched(state.bodies.size(), 0);
  bool any = false;
  for (const ArmedRule& armed : state.armed) {
    // What was vetoed is tried again at each instant, blow or none.
    if (!has_contact_trigger(*state.rules[armed.rule]) || !waits(state, armed) || armed.vetoed) continue;
    if (state.world.owner(state.bodies[armed.body].id) != Owner::keyed) continue;
    watched[armed.body] = 1;
    any = true;
  }
  if (!any) return false;
  for (const Meeting& meeting : meetings(state, end, watched)) {
    const BodyId body = state.bodies[meeting.body].id;
    // No piece is shorter than a sliver.
    const double time = std::min(meeting.time, end - 2 * sliver);
    StageState there = state;
    std::vector<Happening> before;
    if (time - state.time >= sliver) approach(there, body, time, step, before);
    std::optional<Touch> touch;
    for (std::size_t i = 0; i < there.armed.size(); ++i) {
      ArmedRule& armed = there.armed[i];
      if (armed.body != meeting.body || !has_contact_trigger(*there.rules[armed.rule]) || !waits(there, armed) ||
          armed.vetoed)
        continue;
      const StageState trial = tried(there, i, there.time + step / 16, step);
      ArmedRule after = trial.armed[i];
      const ContactsByBody contacts(trial);
      const bool fires = latch(after, trial, contacts);
      state.armed[i].attempt = armed.attempt = after.attempt;
      if (!fires) {
        state.armed[i].latched = armed.latched = after.latched;  // of an `all`: this trigger has come, others have not
        for (const Touch& one : touches(trial, contacts, body))
          if (one.other == meeting.other) touch = one;
        continue;
      }
      happenings.insert(happenings.end(), before.begin(), before.end());
      fire_rule(there, there.armed[i], Cause::contact, there.time, step, happenings);
      state = std::move(there);
      return true;
    }
    const bool unmoved = there.world.is_fixed(meeting.other) || there.world.owner(meeting.other) == Owner::keyed;
    if (touch && unmoved) report_touch(there, meeting, *touch, happenings);
  }
  return false;
}

}  // namespace

void move_world(StageState& state, double end, double step, std::vector<Happening>& happenings) {
  const bool watched = std::ranges::any_of(state.armed, [&](const ArmedRule& armed) {
    return !armed.done && has_contact_trigger(*state.rules[armed.rule]);
  });
  if (!watched) {
    step_world(state, end, step, happenings);
    return;
  }
  // Rules that take a body and give it back at one and the same contact would do so for ever.
  const std::size_t most_at_once = 8 + 2 * state.armed.size();
  if (static_cast<std::size_t>(state.at_once) < most_at_once && fire_at_impact(state, end, step, happenings)) return;

  // A body that is pressed without a blow, or struck through others, is judged by its impulse in the piece, and freed
  // at the piece's start. Freeing one may strike the next, so this repeats until no more are freed; each rule fires
  // once.
  StageState start = state;
  std::vector<Happening> moved;
  step_world(state, end, step, moved);
  std::vector<char> judged(state.armed.size(), 0);
  std::vector<Happening> fired;
  for (bool freed = true; freed;) {
    freed = false;
    const ContactsByBody contacts(state);
    for (std::size_t i = 0; i < state.armed.size() && !freed; ++i) {
      if (judged[i] || !has_contact_trigger(*state.rules[state.armed[i].rule]) || !waits(state, state.armed[i]))
        continue;
      if (state.world.owner(state.bodies[state.armed[i].body].id) != Owner::keyed) {
        static_cast<void>(latch(state.armed[i], state, contacts));  // fired at the end of the piece, with all others
        continue;
      }
      if (!any_pulled(state, contacts, state.armed[i])) continue;
      const StageState trial = tried(start, i, end, step);
      ArmedRule after = trial.armed[i];
      const bool fires = latch(after, trial, ContactsByBody(trial));
      start.armed[i].attempt = state.armed[i].attempt = after.attempt;
      if (!fires) {
        state.armed[i].latched = start.armed[i].latched = after.latched;
        continue;
      }
      fire_rule(start, start.armed[i], Cause::contact, start.time, step, fired);
      judged[i] = 1;
      freed = true;
      state = start;
      moved.clear();
      step_world(state, end, step, moved);
    }
  }
  happenings.insert(happenings.end(), fired.begin(), fired.end());
  happenings.insert(happenings.end(), moved.begin(), moved.end());
}

}  // namespace tweenfall::staging
