#include "plot/track_values.h"

#include <tweenfall/anim/component.h>

namespace tweenfall::plotting {

namespace {

std::vector<double> parts(const Vec3& vector) {
  return {vector.x(), vector.y(), vector.z()};
}
std::vector<double> parts(const Quat& q) {
  return {q.x(), q.y(), q.z(), q.w()};
}

}  // namespace

std::vector<std::string> component_names(const TrackCurve& curve) {
  if (std::holds_alternative<Curve<Vec2>>(curve)) return {"x", "y"};
  if (std::holds_alternative<Curve<Vec3>>(curve)) return {"x", "y", "z"};
  if (std::holds_alternative<Curve<Vec4>>(curve) || std::holds_alternative<Curve<Quat>>(curve))
    return {"x", "y", "z", "w"};
  if (std::holds_alternative<Curve<Color>>(curve)) return {"r", "g", "b", "a"};
  if (std::holds_alternative<StepCurve<std::string>>(curve)) return {};
  if (const auto* weights = std::get_if<WeightCurves>(&curve)) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < weights->size(); ++i) names.push_back(std::to_string(i));
    return names;
  }
  return {"value"};
}

std::vector<std::string> rate_names(const TrackCurve& curve) {
  if (std::holds_alternative<Curve<Quat>>(curve)) return {"x", "y", "z"};
  if (std::holds_alternative<StepCurve<bool>>(curve)) return {};
  return component_names(curve);
}

std::vector<TrackPoint> recorded_track(const Recording& recording, std::size_t node, std::string_view property_name,
                                       std::size_t first, std::size_t last) {
  std::vector<TrackPoint> points;
  const std::optional<Component> component = component_named(property_name);
  // A single angle is not derived from the recorded rotation.
  const bool coordinate = component && component->property == Property::position;
  const Property property = coordinate ? Property::position : property_named(property_name);
  if (property != Property::position && property != Property::rotation) return points;
  const NodeRecord& record = recording.nodes[node];
  Quat before(0, 0, 0, 0);
  for (std::size_t frame = first; frame <= last; ++frame) {
    Motion local = record.world[frame].motion;
    if (record.parent != no_node) local = relative_to(recording.nodes[record.parent].world[frame].motion, local);
    TrackPoint& point = points.emplace_back();
    point.time = recording.times[frame];
    if (property == Property::position) {
      point.values = parts(local.pose.position);
      point.rates = parts(local.twist.linear);
      if (coordinate) {
        const auto index = static_cast<std::size_t>(component->index);
        point.values = {point.values[index]};
        point.rates = {point.rates[index]};
      }
    } else {
      Quat rotation = local.pose.rotation;
      if (rotation.dot(before) < 0) rotation.coeffs() = -rotation.coeffs();
      before = rotation;
      point.values = parts(rotation);
      point.rates = parts(local.twist.angular);
    }
  }
  return points;
}

}  // namespace tweenfall::plotting
