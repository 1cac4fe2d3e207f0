#include "queries/checked.h"

#include <tweenfall/curves/number_text.h>

#include <stdexcept>
#include <string>

namespace tweenfall::queries {

void require_finite(const Vec3& value, const char* name) {
  if (!value.allFinite())
    throw std::invalid_argument(std::string(name) + " must be finite, but is (" + number_text(value.x()) + ", " +
                                number_text(value.y()) + ", " + number_text(value.z()) + ")");
}

void require_amount(double value, const char* name) {
  if (!(value >= 0))
    throw std::invalid_argument(std::string(name) + " must not be negative, but is " + number_text(value));
}

void require_place(const Pose& pose) {
  require_finite(pose.position, "a position");
  const double length = pose.rotation.norm();
  if (!(std::abs(length - 1) <= 1e-6))
    throw std::invalid_argument("a rotation must be a quaternion of length 1, but has " + number_text(length));
}

void require_no_plane(const Shape& shape) {
  if (std::holds_alternative<Plane>(shape.solid))
    throw std::invalid_argument("a plane is infinite: ask with a finite shape");
}

void require_pair(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  require_place(pose_a);
  require_place(pose_b);
  if (std::holds_alternative<Plane>(a.solid) && std::holds_alternative<Plane>(b.solid))
    throw std::invalid_argument("two planes meet in infinitely many points: one of the shapes must be finite");
}

}  // namespace tweenfall::queries
