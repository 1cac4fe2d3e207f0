#include <tweenfall/anim/blend_values.h>
#include <tweenfall/curves/barycentric.h>
#include <tweenfall/curves/rotation.h>

#include <cmath>
#include <type_traits>

#include "blending/mixer.h"

namespace tweenfall {

namespace blending {
namespace {

bool is(const Sample<double>& weight, double value) noexcept {
  return weight.value == value && weight.rate == 0 && weight.acceleration == 0;
}

// The numbers of a value whose parts are simply added.
template <class T>
auto& plain(T& value) noexcept {
  if constexpr (std::is_same_v<std::remove_const_t<T>, Color>)
    return value.rgba;
  else
    return value;
}

template <class T>
Sample<T> between(const Sample<T>& a, const Sample<T>& b, const Sample<double>& w, ColorSpace space) noexcept {
  if constexpr (std::is_same_v<T, Quat>) {
    return slerp(a, b, w);
  } else {
    const Sample<T> ends[]{a, b};
    const Sample<double> weights[]{{1 - w.value, -w.rate, -w.acceleration}, w};
    if constexpr (std::is_same_v<T, Color>)
      return barycentric(ends, weights, space);
    else
      return barycentric<T>(ends, weights);
  }
}

template <class T>
Sample<T> faded(const Sample<T>& a, const Sample<T>& b, const Sample<double>& weight, ColorSpace space) noexcept {
  if (is(weight, 0)) return a;
  if (is(weight, 1)) return b;
  // Beyond this, 1 is lost to rounding beside w.
  if (!(std::abs(weight.value) < 1e15)) return weight.value > 0 ? b : a;
  Sample<T> result = between(a, b, weight, space);
  if (weight.value == 0) result.value = a.value;
  if (weight.value == 1) result.value = b.value;
  return result;
}

}  // namespace
}  // namespace blending

template <class T>
Sample<T> cross_fade(const Sample<T>& a, const Sample<T>& b, const Sample<double>& weight) noexcept {
  return blending::faded(a, b, weight, ColorSpace::linear);
}

Sample<Color> cross_fade(const Sample<Color>& a, const Sample<Color>& b, const Sample<double>& weight,
                         ColorSpace space) noexcept {
  return blending::faded(a, b, weight, space);
}

template <class T>
Sample<T> add_difference(const Sample<T>& base, const Sample<T>& reference, const Sample<T>& value,
                         const Sample<double>& weight) noexcept {
  if (blending::is(weight, 0)) return base;
  if constexpr (std::is_same_v<T, Quat>) {
    const Sample<Quat> none{Quat::Identity(), Vec3(0, 0, 0), Vec3(0, 0, 0)};
    const Sample<Quat> part = slerp(none, product(inverse(reference), value), weight);
    Sample<Quat> result = product(base, part);
    if (weight.value == 0) result.value = base.value;
    return result;
  } else {
    using blending::plain;
    Sample<T> result = base;
    const Rate<T> apart = plain(value.value) - plain(reference.value), apart_rate = value.rate - reference.rate;
    plain(result.value) += weight.value * apart;
    result.rate += weight.value * apart_rate + weight.rate * apart;
    result.acceleration += weight.value * (value.acceleration - reference.acceleration) + 2 * weight.rate * apart_rate +
                           weight.acceleration * apart;
    return result;
  }
}

template <class T>
Sample<T> blend(std::span<const Sample<T>> values, std::span<const Sample<double>> weights, const Sample<T>& rest,
                double least) noexcept {
  const auto mean = [](std::span<const Sample<T>> kept, std::span<const Sample<double>> shares) noexcept {
    if constexpr (std::is_same_v<T, Color>)
      return barycentric(kept, shares, ColorSpace::linear);
    else
      return barycentric<T>(kept, shares);
  };
  blending::Mixer<Sample<T>, decltype(mean)> mixer(mean);
  const auto weight = [weights](std::size_t i) noexcept { return blending::above_nothing(weights[i]); };
  const auto value = [values](std::size_t i) noexcept -> const Sample<T>& { return values[i]; };
  return blending::fill(mixer, values.size(), weight, value, rest, least) ? mixer.mixed() : rest;
}

template Sample<double> cross_fade(const Sample<double>&, const Sample<double>&, const Sample<double>&) noexcept;
template Sample<Vec2> cross_fade(const Sample<Vec2>&, const Sample<Vec2>&, const Sample<double>&) noexcept;
template Sample<Vec3> cross_fade(const Sample<Vec3>&, const Sample<Vec3>&, const Sample<double>&) noexcept;
template Sample<Vec4> cross_fade(const Sample<Vec4>&, const Sample<Vec4>&, const Sample<double>&) noexcept;
template Sample<Quat> cross_fade(const Sample<Quat>&, const Sample<Quat>&, const Sample<double>&) noexcept;
template Sample<Color> cross_fade(const Sample<Color>&, const Sample<Color>&, const Sample<double>&) noexcept;

template Sample<double> add_difference(const Sample<double>&, const Sample<double>&, const Sample<double>&,
                                       const Sample<double>&) noexcept;
template Sample<Vec2> add_difference(const Sample<Vec2>&, const Sample<Vec2>&, const Sample<Vec2>&,
                                     const Sample<double>&) noexcept;
template Sample<Vec3> add_difference(const Sample<Vec3>&, const Sample<Vec3>&, const Sample<Vec3>&,
                                     const Sample<double>&) noexcept;
template Sample<Vec4> add_difference(const Sample<Vec4>&, const Sample<Vec4>&, const Sample<Vec4>&,
                                     const Sample<double>&) noexcept;
template Sample<Quat> add_difference(const Sample<Quat>&, const Sample<Quat>&, const Sample<Quat>&,
                                     const Sample<double>&) noexcept;
template Sample<Color> add_difference(const Sample<Color>&, const Sample<Color>&, const Sample<Color>&,
                                      const Sample<double>&) noexcept;

template Sample<double> blend(std::span<const Sample<double>>, std::span<const Sample<double>>, const Sample<double>&,
                              double) noexcept;
template Sample<Vec2> blend(std::span<const Sample<Vec2>>, std::span<const Sample<double>>, const Sample<Vec2>&,
                            double) noexcept;
template Sample<Vec3> blend(std::span<const Sample<Vec3>>, std::span<const Sample<double>>, const Sample<Vec3>&,
                            double) noexcept;
template Sample<Vec4> blend(std::span<const Sample<Vec4>>, std::span<const Sample<double>>, const Sample<Vec4>&,
                            double) noexcept;
template Sample<Quat> blend(std::span<const Sample<Quat>>, std::span<const Sample<double>>, const Sample<Quat>&,
                            double) noexcept;
template Sample<Color> blend(std::span<const Sample<Color>>, std::span<const Sample<double>>, const Sample<Color>&,
                             double) noexcept;

}  // namespace tweenfall
