#include "islands/blocks/island_holds.h"

#include <cmath>

#include "forces/drive_law.h"
#include "step/contact_rows.h"

namespace tweenfall::blocks {

using contacts::ContactConstraint;
using state::Body;
using step::SolverBody;

namespace {

/// The body as rows that are solved one by one need it.
SolverBody seen(const IslandBody& entry, const BodyLanes& velocity) {
  SolverBody body;
  body.surface = entry.surface;
  body.inverse_mass = entry.inverse_mass;
  body.inverse_inertia = entry.inverse_inertia;
  body.center = entry.center;
  body.rotation = entry.rotation;
  body.linear = linear_of(velocity);
  body.angular = angular_of(velocity);
  return body;
}

void give(const SolverBody& body, BodyLanes& velocity) {
  set(velocity.linear, body.linear);
  set(velocity.angular, body.angular);
}

/// Lets `act` change the velocities of two bodies; the second place may stand for no body.
template <class Act>
void between(std::uint32_t a, std::uint32_t b, const std::vector<IslandBody>& entries,
             std::vector<BodyLanes>& velocities, const Act& act) {
  SolverBody first = seen(entries[a], velocities[a]);
  SolverBody second = seen(entries[b], velocities[b]);
  act(first, second);
  give(first, velocities[a]);
  if (b != 0) give(second, velocities[b]);
}

}  // namespace

void IslandHolds::gather(const islands::IslandContents& island, const std::vector<Body>& bodies,
                         const std::vector<std::uint32_t>& places, std::vector<IslandBody>& entries, bool driven,
                         double h) {
  h_ = h;
  drives_.clear();
  springs_.clear();
  for (std::uint32_t place = 1; driven && place < entries.size(); ++place) {
    IslandBody& entry = entries[place];
    const Body& body = bodies[entry.index];
    if (!entry.movable || body.drive.owner() != Owner::driven) continue;
    HeldByDrive& held = drives_.emplace_back();
    held.place = place;
    held.without_limit = std::isinf(body.drive.max_force) && std::isinf(body.drive.max_torque);
    entry.held = true;
    if (!held.without_limit) continue;
    entry.pulled = true;
    entry.given = 1 / (1 + forces::drive_law(body, entry.center, entry.rotation, h, 0).stiffness);
    entry.inverse_mass *= entry.given;
    entry.inverse_moment *= entry.given;
    entry.inverse_inertia *= entry.given;
  }
  for (step::SpringRow* row : island.springs) {
    const std::uint32_t a = places[row->a];
    const std::uint32_t b = row->b == step::SpringRow::world ? 0 : places[row->b];
    springs_.push_back({row, a, b});
    entries[a].held = true;
    if (b != 0) entries[b].held = true;
  }
}

void IslandHolds::gather(const ContactBlocks& contacts, bool rolls, double h) {
  rolls_.clear();
  if (!rolls) return;
  for (std::uint32_t i = 0; i < contacts.size(); ++i)
    for (std::uint32_t lane = 0; lane < lane_count; ++lane) {
      ContactConstraint* contact = contacts.origin(i)[lane];
      if (!contact || !(contact->rolling_friction > 0 || contact->spinning_friction > 0)) continue;
      const bool ball = i >= contacts.blocks.size();
      const std::size_t number = ball ? i - contacts.blocks.size() : i;
      rolls_.push_back({contact, static_cast<std::uint32_t>(lane_count) * i + lane,
                        ball ? contacts.balls[number].a[lane] : contacts.blocks[number].a[lane],
                        ball ? contacts.balls[number].b[lane] : contacts.blocks[number].b[lane]});
      const double ratio = contact->kept_step > h ? h / contact->kept_step : 1;
      contact->rolling_impulse = ratio * contact->kept_rolling;
      contact->spin_impulse = ratio * contact->kept_spin;
    }
}

void IslandHolds::begin_sub_step(const std::vector<Body>& bodies, const std::vector<IslandBody>& entries,
                                 std::vector<BodyLanes>& velocities, double ahead) {
  ahead_ = ahead;
  for (HeldByDrive& held : drives_) {
    held.impulse = held.angular_impulse = Vec3::Zero();
    if (!held.without_limit) continue;
    const IslandBody& entry = entries[held.place];
    BodyLanes& velocity = velocities[held.place];
    const forces::DriveLaw law = forces::drive_law(bodies[entry.index], entry.center, entry.rotation, h_, ahead);
    set(velocity.linear, entry.given * (linear_of(velocity) + law.linear));
    set(velocity.angular, entry.given * (angular_of(velocity) + law.angular));
  }
  for (const HeldBySpring& held : springs_)
    between(held.a, held.b, entries, velocities,
            [&](SolverBody& a, SolverBody& b) { held.row->begin(&a, held.b == 0 ? nullptr : &b, h_); });
  for (const Rolling& rolling : rolls_) {
    const ContactConstraint& contact = *rolling.contact;
    const Vec3 impulse = contact.rolling_impulse + contact.spin_impulse * contact.manifold.normal;
    between(rolling.a, rolling.b, entries, velocities, [&](SolverBody& a, SolverBody& b) {
      a.angular -= a.inverse_inertia * impulse;
      b.angular += b.inverse_inertia * impulse;
    });
  }
}

void IslandHolds::solve_drive(HeldByDrive& held, const std::vector<Body>& bodies, std::vector<IslandBody>& entries,
                              std::vector<BodyLanes>& velocities) const {
  IslandBody& entry = entries[held.place];
  const Body& body = bodies[entry.index];
  BodyLanes& velocity = velocities[held.place];
  const forces::DriveLaw law = forces::drive_law(body, entry.sub_step_center, entry.sub_step_rotation, h_, ahead_);
  entry.saturated = false;
  const auto within = [&entry](const Vec3& impulse, double most) -> Vec3 {
    const double size = impulse.norm();
    entry.saturated = entry.saturated || size > most;
    return size > most ? Vec3(impulse * (most / size)) : impulse;
  };
  // Velocity as it would be without the pull: everything else included, the drive's own impulse removed.
  const Vec3 linear = linear_of(velocity) - entry.inverse_mass * held.impulse;
  held.impulse =
      within(((linear + law.linear) / (1 + law.stiffness) - linear) / entry.inverse_mass, body.drive.max_force * h_);
  set(velocity.linear, linear + entry.inverse_mass * held.impulse);
  const Vec3 angular = angular_of(velocity) - entry.inverse_inertia * held.angular_impulse;
  held.angular_impulse =
      within(body.world_inertia(entry.sub_step_rotation) * ((angular + law.angular) / (1 + law.stiffness) - angular),
             body.drive.max_torque * h_);
  set(velocity.angular, angular + entry.inverse_inertia * held.angular_impulse);
}

void IslandHolds::solve(const std::vector<Body>& bodies, std::vector<IslandBody>& entries,
                        const ContactBlocks& contacts, std::vector<BodyLanes>& velocities) {
  for (const HeldBySpring& held : springs_)
    between(held.a, held.b, entries, velocities,
            [&](SolverBody& a, SolverBody& b) { held.row->solve(&a, held.b == 0 ? nullptr : &b); });
  for (HeldByDrive& held : drives_)
    if (!held.without_limit) solve_drive(held, bodies, entries, velocities);
  for (const Rolling& rolling : rolls_) {
    ContactConstraint& contact = *rolling.contact;
    double pressing = 0;
    for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(contact.count); ++i)
      pressing += contacts.impulse(rolling.lane, i);
    between(rolling.a, rolling.b, entries, velocities, [&](SolverBody& a, SolverBody& b) {
      if (contact.rolling_friction > 0)
        step::solve_rolling(a, b, contact.rolling_impulse, contact.rolling_friction * pressing);
      if (contact.spinning_friction > 0)
        step::solve_spinning(a, b, contact.manifold.normal, contact.spin_impulse, contact.spinning_friction * pressing);
    });
  }
}

void IslandHolds::add_up() const {
  for (const Rolling& rolling : rolls_) rolling.contact->total_rolling += rolling.contact->rolling_impulse;
}

void IslandHolds::store() const {
  for (const Rolling& rolling : rolls_) {
    ContactConstraint& contact = *rolling.contact;
    contact.kept_rolling = contact.rolling_impulse;
    contact.kept_spin = contact.spin_impulse;
  }
}

}  // namespace tweenfall::blocks
