#include "document/read_functions.h"

#include <tweenfall/curves/functions.h>

#include "document/values.h"

#include <array>
#include <limits>

namespace tweenfall::document {

Curve<double> read_oscillator(const JsonValue& settings, double unit) {
  return oscillator({.amplitude = unit * number_in(settings, "amplitude", 1),
                     .hz = number_in(settings, "hz", 1),
                     .phase = radians(number_in(settings, "phase", 0)),
                     .damping = number_in(settings, "damping", 0),
                     .center = unit * number_in(settings, "center", 0)});
}

Curve<Vec3> read_vector_oscillator(const JsonValue& settings) {
  const Vec3 amplitude = vector_in(settings, "amplitude", Vec3(1, 1, 1));
  const Vec3 center = vector_in(settings, "center", Vec3(0, 0, 0));
  const Curve<double> unit = oscillator({.amplitude = 1,
                                         .hz = number_in(settings, "hz", 1),
                                         .phase = radians(number_in(settings, "phase", 0)),
                                         .damping = number_in(settings, "damping", 0)});
  constexpr double forever = std::numeric_limits<double>::infinity();
  return Curve<Vec3>(
      [amplitude, center, unit](double time, Side side) {
        const Sample<double> swing = unit.sample(time, side);
        const Vec3 value = center + swing.value * amplitude;
        const Vec3 rate = swing.rate * amplitude;
        const Vec3 acceleration = swing.acceleration * amplitude;
        return Sample<Vec3>{value, rate, acceleration};
      },
      -forever, forever);
}

Curve<Vec3> read_projectile(const JsonValue& settings) {
  return projectile({.from = vector_in(settings, "from", Vec3(0, 0, 0)),
                     .velocity = vector_in(settings, "velocity", Vec3(0, 0, 0)),
                     .gravity = vector_in(settings, "gravity", Vec3(0, -9.81, 0))});
}

namespace {

Outside rule_of(std::string_view word) {
  if (word == "linear") return Outside::linear;
  if (word == "repeat") return Outside::repeat;
  if (word == "repeat-offset") return Outside::repeat_offset;
  if (word == "pingpong") return Outside::pingpong;
  return Outside::hold;
}

}  // namespace

OutsideParts outside_of(const JsonValue& track, std::string_view side) {
  const JsonValue* given = usable(track, side);
  if (!given) return {};
  if (!given->is(JsonValue::Kind::object)) return {rule_of(given->text)};
  if (const JsonValue* slope = usable(*given, "slope")) return {Outside::linear, 0, slope};
  return {rule_of(text_in(*given, "mode")), number_in(*given, "count", 0)};
}

}  // namespace tweenfall::document
