#pragma once

// Shapes that are given by their sizes or fitted to an imported mesh.

#include "document/shapes/mesh_named.h"
#include "document/shapes/points.h"

#include <span>
#include <utility>

namespace tweenfall::document::shapes {

template <class SolidKind>
struct FittedFields {
  SolidKind solid{};
  json::Value place;
  std::vector<Vec3> points;  // of the mesh
};

// The meaning of a field of `solid`.
template <class SolidKind>
[[nodiscard]] fields::Meaning<FittedFields<SolidKind>> of_solid(
    std::function<void(const json::Value&, SolidKind&, Building&)> read) {
  return {[read = std::move(read)](const json::Value& value, FittedFields<SolidKind>& given, Building& building) {
    read(value, given.solid, building);
  }};
}

template <class SolidKind>
[[nodiscard]] fields::Row<FittedFields<SolidKind>> mesh_row() {
  using Fields = FittedFields<SolidKind>;
  const fields::Meaning<Fields> mesh = {[](const json::Value& value, Fields& given, Building& building) {
    given.place = value;
    if (std::optional<SurfaceMesh> named = mesh_named(value, building)) given.points = std::move(named->positions);
  }};
  return {"mesh", &ValueForms::name, "instead: fitted to this imported node or file", mesh};
}

// A shape with those fields; `around` fits it to points.
template <class SolidKind>
[[nodiscard]] ShapeRow fitted_or_sized(std::string word, std::string help,
                                       const fields::Table<FittedFields<SolidKind>>& table, fields::FormOf form,
                                       Shape (*around)(std::span<const Vec3>)) {
  const auto read = [&table, around](const json::Value& value, Shape& shape, Building& building) {
    FittedFields<SolidKind> given;
    table.read(value, given, building);
    shape.solid = given.solid;
    if (given.points.empty()) return;
    try {
      shape = around(given.points);
    } catch (const std::invalid_argument& fault) {
      building.problems.add(given.place, fault.what());
    }
  };
  return {std::move(word), std::move(form), std::move(help), {read}};
}

}  // namespace tweenfall::document::shapes
