#include "stage/roster/scaled_shape.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/reflection.h>

#include <Eigen/LU>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "collision/surfaces/surface.h"
#include "shapes/compound.h"
#include "shapes/turn_onto.h"

namespace tweenfall::staging {

namespace {

/// Files store rotations and scales as floats, and a skeleton multiplies dozens of them. Relative to the largest.
constexpr double even_enough = 1e-5;

std::string triple(const Vec3& value) {
  return "(" + number_text(value.x()) + ", " + number_text(value.y()) + ", " + number_text(value.z()) + ")";
}

bool is_diagonal(const Mat3& matrix) {
  const Mat3 rest = matrix - Mat3(matrix.diagonal().asDiagonal());
  return rest.cwiseAbs().maxCoeff() <= even_enough * matrix.cwiseAbs().maxCoeff();
}

/// Whether it stretches all axes alike, mirrored or not.
bool is_even(const Vec3& scale) {
  const Vec3 size = scale.cwiseAbs();
  return size.maxCoeff() - size.minCoeff() <= even_enough * size.maxCoeff();
}

double uniform(const Vec3& scale, const char* what) {
  if (!is_even(scale))
    throw std::invalid_argument(std::string(what) + " takes the same scale along all axes, but its node is scaled by " +
                                triple(scale) + "; make it a hull, or scale its node evenly");
  return std::abs(scale.x());
}

/// A solid of revolution about y, mirrored by a uniform scale, points where its mirrored axis does.
void mirror(Shape& shape, const Vec3& scale) {
  const Vec3 axis = shape.offset.rotation * Vec3(0, 1, 0);
  const Vec3 mirrored = axis.cwiseProduct(scale.cwiseQuotient(scale.cwiseAbs()));
  if (mirrored == axis) return;
  shape.offset.rotation = (shapes::turn_onto(axis, mirrored) * shape.offset.rotation).normalized();
}

/// A height field stays one as long as its grid does.
Solid scaled_surface(const Solid& solid, const Mat3& own) {
  const auto* field = std::get_if<HeightField>(&solid);
  if (field && is_diagonal(own) && own.diagonal().minCoeff() > 0) {
    std::vector<double> heights(field->heights().begin(), field->heights().end());
    for (double& height : heights) height *= own(1, 1);
    return HeightField(field->columns(), heights, field->spacing_x() * own(0, 0), field->spacing_z() * own(2, 2));
  }
  SurfaceMesh mesh = field ? field->surface() : std::get<TriangleMesh>(solid).surface();
  for (Vec3& position : mesh.positions) position = own * position;
  // A mirror image runs the other way around.
  if (own.determinant() < 0)
    for (std::size_t i = 0; i + 2 < mesh.triangles.size(); i += 3) std::swap(mesh.triangles[i], mesh.triangles[i + 1]);
  return TriangleMesh(mesh);
}

}  // namespace

RestAxes rest_axes_below(const RestAxes& parent, const Pose& rest) {
  const Mat3 rotation = rest.rotation.toRotationMatrix();
  const Vec3 signs = pose::signs_of(parent.scale);
  const Mat3 reflected = signs.asDiagonal() * rotation * signs.asDiagonal();
  return {parent.linear * rotation * rest.scale.asDiagonal(), parent.turn * reflected,
          parent.scale.cwiseProduct(rest.scale), parent.scaled || rest.scale != Vec3(1, 1, 1)};
}

RestAxes rest_axes(const Hierarchy& nodes, std::size_t node) {
  std::vector<std::size_t> chain;
  for (std::size_t i = node; i != no_node; i = nodes[i].parent) chain.push_back(i);
  RestAxes axes;
  while (!chain.empty()) {
    axes = rest_axes_below(axes, nodes[chain.back()].rest);
    chain.pop_back();
  }
  return axes;
}

Vec3 rest_scale(const RestAxes& axes) {
  if (!axes.scaled) return {1, 1, 1};
  const Mat3 own = axes.turn.transpose() * axes.linear;
  if (!is_diagonal(own))
    throw std::invalid_argument(
        "a scaled parent shears its node, and a body keeps its angles; scale that parent evenly");
  const Vec3 scale = own.diagonal();
  if (!scale.allFinite() || scale.cwiseAbs().minCoeff() == 0)
    throw std::invalid_argument("its node is scaled by " + triple(scale) + "; a body needs factors other than 0");
  return scale;
}

Shape scaled(const Shape& shape, const Vec3& scale) {
  if (scale == Vec3(1, 1, 1)) return shape;
  Shape result = shape;
  result.offset.position = scale.cwiseProduct(shape.offset.position);
  // In the axes of the solid, which may be turned on its node.
  const Mat3 turn = shape.offset.rotation.normalized().toRotationMatrix();
  const Mat3 own = turn.transpose() * Mat3(scale.asDiagonal()) * turn;
  if (auto* sphere = std::get_if<Sphere>(&result.solid)) {
    sphere->radius *= uniform(scale, "a sphere");
  } else if (auto* capsule = std::get_if<Capsule>(&result.solid)) {
    const double factor = uniform(scale, "a capsule");
    capsule->radius *= factor;
    capsule->half_height *= factor;
    mirror(result, scale);
  } else if (auto* cylinder = std::get_if<Cylinder>(&result.solid)) {
    const double factor = uniform(scale, "a cylinder");
    cylinder->radius *= factor;
    cylinder->half_height *= factor;
    mirror(result, scale);
  } else if (auto* cone = std::get_if<Cone>(&result.solid)) {
    const double factor = uniform(scale, "a cone");
    cone->radius *= factor;
    cone->half_height *= factor;
    mirror(result, scale);
  } else if (auto* tapered = std::get_if<TaperedCapsule>(&result.solid)) {
    const double factor = uniform(scale, "a tapered capsule");
    tapered->bottom_radius *= factor;
    tapered->top_radius *= factor;
    tapered->half_height *= factor;
    mirror(result, scale);
  } else if (auto* box = std::get_if<Box>(&result.solid)) {
    if (is_diagonal(own)) {
      box->half_extents = box->half_extents.cwiseProduct(Vec3(own.diagonal().cwiseAbs()));
    } else if (is_even(scale)) {  // mirrored
      box->half_extents *= std::abs(scale.x());
      result.offset.rotation = pose::reflected_by(pose::reflection_of(scale), result.offset.rotation);
    } else {
      throw std::invalid_argument(
          "a box that is turned on its node takes the same scale along all axes, but its node is "
          "scaled by " +
          triple(scale) + "; turn the node, or make it a hull");
    }
  } else if (auto* plane = std::get_if<Plane>(&result.solid)) {
    if (!is_diagonal(own)) (void)uniform(scale, "a plane that is turned on its node");
    const Vec3 normal = is_diagonal(own) ? Vec3(plane->normal.cwiseQuotient(Vec3(own.diagonal())))
                                         : Vec3(turn.transpose() * Vec3((turn * plane->normal).cwiseQuotient(scale)));
    plane->offset /= normal.norm();
    plane->normal = normal.normalized();
  } else if (const auto* compound = std::get_if<Compound>(&shape.solid)) {
    std::vector<Shape> parts;
    parts.reserve(compound->parts().size());
    for (const Shape& part : compound->parts()) parts.push_back(scaled(shapes::on_node(part, shape.offset), scale));
    return {Compound(std::move(parts))};
  } else if (surfaces::surface_of(shape.solid)) {
    return {scaled_surface(shape.solid, own), result.offset};
  } else if (auto* hull = std::get_if<Hull>(&result.solid)) {
    std::vector<Vec3> points;
    for (const Vec3& point : hull->convex.vertices()) points.push_back(own * point);
    hull->convex = ConvexHull(points);
  }
  return result;
}

}  // namespace tweenfall::staging
