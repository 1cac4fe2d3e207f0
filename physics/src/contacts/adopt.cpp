#include "contacts/adopt.h"

#include "shapes/turned.h"

namespace tweenfall::contacts {

namespace {

/// The radius with which a body's surface rolls where something touches it, m.
double rolling_radius(const collision::Passage& way, const collision::Prediction& at, const Vec3& position,
                      const Vec3& out) {
  const state::Body& body = *way.body;
  if (body.makeup->roundness > 0) return body.makeup->roundness;
  if (!body.makeup->turned) return 0;
  const shapes::Placed placed = shapes::place(*way.course.shape, at.node(body));
  const Mat3 into = placed.axes.transpose();
  return shapes::rolling_radius(way.course.shape->solid, into * (position - placed.center), into * out);
}

}  // namespace

void adopt(ContactConstraint& constraint, const collision::Passage& way_a, const collision::Prediction& at_a,
           const collision::Passage& way_b, const collision::Prediction& at_b) {
  const state::Body& a = *way_a.body;
  const state::Body& b = *way_b.body;
  const Quat back_a = a.motion.pose.rotation * at_a.rotation.conjugate();
  const Quat back_b = b.motion.pose.rotation * at_b.rotation.conjugate();
  const Manifold& manifold = constraint.manifold;
  constraint.count = manifold.count;
  for (int i = 0; i < manifold.count; ++i) {
    const ContactPoint& from = manifold.points[static_cast<std::size_t>(i)];
    PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
    point = {};
    point.feature = from.feature;
    point.start_arm_a = from.position - at_a.center;
    point.start_arm_b = from.position - at_b.center;
    point.start_gap = -from.penetration;
    point.skin_a = rolling_radius(way_a, at_a, from.position, manifold.normal);
    point.skin_b = rolling_radius(way_b, at_b, from.position, -manifold.normal);
    if (constraint.impact_time == 0) continue;
    point.start_arm_a = state::carried(back_a, point.start_arm_a, point.skin_a * manifold.normal);
    point.start_arm_b = state::carried(back_b, point.start_arm_b, -point.skin_b * manifold.normal);
    point.start_gap += manifold.normal.dot((b.center + point.start_arm_b) - (a.center + point.start_arm_a));
  }
}

}  // namespace tweenfall::contacts
