#include "islands/free_islands.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "joints/kinds/kinds.h"

namespace tweenfall::islands {

namespace {

using state::Body;

/// Share of the inertia that keeps the equations solvable if no turn about some axis moves anything.
constexpr double hardly = 1e-6;
/// Number of refinements that remove the error of this.
constexpr int refinements = 4;
/// Rounding of the angular momentum, relative.
constexpr double rounding = 1e-15;
/// Rounding of the energy, relative.
constexpr double rounding_of_energy = 1e-14;
/// Greatest relative increase of the energy.
constexpr double little = 0.01;

bool pushed(const contacts::ContactConstraint& contact) {
  for (int i = 0; i < contact.count; ++i)
    if (contact.points[static_cast<std::size_t>(i)].total_normal > 0) return true;
  return false;
}

bool rubbed(const contacts::ContactConstraint& contact) {
  for (int i = 0; i < contact.count; ++i)
    if (contact.points[static_cast<std::size_t>(i)].total_friction != Vec3::Zero()) return true;
  return contact.total_rolling != Vec3::Zero() || contact.spinning_friction > 0;
}

/// A ball that no contact turns without friction.
bool slick(const Body& body) {
  return body.spherical() && std::holds_alternative<Sphere>(body.shape().solid) && body.mass().center == Vec3::Zero();
}

/// Whether a load changes the momentum of bodies relative to each other.
bool disturbs(const forces::Load& load, const Vec3& acceleration) {
  return load.acceleration != acceleration || load.end_acceleration != acceleration || load.torque != Vec3::Zero() ||
         load.drag > 0 || load.angular_drag > 0 || load.angular_damping > 0;
}

/// Whether a joint takes from one end what it gives to the other; what reaches the world by a housing or a pulley does
/// not count.
bool between_bodies(const joints::JointLink& link) {
  const JointKind& kind = link.joint->settings.kind;
  return link.a != joints::JointLink::world && !std::holds_alternative<GearJoint>(kind) &&
         !std::holds_alternative<PulleyJoint>(kind);
}

/// Angular momentum about the common center of mass, and energy without that of the center, except for spins that
/// nothing changed.
struct Whole {
  double mass = 0;
  Vec3 center{0, 0, 0}, velocity{0, 0, 0}, momentum{0, 0, 0};
  double size = 0;  ///< size of the terms of the momentum
  double energy = 0;
};

}  // namespace

bool FreeIslands::gather(const IslandContents& island, const std::vector<Body>& bodies,
                         const std::vector<forces::Load>& loads, const std::vector<char>& moved) {
  if (!island.springs.empty()) return false;
  members_.clear();
  const auto clear = [this] {
    for (const Member& member : members_) slots_[member.index] = nobody;
  };
  const auto slot_of = [this](std::uint32_t index) {
    if (slots_[index] == nobody) {
      slots_[index] = static_cast<std::uint32_t>(members_.size());
      members_.emplace_back().index = index;
    }
    return slots_[index];
  };
  // Contacts that only pushed bodies apart count too, although they leave no impulse.
  const auto joins = [&](const contacts::ContactConstraint& contact) {
    return pushed(contact) || (moved[contact.a] != 0 && moved[contact.b] != 0);
  };
  const auto held = [&](std::uint32_t index, std::uint32_t other) {
    const Body& body = bodies[index];
    return moved[index] == 0 || body.drive.owner() == Owner::driven || body.conveys ||
           disturbs(loads[index], loads[other].acceleration);
  };
  // A joint that did nothing left at least one of its ends alone.
  const auto acted = [&](const joints::JointLink& link) {
    const auto has_moved = [&](std::uint32_t end) {
      return end == joints::JointLink::world || bodies[end].immovable() || moved[end] != 0;
    };
    return has_moved(link.a) && has_moved(link.b);
  };
  for (const joints::JointLink* link : island.joints) {
    if (!acted(*link)) continue;
    if (!between_bodies(*link) || held(link->a, link->b) || held(link->b, link->b)) {
      clear();
      return false;
    }
    for (const std::uint32_t index : {link->a, link->b}) {
      Member& member = members_[slot_of(index)];
      member.gripped = member.jointed = true;
      member.driven = member.driven || joints::gives_energy(link->joint->settings.kind);
    }
  }
  for (const contacts::ContactConstraint* contact : island.contacts) {
    if (!joins(*contact)) continue;
    if (held(contact->a, contact->a) || held(contact->b, contact->a)) {
      clear();
      return false;
    }
    const bool rubs = rubbed(*contact);
    for (const std::uint32_t index : {contact->a, contact->b}) {
      Member& member = members_[slot_of(index)];
      member.gripped = member.gripped || rubs || !slick(bodies[index]);
    }
  }
  if (members_.empty()) return false;
  groups_.reset(members_.size());
  for (const joints::JointLink* link : island.joints)
    if (acted(*link)) groups_.join(slots_[link->a], slots_[link->b]);
  for (const contacts::ContactConstraint* contact : island.contacts)
    if (joins(*contact)) groups_.join(slots_[contact->a], slots_[contact->b]);
  return true;
}

void FreeIslands::keep_all(const IslandContents& island, std::vector<Body>& bodies, Integrator integrator, double dt) {
  for (Member& member : members_) member.left = bodies[member.index].twist.linear;
  for (std::uint32_t root = 0; root < members_.size(); ++root) {
    if (groups_.of(root) != root) continue;
    group_.clear();
    for (std::uint32_t i = root; i < members_.size(); ++i)
      if (groups_.of(i) == root) group_.push_back(members_[i]);
    keep_group(group_, bodies, integrator, dt);
  }
  if (!handed_on_) handed_on_ = std::make_unique<HandedOn>();
  handed_on_->begin(members_.size());
  for (std::uint32_t i = 0; i < members_.size(); ++i) {
    const Body& body = bodies[members_[i].index];
    handed_on_->note(i, body.mass().mass * (body.twist.linear - members_[i].left));
  }
  handed_on_->hand_on(island, dt, [this](std::uint32_t index) { return slots_[index]; });
}

void FreeIslands::keep_group(std::span<const Member> group, std::vector<Body>& bodies, Integrator integrator,
                             double dt) {
  const auto whole_of = [&](const auto& state_of) {
    Whole whole;
    for (const Member& member : group) {
      const Body& body = bodies[member.index];
      const FreeStart& at = state_of(member);
      whole.mass += body.mass().mass;
      whole.center += body.mass().mass * at.center;
      whole.velocity += body.mass().mass * at.twist.linear;
    }
    whole.center /= whole.mass;
    whole.velocity /= whole.mass;
    for (const Member& member : group) {
      const Body& body = bodies[member.index];
      const FreeStart& at = state_of(member);
      const Vec3 velocity = at.twist.linear - whole.velocity;
      const Vec3 orbit = body.mass().mass * (at.center - whole.center).cross(velocity);
      whole.momentum += orbit;
      whole.size += orbit.norm();
      whole.energy += 0.5 * body.mass().mass * velocity.squaredNorm();
      if (!member.gripped) continue;
      const Vec3 spin = body.world_inertia(at.rotation) * at.twist.angular;
      whole.momentum += spin;
      whole.size += spin.norm();
      whole.energy += 0.5 * spin.dot(at.twist.angular);
    }
    return whole;
  };
  const Whole before = whole_of([](const Member& member) -> const FreeStart& { return member.start; });
  const auto now = [&](const Member& member) -> FreeStart {
    const Body& body = bodies[member.index];
    return {body.center, body.motion.pose.rotation, body.twist};
  };
  const Whole after = whole_of(now);
  const Vec3 mean =
      integrator == Integrator::semi_implicit_euler ? after.velocity : Vec3(0.5 * (before.velocity + after.velocity));
  const Vec3 astray = before.center + mean * dt - after.center;
  const bool strays = astray.norm() > rounding * (before.center.norm() + (mean * dt).norm());
  const Vec3 moved_by = strays ? astray : Vec3(0, 0, 0);
  if (strays)
    for (const Member& member : group) {
      Body& body = bodies[member.index];
      body.center += astray;
      body.follow_center(body.motion.pose.rotation);
    }
  // A blow counts with the energy that it had where the solver left the center, which may be lower than here.
  const bool jointed = std::any_of(group.begin(), group.end(), [](const Member& member) { return member.jointed; });
  const bool driven = std::any_of(group.begin(), group.end(), [](const Member& member) { return member.driven; });
  const double most = (1 + (jointed ? passable_gain : rounding_of_energy)) * before.energy;
  const double gained = driven || after.energy <= most ? 0 : after.energy - (jointed ? most : before.energy);
  if (gained == 0 && (after.momentum - before.momentum).norm() <= rounding * std::max(before.size, after.size)) return;
  const auto arm_of = [center = Vec3(after.center + moved_by)](const Body& body) -> Vec3 {
    return body.center - center;
  };
  Mat3 inertia = Mat3::Zero();
  for (const Member& member : group) {
    const Body& body = bodies[member.index];
    const Vec3 arm = arm_of(body);
    inertia += body.mass().mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
    if (member.gripped) inertia += body.world_inertia(body.motion.pose.rotation);
  }
  const Mat3 solvable = inertia + hardly * inertia.trace() * Mat3::Identity();
  const Mat3 inverse = solvable.inverse();
  const auto turning = [&](const Vec3& momentum) -> Vec3 {
    Vec3 turn = inverse * momentum;
    for (int i = 0; i < refinements; ++i) turn += inverse * (momentum - inertia * turn);
    return turn;
  };
  // Their motion besides the common turn has no angular momentum, and supplies the energy.
  const Vec3 turned = turning(after.momentum), wanted = turning(before.momentum);
  const auto besides = [&](const Member& member) -> Twist {
    const Body& body = bodies[member.index];
    return {body.twist.linear - after.velocity - turned.cross(arm_of(body)), body.twist.angular - turned};
  };
  double energy = 0;
  for (const Member& member : group) {
    const Body& body = bodies[member.index];
    const Twist twist = besides(member);
    energy += 0.5 * body.mass().mass * twist.linear.squaredNorm();
    if (member.gripped)
      energy += 0.5 * twist.angular.dot(body.world_inertia(body.motion.pose.rotation) * twist.angular);
  }
  const double needed = 0.5 * (wanted.dot(before.momentum) - turned.dot(after.momentum)) + gained;
  // If there is little such motion, it cannot supply as much.
  const double share =
      needed > 0 || -needed < little * energy ? std::sqrt(std::max(0.0, 1 - needed / std::max(energy, needed))) : 1;
  Mat3 own = Mat3::Zero();
  for (const Member& member : group) {
    Body& body = bodies[member.index];
    const Twist twist = besides(member);
    body.twist.linear = after.velocity + wanted.cross(arm_of(body)) + share * twist.linear;
    body.twist.angular = member.gripped ? Vec3(wanted + share * twist.angular) : member.start.twist.angular;
    own += body.world_inertia(body.motion.pose.rotation);
  }
  // Balls in a row cannot turn about the row as a whole: each turns by itself to make up what is left.
  const Vec3 left = own.inverse() * (before.momentum - whole_of(now).momentum);
  for (const Member& member : group) {
    Body& body = bodies[member.index];
    body.twist.angular += left;
    body.follow_center(body.motion.pose.rotation);
  }
}

}  // namespace tweenfall::islands
