#include <algorithm>
#include <cmath>

#include "solver.h"

namespace tweenfall {

namespace {

/// Overlap that is left alone, so that resting contacts neither open nor tremble, m.
constexpr double slop = 1e-5;
/// Share of the overlap taken apart in one step.
constexpr double share = 0.3;
constexpr int passes = 10;

}  // namespace

void Solver::push_out(std::vector<ContactConstraint>& constraints, const WorldSettings& settings, double dt) {
  bool any = false;
  for (ContactConstraint& constraint : constraints) {
    refresh(constraint);
    SolverBody& a = at(constraint.a);
    SolverBody& b = at(constraint.b);
    for (int i = 0; i < constraint.count; ++i) {
      PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
      point.push_impulse = 0;
      if (point.gap < -slop) {
        any = true;
        a.touched = b.touched = true;
      }
    }
  }
  if (!any || settings.push_out_speed == 0) return;
  const double most = settings.push_out_speed * dt;
  for (int k = 0; k < passes; ++k) {
    for (std::size_t n = 0; n < constraints.size(); ++n) {
      ContactConstraint& constraint = constraints[k % 2 == 1 ? constraints.size() - 1 - n : n];
      SolverBody& a = at(constraint.a);
      SolverBody& b = at(constraint.b);
      const Vec3& normal = constraint.manifold.normal;
      for (int i = 0; i < constraint.count; ++i) {
        PointConstraint& point = constraint.points[static_cast<std::size_t>(i)];
        // What parts by itself needs no push; what does not overlap may come closer by its gap.
        const double parting =
            dt * normal.dot((b.linear + b.angular.cross(point.arm_b)) - (a.linear + a.angular.cross(point.arm_a)));
        double wanted = -point.gap;
        if (point.gap < -slop)
          wanted = std::max(0.0, std::min(share * (-point.gap - slop), most) - std::max(0.0, parting));
        else if (point.gap < 0)
          wanted = 0;
        const double pushed = normal.dot((b.push_linear + b.push_angular.cross(point.arm_b)) -
                                         (a.push_linear + a.push_angular.cross(point.arm_a)));
        const double next = std::max(0.0, point.push_impulse + point.normal_mass * (wanted - pushed));
        const double change = next - point.push_impulse;
        point.push_impulse = next;
        if (change == 0) continue;
        a.push_linear -= a.inverse_mass * change * normal;
        a.push_angular -= a.inverse_inertia * point.arm_a.cross(change * normal);
        b.push_linear += b.inverse_mass * change * normal;
        b.push_angular += b.inverse_inertia * point.arm_b.cross(change * normal);
      }
    }
  }
}

}  // namespace tweenfall
