#include "collision/impact_time.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

#include "collision/collide_pairs.h"
#include "shapes/placed.h"
#include "step/keyed_step.h"

namespace tweenfall::collision {

using state::Body;

namespace {

constexpr int most_advances = 48;

}  // namespace

Pose Prediction::node(const Body& body) const {
  Pose pose = body.motion.pose;
  pose.rotation = rotation;
  pose.position = center - rotation * body.mass.center;
  return pose;
}

Prediction Course::at(double time) const {
  Prediction prediction{body->center + linear * time + acceleration * (0.5 * time * time), body->motion.pose.rotation};
  if (angular != Vec3::Zero()) {
    prediction.rotation = exp_map(angular * time) * prediction.rotation;
    prediction.rotation.normalize();
  }
  return prediction;
}

Course course_of(const Body& body, const forces::Load& load, double dt) {
  if (body.immovable() || body.asleep) {
    const step::KeyedCourse course = body.immovable() ? step::keyed_course(body, dt) : step::KeyedCourse{};
    return {&body, &body.shape, course.mean.linear - 0.5 * course.gain.linear, course.mean.angular,
            course.gain.linear / dt};
  }
  // A drive may be stiff enough to take the body anywhere within the step.
  if (body.drive.owner() == Owner::driven)
    return {&body, &body.shape, load.pulled.linear, load.pulled.angular, Vec3::Zero()};
  return {&body, &body.shape, body.twist.linear, body.twist.angular, load.acceleration};
}

double swing_speed(const Course& course) {
  const Body& body = *course.body;
  const double spin = course.angular.norm();
  if (spin == 0 || std::isinf(body.radius)) return 0;
  // A ball's surface stays where it is when it spins about its center.
  if (std::holds_alternative<Sphere>(body.shape.solid)) return 0;
  return spin * body.radius;
}

bool stay_apart(const Course& a, const Course& b, const Vec3& direction, double gap, double from, double dt) {
  const double left = dt - from;
  const Vec3 speed = a.linear - b.linear, gain = a.acceleration - b.acceleration;
  const double closing = std::max(direction.dot(speed + gain * from), direction.dot(speed + gain * dt));
  const double swing_a = swing_speed(a), swing_b = swing_speed(b);
  if (gap > 2 * hair + std::max(0.0, closing + swing_a + swing_b) * left) return true;
  if (swing_a + swing_b == 0) return false;
  // No point leaves the chord of its way by more than an eighth of its greatest acceleration times the square of the
  // time: what is apart by more than that at both ends is so between them.
  const double bent = std::abs(direction.dot(gain)) + a.angular.norm() * swing_a + b.angular.norm() * swing_b;
  const double least = 2 * hair + 0.125 * bent * left * left;
  if (!(gap > least)) return false;
  const shapes::Placed end_a = shapes::place(*a.shape, a.at(dt).node(*a.body)),
                       end_b = shapes::place(*b.shape, b.at(dt).node(*b.body));
  const double rounding = 1e-14 * (end_a.center.norm() + end_b.center.norm());
  return direction.dot(end_b.center - end_a.center) - shapes::support_along(a.shape->solid, end_a.axes, direction) -
             shapes::support_along(b.shape->solid, end_b.axes, -direction) >
         least + rounding;
}

std::optional<double> impact_time(const Course& a, const Course& b, double dt) {
  const double swing = swing_speed(a) + swing_speed(b);
  double time = 0;
  const Vec3 last = a.linear - b.linear + (a.acceleration - b.acceleration) * dt;
  for (int i = 0; i < most_advances; ++i) {
    const Vec3 now = a.linear - b.linear + (a.acceleration - b.acceleration) * time;
    // What is wider apart than this along any direction does not meet in the time that is left.
    const double reachable = (std::max(now.norm(), last.norm()) + swing) * (dt - time) + hair;
    const auto [gap, normal] = gap_between(*a.shape, shapes::place(*a.shape, a.at(time).node(*a.body)), *b.shape,
                                           shapes::place(*b.shape, b.at(time).node(*b.body)), reachable);
    if (gap <= hair) return time;
    const double closing = std::max(normal.dot(now), normal.dot(last)) + swing;
    if (!(closing > 0) || stay_apart(a, b, normal, gap, time, dt)) return std::nullopt;
    // Half a hair past the gap, so that the end comes after finitely many advances.
    time += (gap - 0.5 * hair) / closing;
    if (time > dt) return std::nullopt;
  }
  return time;
}

}  // namespace tweenfall::collision
