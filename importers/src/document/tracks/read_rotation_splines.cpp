#include <tweenfall/curves/quaternion_cubic.h>

#include "document/read/values.h"
#include "document/tracks/read_splines.h"

#include <stdexcept>

namespace tweenfall::document {

namespace {

// Empty where one of them is faulty.
std::vector<Quat> rotations_in(const json::Value& settings, Problems& problems) {
  std::vector<Quat> result;
  for (const json::Value& each : usable(settings, "points").items()) {
    const std::optional<Quat> q = rotation_of(each, order_of(text_in(each, "order", "XYZ")), problems);
    if (!q) return {};
    result.push_back(*q);
  }
  return result;
}

std::optional<Vec3> velocity_in(const json::Value& settings, std::string_view end) {
  const json::Value said = usable(settings, end);
  if (!said) return {};
  return Vec3(radians(1) * vector_in(said, "rate", Vec3(0, 0, 0)));
}

std::optional<Curve<Quat>> through_rotations(const json::Value& settings, Problems& problems) {
  const std::vector<Quat> points = rotations_in(settings, problems);
  const std::string why = "one for each of the " + std::to_string(points.size()) + " rotations";
  if (points.empty() || !has_count(settings, "times", points.size(), why, problems) ||
      !has_rising_times(settings, problems))
    return {};
  return clamped_rotation(times_in(settings, even_times(points.size() - 1)), points, velocity_in(settings, "start"),
                          velocity_in(settings, "end"));
}

std::optional<Curve<Quat>> by_controls(const json::Value& settings, Problems& problems) {
  const std::vector<Quat> points = rotations_in(settings, problems);
  const std::size_t curves = points.empty() ? 0 : bezier_curves_in(settings, 3, problems);
  if (curves == 0) return {};
  return bezier_rotation(times_in(settings, even_times(curves)), points);
}

}  // namespace

std::optional<Curve<Quat>> read_rotation_spline(const json::Value& track, Problems& problems) {
  for (const auto& [name, read] : {std::pair("spline", &through_rotations), std::pair("bezier", &by_controls)}) {
    const json::Value settings = usable(track, name);
    if (!settings || has_faults(settings) || !usable(settings, "points")) continue;
    try {
      return read(settings, problems);
    } catch (const std::invalid_argument& fault) {
      problems.add(settings, fault.what());
    }
  }
  return {};
}

}  // namespace tweenfall::document
