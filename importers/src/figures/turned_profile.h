#pragma once

// Cylinders, cones and tapered capsules for drawing: an outline turned about y.

#include <tweenfall/physics/shape.h>

#include <vector>

namespace tweenfall::figures {

struct ProfilePoint {
  double radius, height;                // m
  double normal_radius, normal_height;  // unit, out of the solid
};

// From the top down; places where the surface has an edge are duplicated. Empty for other solids.
[[nodiscard]] std::vector<ProfilePoint> turned_profile(const Solid& solid);

}  // namespace tweenfall::figures
