#include "document/shapes/mesh_named.h"
#include "document/shapes/points.h"

#include <algorithm>
#include <utility>

namespace tweenfall::document::shapes {

namespace {

struct MeshFields {
  std::optional<SurfaceMesh> named;
  SurfaceMesh written;
};

const Form* vertices_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(values.vector, "a list of at least 3 points", 3, 1'000'000));
}

const Form* triangles_form(FormStore& store, const ValueForms&) {
  const Form* vertex = store.add(bounded("a number of a vertex, from 0", 0, false, 1e6, true));
  const Form* triangle = store.add(list_of(vertex, "a triangle: 3 numbers of vertices", 3, 3));
  return store.add(list_of(triangle, "a list of triangles", 1, 1'000'000));
}

const fields::Table<MeshFields>& mesh_table() {
  using Fields = MeshFields;
  const fields::Meaning<Fields> of = {
      [](const json::Value& value, Fields& mesh, Building& building) { mesh.named = mesh_named(value, building); }};
  const fields::Meaning<Fields> vertices = {
      [](const json::Value& value, Fields& mesh, Building&) { mesh.written.positions = points_3(value); }};
  const fields::Meaning<Fields> triangles = {[](const json::Value& value, Fields& mesh, Building&) {
    for (const json::Value& triangle : value.items())
      for (const json::Value& vertex : triangle.items())
        mesh.written.triangles.push_back(static_cast<std::uint32_t>(std::clamp(vertex.number(), 0.0, 1e6)));
  }};
  static const fields::Table<Fields> table(
      "a mesh",
      {{"of", &ValueForms::name, "an imported node or file", of},
       {"vertices", vertices_form, "m", vertices},
       {"triangles", triangles_form, "three vertices each, counter-clockwise seen from the front", triangles}});
  return table;
}

}  // namespace

const Form* mesh_form(FormStore& store, const ValueForms& values) {
  Form form = mesh_table().listing_form(store, values);
  form.together = {exactly_one({"of", "vertices"}),
                   {Together::Rule::first_needs_second, {"vertices", "triangles"}},
                   {Together::Rule::first_needs_second, {"triangles", "vertices"}}};
  return store.add(std::move(form));
}

std::optional<SurfaceMesh> read_mesh(const json::Value& place, Building& building) {
  MeshFields given;
  mesh_table().read(place, given, building);
  if (given.named) return std::move(given.named);
  if (given.written.positions.empty() || given.written.triangles.empty()) return std::nullopt;
  return std::move(given.written);
}

ShapeRow mesh() {
  const auto read = [](const json::Value& place, Shape& shape, Building& building) {
    const std::optional<SurfaceMesh> given = read_mesh(place, building);
    if (!given) return;
    std::optional<Solid> made =
        solid_or_problem(place, building.problems, [&]() -> Solid { return TriangleMesh(*given); });
    if (made) shape.solid = std::move(*made);
  };
  return {"mesh",
          fields::FormOf::Make(mesh_form),
          "triangles that stop what comes from their front; scenery alone",
          {read}};
}

}  // namespace tweenfall::document::shapes
