#include "state/makeups.h"

#include <bit>

namespace tweenfall::state {

namespace {

bool alike(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}
template <class Derived>
bool alike(const Eigen::PlainObjectBase<Derived>& a, const Eigen::PlainObjectBase<Derived>& b) {
  bool all = true;
  for (Eigen::Index i = 0; i < a.size(); ++i) all = all && alike(a.data()[i], b.data()[i]);
  return all;
}
bool alike(const Pose& a, const Pose& b) {
  return alike(a.position, b.position) && alike(a.rotation.coeffs(), b.rotation.coeffs()) && alike(a.scale, b.scale);
}
bool alike(const Sphere& a, const Sphere& b) {
  return alike(a.radius, b.radius);
}
bool alike(const Box& a, const Box& b) {
  return alike(a.half_extents, b.half_extents);
}
template <class Rod>
bool alike(const Rod& a, const Rod& b) requires requires {
  a.radius, a.half_height;
}
{ return alike(a.radius, b.radius) && alike(a.half_height, b.half_height); }
bool alike(const TaperedCapsule& a, const TaperedCapsule& b) {
  return alike(a.bottom_radius, b.bottom_radius) && alike(a.top_radius, b.top_radius) &&
         alike(a.half_height, b.half_height);
}
bool alike(const Plane& a, const Plane& b) {
  return alike(a.normal, b.normal) && alike(a.offset, b.offset);
}
bool alike(const Hull& a, const Hull& b) {
  return a.convex.vertices().data() == b.convex.vertices().data();
}
bool alike(const Compound& a, const Compound& b) {
  return a.parts().data() == b.parts().data();
}
bool alike(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices().data() == b.vertices().data();
}
bool alike(const HeightField& a, const HeightField& b) {
  return a.heights().data() == b.heights().data();
}
bool alike(const Solid& a, const Solid& b) {
  if (a.index() != b.index()) return false;
  return std::visit([&b](const auto& solid) { return alike(solid, std::get<std::decay_t<decltype(solid)>>(b)); }, a);
}

}  // namespace

bool alike(const Makeup& a, const Makeup& b) {
  return alike(a.shape.solid, b.shape.solid) && alike(a.shape.offset, b.shape.offset) &&
         alike(a.mass.mass, b.mass.mass) && alike(a.mass.center, b.mass.center) &&
         alike(a.mass.inertia, b.mass.inertia) && alike(a.inverse_inertia, b.inverse_inertia) &&
         alike(a.radius, b.radius) && alike(a.roundness, b.roundness) && alike(a.linear_damping, b.linear_damping) &&
         alike(a.angular_damping, b.angular_damping) && alike(a.friction, b.friction) &&
         alike(a.restitution, b.restitution) && alike(a.rolling_friction, b.rolling_friction) &&
         alike(a.spinning_friction, b.spinning_friction) && a.friction_combine == b.friction_combine &&
         a.restitution_combine == b.restitution_combine && a.sensor == b.sensor && a.collision == b.collision &&
         a.weighed == b.weighed && a.spherical == b.spherical && a.turned == b.turned;
}

const std::shared_ptr<const Makeup>& no_makeup() {
  static const auto none = std::make_shared<const Makeup>();
  return none;
}

std::shared_ptr<const Makeup> Makeups::share(const Makeup& makeup) {
  for (const std::shared_ptr<const Makeup>& known : last_)
    if (known && alike(*known, makeup)) return known;
  std::shared_ptr<const Makeup>& place = last_[next_];
  next_ = (next_ + 1) % last_.size();
  return place = std::make_shared<const Makeup>(makeup);
}

}  // namespace tweenfall::state
