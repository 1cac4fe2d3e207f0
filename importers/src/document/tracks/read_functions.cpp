#include "document/tracks/read_functions.h"

#include <tweenfall/curves/functions.h>

#include "document/grammar/grammar_functions.h"
#include "document/read/values.h"
#include "document/tracks/read_expression.h"
#include "document/tracks/read_splines.h"

#include <array>
#include <stdexcept>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

template <class T>
Curve<T> scaled(const Curve<double>& curve, const T& factor) {
  return combined<T>(std::span<const Curve<double>>(&curve, 1), std::span<const T>(&factor, 1));
}

Curve<double> oscillator_of(const json::Value& settings, double unit) {
  return oscillator({.amplitude = unit * number_in(settings, "amplitude", 1),
                     .hz = number_in(settings, "hz", 1),
                     .phase = radians(number_in(settings, "phase", 0)),
                     .damping = number_in(settings, "damping", 0),
                     .center = unit * number_in(settings, "center", 0)});
}

Curve<Vec3> vector_oscillator_of(const json::Value& settings) {
  const Curve<double> parts[] = {oscillator({.amplitude = 1,
                                             .hz = number_in(settings, "hz", 1),
                                             .phase = radians(number_in(settings, "phase", 0)),
                                             .damping = number_in(settings, "damping", 0)}),
                                 Curve<double>(1)};
  const Vec3 factors[] = {vector_in(settings, "amplitude", Vec3(1, 1, 1)),
                          vector_in(settings, "center", Vec3(0, 0, 0))};
  return combined<Vec3>(parts, factors);
}

Curve<double> spring_of(const json::Value& settings, double unit) {
  return damped_spring({.hz = number_in(settings, "hz", 1),
                        .damping_ratio = number_in(settings, "zeta", 1),
                        .position = unit * number_in(settings, "from", 0),
                        .velocity = unit * number_in(settings, "velocity", 0),
                        .goal = unit * number_in(settings, "goal", 0),
                        .goal_velocity = unit * number_in(settings, "goal_velocity", 0)});
}

// Each component oscillates independently.
Curve<Vec3> vector_spring_of(const json::Value& settings) {
  const Vec3 none(0, 0, 0);
  const Vec3 from = vector_in(settings, "from", none), velocity = vector_in(settings, "velocity", none);
  const Vec3 goal = vector_in(settings, "goal", none), goal_velocity = vector_in(settings, "goal_velocity", none);
  const auto axis = [&](Eigen::Index i) {
    return damped_spring({.hz = number_in(settings, "hz", 1),
                          .damping_ratio = number_in(settings, "zeta", 1),
                          .position = from[i],
                          .velocity = velocity[i],
                          .goal = goal[i],
                          .goal_velocity = goal_velocity[i]});
  };
  return parametric(axis(0), axis(1), axis(2));
}

Curve<Vec3> projectile_of(const json::Value& settings) {
  return projectile({.from = vector_in(settings, "from", Vec3(0, 0, 0)),
                     .velocity = vector_in(settings, "velocity", Vec3(0, 0, 0)),
                     .gravity = vector_in(settings, "gravity", Vec3(0, -9.81, 0))});
}

Curve<double> pendulum_of(const json::Value& settings) {
  return pendulum({.angle = radians(number_in(settings, "angle", 0)),
                   .rate = radians(number_in(settings, "rate", 0)),
                   .length = number_in(settings, "length", 1),
                   .gravity = number_in(settings, "gravity", 9.81)});
}

std::optional<Curve<Vec3>> orbit_of(const json::Value& settings, Problems& problems) {
  Orbit o{.center = vector_in(settings, "center", Vec3(0, 0, 0)),
          .periapsis = number_in(settings, "periapsis", 1),
          .eccentricity = number_in(settings, "eccentricity", 0),
          .gravitational_parameter = number_in(settings, "gravitational_parameter", 1),
          .passage = number_in(settings, "passage", 0)};
  if (const json::Value rotation = usable(settings, "rotation")) {
    const std::optional<Quat> q = rotation_of(rotation, order_of(text_in(rotation, "order", "XYZ")), problems);
    if (!q) return {};
    o.rotation = *q;
  }
  if (const json::Value period = usable(settings, "period")) {
    if (!(o.eccentricity < 1)) {
      problems.add(period,
                   "only an eccentricity below 1 has a period; give \"gravitational_parameter\" instead, in m^3/s^2");
      return {};
    }
    o = o.with_period(period.number());
  }
  return orbit(o);
}

std::optional<Curve<Vec3>> path_of(const json::Value& settings, Problems& problems) {
  EvenPath p{.closed = flag_in(settings, "closed", false), .duration = number_in(settings, "duration", 1)};
  const json::Value points = usable(settings, "points");
  if (!points) return {};
  for (const json::Value& each : points.items()) {
    const std::optional<Vec3> point = vector_of(each);
    if (!point) return {};
    if (!p.points.empty() && p.points.back() == *point) {
      problems.add(each, "neighboring points of a path are apart; this one is the same as the one before it");
      return {};
    }
    p.points.push_back(*point);
  }
  if (const std::optional<Ease> ease = Ease::named(text_in(settings, "ease", "natural"))) p.ease = *ease;
  return even_path(p);
}

Curve<Vec3> line_of(const json::Value& settings) {
  return line({.from = vector_in(settings, "from", Vec3(0, 0, 0)),
               .to = vector_in(settings, "to", Vec3(0, 0, 0)),
               .duration = number_in(settings, "duration", 1)});
}

std::optional<Curve<Vec3>> arc_of(const json::Value& settings, Problems& problems) {
  const json::Value axis = usable(settings, "axis");
  const std::optional<Vec3> direction = axis ? axis_of(axis, problems) : std::optional<Vec3>(Vec3(0, 0, 1));
  if (!direction) return {};
  return arc({.center = vector_in(settings, "center", Vec3(0, 0, 0)),
              .from = vector_in(settings, "from", Vec3(1, 0, 0)),
              .axis = *direction,
              .angle = radians(number_in(settings, "angle", 360)),
              .duration = number_in(settings, "duration", 1)});
}

bool has_spline(const json::Value& track) {
  return usable(track, "spline") || usable(track, "bezier") || usable(track, "b_spline");
}

std::optional<TrackCurve> function_of(const json::Value& track, Problems& problems) {
  const auto made = [](const auto& curve) { return curve ? std::optional<TrackCurve>(*curve) : std::nullopt; };
  const auto passing = [&](const auto& curve) -> std::optional<TrackCurve> {
    if (!curve) return {};
    return TrackCurve(with_outside_of(track, *curve));
  };
  if (const json::Value f = usable(track, "oscillator")) {
    const json::Value amplitude = usable(f, "amplitude");
    if (amplitude && amplitude.is(Kind::list)) return TrackCurve(vector_oscillator_of(f));
    return TrackCurve(oscillator_of(f, 1));
  }
  if (const json::Value f = usable(track, "spring")) {
    const json::Value goal = usable(f, "goal");
    if (goal && goal.is(Kind::list)) return TrackCurve(vector_spring_of(f));
    return TrackCurve(spring_of(f, 1));
  }
  if (const json::Value f = usable(track, "pendulum")) return TrackCurve(scaled(pendulum_of(f), degrees(1)));
  if (const json::Value f = usable(track, "projectile")) return TrackCurve(projectile_of(f));
  if (const json::Value f = usable(track, "orbit")) return made(orbit_of(f, problems));
  if (const json::Value f = usable(track, "path")) return passing(path_of(f, problems));
  if (const json::Value f = usable(track, "line")) return passing(std::optional(line_of(f)));
  if (const json::Value f = usable(track, "arc")) return passing(arc_of(f, problems));
  if (has_spline(track)) {
    switch (FunctionForms::dimension(track)) {
      case 2:
        return passing(read_spline<Vec2>(track, 1, problems));
      case 3:
        return passing(read_spline<Vec3>(track, 1, problems));
      case 4:
        return passing(read_spline<Vec4>(track, 1, problems));
      default:
        return passing(read_spline<double>(track, 1, problems));
    }
  }
  return read_expression(track, problems);
}

// The result of `make`; a number that the function refuses is reported at its settings.
template <class Make>
auto guarded(const json::Value& track, Problems& problems, const Make& make) -> decltype(make()) {
  try {
    return make();
  } catch (const std::invalid_argument& fault) {
    for (const std::string& name : FunctionForms::names())
      if (const json::Value settings = usable(track, name)) problems.add(settings, fault.what());
    return {};
  }
}

}  // namespace

bool has_function(const json::Value& track) {
  for (const std::string& name : FunctionForms::names())
    if (usable(track, name)) return true;
  return false;
}

std::optional<TrackCurve> read_function(const json::Value& track, Problems& problems) {
  return guarded(track, problems, [&] { return function_of(track, problems); });
}

std::optional<Curve<double>> read_angle_function(const json::Value& track, Problems& problems) {
  return guarded(track, problems, [&]() -> std::optional<Curve<double>> {
    if (const json::Value f = usable(track, "oscillator")) return oscillator_of(f, radians(1));
    if (const json::Value f = usable(track, "spring")) return spring_of(f, radians(1));
    if (has_spline(track)) return read_spline<double>(track, radians(1), problems);
    if (const json::Value f = usable(track, "pendulum")) return pendulum_of(f);
    const std::optional<TrackCurve> angle = read_expression(track, problems);
    if (!angle || !std::holds_alternative<Curve<double>>(*angle)) return {};
    return scaled(std::get<Curve<double>>(*angle), radians(1));
  });
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

OutsideParts outside_of(const json::Value& track, std::string_view side) {
  const json::Value given = usable(track, side);
  if (!given) return {};
  if (!given.is(json::Value::Kind::object)) return {rule_of(given.text())};
  if (const json::Value slope = usable(given, "slope")) return {Outside::linear, 0, slope};
  return {rule_of(text_in(given, "mode")), number_in(given, "count", 0)};
}

}  // namespace tweenfall::document
