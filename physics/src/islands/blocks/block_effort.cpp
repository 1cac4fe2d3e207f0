#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>

#include "contacts/combine.h"
#include "islands/blocks/block_solver.h"
#include "islands/pinched.h"
#include "islands/shifted_apart.h"
#include "step/softness.h"
#include "step/solver.h"

/// Decides which islands are solved in blocks, and how thoroughly.

namespace tweenfall::blocks {

using contacts::ContactConstraint;
using state::Body;

namespace {

/// Sub-steps per step. Tall stacks need many, and few contacts can afford them: a stack of forty falls with sixteen
/// and stands with 24 to a fifth of a millimeter; a pyramid of fifty rows leans and falls with eight. A pile whose
/// weight passes through fewer contacts needs fewer.
constexpr std::size_t few = 128;
constexpr std::uint32_t deep_of_few = 20, deep_of_many = 50;
constexpr int sub_steps_of_few = 24, fewest_of_few = 14, fewest_of_turning = 4;
constexpr int sub_steps_of_many = 10, fewest_of_many = 4;
/// With so few contacts, sub-steps are those of `Solver`, with several passes in each. With half as many, a box in a
/// press is shot away, and a stack of two sinks a tenth of a millimeter. Where something turns nothing rests: half as
/// many are enough, if nothing springs back from it, or if there is but one contact, with as many passes as it takes.
constexpr std::size_t small = 8;
constexpr int sub_steps_of_small = 8, sub_steps_of_turning = 4;
/// A change below this part of the speed that a contact's impulses give in a sub-step no longer matters: for a body
/// that lies or rolls, a few hundredths of a micrometer per second; for one that turns, a few micrometers.
constexpr double settled_of_resting = 1e-6, settled_of_turning = 1e-4;
/// With joints, an island solved all at once needs few sub-steps, but blows that it passes on need short ones, s. A
/// caller who takes short steps wants more accuracy.
constexpr double longest_of_jointed = 1.0 / 180, long_step = 1.0 / 100;
constexpr int fewest_of_jointed = 3, fewest_of_jointed_in_short = 4;
/// A whole figure may rest on its hand: with contacts as soft as for the hand alone, it would sink in.
constexpr double giving_of_jointed = 0.25;
/// What is stacked on jointed bodies would tremble for ever on contacts that hard; and with as many contacts among what
/// lies there, few sub-steps let ten boxes fall at 60 Hz, where five let them stand.
constexpr std::size_t piled_up = 6;
constexpr int sub_steps_of_piled_up = 6;
/// Rows are prepared again when a body has turned by this since, rad.
constexpr double turned_enough = 0.02, turned_enough_of_small = 0.002;
/// Rows cannot follow a body that turns by more than this in a sub-step, rad.
constexpr double followable = 0.5, followable_of_small = 0.05, followable_of_jointed = 0.3;

/// A body that turns by more than this in a step is not at rest, rad: there is no rest that needs micrometers.
constexpr double turns = 1e-3;
constexpr int passes_of_meeting = 2;

/// Only even numbers: islands with the same number are solved together.
int sub_steps_of_depth(std::uint32_t depth, int fewest) {
  const std::uint32_t deep = std::min(depth, deep_of_few);
  const std::uint32_t more = static_cast<std::uint32_t>(sub_steps_of_few - fewest);
  const std::uint32_t steps = deep * deep * more / (deep_of_few * deep_of_few);
  return fewest + static_cast<int>((steps + 1) / 2 * 2);
}

int sub_steps_of_deep_heap(std::uint32_t depth) {
  const std::uint32_t steps = std::min(depth, deep_of_many) * (sub_steps_of_many - fewest_of_many);
  return fewest_of_many + static_cast<int>((steps + deep_of_many - 1) / deep_of_many);
}

/// Whether a body in it turns that is not round.
bool has_turning(const islands::IslandContents& island, const std::vector<Body>& bodies, double dt) {
  const auto its = [&](std::uint32_t index) {
    const Body& body = bodies[index];
    return !body.immovable() && !body.round() && body.twist.angular.squaredNorm() * dt * dt > turns * turns;
  };
  return std::any_of(island.contacts.begin(), island.contacts.end(),
                     [&](const ContactConstraint* contact) { return its(contact->a) || its(contact->b); });
}

/// Whether it, or its surface, moves by its own will.
bool drives(const Body& body) {
  return body.displaces() || body.conveys;
}

/// Whether the heaviest body has more than `most` times the mass of the lightest: few passes do not get near what that
/// one bears.
bool unlike(const islands::IslandContents& island, const std::vector<Body>& bodies, double most) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const ContactConstraint* contact : island.contacts)
    for (const std::uint32_t index : {contact->a, contact->b}) {
      const Body& body = bodies[index];
      if (body.immovable()) continue;
      least = std::min(least, body.mass().mass);
      greatest = std::max(greatest, body.mass().mass);
    }
  return greatest > most * least;
}

/// Whether nearly all contacts are those of one body, for which few passes do not converge: each undoes what the ones
/// before it did.
bool has_hub(const islands::IslandContents& island, const std::vector<Body>& bodies) {
  const std::size_t count = island.contacts.size();
  for (const std::size_t i : {std::size_t{0}, count / 2, count - 1})
    for (const std::uint32_t end : {island.contacts[i]->a, island.contacts[i]->b}) {
      if (bodies[end].immovable()) continue;
      const auto its = std::count_if(island.contacts.begin(), island.contacts.end(),
                                     [end](const auto* contact) { return contact->a == end || contact->b == end; });
      if (4 * static_cast<std::size_t>(its) >= 3 * count) return true;
    }
  return false;
}

/// Whether a jointed island contains what affects everything solved with it: rebounds, drives, springs, led bodies.
bool is_apart(const islands::IslandContents& island, const std::vector<Body>& bodies) {
  const auto acts = [&](std::uint32_t index) {
    return drives(bodies[index]) || bodies[index].drive.owner() == Owner::driven;
  };
  if (!island.springs.empty()) return true;
  for (const ContactConstraint* contact : island.contacts)
    if (contact->restitution > 0 || contact->rolling_friction > 0 || contact->spinning_friction > 0 ||
        acts(contact->a) || acts(contact->b))
      return true;
  return std::any_of(island.joints.begin(), island.joints.end(), [&](const joints::JointLink* link) {
    return acts(link->b) || (link->a != joints::JointLink::world && acts(link->a));
  });
}

/// Contacts of movable bodies that no joint holds: of what lies on jointed bodies, or is pushed by them.
std::size_t loose_contacts(const islands::IslandContents& island, const std::vector<Body>& bodies,
                           std::vector<std::uint32_t>& jointed) {
  // Most figures touch nothing but the ground.
  if (std::none_of(island.contacts.begin(), island.contacts.end(), [&](const ContactConstraint* contact) {
        return !bodies[contact->a].immovable() && !bodies[contact->b].immovable();
      }))
    return 0;
  jointed.clear();
  for (const joints::JointLink* link : island.joints)
    for (const std::uint32_t end : {link->a, link->b})
      if (end != joints::JointLink::world) jointed.push_back(end);
  std::sort(jointed.begin(), jointed.end());
  const auto loose = [&](std::uint32_t index) {
    return !bodies[index].immovable() && !std::binary_search(jointed.begin(), jointed.end(), index);
  };
  return static_cast<std::size_t>(
      std::count_if(island.contacts.begin(), island.contacts.end(),
                    [&](const ContactConstraint* contact) { return loose(contact->a) && loose(contact->b); }));
}

/// Fastest spin of a jointed body with different moments about its axes, rad/s.
double fastest_spin(const islands::IslandContents& island, const std::vector<Body>& bodies) {
  double fastest = 0;
  for (const joints::JointLink* link : island.joints)
    for (const std::uint32_t end : {link->a, link->b})
      if (end != joints::JointLink::world && !bodies[end].immovable() && !bodies[end].spherical())
        fastest = std::max(fastest, bodies[end].twist.angular.squaredNorm());
  return std::sqrt(fastest);
}

}  // namespace

std::optional<BlockSolver::Effort> BlockSolver::effort_for(const islands::IslandContents& island,
                                                           const std::vector<Body>& bodies,
                                                           const std::vector<forces::Load>& loads,
                                                           const WorldSettings& settings, double dt,
                                                           const threads::Workers& workers) {
  if (island.joints.empty() && !island.springs.empty()) return std::nullopt;
  if (island.joints.empty() && island.contacts.size() <= step::Solver::to_the_end &&
      unlike(island, bodies, island.contacts.size() <= small ? 10 : 30))
    return std::nullopt;
  if (island.joints.empty() && island.contacts.size() > small && island.contacts.size() <= step::Solver::to_the_end &&
      has_hub(island, bodies))
    return std::nullopt;
  if (island.joints.empty() && island.contacts.size() <= small)
    return effort_of_small(island, bodies, loads, settings, dt);
  return effort_of_large(island, bodies, settings, dt, workers);
}

std::optional<BlockSolver::Effort> BlockSolver::effort_of_large(const islands::IslandContents& island,
                                                                const std::vector<Body>& bodies,
                                                                const WorldSettings& settings, double dt,
                                                                const threads::Workers& workers) {
  const int passes = std::max(2, settings.iterations / sub_steps_of_many);
  Effort effort;
  effort.softening = passes - passes / 2;
  effort.relaxing = passes / 2;
  effort.rebound_passes = std::max(1, settings.iterations / 4);
  effort.turned_enough = turned_enough;
  effort.heap = island.contacts.size() > few;
  effort.alone = effort.heap;
  if (!island.joints.empty()) {
    effort.alone = effort.alone || is_apart(island, bodies);
    const std::size_t loose = effort.heap ? 0 : loose_contacts(island, bodies, held_by_joints_);
    effort.giving = loose > 0 ? 1 : giving_of_jointed;
    const int fewest = dt > long_step ? fewest_of_jointed : fewest_of_jointed_in_short;
    const double wanted = std::max(std::ceil(dt / longest_of_jointed - 1e-6),
                                   std::ceil(fastest_spin(island, bodies) * dt / followable_of_jointed));
    effort.sub_steps = std::max(fewest, static_cast<int>(std::min(wanted, double{sub_steps_of_few})));
    if (loose >= piled_up) effort.sub_steps = std::max(effort.sub_steps, sub_steps_of_piled_up);
    return effort;
  }
  const std::uint32_t depth = depth_.of(island.contacts, bodies, workers);
  effort.sub_steps =
      effort.heap ? sub_steps_of_deep_heap(depth)
                  : sub_steps_of_depth(depth, has_turning(island, bodies, dt) ? fewest_of_turning : fewest_of_few);
  const double h = dt / effort.sub_steps;
  std::atomic<bool> unfit = false, driven = false, within = false, carried = false;
  workers.ranges(island.contacts.size(), worth_a_part, [&](std::size_t begin, std::size_t end) {
    for (const ContactConstraint* contact : island.contacts.subspan(begin, end - begin)) {
      bool fits = contact->rolling_friction == 0 && contact->spinning_friction == 0;
      if (contact->within) within.store(true, std::memory_order_relaxed);
      for (const std::uint32_t index : {contact->a, contact->b}) {
        const Body& body = bodies[index];
        if (drives(body)) driven.store(true, std::memory_order_relaxed);
        if (body.immovable() || body.asleep) carried.store(true, std::memory_order_relaxed);
        fits = fits && (body.immovable() ||
                        (body.drive.owner() != Owner::driven && !(body.twist.angular.norm() * h > followable)));
      }
      if (!fits) unfit.store(true, std::memory_order_relaxed);
    }
  });
  if (unfit) return std::nullopt;
  effort.alone = effort.alone || driven;
  if (within && carried) {
    islands::ShiftedApart::mark(island.contacts, workers);
    shifts_ = true;
  }
  return effort;
}

std::optional<BlockSolver::Effort> BlockSolver::effort_of_small(const islands::IslandContents& island,
                                                                const std::vector<Body>& bodies,
                                                                const std::vector<forces::Load>& loads,
                                                                const WorldSettings& settings, double dt) const {
  Effort effort;
  effort.single = island.contacts.size() == 1;
  effort.sub_steps = sub_steps_of_small;
  effort.softening = std::max(1, settings.iterations / (effort.single ? 5 : 10));
  effort.relaxing = 2 * effort.softening;
  effort.rebound_passes = settings.iterations;
  effort.turned_enough = turned_enough_of_small;
  const double h = dt / effort.sub_steps;
  bool meets = false, is_pushed_out = false, is_dull = true;
  double fastest = 0;
  for (ContactConstraint* contact : island.contacts) {
    if (contact->rolling_friction > 0) return std::nullopt;
    effort.spins = effort.spins || contact->spinning_friction > 0;
    const Body &a = bodies[contact->a], &b = bodies[contact->b];
    for (const Body* body : {&a, &b}) {
      if (drives(*body)) return std::nullopt;
      if (body->immovable()) continue;
      const double spin = body->twist.angular.norm();
      if (body->drive.owner() == Owner::driven || body->makeup->turned || spin * h > followable_of_small)
        return std::nullopt;
      if (!body->round()) fastest = std::max(fastest, spin);
    }
    const contacts::Closing closing =
        contacts::closing_of(contact->manifold.normal, loads[contact->a], loads[contact->b], dt * parts_);
    contacts::foresee(*contact, a.twist, b.twist, closing, dt);
    // Deeper than what falls for a step or two, whatever its direction: no rest is like that. What moves anyway need
    // not go straight.
    const double whole = dt * parts_;
    const double pull = std::max(loads[contact->a].acceleration.norm(), loads[contact->b].acceleration.norm());
    const double fallen = 2 * pull * whole * whole, moving = 4 * pull * whole;
    const bool moves = std::max(a.twist.linear.norm(), b.twist.linear.norm()) > moving;
    for (int i = 0; i < contact->count && !moves; ++i)
      is_pushed_out = is_pushed_out || contact->points[static_cast<std::size_t>(i)].start_gap < -fallen;
    is_dull = is_dull && !(contact->restitution > contacts::dull);
    if (!contact->impact) continue;
    // The blow of two bodies, and their rebound, is solved to the end.
    if (island.contacts.size() == 1 || contact->restitution > contacts::dull) return std::nullopt;
    meets = true;
  }
  if (islands::is_wedged(island.contacts, bodies,
                         step::soft_contacts(settings.push_out_speed, dt, effort.sub_steps, parts_).deep()))
    return std::nullopt;
  // A turning body keeps the rest of an uneven push, since it lets go of what it touches; the same rest would move
  // sideways what is being pushed out.
  const bool is_turning = fastest * dt > turns;
  if (is_turning) effort.turned_enough = turned_enough;
  effort.settled = is_turning ? settled_of_turning : settled_of_resting;
  if ((is_turning && effort.single) || is_pushed_out) effort.softening = effort.relaxing = 3 * settings.iterations;
  if (is_turning && !is_pushed_out) {
    if ((effort.single || is_dull) && fastest * dt <= followable_of_small * sub_steps_of_turning)
      effort.sub_steps = sub_steps_of_turning;
    if (!effort.single) effort.relaxing = effort.softening;
  }
  // Bodies that just meet have no rest yet that many passes would find.
  if (meets) effort.softening = effort.relaxing = passes_of_meeting;
  return effort;
}

}  // namespace tweenfall::blocks
