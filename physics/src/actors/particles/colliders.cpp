#include "actors/particles/colliders.h"

#include <tweenfall/physics/query.h>

#include <algorithm>
#include <cmath>

#include "contacts/combine.h"
#include "queries/body_scene.h"
#include "shapes/placed.h"

namespace tweenfall::particles {

namespace {

/// Most bounces of a particle in a step: afterwards it slides.
constexpr int most_bounces = 8;
/// Distance of a bounced particle from the surface, relative to its position: rounding.
constexpr double skin = 1e-12;

double lift_of(const Vec3& place) {
  return skin * std::max(1.0, place.cwiseAbs().maxCoeff());
}

/// When g0 + g1 t + g2 t^2 / 2 first falls to 0 within `most`; negative if it does not.
double falls_to_zero(double g0, double g1, double g2, double most) {
  if (g0 <= 0) return g1 < 0 || (g1 == 0 && g2 < 0) ? 0 : -1;
  const double root = g1 * g1 - 2 * g0 * g2;
  if (!(root >= 0)) return -1;
  // The smaller positive root, computed without subtracting nearly equal numbers.
  const double q = std::sqrt(root) - g1;
  const double time = q > 0 ? 2 * g0 / q : -1;
  return time >= 0 && time <= most ? time : -1;
}

Bounds around(const Vec3& a, const Vec3& b, double reach) {
  return {a.cwiseMin(b) - Vec3::Constant(reach), a.cwiseMax(b) + Vec3::Constant(reach)};
}

}  // namespace

Colliders::Colliders(const World& world, double dt, double radius, double restitution, double friction)
    : radius_(radius), restitution_(restitution), friction_(friction) {
  for (const state::Body& body : queries::bodies_of(world)) {
    if (!body.alive || body.sensor()) continue;
    const Collider one{
        &body.shape(),
        body.motion.pose,
        body.center,
        body.fixed ? Twist{} : body.twist,
        contacts::combined_restitution(restitution, Combine::usual, body.makeup->restitution,
                                       body.makeup->restitution_combine),
        contacts::combined_friction(friction, Combine::usual, body.makeup->friction, body.makeup->friction_combine)};
    if (std::holds_alternative<Plane>(one.shape->solid)) {
      planes_.push_back(one);
      continue;
    }
    // Including where it came from in the step.
    Bounds box = bounds(*one.shape, one.pose);
    const double reach = dt * (one.twist.linear.norm() + one.twist.angular.norm() * body.radius()) + radius;
    box.low -= Vec3::Constant(reach);
    box.high += Vec3::Constant(reach);
    tree_.set(static_cast<std::uint32_t>(bodies_.size()), box);
    bodies_.push_back(one);
  }
  tree_.settle();
}

void Colliders::turn_back(std::size_t count, double dt, const Lists& from, const Lists& with, Lists& places,
                          Lists& speeds) const {
  for (std::size_t i = 0; i < count; ++i) {
    Way way{Vec3(from[0][i], from[1][i], from[2][i]), Vec3(with[0][i], with[1][i], with[2][i]), Vec3(0, 0, 0), dt};
    const Vec3 end(places[0][i], places[1][i], places[2][i]);
    // The parabola with the particle's start, initial velocity and end: its own path, up to changes of forces in the
    // step.
    way.acceleration = 2 / (dt * dt) * (end - way.from - dt * way.with);
    Meeting meeting = first_meeting(way);
    if (!meeting.with) continue;
    bool goes_on = true;
    for (int bounce = 0; meeting.with && goes_on && bounce < most_bounces; ++bounce) {
      goes_on = answer(meeting, way);
      meeting = goes_on ? first_meeting(way) : Meeting{};
    }
    const Vec3 place = meeting.with ? way.from : way.place(way.dt);
    const Vec3 velocity = meeting.with ? way.with : way.velocity(way.dt);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      places[axis][i] = place[static_cast<Eigen::Index>(axis)];
      speeds[axis][i] = velocity[static_cast<Eigen::Index>(axis)];
    }
  }
}

Colliders::Meeting Colliders::first_meeting(const Way& way) const {
  Meeting first;
  for (const Collider& plane : planes_) {
    const auto& solid = std::get<Plane>(plane.shape->solid);
    const shapes::Placed placed = shapes::place(*plane.shape, plane.pose);
    const Vec3 normal = placed.axes * solid.normal;
    // The plane is where it will be at the end of the step.
    const Vec3 moving = plane.velocity_at(way.from);
    const double gap = normal.dot(way.from + way.dt * moving - placed.center) - solid.offset - radius_;
    const double time = falls_to_zero(gap, normal.dot(way.with - moving), normal.dot(way.acceleration), way.dt);
    const bool sunk = gap < -2 * lift_of(way.from);
    if ((time >= 0 || sunk) && (!first.with || std::max(time, 0.0) < first.time))
      first = {&plane, std::max(time, 0.0), normal, sunk ? -gap : 0};
  }
  if (tree_.size() > 0) {
    const double sag = way.acceleration.norm() * way.dt * way.dt / 8;
    tree_.visit(around(way.from, way.place(way.dt), sag + radius_),
                [&](std::uint32_t item) { meet(bodies_[item], way, first); });
  }
  return first;
}

void Colliders::meet(const Collider& body, const Way& way, Meeting& first) const {
  const Vec3 moving = body.velocity_at(way.from);
  const Vec3 start = way.from + way.dt * moving, end = way.place(way.dt), straight = end - start;
  const double length = straight.norm();
  if (!(length > 0)) return;
  Vec3 touched, normal;
  bool inside = false;
  if (radius_ > 0) {
    Pose pose;
    pose.position = start;
    const std::optional<ShapeHit> hit = cast_shape(Shape{Sphere{radius_}, {}}, pose, straight, *body.shape, body.pose);
    if (!hit) return;
    touched = hit->point;
    normal = hit->normal;
    inside = hit->inside;
  } else {
    const std::optional<RayHit> hit = cast_ray(*body.shape, body.pose, start, straight, length);
    if (!hit) return;
    touched = hit->point;
    normal = hit->normal;
    inside = hit->inside;
  }
  if (inside) {
    // It leaves where the surface is nearest, seen from the middle of the body.
    const Bounds box = bounds(*body.shape, body.pose);
    const double far = (box.high - box.low).norm() + radius_;
    const Vec3 out = radius_ > 0 ? normal : Vec3(start - body.center);
    if (!(out.norm() > 0)) return;
    normal = out.normalized();
    const std::optional<RayHit> back = cast_ray(*body.shape, body.pose, start + far * normal, -normal, 2 * far);
    if (!back) return;
    touched = back->point;
    normal = back->normal;
  }
  const double gap = normal.dot(start - touched) - radius_;
  const double toward = normal.dot(way.with - moving);
  double time = falls_to_zero(gap, toward, normal.dot(way.acceleration), way.dt);
  const bool sunk = inside && gap < -2 * lift_of(way.from);
  if (sunk) time = std::max(time, 0.0);
  if (time < 0 && gap > 0) time = std::min(way.dt, gap / std::max(-toward, gap / way.dt));
  if (time < 0 || (first.with && time >= first.time)) return;
  first = {&body, time, normal, sunk ? -gap : 0};
}

bool Colliders::answer(const Meeting& meeting, Way& way) const {
  const Vec3& normal = meeting.normal;
  const double t = meeting.time;
  const Vec3 place = way.place(t), velocity = way.velocity(t), moving = meeting.with->velocity_at(place);
  const Vec3 against = velocity - moving;
  const double closing = -normal.dot(against), pressing = -normal.dot(way.acceleration);
  way.from = place + (meeting.depth + lift_of(place)) * normal;
  // A particle that comes in no faster than it is pressed on within the step comes to rest.
  const bool rests = !(closing > std::max(0.0, pressing) * way.dt);
  Vec3 along = against + closing * normal;
  const double sliding = along.norm();
  const double bounced = rests ? 0 : meeting.with->restitution * closing;
  const double stopped = std::max(0.0, closing) + bounced;
  if (sliding > 0) along *= std::max(0.0, 1 - meeting.with->friction * stopped / sliding);
  way.dt -= t;
  if (!rests) {
    way.with = moving + along + bounced * normal;
    return way.dt > 0;
  }
  // Through the rest of the step it slides, slowed by friction, at most to rest.
  if (closing < 0) along -= closing * normal;
  const double pressed = closing < 0 ? 0 : std::max(0.0, pressing);
  const Vec3 unslowed = along + way.dt * (way.acceleration + pressed * normal);
  const double speed = unslowed.norm(), lost = meeting.with->friction * pressed * way.dt;
  const Vec3 after = speed > lost ? Vec3(unslowed * (1 - lost / speed)) : Vec3(0, 0, 0);
  // Another surface may be in its way: in a corner it comes to rest on both.
  way.with = moving + along;
  way.acceleration = way.dt > 0 ? Vec3((after - along) / way.dt) : Vec3(0, 0, 0);
  return way.dt > 0;
}

}  // namespace tweenfall::particles
