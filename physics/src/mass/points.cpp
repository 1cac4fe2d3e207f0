#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/mass_properties.h>

#include <cmath>
#include <stdexcept>

namespace tweenfall {

MassProperties mass_properties(std::span<const PointMass> points) {
  if (points.empty()) throw std::invalid_argument("a system of points needs at least one");
  MassProperties whole;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string which = "point " + std::to_string(i) + " of a system: ";
    if (!(points[i].mass > 0) || !std::isfinite(points[i].mass))
      throw std::invalid_argument(which + "mass must be positive and finite, but is " + number_text(points[i].mass));
    if (!points[i].position.allFinite()) throw std::invalid_argument(which + "its place must be finite");
    whole.mass += points[i].mass;
  }
  for (const PointMass& point : points) whole.center += point.mass / whole.mass * point.position;
  for (const PointMass& point : points) {
    const Vec3 arm = point.position - whole.center;
    whole.inertia += point.mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose());
  }
  return whole;
}

}  // namespace tweenfall
