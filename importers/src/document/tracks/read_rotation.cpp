#include "document/tracks/read_rotation.h"

#include <tweenfall/curves/barycentric.h>
#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/modifiers.h>
#include <tweenfall/curves/number_text.h>

#include "document/read/values.h"
#include "document/tracks/read_functions.h"
#include "document/tracks/read_keys.h"
#include "document/tracks/read_mix.h"
#include "document/tracks/read_modifiers.h"
#include "document/tracks/read_splines.h"

#include <cmath>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

Vec3 in_radians(const Vec3& angles) {
  return {radians(angles[0]), radians(angles[1]), radians(angles[2])};
}

// The angular velocity per rate of each angle: the axes of the three turns at these angles.
Mat3 turn_axes(const Vec3& angles, const EulerOrder& order) {
  Mat3 axes;
  Quat before(1, 0, 0, 0);
  for (int i = 0; i < 3; ++i) {
    // Extrinsic turns are the intrinsic ones in reverse.
    const int which = order.intrinsic ? i : 2 - i;
    Vec3 axis(0, 0, 0);
    axis[order.axes[which]] = 1;
    axes.col(which) = before.toRotationMatrix() * axis;
    const elementary::SinCos half = elementary::sin_cos(angles[which] / 2);
    before = before * Quat(half.cos, half.sin * axis[0], half.sin * axis[1], half.sin * axis[2]);
  }
  return axes;
}

class RotationTrack {
 public:
  RotationTrack(const json::Value& track, const ClipTimes& times, Problems& problems)
      : track_(track),
        list_(track.is(Kind::list) ? track : usable(track, "keys")),
        times_(times),
        problems_(problems) {}

  std::optional<Curve<Quat>> read() {
    if (usable(track_, "axis")) return about_axis();
    if (const json::Value mix = usable(track_, "barycentric")) return mixed(mix);
    if (has_function(track_)) {
      const std::optional<Curve<Quat>> spline = read_rotation_spline(track_, problems_);
      return spline ? std::optional(with_outside_of(track_, *spline)) : std::nullopt;
    }
    if (!list_ || list_.items().empty()) return {};
    const json::Value first = key_parts(list_.items().front()).value;
    if (!first) {
      (void)times_.of_keys(list_, problems_);
      return {};
    }
    if (first.find("euler")) return in_euler();
    if (first.find("angle")) return in_axis_angle();
    return in_quaternions(text_in(track_, "turn") == "long");
  }

  /// Only the angle, from plain degrees.
  std::optional<Curve<double>> read_angle() {
    std::optional<Curve<double>> angle;
    if (const json::Value mix = usable(track_, "barycentric"))
      angle = mixed_angle(mix);
    else if (has_function(track_))
      angle = read_angle_function(track_, problems_);
    else if (list_)
      angle = degrees_curve([](const json::Value& value) { return value; }, {});
    if (!angle) return {};
    angle = with_outside_of(track_, *angle);
    return usable(track_, "modifiers") ? with_modifiers(*angle) : angle;
  }

 private:
  std::optional<Curve<Quat>> about_axis() {
    const std::optional<Vec3> axis = axis_of(usable(track_, "axis"), problems_);
    const std::optional<Curve<double>> angle = read_angle();
    if (!axis || !angle) return {};
    return axis_curve(*axis, *angle);
  }

  std::optional<Curve<double>> mixed_angle(const json::Value& mix) {
    const auto angle_of = [](const json::Value& value) {
      return value.is(Kind::number) ? std::optional(radians(value.number())) : std::nullopt;
    };
    const std::optional<std::vector<Curve<double>>> weights = read_mix_weights(mix, times_, problems_);
    const std::optional<std::vector<Curve<double>>> values = read_mix_values<double>(mix, angle_of);
    if (!weights || !values) return {};
    return barycentric_curve<double>(*values, *weights);
  }

  std::optional<Curve<Quat>> mixed(const json::Value& mix) {
    const EulerOrder order = order_of(text_in(track_, "order", "XYZ"));
    const auto rotation = [&](const json::Value& value) { return rotation_of(value, order, problems_); };
    const std::optional<std::vector<Curve<double>>> weights = read_mix_weights(mix, times_, problems_);
    const std::optional<std::vector<Curve<Quat>>> values = read_mix_values<Quat>(mix, rotation);
    if (!weights || !values) return {};
    return barycentric_curve<Quat>(*values, *weights);
  }

  // Modifiers are in degrees.
  template <class T>
  std::optional<Curve<T>> with_modifiers(const Curve<T>& angle) {
    const auto scaled = [](const Curve<T>& curve, double factor) {
      const std::vector<Modifier> scaling = {{modifiers::Placement{.value_scale = factor}}};
      if constexpr (std::is_same_v<T, double>)
        return modified(curve, scaling);
      else
        return modified<T>(curve, std::vector(static_cast<std::size_t>(T::RowsAtCompileTime), scaling));
    };
    const std::optional<Curve<T>> in_degrees = with_modifiers_of(track_, scaled(angle, degrees(1)), problems_);
    return in_degrees ? std::optional(scaled(*in_degrees, radians(1))) : std::nullopt;
  }

  // The unwrapped angle about one axis. Rates are degrees per second, or angular velocities along `axis`.
  std::optional<Curve<double>> degrees_curve(const std::function<json::Value(const json::Value&)>& angle_in,
                                             const std::optional<Vec3>& axis) {
    KeyReader<double> reader;
    reader.value = [&](const json::Value& value) -> std::optional<double> {
      const json::Value angle = angle_in(value);
      if (!angle || !angle.is(Kind::number)) return {};
      return radians(angle.number());
    };
    reader.rate = [&](const json::Value& rate, double) -> std::optional<double> {
      if (rate.is(Kind::number)) return radians(rate.number());
      const std::optional<Vec3> given = vector_of(rate);
      if (!given || !axis) return {};
      const double along = given->dot(*axis);
      const Vec3 across = *given - along * *axis;
      if (across.norm() > 1e-9 * given->norm()) {
        problems_.add(rate, "all keys turn about one axis, and this rate turns about another");
        return {};
      }
      return radians(along);
    };
    reader.unit = radians(1);
    return read_keys<double>(list_, times_, reader, key_options_of(track_), problems_);
  }

  std::optional<Curve<Quat>> in_euler() {
    const EulerOrder order = order_of(text_in(track_, "order", "XYZ"));
    KeyReader<Vec3> reader;
    reader.value = [](const json::Value& value) -> std::optional<Vec3> {
      const json::Value euler = usable(value, "euler");
      const std::optional<Vec3> angles = euler ? vector_of(euler) : std::nullopt;
      if (!angles) return {};
      return in_radians(*angles);
    };
    reader.rate = [&](const json::Value& rate, const Vec3& angles) -> std::optional<Vec3> {
      const std::optional<Vec3> velocity = vector_of(rate);
      if (!velocity) return {};
      if (velocity->isZero(0)) return Vec3(0, 0, 0);
      // Cramer's rule: the three axes are unit vectors, so the determinant says how near to a gimbal lock this is.
      const Mat3 axes = turn_axes(angles, order);
      const double determinant = axes.col(0).dot(axes.col(1).cross(axes.col(2)));
      if (std::abs(determinant) < 1e-6) {
        problems_.add(
            rate,
            "at these angles two of the three turns share an axis (gimbal lock), so no rates of the angles give "
            "this angular velocity; use \"quat\" or another \"order\"");
        return {};
      }
      const Vec3 wanted = in_radians(*velocity);
      const Vec3 rates(wanted.dot(axes.col(1).cross(axes.col(2))) / determinant,
                       axes.col(0).dot(wanted.cross(axes.col(2))) / determinant,
                       axes.col(0).dot(axes.col(1).cross(wanted)) / determinant);
      return rates;
    };
    reader.unit = radians(1);
    const std::optional<Curve<Vec3>> angles = read_keys<Vec3>(list_, times_, reader, key_options_of(track_), problems_);
    if (!angles) return {};
    std::optional<Curve<Vec3>> turned = with_outside_of(track_, *angles);
    if (usable(track_, "modifiers")) turned = with_modifiers(*turned);
    return turned ? std::optional(euler_curve(*turned, order)) : std::nullopt;
  }

  // Angles about a common axis keep full turns; about different axes they are ordinary rotations.
  std::optional<Curve<Quat>> in_axis_angle() {
    const json::Value first = usable(key_parts(list_.items().front()).value, "axis");
    std::optional<Vec3> axis = first ? axis_of(first, problems_) : std::nullopt;
    bool one_axis = axis.has_value();
    json::Value many_turns;
    for (const json::Value& key : list_.items()) {
      const KeyParts parts = key_parts(key);
      for (const json::Value& value : {parts.value, parts.value_in}) {
        const json::Value other = value ? usable(value, "axis") : json::Value();
        Problems unheard;
        const std::optional<Vec3> unit = other ? axis_of(other, unheard) : std::nullopt;
        if (one_axis && unit && !((*unit - *axis).norm() < 1e-12)) one_axis = false;
        if (value && std::abs(number_in(value, "angle", 0)) > 360) many_turns = usable(value, "angle");
      }
    }
    if (one_axis) {
      const std::optional<Curve<double>> angle =
          degrees_curve([](const json::Value& value) { return usable(value, "angle"); }, axis);
      if (!angle) return {};
      return axis_curve(*axis, with_outside_of(track_, *angle));
    }
    if (many_turns)
      problems_.add(many_turns,
                    number_text(many_turns.number()) +
                        " degrees are more than a turn, which only a track whose keys share one axis can keep");
    return in_quaternions(false);
  }

  std::optional<Curve<Quat>> in_quaternions(bool long_way) {
    KeyReader<Quat> reader;
    reader.value = [&](const json::Value& value) { return rotation_of(value, {}, problems_); };
    reader.rate = [](const json::Value& rate, const Quat&) -> std::optional<Vec3> {
      const std::optional<Vec3> velocity = vector_of(rate);
      if (!velocity) return {};
      return in_radians(*velocity);
    };
    reader.unit = radians(1);
    reader.turn = [&](const json::Value& key) { return turn_of(key, long_way); };
    const std::optional<Curve<Quat>> curve = read_keys<Quat>(list_, times_, reader, key_options_of(track_), problems_);
    if (!curve) return {};
    return with_outside_of(track_, *curve);
  }

  // The way to the next key: as stated by the key, or else by the track.
  Turn turn_of(const json::Value& key, bool long_way) {
    Turn turn{long_way ? Turn::Way::longer : Turn::Way::shorter};
    const json::Value said = key.is(Kind::object) ? usable(key, "turn") : json::Value();
    if (!said) return turn;
    const std::string way = said.is(Kind::text) ? std::string(said.text()) : text_in(said, "way");
    if (!way.empty()) turn.way = way == "long" ? Turn::Way::longer : Turn::Way::shorter;
    if (!said.is(Kind::object)) return turn;
    turn.whole_turns = static_cast<int>(number_in(said, "turns", 0));
    if (const json::Value axis = usable(said, "axis")) {
      turn.way = Turn::Way::along;
      turn.axis = axis_of(axis, problems_).value_or(Vec3(0, 0, 1));
    }
    return turn;
  }

  const json::Value& track_;
  json::Value list_;
  const ClipTimes& times_;
  Problems& problems_;
};

}  // namespace

std::optional<Curve<Quat>> read_rotation_track(const json::Value& track, const ClipTimes& times, Problems& problems) {
  return RotationTrack(track, times, problems).read();
}

std::optional<Curve<double>> read_angle_track(const json::Value& track, const ClipTimes& times, Problems& problems) {
  return RotationTrack(track, times, problems).read_angle();
}

}  // namespace tweenfall::document
