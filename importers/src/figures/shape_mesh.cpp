#include "figures/shape_mesh.h"

#include <tweenfall/curves/elementary.h>

#include <numbers>

#include "figures/turned_profile.h"

namespace tweenfall::figures {

namespace {

constexpr std::uint32_t sectors = 32, rings = 16;

/// Two half balls on a cylinder along y; a ball when it has no length.
void add_round(Mesh& mesh, double radius, double half_height) {
  for (std::uint32_t ring = 0; ring <= rings + 1; ++ring) {
    // The equator is duplicated, once for each half.
    const std::uint32_t parallel = ring <= rings / 2 ? ring : ring - 1;
    const auto down = elementary::sin_cos(std::numbers::pi * parallel / rings);
    const double lift = ring <= rings / 2 ? half_height : -half_height;
    for (std::uint32_t sector = 0; sector <= sectors; ++sector) {
      const auto around = elementary::sin_cos(2 * std::numbers::pi * (sector % sectors) / sectors);
      const Vec3 normal(down.sin * around.cos, down.cos, down.sin * around.sin);
      mesh.normals.push_back(normal);
      mesh.positions.push_back(normal * radius + Vec3(0, lift, 0));
    }
  }
  for (std::uint32_t ring = 0; ring <= rings; ++ring) {
    if (ring == rings / 2 && half_height == 0) continue;
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      const std::uint32_t a = ring * (sectors + 1) + sector, b = a + sectors + 1;
      if (ring > 0) mesh.triangles.insert(mesh.triangles.end(), {a, a + 1, b + 1});
      if (ring < rings) mesh.triangles.insert(mesh.triangles.end(), {a, b + 1, b});
    }
  }
}

/// An outline turned about y.
void add_turned(Mesh& mesh, const std::vector<ProfilePoint>& profile) {
  for (const ProfilePoint& point : profile)
    for (std::uint32_t sector = 0; sector <= sectors; ++sector) {
      const auto around = elementary::sin_cos(2 * std::numbers::pi * (sector % sectors) / sectors);
      mesh.positions.emplace_back(point.radius * around.sin, point.height, point.radius * around.cos);
      mesh.normals.emplace_back(point.normal_radius * around.sin, point.normal_height,
                                point.normal_radius * around.cos);
    }
  for (std::uint32_t ring = 0; ring + 1 < profile.size(); ++ring) {
    const ProfilePoint &upper = profile[ring], &lower = profile[ring + 1];
    if (upper.radius == lower.radius && upper.height == lower.height) continue;
    for (std::uint32_t sector = 0; sector < sectors; ++sector) {
      const std::uint32_t a = ring * (sectors + 1) + sector, b = a + sectors + 1;
      if (upper.radius > 0) mesh.triangles.insert(mesh.triangles.end(), {a, b + 1, a + 1});
      if (lower.radius > 0) mesh.triangles.insert(mesh.triangles.end(), {a, b, b + 1});
    }
  }
}

/// A rectangle around `center`; the normal is `u` x `v`.
void add_rectangle(Mesh& mesh, const Vec3& center, const Vec3& u, const Vec3& v) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const Vec3 normal = u.cross(v).normalized();
  for (const auto& [a, b] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    mesh.positions.push_back(center + u * a + v * b);
    mesh.normals.push_back(normal);
  }
  mesh.triangles.insert(mesh.triangles.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
}

void add_box(Mesh& mesh, const Vec3& half) {
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      Vec3 out(0, 0, 0), u(0, 0, 0), v(0, 0, 0);
      out[axis] = side * half[axis];
      u[(axis + 1) % 3] = half[(axis + 1) % 3];
      v[(axis + 2) % 3] = side * half[(axis + 2) % 3];
      add_rectangle(mesh, out, u, v);
    }
}

void add_plane(Mesh& mesh, const Plane& plane) {
  const Vec3 other = plane.normal.x() * plane.normal.x() < 0.5 ? Vec3(1, 0, 0) : Vec3(0, 0, 1);
  const Vec3 u = other.cross(plane.normal).normalized();
  add_rectangle(mesh, plane.normal * plane.offset, u * 10, plane.normal.cross(u) * 10);
}

/// Adds a surface with separate corners for each triangle.
void add_flat(Mesh& mesh, const SurfaceMesh& surface) {
  for (std::size_t i = 0; i + 2 < surface.triangles.size(); i += 3) {
    const Vec3 &a = surface.positions[surface.triangles[i]], &b = surface.positions[surface.triangles[i + 1]],
               &c = surface.positions[surface.triangles[i + 2]];
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (const Vec3& corner : {a, b, c}) {
      mesh.triangles.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(corner);
      mesh.normals.push_back(normal);
    }
  }
}

void append(Mesh& mesh, const Mesh& more) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  mesh.positions.insert(mesh.positions.end(), more.positions.begin(), more.positions.end());
  mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
  mesh.triangles.reserve(mesh.triangles.size() + more.triangles.size());
  for (const std::uint32_t corner : more.triangles) mesh.triangles.push_back(first + corner);
}

}  // namespace

Mesh shape_mesh(const Shape& shape) {
  Mesh mesh;
  if (const auto* sphere = std::get_if<Sphere>(&shape.solid)) {
    add_round(mesh, sphere->radius, 0);
  } else if (const auto* capsule = std::get_if<Capsule>(&shape.solid)) {
    add_round(mesh, capsule->radius, capsule->half_height);
  } else if (const auto* box = std::get_if<Box>(&shape.solid)) {
    add_box(mesh, box->half_extents);
  } else if (const auto* plane = std::get_if<Plane>(&shape.solid)) {
    add_plane(mesh, *plane);
  } else if (const std::vector<ProfilePoint> profile = turned_profile(shape.solid); !profile.empty()) {
    add_turned(mesh, profile);
  } else if (const auto* compound = std::get_if<Compound>(&shape.solid)) {
    for (const Shape& part : compound->parts()) append(mesh, shape_mesh(part));
  } else if (const auto* triangles = std::get_if<TriangleMesh>(&shape.solid)) {
    add_flat(mesh, triangles->surface());
  } else if (const auto* field = std::get_if<HeightField>(&shape.solid)) {
    add_flat(mesh, field->surface());
  } else if (const auto* hull = std::get_if<Hull>(&shape.solid)) {
    SurfaceMesh surface = hull->convex.surface();
    mesh.positions = std::move(surface.positions);
    mesh.normals = std::move(surface.normals);
    mesh.triangles = std::move(surface.triangles);
  }
  for (Vec3& position : mesh.positions) position = shape.offset.rotation * position + shape.offset.position;
  for (Vec3& normal : mesh.normals) normal = shape.offset.rotation * normal;
  return mesh;
}

}  // namespace tweenfall::figures
