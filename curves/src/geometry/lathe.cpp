#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/sweep.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "curve/components.h"
#include "geometry/profile.h"

namespace tweenfall::geometry {
namespace {

constexpr double full_circle = 2 * std::numbers::pi;

class Lathe {
 public:
  Lathe(const Curve<Vec2>& curve, const LatheOptions& options)
      : profile_(curve, options.profile_steps, true), options_(options), whole_(options.angle == full_circle) {
    if (options.segments < 3)
      throw std::invalid_argument("a lathe needs at least three segments; " + std::to_string(options.segments) +
                                  " given");
    if (!(options.angle > 0 && options.angle <= full_circle))
      throw std::invalid_argument("a lathe's angle must be above 0 and at most a whole turn; it is " +
                                  spans::text_of(options.angle));
    double size = 0;
    for (const Profile::Column& c : profile_.columns) size = std::max(size, c.position.cwiseAbs().maxCoeff());
    for (Profile::Column& c : profile_.columns) {
      if (c.position[0] < -1e-9 * size)
        throw std::invalid_argument("a profile on the lathe must stay on one side of the axis, x >= 0; it reaches " +
                                    spans::text_of(c.position));
      if (c.position[0] < 1e-12 * size) c.position[0] = 0;
    }
    if (enclosed() < 0) profile_.reverse();
    for (int i = 0; i <= options.segments; ++i)
      rays_.push_back(whole_ && i == options.segments ? rays_[0]
                                                      : elementary::sin_cos(options.angle * i / options.segments));
  }

  SurfaceMesh made() {
    for (std::size_t i = 0; i < rays_.size(); ++i) add_ray(i);
    if (!options_.caps) return std::move(mesh_);
    if (!profile_.closed) {
      add_disc(profile_.columns.front(), false);
      add_disc(profile_.columns.back(), true);
    }
    if (!whole_) {
      add_cut(0);
      add_cut(rays_.size() - 1);
    }
    return std::move(mesh_);
  }

 private:
  // Area between the profile and the axis, > 0 where it lies to the left of the profile.
  double enclosed() const {
    double area = 0;
    const std::vector<Profile::Column>& c = profile_.columns;
    for (const std::uint32_t side : profile_.sides)
      area += 0.5 * (c[side].position[0] + c[side + 1].position[0]) * (c[side + 1].position[1] - c[side].position[1]);
    return area;
  }

  // The profile's plane turned to ray i.
  Vec3 turned(const Vec2& p, std::size_t i) const { return {p[0] * rays_[i].cos, p[1], -p[0] * rays_[i].sin}; }

  double share(std::size_t i) const { return static_cast<double>(i) / static_cast<double>(rays_.size() - 1); }

  std::uint32_t add(const Vec3& position, const Vec3& normal, const Vec2& texture) {
    mesh_.positions.push_back(position);
    mesh_.normals.push_back(normal);
    mesh_.texture_coordinates.push_back(texture);
    return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
  }

  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    mesh_.triangles.insert(mesh_.triangles.end(), {a, b, c});
  }

  void add_ray(std::size_t i) {
    const auto columns = static_cast<std::uint32_t>(profile_.columns.size());
    for (const Profile::Column& c : profile_.columns)
      (void)add(turned(c.position, i), turned({c.tangent[1], -c.tangent[0]}, i), {share(i), c.share});
    if (i == 0) return;
    const auto now = static_cast<std::uint32_t>(i) * columns, before = now - columns;
    for (const std::uint32_t side : profile_.sides) {
      // On the axis a side of the quadrilateral has no length.
      if (profile_.columns[side].position[0] > 0) triangle(before + side, now + side, now + side + 1);
      if (profile_.columns[side + 1].position[0] > 0) triangle(before + side, now + side + 1, before + side + 1);
    }
  }

  // From an end of the profile straight to the axis.
  void add_disc(const Profile::Column& end, bool last) {
    const double radius = end.position[0];
    if (radius == 0) return;
    const Vec3 normal(0, last ? 1 : -1, 0);
    const auto place = [&](std::size_t i) { return turned({radius, end.position[1]}, i); };
    const std::uint32_t middle = add({0, end.position[1], 0}, normal, {0, 0});
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      const Vec3 p = place(i);
      const std::uint32_t rim = add(p, normal, {p[0], p[2]});
      if (i == 0) continue;
      if (last)
        triangle(middle, rim - 1, rim);
      else
        triangle(middle, rim, rim - 1);
    }
  }

  // The flat face where a partial turn begins or ends.
  void add_cut(std::size_t i) {
    std::vector<Vec2> outline;
    for (const std::uint32_t corner : profile_.corners) outline.push_back(profile_.columns[corner].position);
    if (!profile_.closed) {
      if (outline.back()[0] > 0) outline.push_back({0, outline.back()[1]});
      if (outline.front()[0] > 0) outline.push_back({0, outline.front()[1]});
    }
    const bool first = i == 0;
    // The direction of turning, which the face at the beginning looks against.
    const Vec3 way(-rays_[i].sin, 0, -rays_[i].cos);
    const auto begin = static_cast<std::uint32_t>(mesh_.positions.size());
    for (const Vec2& p : outline) (void)add(turned(p, i), first ? Vec3(-way) : way, p);
    const std::vector<std::uint32_t> t = polygon_triangles(outline);
    for (std::size_t k = 0; k < t.size(); k += 3) {
      if (first)
        triangle(begin + t[k], begin + t[k + 1], begin + t[k + 2]);
      else
        triangle(begin + t[k], begin + t[k + 2], begin + t[k + 1]);
    }
  }

  Profile profile_;
  const LatheOptions& options_;
  bool whole_;
  std::vector<elementary::SinCos> rays_;
  SurfaceMesh mesh_;
};

}  // namespace
}  // namespace tweenfall::geometry

namespace tweenfall {

SurfaceMesh lathe(const Curve<Vec2>& profile, const LatheOptions& options) {
  return geometry::Lathe(profile, options).made();
}

}  // namespace tweenfall
