#include <tweenfall/curves/quaternion_cubic.h>

#include <stdexcept>

#include "curve/curve_data.h"
#include "turns/natural.h"
#include "turns/turn_rule.h"

namespace tweenfall::rotations {
namespace {

std::string named_key(std::size_t i, double time) {
  return "key " + std::to_string(i) + " (time " + spans::text_of(time) + " s) ";
}

void check_key_times(std::span<const double> times) {
  if (times.empty()) throw std::invalid_argument("a curve needs at least one key; none were given");
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i])) throw std::invalid_argument(named_key(i, times[i]) + "must have a finite time");
    if (i > 0 && !(times[i] > times[i - 1]))
      throw std::invalid_argument(named_key(i, times[i]) + "must come after the key before it, at " +
                                  spans::text_of(times[i - 1]) + " s");
  }
}

// All scaled to unit length, each with the sign that is nearer to the one before.
std::vector<Quat> aligned(std::span<const Quat> rotations, const char* what) {
  std::vector<Quat> result;
  for (std::size_t i = 0; i < rotations.size(); ++i) {
    try {
      const Quat unit = normalized(rotations[i]);
      result.push_back(result.empty() ? unit : hemisphere_aligned(unit, result.back()));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(std::string(what) + " " + std::to_string(i) + " is not a rotation: " + error.what());
    }
  }
  return result;
}

}  // namespace
}  // namespace tweenfall::rotations

namespace tweenfall {

Curve<Quat> bezier_rotation(std::span<const double> times, std::span<const Quat> controls) {
  rotations::check_key_times(times);
  const std::size_t wanted = 3 * times.size() - 2;
  if (controls.size() != wanted)
    throw std::invalid_argument("cubics through " + std::to_string(times.size()) + " keys take " +
                                std::to_string(wanted) + " control rotations; there are " +
                                std::to_string(controls.size()));
  const std::vector<Quat> units = rotations::aligned(controls, "control");
  if (times.size() == 1) return CurveAccess::one_key(units[0], times[0]);
  std::vector<RotationSpan> spans;
  for (std::size_t i = 0; i + 1 < times.size(); ++i) {
    const Quat* c = &units[3 * i];
    RotationSpan span =
        turns::blank_span({times[i], times[i + 1] - times[i], c[0], c[3], Vec3(0, 0, 0), Vec3(0, 0, 0)});
    turns::set_de_casteljau(span, c[0], c[1], c[2], c[3]);
    spans.push_back(span);
  }
  return CurveAccess::from_spans<Quat>(spans, times.back());
}

Curve<Quat> clamped_rotation(std::span<const double> times, std::span<const Quat> rotations,
                             const std::optional<Vec3>& start, const std::optional<Vec3>& end) {
  rotations::check_key_times(times);
  if (rotations.size() != times.size())
    throw std::invalid_argument("a curve needs one rotation per time; there are " + std::to_string(rotations.size()) +
                                " rotations and " + std::to_string(times.size()) + " times");
  for (const std::optional<Vec3>& velocity : {start, end})
    if (velocity && !spans::all_finite(*velocity))
      throw std::invalid_argument("the angular velocity at an end must be finite; it is " + spans::text_of(*velocity));
  const std::vector<Quat> units = rotations::aligned(rotations, "key");
  if (times.size() == 1) return CurveAccess::one_key(units[0], times[0]);
  std::vector<turns::Stretch> stretches;
  for (std::size_t i = 0; i + 1 < units.size(); ++i)
    stretches.push_back({times[i], times[i + 1] - times[i], units[i], units[i + 1],
                         log_map(units[i].conjugate() * units[i + 1]), Vec3(0, 0, 0)});
  turns::NaturalEnds ends;
  ends.start =
      start ? Vec3(units.front().conjugate() * *start) : Vec3(stretches.front().way / stretches.front().duration);
  ends.end = end ? Vec3(units.back().conjugate() * *end) : Vec3(stretches.back().way / stretches.back().duration);
  std::vector<RotationSpan> spans;
  turns::append_natural(stretches, 0, stretches.size(), ends, spans);
  return CurveAccess::from_spans<Quat>(spans, times.back());
}

}  // namespace tweenfall
