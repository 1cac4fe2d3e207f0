#include "document/read/read_hull.h"

#include "document/read/values.h"

#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/sweep.h>

#include <stdexcept>

namespace tweenfall::document {

namespace {

template <class T>
std::vector<T> points_in(const JsonValue& object, std::string_view name) {
  std::vector<T> points;
  const JsonValue list = usable(object, name);
  if (!list) return points;
  for (const JsonValue& item : list.items()) {
    T point = T::Zero();
    bool whole = item.is(JsonValue::Kind::list) && item.items().size() == static_cast<std::size_t>(point.size());
    for (std::size_t i = 0; whole && i < item.items().size(); ++i) {
      whole = item.items()[i].is(JsonValue::Kind::number);
      point[static_cast<Eigen::Index>(i)] = item.items()[i].number();
    }
    if (!whole) return {};
    points.push_back(point);
  }
  return points;
}

// Straight from point to point.
template <class T>
Curve<T> polyline_curve(const std::vector<T>& points) {
  std::vector<Key<T>> keys;
  for (std::size_t i = 0; i < points.size(); ++i) keys.push_back({static_cast<double>(i), points[i], Ease::linear()});
  return keyed_curve<T>(std::span<const Key<T>>(keys));
}

// What `make` throws is told at the place.
template <class Make>
std::optional<Hull> made_hull(const JsonValue& at, Problems& problems, Make make) {
  try {
    return Hull{ConvexHull(make())};
  } catch (const std::invalid_argument& fault) {
    problems.add(at, fault.what());
    return std::nullopt;
  }
}

}  // namespace

std::optional<Hull> read_hull(const JsonValue& shape, Problems& problems) {
  if (const JsonValue hull = usable(shape, "hull")) {
    const std::vector<Vec3> points = points_in<Vec3>(hull, "points");
    if (points.empty()) return std::nullopt;
    return made_hull(hull.find("points"), problems, [&] { return std::span<const Vec3>(points); });
  }
  if (const JsonValue turned = usable(shape, "lathe")) {
    const std::vector<Vec2> profile = points_in<Vec2>(turned, "profile");
    if (profile.size() < 2) return std::nullopt;
    const int sides = static_cast<int>(number_in(turned, "sides", 24));
    return made_hull(turned.find("profile"), problems, [&] {
      return lathe(polyline_curve(profile), {.segments = sides, .profile_steps = 1, .caps = false});
    });
  }
  if (const JsonValue swept = usable(shape, "sweep")) {
    const std::vector<Vec2> profile = points_in<Vec2>(swept, "profile");
    const std::vector<Vec3> rail = points_in<Vec3>(swept, "rail");
    if (profile.size() < 2 || rail.size() < 2) return std::nullopt;
    SweepOptions options{.rail_steps = 1, .profile_steps = 1, .caps = false};
    if (const JsonValue normal = usable(swept, "normal")) options.normal = vector_of(normal);
    return made_hull(swept, problems, [&] { return sweep(polyline_curve(profile), polyline_curve(rail), options); });
  }
  return std::nullopt;
}

}  // namespace tweenfall::document
