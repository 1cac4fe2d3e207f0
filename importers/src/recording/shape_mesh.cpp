#include "recording/shape_mesh.h"

#include <tweenfall/curves/elementary.h>

#include <cmath>
#include <numbers>

namespace tweenfall {

namespace {

constexpr int around = 24;  // corners of a circle
constexpr int down = 12;    // rings from pole to pole; even, so that one is the equator
constexpr double plane_size = 20;

void add_quad(Mesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  for (const std::uint32_t corner : {a, b, c, a, c, d}) mesh.triangles.push_back(corner);
}

/// A ball drawn apart at its equator by a cylinder; `half_height` 0 is the ball itself.
void add_round(Mesh& mesh, double radius, double half_height) {
  const auto add_ring = [&](double polar, double shift) {
    const auto [sin_polar, cos_polar] = elementary::sin_cos(polar);
    for (int i = 0; i <= around; ++i) {
      const auto [sin_turn, cos_turn] = elementary::sin_cos(2 * std::numbers::pi * i / around);
      const Vec3 normal(sin_polar * cos_turn, cos_polar, sin_polar * sin_turn);
      mesh.normals.push_back(normal);
      mesh.positions.push_back(radius * normal + Vec3(0, shift, 0));
    }
  };
  int rings = 0;
  for (int ring = 0; ring <= down; ++ring) {
    const double polar = std::numbers::pi * ring / down;
    add_ring(polar, ring <= down / 2 ? half_height : -half_height);
    ++rings;
    if (ring == down / 2 && half_height > 0) {
      add_ring(polar, -half_height);
      ++rings;
    }
  }
  constexpr std::uint32_t stride = around + 1;
  for (std::uint32_t ring = 0; ring + 1 < static_cast<std::uint32_t>(rings); ++ring)
    for (std::uint32_t i = 0; i < around; ++i) {
      const std::uint32_t corner = ring * stride + i;
      add_quad(mesh, corner, corner + 1, corner + stride + 1, corner + stride);
    }
}

/// A rectangle around `center`, seen counter-clockwise from where `normal` points.
void add_face(Mesh& mesh, const Vec3& center, const Vec3& right, const Vec3& up, const Vec3& normal) {
  const std::uint32_t first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    mesh.positions.push_back(center + x * right + y * up);
    mesh.normals.push_back(normal);
  }
  add_quad(mesh, first, first + 1, first + 2, first + 3);
}

void add_solid(Mesh& mesh, const Sphere& sphere) {
  add_round(mesh, sphere.radius, 0);
}
void add_solid(Mesh& mesh, const Capsule& capsule) {
  add_round(mesh, capsule.radius, capsule.half_height);
}
void add_solid(Mesh& mesh, const Box& box) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const int next = (axis + 1) % 3, last = (axis + 2) % 3;
      Vec3 normal(0, 0, 0), right(0, 0, 0), up(0, 0, 0);
      normal[axis] = sign;
      right[next] = sign * box.half_extents[next];
      up[last] = box.half_extents[last];
      add_face(mesh, box.half_extents[axis] * normal, right, up, normal);
    }
}
void add_solid(Mesh& mesh, const Plane& plane) {
  const Vec3 beside = std::abs(plane.normal.x()) < 0.9 ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
  const Vec3 right = plane.normal.cross(beside).normalized(), up = plane.normal.cross(right);
  add_face(mesh, plane.offset * plane.normal, plane_size / 2 * right, plane_size / 2 * up, plane.normal);
}

}  // namespace

Mesh shape_mesh(const Shape& shape) {
  Mesh mesh;
  std::visit([&](const auto& solid) { add_solid(mesh, solid); }, shape.solid);
  for (Vec3& position : mesh.positions) position = shape.offset.position + shape.offset.rotation * position;
  for (Vec3& normal : mesh.normals) normal = shape.offset.rotation * normal;
  return mesh;
}

}  // namespace tweenfall
