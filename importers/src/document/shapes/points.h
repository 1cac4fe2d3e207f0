#pragma once

// Points of a convex hull, or of a line that is swept along another.

#include <tweenfall/curves/curve.h>

#include "document/shapes/shapes.h"

#include <stdexcept>
#include <vector>

namespace tweenfall::document::shapes {

// Empty where one of them is faulty.
[[nodiscard]] std::vector<Vec2> points_2(const json::Value& list);
[[nodiscard]] std::vector<Vec3> points_3(const json::Value& list);

// Straight lines from point to point.
[[nodiscard]] Curve<Vec2> polyline(const std::vector<Vec2>& points);
[[nodiscard]] Curve<Vec3> polyline(const std::vector<Vec3>& points);

// The solid that `make` makes; if it throws, that is reported at the place.
template <class Make>
[[nodiscard]] std::optional<Solid> solid_or_problem(const json::Value& at, Problems& problems, Make make) {
  try {
    return make();
  } catch (const std::invalid_argument& fault) {
    problems.add(at, fault.what());
    return std::nullopt;
  }
}

// The hull of the points that `make` makes.
template <class Make>
[[nodiscard]] std::optional<Solid> hull_or_problem(const json::Value& at, Problems& problems, Make make) {
  return solid_or_problem(at, problems, [&]() -> Solid { return Hull{ConvexHull(make())}; });
}

}  // namespace tweenfall::document::shapes
