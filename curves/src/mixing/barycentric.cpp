#include <tweenfall/curves/barycentric.h>

#include <stdexcept>

#include "color/alpha.h"
#include "curve/components.h"
#include "rotation/rotation_center.h"

namespace tweenfall::mixing {
namespace {

using Weights = std::span<const Sample<double>>;

// The weights divided by their sum.
class Shares {
 public:
  Shares(Weights weights, std::size_t values) : weights_(weights) {
    if (values == 0) throw std::invalid_argument("a mix needs at least one value; none were given");
    if (weights.size() != values)
      throw std::invalid_argument("a mix needs one weight per value; there are " + std::to_string(weights.size()) +
                                  " weights and " + std::to_string(values) + " values");
    math::Jet sum;
    std::size_t loaded = 0;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      const Sample<double>& w = weights[i];
      if (!std::isfinite(w.value) || !std::isfinite(w.rate) || !std::isfinite(w.acceleration))
        throw std::invalid_argument("weight " + std::to_string(i) + " must be finite with its rates; it is " +
                                    spans::text_of(w.value));
      sum = sum + math::Jet{w.value, w.rate, w.acceleration};
      if (w.value == 0) continue;
      ++loaded;
      only_ = i;
    }
    if (sum.v == 0 || !std::isfinite(1 / sum.v))
      throw std::invalid_argument("the weights of a mix must not sum to zero");
    if (loaded > 1) only_ = weights.size();
    whole_ = math::reciprocal(sum);
  }

  [[nodiscard]] std::size_t size() const noexcept { return weights_.size(); }
  [[nodiscard]] math::Jet operator[](std::size_t i) const noexcept {
    const Sample<double>& w = weights_[i];
    return math::Jet{w.value, w.rate, w.acceleration} * whole_;
  }
  /// The index of the only value whose weight is not 0; `size()` where there are several.
  [[nodiscard]] std::size_t only() const noexcept { return only_; }

 private:
  Weights weights_;
  std::size_t only_ = 0;
  math::Jet whole_;
};

// `get(i)` is the i-th value with its rates.
template <class T, class Get>
Sample<T> mean(const Shares& shares, const Get& get) {
  Sample<T> result{zero<T>(), zero<T>(), zero<T>()};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const math::Jet w = shares[i];
    const Sample<T> x = get(i);
    result.value += w.v * x.value;
    result.rate += w.v * x.rate + w.d * x.value;
    result.acceleration += w.v * x.acceleration + 2 * w.d * x.rate + w.dd * x.value;
  }
  if (shares.only() < shares.size()) result.value = get(shares.only()).value;
  return result;
}

template <class Get>
Sample<Quat> center(const Shares& shares, const Get& get) {
  Sample<Quat> result = rotations::rotation_center(shares.size(), get, [&shares](std::size_t i) { return shares[i]; });
  if (shares.only() < shares.size()) result.value = get(shares.only()).value;
  return result;
}

// Without the acceleration, in half the time.
template <class Get>
Sample<Quat> turning(const Shares& shares, const Get& get) {
  Sample<Quat> result = rotations::outer(
      rotations::turning_center(shares.size(), get, [&shares](std::size_t i) { return shares[i]; }).moving);
  if (shares.only() < shares.size()) result.value = get(shares.only()).value;
  return result;
}

}  // namespace
}  // namespace tweenfall::mixing

namespace tweenfall {

template <class T>
Sample<T> barycentric(std::span<const Sample<T>> values, mixing::Weights weights) {
  const mixing::Shares shares(weights, values.size());
  const auto get = [&values](std::size_t i) { return values[i]; };
  if constexpr (std::is_same_v<T, Quat>)
    return mixing::center(shares, get);
  else
    return mixing::mean<T>(shares, get);
}

template Sample<double> barycentric<double>(std::span<const Sample<double>>, mixing::Weights);
template Sample<Vec2> barycentric<Vec2>(std::span<const Sample<Vec2>>, mixing::Weights);
template Sample<Vec3> barycentric<Vec3>(std::span<const Sample<Vec3>>, mixing::Weights);
template Sample<Vec4> barycentric<Vec4>(std::span<const Sample<Vec4>>, mixing::Weights);
template Sample<Quat> barycentric<Quat>(std::span<const Sample<Quat>>, mixing::Weights);

Sample<Color> barycentric(std::span<const Sample<Color>> values, mixing::Weights weights, ColorSpace space) {
  const mixing::Shares shares(weights, values.size());
  const int hue = hue_index(space);
  const auto coordinates = [&](std::size_t i) { return to_space(values[i], space); };
  Sample<Vec4> mixed =
      mixing::mean<Vec4>(shares, [&](std::size_t i) { return color_spaces::premultiplied(coordinates(i), hue); });
  if (hue >= 0) {
    constexpr double turn = 0x1.921fb54442d18p+2;
    math::Jet sum, part;
    double first = 0;
    bool found = false;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const Sample<Vec4> c = coordinates(i);
      if (c.value[3] == 0 || !has_hue(c.value, space)) continue;
      math::Jet h{c.value[hue], c.rate[hue], c.acceleration[hue]};
      if (!found) first = h.v;
      found = true;
      h.v -= turn * std::floor((h.v - first) / turn + 0.5);
      const math::Jet w = shares[i];
      sum = sum + w * h;
      part = part + w;
    }
    const math::Jet h = part.v == 0 ? math::constant(first) : sum * math::reciprocal(part);
    mixed.value[hue] = h.v;
    mixed.rate[hue] = h.d;
    mixed.acceleration[hue] = h.dd;
  }
  Sample<Color> result = from_space(color_spaces::divided(mixed, hue), space);
  if (shares.only() < shares.size()) result.value = values[shares.only()].value;
  return result;
}

Motion barycentric(std::span<const Motion> values, mixing::Weights weights) {
  const mixing::Shares shares(weights, values.size());
  const Vec3 none(0, 0, 0);
  const Sample<Vec3> position = mixing::mean<Vec3>(shares, [&](std::size_t i) {
    return Sample<Vec3>{values[i].pose.position, values[i].twist.linear, none};
  });
  const Sample<Vec3> scale = mixing::mean<Vec3>(shares, [&](std::size_t i) {
    return Sample<Vec3>{values[i].pose.scale, values[i].scale_rate, none};
  });
  const Sample<Quat> rotation = mixing::turning(shares, [&](std::size_t i) {
    return Sample<Quat>{values[i].pose.rotation, values[i].twist.angular, none};
  });
  return {{position.value, rotation.value, scale.value}, {position.rate, rotation.rate}, scale.rate};
}

std::array<Sample<double>, 3> triangle_weights(const Sample<Vec3>& point, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a;
  const Vec3 normal = ab.cross(ac);
  // Products of the same numbers in the same order, so that at a corner the weights are exactly 1 and 0.
  const auto towards_b = [&](const Vec3& v) { return v.cross(ac).dot(normal); };
  const auto towards_c = [&](const Vec3& v) { return ab.cross(v).dot(normal); };
  const double all = normal.dot(normal);
  if (!(all > 1e-24 * ab.squaredNorm() * ac.squaredNorm()) || !std::isfinite(all))
    throw std::invalid_argument("the corners of a triangle must not lie on one line; they are " + spans::text_of(a) +
                                ", " + spans::text_of(b) + ", " + spans::text_of(c));
  std::array<Sample<double>, 3> result;
  const Vec3 from_a = point.value - a;
  result[1] = {towards_b(from_a) / all, towards_b(point.rate) / all, towards_b(point.acceleration) / all};
  result[2] = {towards_c(from_a) / all, towards_c(point.rate) / all, towards_c(point.acceleration) / all};
  result[0] = {1 - result[1].value - result[2].value, -result[1].rate - result[2].rate,
               -result[1].acceleration - result[2].acceleration};
  return result;
}

}  // namespace tweenfall
