#include "plot/track_handles.h"

#include <tweenfall/curves/editing.h>

#include <stdexcept>
#include <type_traits>

namespace tweenfall::plotting {

namespace {

void append(std::vector<double>& list, double value) {
  list.push_back(value);
}
template <class Vector>
void append(std::vector<double>& list, const Vector& value) {
  list.insert(list.end(), value.data(), value.data() + value.size());
}

template <class T>
void add_handles(const Curve<T>& curve, std::vector<TrackHandle>& handles) {
  for (const Span<T>& span : curve.spans()) {
    if (span.degree != 2 && span.degree != 3) continue;
    try {
      const BezierPoints<T> points = bezier_points(Curve<T>(std::span<const Span<T>>(&span, 1))).front();
      for (const bool arrives : {false, true}) {
        const std::size_t key = arrives ? 3 : 0, tip = arrives ? 2 : 1;
        TrackHandle& handle = handles.emplace_back();
        handle.key = points.times[key];
        handle.arrives = arrives;
        append(handle.change, T(points.values[tip] - points.values[key]));
        handle.time.assign(handle.change.size(), points.times[tip] - points.times[key]);
      }
    } catch (const std::invalid_argument&) {
      // An ease, which has no handles.
    }
  }
}

}  // namespace

std::vector<TrackHandle> track_handles(const TrackCurve& curve) {
  std::vector<TrackHandle> handles;
  if (const auto* numbers = std::get_if<Curve<double>>(&curve)) add_handles(*numbers, handles);
  if (const auto* vectors = std::get_if<Curve<Vec2>>(&curve)) add_handles(*vectors, handles);
  if (const auto* vectors = std::get_if<Curve<Vec3>>(&curve)) add_handles(*vectors, handles);
  if (const auto* vectors = std::get_if<Curve<Vec4>>(&curve)) add_handles(*vectors, handles);
  return handles;
}

}  // namespace tweenfall::plotting
