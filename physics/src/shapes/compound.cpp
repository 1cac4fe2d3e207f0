#include "shapes/compound.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace tweenfall {

namespace shapes {
namespace {

void require_part(const Shape& part, std::size_t index) {
  const std::string which = "part " + std::to_string(index) + " of a compound: ";
  if (std::holds_alternative<Plane>(part.solid))
    throw std::invalid_argument(which + "a plane is infinite; give it to a fixed body of its own");
  if (std::holds_alternative<TriangleMesh>(part.solid) || std::holds_alternative<HeightField>(part.solid))
    throw std::invalid_argument(which + kind_name(part.solid) + " has no volume; give it to a fixed body of its own");
  if (std::holds_alternative<Compound>(part.solid))
    throw std::invalid_argument(which + "it is a compound itself; put its parts here, at their places");
  const double turn = part.offset.rotation.norm();
  if (!part.offset.position.allFinite() || !(turn > 0) || !std::isfinite(turn))
    throw std::invalid_argument(which +
                                "its place must be finite, and its rotation a quaternion that can be normalized");
  try {
    validate(part.solid);
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument(which + fault.what());
  }
}

}  // namespace

Shape on_node(const Shape& part, const Pose& offset) noexcept {
  Shape result = part;
  result.offset.position = offset.position + offset.rotation * part.offset.position;
  result.offset.rotation = normalized(offset.rotation * part.offset.rotation);
  return result;
}

Shape without_offset(const Shape& shape) {
  const auto* compound = std::get_if<Compound>(&shape.solid);
  if (!compound ||
      (shape.offset.position == Vec3(0, 0, 0) && shape.offset.rotation.coeffs() == Quat(1, 0, 0, 0).coeffs()))
    return shape;
  std::vector<Shape> parts;
  parts.reserve(compound->parts().size());
  for (const Shape& part : compound->parts()) parts.push_back(on_node(part, shape.offset));
  return {Compound(std::move(parts))};
}

double volume_of(const Compound& compound) noexcept {
  double sum = 0;
  for (const Shape& part : compound.parts()) sum += volume(part.solid);
  return sum;
}

MassProperties mass_of(const Compound& compound, double mass) {
  const double whole = volume_of(compound);
  MassProperties sum;
  sum.mass = mass;
  for (const Shape& part : compound.parts()) {
    const double share = volume(part.solid) / whole;
    sum.center += share * mass_properties(part, mass * share).center;
  }
  for (const Shape& part : compound.parts())
    sum.inertia += inertia_about(mass_properties(part, mass * (volume(part.solid) / whole)), sum.center);
  return sum;
}

Bounds bounds_of(const Compound& compound, const Shape& shape, const Pose& node) noexcept {
  Bounds all{Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  for (const Shape& part : compound.parts()) {
    const Bounds its = bounds(on_node(part, shape.offset), node);
    all.low = all.low.cwiseMin(its.low);
    all.high = all.high.cwiseMax(its.high);
  }
  return all;
}

}  // namespace shapes

Compound::Compound(std::vector<Shape> parts) {
  if (parts.empty()) throw std::invalid_argument("a compound needs at least one part");
  if (parts.size() > most_parts)
    throw std::invalid_argument("a compound can have " + std::to_string(most_parts) + " parts, but has " +
                                std::to_string(parts.size()));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    shapes::require_part(parts[i], i);
    const double turn = parts[i].offset.rotation.norm();
    if (std::abs(turn - 1) > 1e-12) parts[i].offset.rotation = normalized(parts[i].offset.rotation);
  }
  parts_ = std::make_shared<const std::vector<Shape>>(std::move(parts));
}

std::span<const Shape> Compound::parts() const noexcept {
  return *parts_;
}

}  // namespace tweenfall
