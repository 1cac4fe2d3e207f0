#pragma once

// Grounds of triangles, and bodies that fall on them.

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/query.h>
#include <tweenfall/physics/world.h>

#include "support.h"

namespace tweenfall::test::grounds {

/// A flat floor from -half to half in cells, split one way and the other.
inline SurfaceMesh flat_floor(double half, int cells, test::Random* random = nullptr) {
  SurfaceMesh mesh;
  for (int k = 0; k <= cells; ++k)
    for (int i = 0; i <= cells; ++i) {
      const bool inside = i > 0 && k > 0 && i < cells && k < cells;
      const double side = 2 * half / cells;
      Vec3 place(-half + i * side, 0, -half + k * side);
      if (random && inside) place += Vec3(random->between(-0.3, 0.3) * side, 0, random->between(-0.3, 0.3) * side);
      mesh.positions.push_back(place);
    }
  const auto at = [cells](int i, int k) { return static_cast<std::uint32_t>(k * (cells + 1) + i); };
  for (int k = 0; k < cells; ++k)
    for (int i = 0; i < cells; ++i) {
      const std::uint32_t a = at(i, k), b = at(i, k + 1), c = at(i + 1, k + 1), d = at(i + 1, k);
      if ((i + k) % 2 == 0)
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c, a, c, d});
      else
        mesh.triangles.insert(mesh.triangles.end(), {a, b, d, b, c, d});
    }
  return mesh;
}

inline WorldSettings wide_awake() {
  WorldSettings settings;
  settings.sleep_after = std::numeric_limits<double>::infinity();
  return settings;
}

inline BodySettings sliding(const Solid& solid, const Vec3& place, const Quat& turn, const Vec3& velocity,
                            double friction) {
  BodySettings body{.shape = {solid}, .mass = 1.0, .friction = friction};
  body.motion.pose.position = place;
  body.motion.pose.rotation = turn;
  body.motion.twist.linear = velocity;
  return body;
}

/// How far the same body differs from its motion on a plane, at most and in the end, m.
inline double away_from_plane(const Shape& floor, const BodySettings& body, int steps, double* turned = nullptr) {
  World over_mesh(wide_awake()), over_plane(wide_awake());
  over_mesh.add({.shape = floor, .friction = 1, .fixed = true});
  over_plane.add({.shape = {Plane{}}, .friction = 1, .fixed = true});
  const BodyId a = over_mesh.add(body), b = over_plane.add(body);
  double most = 0;
  for (int i = 0; i < steps; ++i) {
    over_mesh.step(1.0 / 60);
    over_plane.step(1.0 / 60);
    most = std::max(most, (over_mesh.motion(a).pose.position - over_plane.motion(b).pose.position).norm());
    if (turned)
      *turned = std::max(
          *turned, (over_mesh.motion(a).pose.rotation.coeffs() - over_plane.motion(b).pose.rotation.coeffs()).norm());
  }
  return most;
}

/// Hills of one meter, up and down; `at` of the random numbers turns the ground into another one.
inline HeightField hills(std::size_t count, double spacing, double height, std::uint64_t at) {
  test::Random random(at);
  std::vector<double> heights;
  heights.reserve(count * count);
  for (std::size_t i = 0; i < count * count; ++i) heights.push_back(random.between(0, height));
  return {count, heights, spacing, spacing};
}

inline Pose placed_at(const Vec3& position, const Quat& rotation = Quat(1, 0, 0, 0)) {
  Pose pose;
  pose.position = position;
  pose.rotation = rotation;
  return pose;
}

/// A ball of triangles, wound outwards.
inline SurfaceMesh ball_of_triangles(double radius, int rings) {
  SurfaceMesh mesh;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < 2 * rings; ++k) {
      const double down = test::pi * i / rings, around = test::pi * k / rings;
      const double out = i == 0 || i == rings ? 0 : radius * std::sin(down);
      mesh.positions.emplace_back(out * std::sin(around), radius * std::cos(down), out * std::cos(around));
    }
  const auto at = [rings](int i, int k) { return static_cast<std::uint32_t>(i * 2 * rings + k % (2 * rings)); };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < 2 * rings; ++k)
      mesh.triangles.insert(mesh.triangles.end(),
                            {at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k), at(i + 1, k + 1), at(i, k + 1)});
  return mesh;
}

/// The point of a triangle that is nearest to a given point: on its plane if that lies inside, else on its sides.
inline Vec3 nearest_of_triangle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  const Vec3 n = (b - a).cross(c - a);
  const double of_a = n.dot((b - p).cross(c - p)), of_b = n.dot((c - p).cross(a - p)),
               of_c = n.dot((a - p).cross(b - p));
  if (of_a >= 0 && of_b >= 0 && of_c >= 0) return p - n * (n.dot(p - a) / n.squaredNorm());
  Vec3 best = a;
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    const double share = std::clamp((to - from).dot(p - from) / (to - from).squaredNorm(), 0.0, 1.0);
    const Vec3 place = from + share * (to - from);
    if ((place - p).norm() < (best - p).norm()) best = place;
  }
  return best;
}

inline double distance_to(const SurfaceMesh& mesh, const Vec3& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 3)
    least =
        std::min(least, (nearest_of_triangle(mesh.positions[mesh.triangles[i]], mesh.positions[mesh.triangles[i + 1]],
                                             mesh.positions[mesh.triangles[i + 2]], point) -
                         point)
                            .norm());
  return least;
}

inline std::vector<Solid> one_of_each() {
  const std::vector<Vec3> points = {{-0.2, -0.1, -0.2}, {0.3, -0.1, -0.2}, {0.2, -0.1, 0.3}, {-0.1, 0.25, 0}};
  return {Sphere{0.15},
          Box{{0.2, 0.1, 0.15}},
          Capsule{0.1, 0.15},
          Hull{ConvexHull(points)},
          Cylinder{0.15, 0.1},
          Cone{0.2, 0.15},
          TaperedCapsule{0.12, 0.06, 0.15}};
}

}  // namespace tweenfall::test::grounds
