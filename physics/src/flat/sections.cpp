#include "flat/sections.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "shapes/compound.h"

namespace tweenfall::flat {

namespace {

/// Deviations up to this are rounding, m or relative to a unit.
constexpr double rounding = 1e-9;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// The convex hull of points in a plane, counterclockwise, without points inside of sides.
/// Source: Andrew, Another efficient algorithm for convex hulls in two dimensions, 1979.
std::vector<Vec2> around(std::vector<Vec2> points) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  double size = 0;
  for (const Vec2& point : points) size = std::max(size, (point - points.front()).norm());
  const auto half = [&](auto begin, auto end) {
    std::vector<Vec2> chain;
    for (auto it = begin; it != end; ++it) {
      if (!chain.empty() && (*it - chain.back()).norm() <= rounding * size) continue;
      while (chain.size() > 1 && cross(chain.back() - chain[chain.size() - 2], *it - chain.back()) <=
                                     rounding * size * (*it - chain.back()).norm())
        chain.pop_back();
      chain.push_back(*it);
    }
    return chain;
  };
  std::vector<Vec2> lower = half(points.begin(), points.end()), upper = half(points.rbegin(), points.rend());
  if (!lower.empty()) lower.pop_back();
  if (!upper.empty()) upper.pop_back();
  lower.insert(lower.end(), upper.begin(), upper.end());
  return lower;
}

/// The section of a shape that can be part of a compound.
planar::Part part_of(planar::Shape&& section) {
  planar::Part part{.offset = section.offset, .angle = section.angle};
  std::visit(
      [&]<class Outline>(Outline& outline) {
        if constexpr (std::is_constructible_v<decltype(part.outline), Outline>) part.outline = std::move(outline);
      },
      section.outline);
  return part;
}

/// A shape's axes relative to those of the node.
struct Cut {
  const Axes& axes;
  Vec3 offset;
  Mat3 turn;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::invalid_argument(what +
                                " cannot be cut by the world's plane: its axes must lie in the plane or be "
                                "perpendicular to it, and its center must lie in it");
  }
  /// Which of the shape's own axes is perpendicular to the plane; -1: none.
  [[nodiscard]] int upright() const {
    for (int i = 0; i < 3; ++i)
      if (std::abs(std::abs(turn.col(i)[axes.normal]) - 1) <= rounding) return i;
    return -1;
  }
  [[nodiscard]] bool lies(int axis) const { return std::abs(turn.col(axis)[axes.normal]) <= rounding; }
  /// The angle that turns the second axis of the plane to one of the shape's.
  [[nodiscard]] double angle_to(int axis) const {
    const Vec2 along = axes.flat(turn.col(axis));
    return elementary::atan2(-along.x(), along.y());
  }
  [[nodiscard]] planar::Shape shape(planar::Outline outline, double angle) const {
    return {std::move(outline), axes.flat(offset), angle};
  }
  void require_center(const char* what) const {
    if (!lies_in(axes, offset)) fail(what);
  }

  planar::Shape operator()(const Sphere& sphere) const {
    require_center("a sphere");
    return shape(planar::Circle{sphere.radius}, 0);
  }
  planar::Shape operator()(const Box& box) const {
    const int up = upright();
    if (up < 0 || !lies_in(axes, offset)) fail("a box");
    const int other = up == 1 ? 2 : 1, one = 3 - up - other;
    return shape(planar::Box{Vec2(box.half_extents[one], box.half_extents[other])}, angle_to(other));
  }
  planar::Shape operator()(const Capsule& capsule) const {
    require_center("a capsule");
    if (upright() == 1) return shape(planar::Circle{capsule.radius}, 0);
    if (!lies(1)) fail("a capsule");
    return shape(planar::Capsule{capsule.radius, capsule.half_height}, angle_to(1));
  }
  planar::Shape operator()(const Cylinder& cylinder) const {
    require_center("a cylinder");
    if (upright() == 1) return shape(planar::Circle{cylinder.radius}, 0);
    if (!lies(1)) fail("a cylinder");
    return shape(planar::Box{Vec2(cylinder.radius, cylinder.half_height)}, angle_to(1));
  }
  planar::Shape operator()(const Cone& cone) const {
    require_center("a cone");
    if (!lies(1)) fail("a cone");
    const double r = cone.radius, h = cone.half_height;
    return shape(planar::Polygon{{Vec2(-r, -h), Vec2(r, -h), Vec2(0, h)}}, angle_to(1));
  }
  planar::Shape operator()(const Plane& plane) const {
    const Vec3 normal = turn * plane.normal;
    if (std::abs(normal[axes.normal]) > rounding) fail("a plane");
    const Vec2 out = axes.flat(normal);
    return {planar::HalfPlane{out, plane.offset + normal.dot(offset)}, Vec2(0, 0), 0};
  }
  planar::Shape operator()(const Hull& hull) const {
    std::vector<Vec3> corners;
    for (const Vec3& vertex : hull.convex.vertices()) corners.emplace_back(offset + turn * vertex);
    std::vector<Vec2> points;
    for (const ConvexHull::Edge& edge : hull.convex.edges()) {
      const Vec3 &from = corners[edge.from], &to = corners[edge.to];
      const double below = from[axes.normal], above = to[axes.normal];
      if ((below > 0 && above > 0) || (below < 0 && above < 0)) continue;
      const double part = below == above ? 0 : below / (below - above);
      points.push_back(axes.flat(from + part * (to - from)));
      if (below == above) points.push_back(axes.flat(to));
    }
    std::vector<Vec2> corners_around = points.empty() ? points : around(points);
    if (corners_around.size() < 3) throw std::invalid_argument("the world's plane does not cut through this hull");
    if (corners_around.size() > planar::Polygon::most_corners)
      throw std::invalid_argument("the world's plane cuts a polygon of more than 64 corners out of this hull");
    return {planar::Polygon{std::move(corners_around)}, Vec2(0, 0), 0};
  }
  planar::Shape operator()(const Compound& compound) const {
    planar::Compound cut;
    for (const Shape& part : compound.parts()) try {
        cut.parts.push_back(part_of(section_of(shapes::on_node(part, {offset, Quat(turn), Vec3(1, 1, 1)}), axes)));
      } catch (const std::invalid_argument& fault) {
        throw std::invalid_argument("part " + std::to_string(cut.parts.size()) + " of a compound: " + fault.what());
      }
    return {std::move(cut), Vec2(0, 0), 0};
  }
  template <class Other>
  planar::Shape operator()(const Other& other) const {
    throw std::invalid_argument(std::string("in a plane a body cannot be ") + kind_name(other));
  }
};

}  // namespace

bool lies_in(const Axes& axes, const Vec3& v) {
  return std::abs(v[axes.normal]) <= rounding;
}
bool turns_in(const Axes& axes, const Vec3& v) {
  return std::abs(v[axes.first]) <= rounding && std::abs(v[axes.second]) <= rounding;
}

planar::Shape section_of(const Shape& shape, const Axes& axes) {
  const Cut cut{axes, shape.offset.position, shape.offset.rotation.toRotationMatrix()};
  return std::visit(cut, shape.solid);
}

}  // namespace tweenfall::flat
