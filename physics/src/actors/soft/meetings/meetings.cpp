#include "actors/soft/meetings/meetings.h"

#include <algorithm>
#include <cmath>

#include "actors/soft/meetings/between.h"
#include "collision/collide_pairs.h"

namespace tweenfall::soft {

namespace {

bool overlap(const Bounds& a, const Bounds& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

Pose pose_of(const state::Body& body, const Place& place) {
  return {place.center - place.rotation * body.mass().center, place.rotation, Vec3(1, 1, 1)};
}

/// Upper bound of how far a turn between two poses moves a point, m.
double swing(const Place& before, const Place& now, double arm) {
  return 2 * arm * std::min(1.0, (now.rotation.coeffs() - before.rotation.coeffs()).norm());
}

}  // namespace

Manifold Near::touch(const state::Body& rigid, const Pose& node, const Vec3& ball, double radius, double reach) const {
  if (section) return section->touch(node, ball, radius, reach);
  return collision::collide(rigid.shape(), shapes::place(rigid.shape(), node), Shape{Sphere{radius}, {}},
                            {ball, Mat3::Identity()}, reach, reach);
}

void find_near(const SoftBody& body, const std::vector<state::Body>& bodies, Partners& partners,
               const WorldSettings& settings, double dt, std::vector<Near>& near) {
  const SoftSettings& made = *body.made;
  near.clear();
  if (!made.collide) return;
  Bounds all{body.positions[0], body.positions[0]};
  double fastest = 0;
  for (std::size_t i = 0; i < body.positions.size(); ++i) {
    all.low = all.low.cwiseMin(body.positions[i]);
    all.high = all.high.cwiseMax(body.positions[i]);
    fastest = std::max(fastest, body.velocities[i].norm());
  }
  const double reach = 2 * dt * (fastest + dt * settings.gravity.norm()) + 2 * made.radius;
  all.low -= Vec3::Constant(reach);
  all.high += Vec3::Constant(reach);
  for (std::uint32_t i = 0; i < bodies.size(); ++i) {
    const state::Body& other = bodies[i];
    if (!other.alive || other.sensor()) continue;
    if ((other.groups() & made.collides_with) == 0 || (made.groups & other.collides_with()) == 0) continue;
    const Bounds before = bounds(other.shape(), pose_of(other, partners.start(i)));
    const Bounds after = bounds(other.shape(), other.motion.pose);
    const Bounds around{before.low.cwiseMin(after.low), before.high.cwiseMax(after.high)};
    if (!overlap(all, around)) continue;
    near.push_back({partners.number_of(i), around, std::sqrt(made.friction * other.makeup->friction),
                    may_slip_between(made, other.shape())});
    if (settings.plane != WorldPlane::none)
      near.back().section = std::make_shared<const flat::Section>(other.shape(), settings.plane);
  }
}

void find_contacts(const SoftBody& body, const std::vector<Near>& near, const std::vector<state::Body>& bodies,
                   const Partners& partners, const Vec3& gravity, double push_out_speed, double h,
                   std::vector<NodeContact>& contacts) {
  const SoftSettings& made = *body.made;
  contacts.clear();
  for (const Near& other : near) {
    const Partner& partner = partners[other.partner];
    const state::Body& rigid = bodies[partner.body];
    const Pose was = pose_of(rigid, partner.before);
    const Quat turned = partner.now.rotation * partner.before.rotation.conjugate();
    const Vec3 went = partner.now.center - partner.before.center;
    const double way = went.norm();
    for (std::uint32_t node = 0; node < body.positions.size(); ++node) {
      const Vec3& at = body.positions[node];
      const Vec3 goes = h * (body.velocities[node] + h * gravity);
      const double arm = (at - partner.before.center).norm();
      // Half a radius more, because its neighbors change its path.
      const double reach = goes.norm() + way + swing(partner.before, partner.now, arm) + 0.5 * made.radius;
      const double beyond = reach + made.radius + partner.shift.norm();
      if (((at - other.around.low).array() < -beyond).any() || ((other.around.high - at).array() < -beyond).any())
        continue;
      if (body.pin_of(node)) continue;
      const Manifold manifold = other.touch(rigid, was, at, made.radius, reach);
      if (manifold.count == 0) continue;
      int deepest = 0;
      for (int i = 1; i < manifold.count; ++i)
        if (manifold.points[static_cast<std::size_t>(i)].penetration >
            manifold.points[static_cast<std::size_t>(deepest)].penetration)
          deepest = i;
      const ContactPoint& point = manifold.points[static_cast<std::size_t>(deepest)];
      const Vec3 surface = point.position + 0.5 * point.penetration * manifold.normal;
      NodeContact contact;
      contact.node = node;
      contact.partner = other.partner;
      contact.normal = turned * manifold.normal;
      contact.arm = turned * (surface - partner.before.center);
      contact.carried = went + contact.arm - (surface - partner.before.center);
      if (rigid.conveys) {
        const Twist own = rigid.surface();
        contact.carried += h * velocity_at(own, contact.arm);
      }
      // A node inside is pushed out at a speed that throws nothing.
      contact.least = std::min(0.0, h * push_out_speed - point.penetration);
      contact.friction = other.friction;
      contacts.push_back(contact);
    }
  }
}

}  // namespace tweenfall::soft
