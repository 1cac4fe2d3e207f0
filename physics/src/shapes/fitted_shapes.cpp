#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/fitted_shapes.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>

#include "shapes/fitted_capsule.h"
#include "shapes/principal_axes.h"
#include "shapes/turn_onto.h"

namespace tweenfall {

namespace shapes {
namespace {

void require_points(std::span<const Vec3> points, const char* what) {
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite())
      throw std::invalid_argument(std::string(what) + " around points needs finite ones, but point " +
                                  std::to_string(i) + " is (" + number_text(points[i].x()) + ", " +
                                  number_text(points[i].y()) + ", " + number_text(points[i].z()) + ")");
}

/// The diagonal of the box around them along the axes, m.
double extent_of(std::span<const Vec3> points) {
  Vec3 low = points.front(), high = low;
  for (const Vec3& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).norm();
}

/// The point farthest along a direction; of equal ones the first.
std::size_t farthest_point(std::span<const Vec3> points, const Vec3& direction) {
  std::size_t best = 0;
  double most = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double along = direction.dot(points[i]);
    if (!(along > most)) continue;
    most = along;
    best = i;
  }
  return best;
}

/// Along the axes, perpendicular to them, and in between: 26 directions.
std::vector<std::size_t> outermost(std::span<const Vec3> points) {
  std::vector<std::size_t> chosen;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x != 0 || y != 0 || z != 0) chosen.push_back(farthest_point(points, Vec3(x, y, z)));
  return chosen;
}

/// The point for which `measure` is greatest; of equal ones the first.
template <class Measure>
std::size_t index_of_greatest(std::span<const Vec3> points, const Measure& measure) {
  const auto found = std::ranges::max_element(points, {}, measure);
  return static_cast<std::size_t>(found - points.begin());
}

/// Four points: the one farthest from the first point, the one farthest from that, the one farthest from the line of
/// both, and the one farthest from the plane of these.
std::vector<std::size_t> widest(std::span<const Vec3> points) {
  const auto from = [&](const Vec3& place) {
    return index_of_greatest(points, [&](const Vec3& point) { return (point - place).norm(); });
  };
  const std::size_t a = from(points.front()), b = from(points[a]);
  const Vec3 along = points[b] - points[a];
  const std::size_t c =
      index_of_greatest(points, [&](const Vec3& point) { return along.cross(point - points[a]).norm(); });
  const Vec3 normal = along.cross(points[c] - points[a]);
  const std::size_t d =
      index_of_greatest(points, [&](const Vec3& point) { return std::abs(normal.dot(point - points[a])); });
  return {a, b, c, d};
}

ConvexHull hull_of_chosen(std::span<const Vec3> points, std::vector<std::size_t>& chosen) {
  std::ranges::sort(chosen);
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Vec3> places;
  places.reserve(chosen.size());
  for (const std::size_t index : chosen) places.push_back(points[index]);
  return ConvexHull(places);
}

std::optional<ConvexHull> hull_if_any(std::span<const Vec3> points, std::vector<std::size_t>& chosen) {
  try {
    return hull_of_chosen(points, chosen);
  } catch (const std::invalid_argument&) {
    return std::nullopt;
  }
}

/// A point that sticks out of a hull.
struct Outlier {
  double out;
  std::size_t index;
};

/// For each face, the point farthest outside of it; sorted by how far they stick out.
std::vector<Outlier> outliers_of(const ConvexHull& hull, std::span<const Vec3> points, double noise) {
  std::vector<Outlier> farthest(hull.faces().size(), {noise, points.size()});
  for (std::size_t i = 0; i < points.size(); ++i) {
    std::size_t face = 0;
    double out = -std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < hull.faces().size(); ++k) {
      const double its = hull.faces()[k].normal.dot(points[i]) - hull.faces()[k].offset;
      if (!(its > out)) continue;
      out = its;
      face = k;
    }
    if (out > farthest[face].out) farthest[face] = {out, i};
  }
  std::erase_if(farthest, [&](const Outlier& each) { return each.index == points.size(); });
  std::ranges::sort(
      farthest, [](const Outlier& a, const Outlier& b) { return a.out != b.out ? a.out > b.out : a.index < b.index; });
  return farthest;
}

struct OrientedBox {
  Mat3 axes = Mat3::Identity();
  Vec3 low{0, 0, 0}, high{0, 0, 0};  ///< along the axes
  double volume = std::numeric_limits<double>::infinity();
};

OrientedBox box_along(const Mat3& axes, std::span<const Vec3> points) {
  OrientedBox box;
  box.axes = axes;
  box.low = Vec3::Constant(std::numeric_limits<double>::infinity());
  box.high = -box.low;
  for (const Vec3& point : points) {
    const Vec3 local = axes.transpose() * point;
    box.low = box.low.cwiseMin(local);
    box.high = box.high.cwiseMax(local);
  }
  box.volume = (box.high - box.low).prod();
  return box;
}

/// Tries small turns about its own axes, smaller ones when none is better.
OrientedBox refined(OrientedBox box, std::span<const Vec3> points) {
  for (double turn = 0.2; turn > 1e-6;) {
    bool better = false;
    for (int axis = 0; axis < 3; ++axis)
      for (const double way : {-turn, turn}) {
        const Quat turned = exp_map(Vec3(way * Vec3::Unit(axis)));
        const OrientedBox tried = box_along(box.axes * turned.toRotationMatrix(), points);
        if (!(tried.volume < (1 - 1e-12) * box.volume)) continue;
        box = tried;
        better = true;
      }
    if (!better) turn *= 0.5;
  }
  return box;
}

}  // namespace
}  // namespace shapes

ConvexHull hull_around(std::span<const Vec3> points, std::size_t most) {
  shapes::require_points(points, "a hull");
  if (most < 4 || most > ConvexHull::most_vertices)
    throw std::invalid_argument("a hull can have 4 to " + std::to_string(ConvexHull::most_vertices) +
                                " vertices, but is asked for " + std::to_string(most));
  if (points.size() <= most) return ConvexHull(points);
  std::vector<std::size_t> chosen = shapes::outermost(points);
  if (most < chosen.size()) {
    std::ranges::sort(chosen);
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    if (chosen.size() > most) chosen.resize(most);
  }
  std::optional<ConvexHull> begun = shapes::hull_if_any(points, chosen);
  if (!begun) {
    // In a needle or a sheet that lies aslant, the same few points are the outermost ones in all of these directions.
    chosen = shapes::widest(points);
    begun = shapes::hull_if_any(points, chosen);
  }
  if (!begun) {
    static_cast<void>(ConvexHull(points));  // throws what is wrong with all of them
    throw std::invalid_argument("points that nearly lie in one plane have no hull of so few vertices");
  }
  ConvexHull hull = *begun;
  const double noise = 1e-6 * shapes::extent_of(points);
  while (chosen.size() < most) {
    const std::vector<shapes::Outlier> outliers = shapes::outliers_of(hull, points, noise);
    if (outliers.empty()) break;
    // Only those that stick out far: adding them changes how far the others do.
    for (const shapes::Outlier& each : outliers)
      if (chosen.size() < most && each.out >= 0.3 * outliers.front().out) chosen.push_back(each.index);
    hull = shapes::hull_of_chosen(points, chosen);
  }
  return hull;
}

Shape box_around(std::span<const Vec3> points) {
  const ConvexHull hull = hull_around(points);
  const std::span<const Vec3> corners = hull.vertices();
  shapes::OrientedBox best = shapes::box_along(Mat3::Identity(), corners);
  const auto consider = [&](const Mat3& axes) {
    const shapes::OrientedBox tried = shapes::box_along(axes, corners);
    if (tried.volume < (1 - 1e-9) * best.volume) best = tried;
  };
  consider(shapes::principal_axes(corners));
  for (const ConvexHull::Face& face : hull.faces()) {
    const std::span<const std::uint32_t> around = hull.corners(face);
    for (std::size_t i = 0; i < around.size(); ++i) {
      const Vec3 edge = corners[around[(i + 1) % around.size()]] - corners[around[i]];
      Mat3 axes;
      axes.col(1) = face.normal;
      axes.col(0) = (edge - face.normal.dot(edge) * face.normal).normalized();
      axes.col(2) = axes.col(0).cross(face.normal);
      consider(axes);
    }
  }
  // Around all points, including those that a hull of limited vertices leaves out.
  const shapes::OrientedBox box = shapes::box_along(shapes::refined(best, corners).axes, points);
  Shape shape{Box{0.5 * (box.high - box.low)}, {}};
  shape.offset.position = box.axes * (0.5 * (box.low + box.high));
  shape.offset.rotation = normalized(Quat(box.axes));
  validate(shape.solid);
  return shape;
}

Shape capsule_around(std::span<const Vec3> points, const std::optional<Vec3>& along) {
  shapes::require_points(points, "a capsule");
  std::optional<Vec3> unit;
  if (along) {
    unit = Vec3(*along / along->cwiseAbs().maxCoeff()).normalized();
    if (!unit->allFinite()) throw std::invalid_argument("the axis of a capsule must be finite and not zero");
  }
  const std::optional<shapes::FittedCapsule> fitted = shapes::fitted_capsule(points, unit);
  if (!fitted) throw std::invalid_argument("a capsule around points needs some that span a volume");
  const double extent = shapes::extent_of(points);
  if (!(extent > 0 && fitted->capsule.radius > 1e-6 * extent))
    throw std::invalid_argument("a capsule around points needs some beside its axis, but " +
                                std::string(extent > 0 ? "nearly all of the " : "all ") +
                                std::to_string(points.size()) + " points lie " +
                                (extent > 0 ? "on one straight line" : "at one place"));
  Shape shape{fitted->capsule, {}};
  shape.offset.position = fitted->center;
  shape.offset.rotation = normalized(shapes::turn_onto(Vec3(0, 1, 0), fitted->axis));
  validate(shape.solid);
  return shape;
}

}  // namespace tweenfall
