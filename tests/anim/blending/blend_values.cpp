#include <tweenfall/anim/blend_values.h>

#include "anim/moving_pose.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

// Three coefficients of a parabola: a smooth value with its rate and acceleration.
template <class T>
Sample<T> moving_value(std::uint64_t seed, double t) {
  Random random(seed);
  if constexpr (std::is_same_v<T, Quat>) {
    const Vec3 spin = random.vector(1), away = random.vector(0.3);
    return {Quat(exp_map(t * spin) * exp_map(away)), spin, Vec3(0, 0, 0)};
  } else {
    const auto number = [&] { return random.between(0.2, 0.6); };
    if constexpr (std::is_same_v<T, double>) {
      const double a = number(), b = number(), c = number();
      return {a + b * t + c * t * t, b + 2 * c * t, 2 * c};
    } else {
      Rate<T> a, b, c;
      for (int i = 0; i < a.size(); ++i) a[i] = number(), b[i] = number(), c[i] = number();
      return {T{Rate<T>(a + b * t + c * t * t)}, b + 2 * c * t, 2 * c};
    }
  }
}

template <class T>
Vec4 numbers_of(const T& value) {
  if constexpr (std::is_same_v<T, double>) return {value, 0, 0, 0};
  if constexpr (std::is_same_v<T, Color>) return value.rgba;
  if constexpr (!std::is_same_v<T, double> && !std::is_same_v<T, Color>) {
    Vec4 out(0, 0, 0, 0);
    out.head(value.size()) = value;
    return out;
  }
}

template <class T, class At>
void check_value_rates(const At& at, double t) {
  if constexpr (std::is_same_v<T, Quat>) {
    const Quat back = at(t).value.conjugate();
    CHECK(near(at(t).rate, slope([&](double x) { return log_map(at(x).value * back); }, t), 1e-9));
  } else {
    CHECK(near(numbers_of<Rate<T>>(at(t).rate), slope([&](double x) { return numbers_of<T>(at(x).value); }, t), 1e-9));
  }
  CHECK(near(numbers_of<Rate<T>>(at(t).acceleration),
             slope([&](double x) { return numbers_of<Rate<T>>(at(x).rate); }, t), 1e-8));
}

template <class T>
bool same_value(const T& a, const T& b) {
  if constexpr (std::is_same_v<T, Quat>)
    return a.coeffs() == b.coeffs();
  else
    return a == b;
}
template <class T>
bool same_sample(const Sample<T>& a, const Sample<T>& b) {
  return same_value(a.value, b.value) && a.rate == b.rate && a.acceleration == b.acceleration;
}

}  // namespace

TEST_CASE_TEMPLATE("a blended value has exact rates and accelerations", T, double, Vec2, Vec3, Vec4, Quat, Color) {
  const double t = 0.1;
  check_value_rates<T>(
      [](double x) { return cross_fade(moving_value<T>(1, x), moving_value<T>(2, x), moving_weight(x)); }, t);
  check_value_rates<T>(
      [](double x) {
        return add_difference(moving_value<T>(1, x), moving_value<T>(2, x), moving_value<T>(3, x), moving_weight(x));
      },
      t);
  for (const double least : {0.1, 1.0, 100.0})
    for (const std::size_t count : {2, 3, 20}) {
      CAPTURE(least);
      CAPTURE(count);
      check_value_rates<T>(
          [&](double x) {
            std::vector<Sample<T>> values;
            std::vector<Sample<double>> weights;
            for (std::size_t i = 0; i < count; ++i) {
              values.push_back(moving_value<T>(10 + i, x));
              weights.push_back(moving_weight(x, 0.05 * static_cast<double>(i + 1)));
            }
            return blend<T>(values, weights, moving_value<T>(9, x), least);
          },
          t);
    }
}

TEST_CASE_TEMPLATE("weights 0 and 1 give a value bit for bit", T, double, Vec2, Vec3, Vec4, Quat, Color) {
  const auto a = moving_value<T>(1, 0.3), b = moving_value<T>(2, 0.3), rest = moving_value<T>(3, 0.3);
  CHECK(same_sample(cross_fade(a, b, {0, 0, 0}), a));
  CHECK(same_sample(cross_fade(a, b, {1, 0, 0}), b));
  CHECK(same_value(cross_fade(a, b, {0, 2, 0}).value, a.value));
  CHECK(same_value(cross_fade(a, b, {1, 2, 3}).value, b.value));
  CHECK(same_sample(add_difference(a, rest, b, {0, 0, 0}), a));
  CHECK(same_value(add_difference(a, rest, b, {0, 1, 0}).value, a.value));
  const std::vector<Sample<T>> values{a, b};
  const std::vector<Sample<double>> none{{0, 0, 0}, {-1, 0, 0}}, first{{0.7, 2, 1}, {0, 0, 0}};
  CHECK(same_sample(blend<T>(values, none, rest), rest));
  CHECK(same_sample(blend<T>(values, first, rest), a));
}

TEST_CASE("colors fade by light, unseen ones without a trace, and in another space where asked") {
  const Sample<Color> unseen{{Vec4(1, 0, 0, 0)}, Vec4::Zero(), Vec4::Zero()},
      blue{{Vec4(0, 0, 1, 1)}, Vec4::Zero(), Vec4::Zero()}, red{{Vec4(1, 0, 0, 1)}, Vec4::Zero(), Vec4::Zero()};
  CHECK(near(cross_fade(unseen, blue, {0.5, 0, 0}).value.rgba, Vec4(0, 0, 1, 0.5), 1e-15));
  CHECK(near(cross_fade(red, blue, {0.25, 0, 0}).value.rgba, Vec4(0.75, 0, 0.25, 1), 1e-15));
  CHECK(near(to_space(cross_fade(red, blue, {0.5, 0, 0}, ColorSpace::srgb).value, ColorSpace::srgb),
             Vec4(0.5, 0, 0.5, 1), 1e-14));
}
