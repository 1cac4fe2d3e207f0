#include "document/shapes/points.h"

#include <tweenfall/curves/keys.h>

#include <span>

namespace tweenfall::document::shapes {

namespace {

template <class T>
std::vector<T> points_in(const json::Value& list) {
  std::vector<T> points;
  for (const json::Value& item : list.items()) {
    T point = T::Zero();
    bool whole = item.is(json::Value::Kind::list) && item.items().size() == static_cast<std::size_t>(point.size());
    for (std::size_t i = 0; whole && i < item.items().size(); ++i) {
      whole = item.items()[i].is(json::Value::Kind::number);
      point[static_cast<Eigen::Index>(i)] = item.items()[i].number();
    }
    if (!whole) return {};
    points.push_back(point);
  }
  return points;
}

template <class T>
Curve<T> polyline_through(const std::vector<T>& points) {
  std::vector<Key<T>> keys;
  for (std::size_t i = 0; i < points.size(); ++i) keys.push_back({static_cast<double>(i), points[i], Ease::linear()});
  return keyed_curve<T>(std::span<const Key<T>>(keys));
}

}  // namespace

std::vector<Vec2> points_2(const json::Value& list) {
  return points_in<Vec2>(list);
}
std::vector<Vec3> points_3(const json::Value& list) {
  return points_in<Vec3>(list);
}

Curve<Vec2> polyline(const std::vector<Vec2>& points) {
  return polyline_through(points);
}
Curve<Vec3> polyline(const std::vector<Vec3>& points) {
  return polyline_through(points);
}

}  // namespace tweenfall::document::shapes
