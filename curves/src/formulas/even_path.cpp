#include <tweenfall/curves/arc_length.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>

#include <stdexcept>

#include "curve/components.h"

namespace tweenfall::formulas {
namespace {

// The path's shape, over any parameter: a spline whose keys are as far apart in time as in space.
Curve<Vec3> shape_of(const EvenPath& p) {
  std::vector<Vec3> points = p.points;
  if (points.size() < 2)
    throw std::invalid_argument("a path needs at least two points; " + std::to_string(points.size()) + " given");
  if (p.closed) points.push_back(points.front());
  std::vector<Key<Vec3>> keys;
  double along = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!spans::all_finite(points[i]))
      throw std::invalid_argument("point " + std::to_string(i) + " of a path must be finite; it is " +
                                  spans::text_of(points[i]));
    if (i > 0) {
      const double chord = (points[i] - points[i - 1]).norm();
      if (!(along + chord > along) || !std::isfinite(along + chord))
        throw std::invalid_argument("point " + std::to_string(i) + " of a path, " + spans::text_of(points[i]) +
                                    ", must be apart from the one before it, at a finite distance; it is " +
                                    spans::text_of(chord) + " m away" +
                                    (p.closed && i + 1 == points.size() ? " (a closed path ends at its first)" : ""));
      along += chord;
    }
    keys.push_back({.time = along, .value = points[i], .ease = p.ease});
  }
  return keyed_curve<Vec3>(keys, {.ends = p.closed ? Ends::wrap : Ends::secant});
}

}  // namespace
}  // namespace tweenfall::formulas

namespace tweenfall {

Curve<Vec3> even_path(const EvenPath& settings) {
  return even_path(formulas::shape_of(settings), settings.duration);
}

Curve<Vec3> even_path(const Curve<Vec3>& shape, double duration) {
  if (!(duration > 0) || !std::isfinite(duration))
    throw std::invalid_argument("a path's duration must be finite and > 0 s; it is " + spans::text_of(duration));
  if (!(shape.duration() > 0) || !std::isfinite(shape.duration()))
    throw std::invalid_argument("a path's shape must begin and end; it leads from " + spans::text_of(shape.start()) +
                                " s to " + spans::text_of(shape.end()) + " s");
  const double length = arc_length(shape, shape.start(), shape.end());
  if (!(length > 0) || !std::isfinite(length))
    throw std::invalid_argument("a path's length must be finite and > 0 m; it is " + spans::text_of(length));
  return at_even_speed(shape, 0, duration);
}

}  // namespace tweenfall
