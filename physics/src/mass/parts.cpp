#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/curves/symmetric_eigen.h>
#include <tweenfall/physics/mass_properties.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tweenfall {

void validate(const MassProperties& properties) {
  const auto require = [](bool holds, const std::string& what) {
    if (!holds) throw std::invalid_argument(what);
  };
  require(properties.mass > 0 && std::isfinite(properties.mass),
          "mass must be positive and finite, but is " + number_text(properties.mass));
  require(properties.center.allFinite(), "the center of mass must be finite");
  const Mat3& inertia = properties.inertia;
  require(inertia.allFinite(), "inertia must be finite");
  const double most = inertia.cwiseAbs().maxCoeff(), rounding = 1e-9 * most;
  require((inertia - inertia.transpose()).cwiseAbs().maxCoeff() <= rounding,
          "inertia must be symmetric: elements right of the diagonal must equal those left of it");
  if (!(most > 0)) return;  // a point
  const Vec3 moments = symmetric_eigen(Mat3(inertia / most)).values * most;
  require(moments[2] >= -rounding,
          "no principal moment of an inertia can be negative, but one is " + number_text(moments[2]) + " kg m^2");
  require(moments[0] <= moments[1] + moments[2] + rounding,
          "no principal moment of an inertia can exceed the sum of the others, but " + number_text(moments[0]) +
              " kg m^2 is more than " + number_text(moments[1]) + " and " + number_text(moments[2]) + " together");
}

MassProperties mass_properties(std::span<const MassProperties> parts) {
  if (parts.empty()) throw std::invalid_argument("combined mass properties need at least one part");
  MassProperties whole;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    try {
      validate(parts[i]);
    } catch (const std::invalid_argument& fault) {
      throw std::invalid_argument("part " + std::to_string(i) + ": " + fault.what());
    }
    whole.mass += parts[i].mass;
  }
  for (const MassProperties& part : parts) whole.center += part.mass / whole.mass * part.center;
  for (const MassProperties& part : parts) whole.inertia += inertia_about(part, whole.center);
  return whole;
}

MassProperties moved(const MassProperties& properties, const Pose& pose) {
  const Mat3 axes = normalized(pose.rotation).toRotationMatrix();
  MassProperties result = properties;
  result.center = pose.position + axes * properties.center;
  const Mat3 turned = axes * properties.inertia * axes.transpose();
  result.inertia = 0.5 * (turned + turned.transpose());
  return result;
}

double moment_about(const MassProperties& properties, const Vec3& point, const Vec3& axis) {
  const double length = axis.norm();
  if (!(length > 0) || !std::isfinite(length))
    throw std::invalid_argument("an axis must be finite and have a direction");
  const Vec3 unit = axis / length;
  return unit.dot(inertia_about(properties, point) * unit);
}

PrincipalAxes principal_axes(const MassProperties& properties) noexcept {
  const double most = properties.inertia.cwiseAbs().maxCoeff();
  if (!(most > 0) || !std::isfinite(most)) return {};
  const SymmetricEigen<3> found = symmetric_eigen(Mat3(properties.inertia / most));
  Mat3 axes;
  axes.col(0) = found.vectors.col(2);
  axes.col(1) = found.vectors.col(1);
  axes.col(2) = Vec3(axes.col(0)).cross(Vec3(axes.col(1)));
  return {Vec3(most * found.values[2], most * found.values[1], most * found.values[0]), Quat(axes).normalized()};
}

}  // namespace tweenfall
