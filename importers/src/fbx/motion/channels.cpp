#include "fbx/motion/channels.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace tweenfall::fbx {

namespace {

/// A layer's own curves of a property, to be laid over the layers below.
template <class T>
struct Overlay {
  Curve<T> value;
  Curve<double> weight;
  Layer::Blend blend;
  bool whole;  ///< multiplies factors or whole rotations
};

using Axes = std::array<std::size_t, 3>;
constexpr Axes plain_axes{0, 1, 2};

Curve<Vec3> vector_of(const Driver& driver, const Axes& axes, double factor) {
  return vector_curve(times(driver.parts[axes[0]], factor), times(driver.parts[axes[1]], factor),
                      times(driver.parts[axes[2]], factor));
}

Sample<double> rest_of(const Sample<double>& weight) {
  return {1 - weight.value, -weight.rate, -weight.acceleration};
}

Sample<double> row(const Sample<Vec3>& v, int i) {
  return {v.value[i], v.rate[i], v.acceleration[i]};
}

/// Each component of `a`, raised to one power, times that of `b`, raised to another.
Sample<Vec3> blended_factors(const Sample<Vec3>& a, const Sample<double>& a_power, const Sample<Vec3>& b,
                             const Sample<double>& b_power) {
  Sample<Vec3> result{};
  for (int i = 0; i < 3; ++i) {
    const Sample<double> one = product(power(row(a, i), a_power), power(row(b, i), b_power));
    result.value[i] = one.value;
    result.rate[i] = one.rate;
    result.acceleration[i] = one.acceleration;
  }
  return result;
}

Sample<Vec3> laid_over(const Sample<Vec3>& below, const Sample<Vec3>& value, const Sample<double>& weight,
                       Layer::Blend blend, bool factors) {
  if (blend == Layer::Blend::replace) return value;
  if (blend == Layer::Blend::add)
    return factors ? blended_factors(below, {1, 0, 0}, value, weight) : sum(below, scaled(value, weight));
  return factors ? blended_factors(below, rest_of(weight), value, weight)
                 : sum(scaled(below, rest_of(weight)), scaled(value, weight));
}

/// The layers above the first.
std::vector<Overlay<Vec3>> overlays(const std::vector<Driver>& drivers, const Stack& stack, bool (*whole)(const Layer&),
                                    const Axes& axes, double factor) {
  std::vector<Overlay<Vec3>> all;
  for (const Driver& driver : drivers) {
    if (driver.layer == 0) continue;
    const Layer& layer = stack.layers[driver.layer];
    all.push_back({vector_of(driver, axes, factor), layer.weight, layer.blend, whole(layer)});
  }
  return all;
}

/// The lowest layer as it is; without it the property's own value is below the others.
Curve<Vec3> lowest(const std::vector<Driver>& drivers, const Vec3& rest, const Axes& axes, double factor) {
  if (drivers.front().layer == 0) return vector_of(drivers.front(), axes, factor);
  return Curve<Vec3>(Vec3(rest[static_cast<Eigen::Index>(axes[0])], rest[static_cast<Eigen::Index>(axes[1])],
                          rest[static_cast<Eigen::Index>(axes[2])]) *
                     factor);
}

Knots knots_of(const Curve<Vec3>& base, const std::vector<Overlay<Vec3>>& above) {
  Knots knots;
  knots.of(base);
  for (const Overlay<Vec3>& each : above) knots.of(each.value).of(each.weight);
  return knots;
}

Curve<Vec3> layered(const Curve<Vec3>& base, const std::vector<Overlay<Vec3>>& above) {
  if (above.empty()) return base;
  return composed<Vec3>(
      [base, above](double at, Side side) {
        Sample<Vec3> result = base.sample(at, side);
        for (const Overlay<Vec3>& each : above)
          result = laid_over(result, each.value.sample(at, side), each.weight.sample(at, side), each.blend, each.whole);
        return result;
      },
      knots_of(base, above));
}

/// Angles layered over each other, some of them as whole rotations.
Curve<Quat> layered_rotations(const Curve<Vec3>& base, const std::vector<Overlay<Vec3>>& above,
                              const EulerOrder& order) {
  return composed<Quat>(
      [base, above, order](double at, Side side) {
        const Sample<Quat> still{Quat::Identity(), Vec3::Zero(), Vec3::Zero()};
        Sample<Vec3> angles = base.sample(at, side);
        Sample<Quat> rotation = from_euler(angles, order);
        bool as_angles = true;
        for (const Overlay<Vec3>& each : above) {
          const Sample<Vec3> value = each.value.sample(at, side);
          const Sample<double> weight = each.weight.sample(at, side);
          if (each.whole && each.blend != Layer::Blend::replace) {
            if (as_angles) rotation = from_euler(angles, order);
            const Sample<Quat> own = from_euler(value, order);
            rotation = each.blend == Layer::Blend::add ? product(rotation, slerp(still, own, weight))
                                                       : slerp(rotation, own, weight);
            as_angles = false;
          } else {
            if (!as_angles && each.blend != Layer::Blend::replace) angles = to_euler(rotation, order);
            angles = laid_over(angles, value, weight, each.blend, false);
            as_angles = true;
          }
        }
        return as_angles ? from_euler(angles, order) : rotation;
      },
      knots_of(base, above));
}

const std::vector<Driver>* drivers_of(const Stack* stack, std::size_t object, const std::string& property) {
  const std::vector<Driver>* drivers = stack ? stack->driving(object, property) : nullptr;
  return drivers && !drivers->empty() ? drivers : nullptr;
}

Vec3 finite(const Objects& objects, std::size_t object, const std::string& property, const Vec3& otherwise) {
  const Vec3 value = objects.vector(objects[object], property, otherwise);
  if (!value.allFinite())
    objects.source().fail(objects[object].record->at,
                          "\"" + property + "\" of \"" + objects[object].name + "\" is not finite");
  return value;
}

}  // namespace

Curve<double> times(const Curve<double>& curve, double factor) {
  if (factor == 1) return curve;
  std::vector<Span<double>> spans = curve.spans();
  if (spans.empty())
    return composed<double>(
        [curve, factor](double at, Side side) {
          return product(curve.sample(at, side), Sample<double>{factor, 0, 0});
        },
        Knots().of(curve));
  for (Span<double>& span : spans) {
    for (int i = 0; i <= span.degree; ++i) span.coefficients[static_cast<std::size_t>(i)] *= factor;
    span.end *= factor;
  }
  return Curve<double>(std::span<const Span<double>>(spans)).with_outside(curve.rule_before(), curve.rule_after());
}

Channel<Vec3> vector_channel(const Objects& objects, std::size_t object, const std::string& property,
                             const Vec3& otherwise, const Stack* stack) {
  const Vec3 rest = finite(objects, object, property, otherwise);
  const std::vector<Driver>* drivers = drivers_of(stack, object, property);
  if (!drivers) return {Curve<Vec3>(rest), false};
  const bool scale = property == "Lcl Scaling";
  const auto whole = scale ? +[](const Layer& layer) { return layer.factors; } : +[](const Layer&) { return false; };
  return {layered(lowest(*drivers, rest, plain_axes, 1), overlays(*drivers, *stack, whole, plain_axes, 1)), true};
}

Channel<double> number_channel(const Objects& objects, std::size_t object, const std::string& property,
                               double otherwise, const Stack* stack) {
  double rest = objects.number(objects[object], property, otherwise);
  if (!std::isfinite(rest)) rest = otherwise;
  const std::vector<Driver>* drivers = drivers_of(stack, object, property);
  if (!drivers) return {Curve<double>(rest), false};
  const bool lowest = drivers->front().layer == 0;
  const Curve<double> base = lowest ? drivers->front().parts[0] : Curve<double>(rest);
  std::vector<Overlay<double>> above;
  Knots knots;
  knots.of(base);
  for (std::size_t i = lowest ? 1 : 0; i < drivers->size(); ++i) {
    const Layer& layer = stack->layers[(*drivers)[i].layer];
    above.push_back({(*drivers)[i].parts[0], layer.weight, layer.blend, false});
    knots.of(above.back().value).of(above.back().weight);
  }
  if (above.empty()) return {base, true};
  return {composed<double>(
              [base, above](double at, Side side) {
                Sample<double> result = base.sample(at, side);
                for (const Overlay<double>& each : above) {
                  const Sample<double> value = each.value.sample(at, side), weight = each.weight.sample(at, side);
                  const Sample<double> part = each.blend == Layer::Blend::replace ? value : product(value, weight);
                  const Sample<double> kept = each.blend == Layer::Blend::add   ? result
                                              : each.blend == Layer::Blend::mix ? product(result, rest_of(weight))
                                                                                : Sample<double>{0, 0, 0};
                  result = {kept.value + part.value, kept.rate + part.rate, kept.acceleration + part.acceleration};
                }
                return result;
              },
              knots),
          true};
}

Channel<Quat> rotation_channel(const Objects& objects, std::size_t object, const std::string& property,
                               const EulerOrder& order, const Stack* stack) {
  constexpr double degree = std::numbers::pi / 180;
  const Axes axes{static_cast<std::size_t>(order.axes[0]), static_cast<std::size_t>(order.axes[1]),
                  static_cast<std::size_t>(order.axes[2])};
  const Vec3 rest = finite(objects, object, property, Vec3(0, 0, 0));
  const std::vector<Driver>* drivers = drivers_of(stack, object, property);
  if (!drivers) {
    const Vec3 angles(rest[order.axes[0]], rest[order.axes[1]], rest[order.axes[2]]);
    return {Curve<Quat>(from_euler(Vec3(angles * degree), order)), false};
  }
  try {
    const Curve<Vec3> base = lowest(*drivers, rest, axes, degree);
    const std::vector<Overlay<Vec3>> above = overlays(
        *drivers, *stack, [](const Layer& layer) { return layer.whole_rotations; }, axes, degree);
    for (const Overlay<Vec3>& each : above)
      if (each.whole && each.blend != Layer::Blend::replace) return {layered_rotations(base, above, order), true};
    return {euler_curve(layered(base, above), order), true};
  } catch (const std::invalid_argument& error) {
    // Each curve is valid, but their sum may not be.
    objects.source().fail(objects[object].record->at, std::string("an animated rotation: ") + error.what());
  }
}

}  // namespace tweenfall::fbx
