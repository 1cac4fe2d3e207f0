#include <tweenfall/curves/rotation.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "mass/weighing.h"
#include "shapes/compound.h"

namespace tweenfall {

namespace mass {
namespace {

Pieces pieces_of_solid(const Solid& solid) {
  return std::visit(
      [](const auto& one) {
        if constexpr (requires { pieces_of(one); }) return pieces_of(one);
        return Pieces{};
      },
      solid);
}

/// Parts of a compound are weighed one by one.
WeighedProperties weigh_parts(const Shape& whole, const Compound& compound, const Density& density,
                              const Quadrature& quadrature) {
  std::vector<WeighedProperties> parts;
  std::vector<MassProperties> properties;
  for (const Shape& part : compound.parts()) {
    parts.push_back(weigh(shapes::on_node(part, whole.offset), density, quadrature));
    properties.push_back(parts.back().properties);
  }
  WeighedProperties sum{mass_properties(properties)};
  for (const WeighedProperties& part : parts) {
    const double far = (part.properties.center - sum.properties.center).norm();
    const double share = part.properties.mass / sum.properties.mass;
    sum.mass_error += part.mass_error;
    sum.center_error += share * part.center_error + far * part.mass_error / sum.properties.mass;
    sum.inertia_error +=
        part.inertia_error + 2 * far * part.properties.mass * part.center_error + far * far * part.mass_error;
    sum.evaluations += part.evaluations;
  }
  return sum;
}

}  // namespace
}  // namespace mass

WeighedProperties weigh(const Shape& shape, const Density& density, const Quadrature& quadrature) {
  validate(shape.solid);
  if (is_scenery(shape.solid) || density.even()) {
    const double even = is_scenery(shape.solid) ? 1 : density.at({0, 0, 0}) * volume(shape.solid);
    return {mass_properties(shape, even)};
  }
  if (const auto* compound = std::get_if<Compound>(&shape.solid))
    return mass::weigh_parts(shape, *compound, density, quadrature);
  const MassProperties whole = mass_properties(Shape{shape.solid}, 1);
  Pose pose = shape.offset;
  pose.rotation = normalized(pose.rotation);
  return mass::weigh_pieces({mass::pieces_of_solid(shape.solid), pose, whole.center, std::sqrt(whole.inertia.trace())},
                            density, quadrature);
}

}  // namespace tweenfall
