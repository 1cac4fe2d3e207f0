#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/mass_properties.h>

#include <array>
#include <optional>
#include <stdexcept>
#include <vector>

#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/shapes/mesh_named.h"
#include "document/tracks/read_expression.h"

namespace tweenfall::document::fields {

namespace {

using Kind = json::Value::Kind;

/// Mass properties as written: moments and products of inertia are separate, or follow from something.
struct Given {
  double mass = 0;
  Vec3 center{0, 0, 0}, moments{0, 0, 0}, products{0, 0, 0};
  std::optional<SurfaceMesh> closed_mesh;
  std::vector<PointMass> points;
  std::optional<Ellipsoid> ellipsoid;
};

const Table<PointMass>& point_table() {
  static const Table<PointMass> table(
      "a point with mass",
      {{"mass", bounded("a mass in kg, above 0", 0, true), "kg", member<PointMass>(&PointMass::mass), true},
       {"at", &ValueForms::vector, "on the node, m", member<PointMass>(&PointMass::position), true}});
  return table;
}

const Form* points_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(store.add(point_table().listing_form(store, values)), "a list of points with mass"));
}

const Table<Given>& given_table() {
  const Meaning<Given> closed_mesh = {[](const json::Value& value, Given& given, Building& building) {
    given.closed_mesh = shapes::read_mesh(value, building);
  }};
  const Meaning<Given> points = {[](const json::Value& value, Given& given, Building& building) {
    for (const json::Value& item : value.items()) point_table().read(item, given.points.emplace_back(), building);
  }};
  const Meaning<Given> ellipsoid = {[](const json::Value& value, Given& given, Building& building) {
    take(value, given.ellipsoid.emplace().semi_axes, building);
  }};
  static const Table<Given> table(
      "mass properties",
      {{"mass", bounded("a mass in kg, above 0", 0, true), "kg", member<Given>(&Given::mass)},
       {"center", &ValueForms::vector, "of mass, on the node, m", member<Given>(&Given::center)},
       {"inertia", &ValueForms::vector, "xx, yy and zz about the center of mass, kg m^2",
        member<Given>(&Given::moments)},
       {"products", &ValueForms::vector, "xy, yz and zx of the tensor, which are minus the integrals, kg m^2",
        member<Given>(&Given::products)},
       {"closed_mesh", shapes::mesh_form, "whose inside has the mass, evenly", closed_mesh},
       {"point_masses", points_form, "that have the mass", points},
       {"ellipsoid", &ValueForms::vector, "that has the mass, evenly: its half axes along x, y and z, m", ellipsoid}});
  return table;
}

MassProperties properties_of(const Given& given) {
  if (given.closed_mesh) return mass_properties(*given.closed_mesh, given.mass);
  if (!given.points.empty()) return mass_properties(given.points);
  if (given.ellipsoid) {
    MassProperties properties = mass_properties(*given.ellipsoid, given.mass);
    properties.center = given.center;
    return properties;
  }
  MassProperties properties{given.mass, given.center, given.moments.asDiagonal()};
  for (int i = 0; i < 3; ++i)
    properties.inertia(i, (i + 1) % 3) = properties.inertia((i + 1) % 3, i) = given.products[i];
  return properties;
}

/// There may be many bodies, so evaluations are limited; results that are still rough then are reported.
constexpr Quadrature of_documents{.tolerance = 1e-6, .most_evaluations = 50000};
constexpr double noted = 1e-3;

}  // namespace

const Form* mass_properties_form(FormStore& store, const ValueForms& values) {
  constexpr Together::Rule needs = Together::Rule::first_needs_second;
  Form form = given_table().listing_form(store, values);
  form.together = {exactly_one({"inertia", "closed_mesh", "point_masses", "ellipsoid"}),
                   {needs, {"inertia", "mass"}},
                   {needs, {"closed_mesh", "mass"}},
                   {needs, {"ellipsoid", "mass"}},
                   {needs, {"products", "inertia"}},
                   at_most_one({"mass", "point_masses"}),
                   at_most_one({"center", "closed_mesh", "point_masses"})};
  return store.add(std::move(form));
}

void read_mass_properties(const json::Value& value, BodyDescription& body, Building& building) {
  Given given;
  given_table().read(value, given, building);
  const bool tells = given.closed_mesh || given.ellipsoid || usable(value, "inertia");
  if (given.points.empty() && !(tells && usable(value, "mass"))) return;  // was reported
  try {
    const MassProperties properties = properties_of(given);
    validate(properties);
    body.mass_properties = properties;
  } catch (const std::invalid_argument& fault) {
    building.problems.add(value, fault.what());
  }
}

const Form* density_form(FormStore& store, const ValueForms&) {
  Form text;
  text.kind = Form::Kind::text;
  text.what = "an expression of x, y and z";
  return store.add(
      choice_of("a density in kg/m^3, above 0, or an expression of x, y and z, such as \"1000*(1+x)\"",
                {store.add(bounded("a density in kg/m^3, above 0", 0, true)), store.add(std::move(text))}));
}

void read_density(const json::Value& density, BodyDescription& body, Building& building) {
  take(density, body.density, building);
  if (!density.is(Kind::text)) return;
  static const std::array<std::string, 3> names{"x", "y", "z"};
  try {
    const Expression expression(density.text(), names, {});
    const WeighedProperties weighed =
        weigh(body.shape, Density([&](const Vec3& place) {
                const std::array<Sample<double>, 3> at{Sample<double>{place.x()}, {place.y()}, {place.z()}};
                return expression.sample(at).value;
              }),
              of_documents);
    body.mass_properties = weighed.properties;
    if (weighed.mass_error > noted * weighed.properties.mass)
      building.problems.note(density, "varies too fast to be weighed exactly: the mass may be off by " +
                                          brief_text(100 * weighed.mass_error / weighed.properties.mass) + " %");
  } catch (const ExpressionError& error) {
    add_fault_of_expression(density, error, building.problems);
  } catch (const std::invalid_argument& fault) {
    building.problems.add(density, fault.what());
  }
}

}  // namespace tweenfall::document::fields
