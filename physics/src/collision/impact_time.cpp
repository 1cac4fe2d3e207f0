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

/// A plane is assumed not to spin.
double swing_of(const Body& body, const Vec3& angular) {
  const double spin = angular.norm();
  if (spin == 0 || std::isinf(body.radius())) return 0;
  // A ball's surface does not move when it spins about its center.
  if (std::holds_alternative<Sphere>(body.shape().solid) && body.mass().center == body.shape().offset.position)
    return 0;
  return spin * body.radius();
}

}  // namespace

Pose Prediction::node(const Body& body) const {
  Pose pose = body.motion.pose;
  pose.rotation = rotation;
  pose.position = center - rotation * body.mass().center;
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
  Course course{&body, &body.shape(), body.twist.linear, body.twist.angular, load.acceleration};
  if (body.immovable() || body.asleep) {
    const step::KeyedCourse keyed = body.immovable() ? step::keyed_course(body, dt) : step::KeyedCourse{};
    course.linear = keyed.mean.linear - 0.5 * keyed.gain.linear;
    course.angular = keyed.mean.angular;
    course.acceleration = keyed.gain.linear / dt;
  } else if (body.drive.owner() == Owner::driven) {
    // A drive may be stiff enough to take the body anywhere within the step.
    course.linear = load.pulled.linear;
    course.angular = load.pulled.angular;
    course.acceleration = Vec3::Zero();
  }
  course.swing = swing_of(body, course.angular);
  return course;
}

namespace {

/// How a gap along a direction may change while two shapes follow their paths.
struct GapAlong {
  const Course &a, &b;
  Vec3 direction;
  /// No point leaves the chord of its path along the direction by more than an eighth of this times the square of the
  /// time, m/s^2.
  double bent = 0;

  GapAlong(const Course& first, const Course& second, const Vec3& along) : a(first), b(second), direction(along) {
    bent = std::abs(direction.dot(a.acceleration - b.acceleration)) + a.angular.norm() * a.swing +
           b.angular.norm() * b.swing;
  }
  /// The gap at a time, too small by no more than its rounding; -infinity if it is not known, m.
  [[nodiscard]] double at(double time) const {
    const shapes::Placed at_a = shapes::place(*a.shape, a.at(time).node(*a.body)),
                         at_b = shapes::place(*b.shape, b.at(time).node(*b.body));
    const double rounding = 1e-14 * (at_a.center.norm() + at_b.center.norm());
    return direction.dot(at_b.center - at_a.center) - shapes::support_along(a.shape->solid, at_a.axes, direction) -
           shapes::support_along(b.shape->solid, at_b.axes, -direction) - rounding;
  }
};

/// How long a gap stays open during a stretch of time, if it is `gap` at its beginning and `end` at its end.
/// @return a part of the stretch: 1 for all of it
double open_for(double gap, double end, double bent, double stretch) {
  // The gap is at least gap + (end - gap) x - bow x (1 - x).
  const double bow = 0.5 * bent * stretch * stretch;
  const double falls = gap - end + bow;
  if (!(falls > 0)) return 1;
  const double square = falls * falls - 4 * bow * gap;
  return square < 0 ? 1 : std::min(1.0, 2 * gap / (falls + std::sqrt(square)));
}

}  // namespace

bool stay_apart(const Course& a, const Course& b, const Vec3& direction, double gap, double from, double dt) {
  const double left = dt - from;
  const Vec3 speed = a.linear - b.linear, gain = a.acceleration - b.acceleration;
  const double closing = std::max(direction.dot(speed + gain * from), direction.dot(speed + gain * dt));
  const double swing_a = a.swing, swing_b = b.swing;
  if (gap > 2 * hair + std::max(0.0, closing + swing_a + swing_b) * left) return true;
  if (swing_a + swing_b == 0) return false;
  // If shapes are farther apart at both ends than their paths bend, they are apart in between.
  const GapAlong along(a, b, direction);
  const double least = 2 * hair + 0.125 * along.bent * left * left;
  return gap > least && along.at(dt) > least;
}

std::optional<double> impact_time(const Course& a, const Course& b, double dt, double near, const Vec3& apart) {
  const double swing = a.swing + b.swing;
  double time = 0;
  // How far to look ahead: first to the end, then to where the gap should have closed.
  double stretch = dt;
  const Vec3 last = a.linear - b.linear + (a.acceleration - b.acceleration) * dt;
  for (int i = 0; i < most_advances; ++i) {
    const Vec3 now = a.linear - b.linear + (a.acceleration - b.acceleration) * time;
    // Shapes farther apart than this along any direction do not meet in the time that is left.
    const double reachable = (std::max(now.norm(), last.norm()) + swing) * (dt - time) + near;
    const auto known = [&]() -> Gap { return {GapAlong(a, b, apart).at(0), apart}; };
    const auto found = [&]() -> Gap {
      return gap_between(*a.shape, shapes::place(*a.shape, a.at(time).node(*a.body)), *b.shape,
                         shapes::place(*b.shape, b.at(time).node(*b.body)), reachable);
    };
    Gap its = i == 0 && apart != Vec3::Zero() ? known() : Gap{};
    if (!(its.width > near)) its = found();
    const auto& [gap, normal] = its;
    if (gap <= near) return time;
    const double closing = std::max(normal.dot(now), normal.dot(last)) + swing;
    // Half past what counts as near, so that it ends after finitely many advances.
    const double open = gap - 0.5 * near, left = dt - time;
    if (!(closing > 0) || open > closing * left) return std::nullopt;
    double advance = open / closing;
    stretch = std::min(stretch, left);
    const GapAlong along(a, b, normal);
    const double end = along.at(time + stretch);
    if (std::isfinite(end) && stretch > advance) {
      const double share = open_for(open, end - 0.5 * near, along.bent, stretch);
      if (share == 1 && stretch == left) return std::nullopt;
      advance = std::max(advance, share * stretch);
      const double closed = 2 * gap * stretch / (gap - end);
      stretch = closed > 0 ? closed : dt;
    }
    time += advance;
    if (time > dt) return std::nullopt;
  }
  return time;
}

}  // namespace tweenfall::collision
