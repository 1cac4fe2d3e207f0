#include "contacts/meeting.h"

#include <algorithm>

namespace tweenfall::contacts {

Meeting meeting_of(double gap, double closing, double pull, double span) {
  if (!(gap > 0)) return {0, closing};
  const double square = closing * closing + 2 * pull * gap;
  const double root = square > 0 ? std::sqrt(square) : 0;
  const double time = square >= 0 && closing + root > 0 ? 2 * gap / (closing + root) : span;
  return {time, time < span ? root : 0};
}

Closing closing_of(const Vec3& normal, const forces::Load& a, const forces::Load& b, double whole) {
  const double along_a = normal.dot(a.acceleration);
  const double along_b = normal.dot(b.acceleration);
  return {along_a - along_b, std::max(1e-7, 2 * std::max(std::abs(along_a), std::abs(along_b)) * whole)};
}

void foresee(ContactConstraint& contact, const Twist& a, const Twist& b, const Closing& closing, double dt) {
  const Vec3& normal = contact.manifold.normal;
  contact.impact = false;
  for (int i = 0; i < contact.count; ++i) {
    PointConstraint& point = contact.points[static_cast<std::size_t>(i)];
    point.total_normal = 0;
    point.total_friction = Vec3::Zero();
    const Vec3 velocity_a = a.linear + a.angular.cross(point.start_arm_a);
    const Vec3 velocity_b = b.linear + b.angular.cross(point.start_arm_b);
    const double speed = normal.dot(velocity_a - velocity_b);
    point.approach = std::max(0.0, meeting_of(point.start_gap, speed, closing.pull, dt).speed);
    contact.impact = contact.impact || point.approach > closing.tremble;
  }
  contact.total_rolling = Vec3::Zero();
}

}  // namespace tweenfall::contacts
