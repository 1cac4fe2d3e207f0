// Numbers that are finite but absurd: a curve is finite wherever it is evaluated, or was refused.

#include "support.h"

#include <tweenfall/curves/keys.h>

#include <limits>
#include <stdexcept>

using namespace tweenfall;

namespace {

constexpr double absurd_values[] = {0,    1,     -1,    5e-324, 1e-300,
                                    1e15, 1e100, 1e300, -1e300, std::numeric_limits<double>::max()};

template <class V>
bool is_finite(const V& value) {
  if constexpr (std::is_same_v<V, double>)
    return std::isfinite(value);
  else if constexpr (std::is_same_v<V, Quat>)
    return value.coeffs().allFinite();
  else
    return value.allFinite();
}

// Whether a curve that was made is finite at its keys and between them; a refusal is fine.
template <class Make>
bool is_finite_or_refused(const Make& make) {
  try {
    const auto curve = make();
    for (int i = 0; i <= 64; ++i)
      for (const Side side : {Side::in, Side::out}) {
        const double time = curve.start() + (curve.end() - curve.start()) * i / 64;
        const auto sample = curve.sample(time, side);
        if (!is_finite(sample.value) || !is_finite(sample.rate) || !is_finite(sample.acceleration)) return false;
      }
    return true;
  } catch (const std::invalid_argument& refusal) {
    return std::string(refusal.what()).size() > 10;
  }
}

}  // namespace

TEST_CASE("keys of absurd values and times make finite curves or are refused") {
  for (const char* word : {"hold", "linear", "smooth", "smooth-clamped", "monotone", "quad-in-out", "elastic-out",
                           "spring(0.3s,0.5)", "bezier(0,1e6,0,1)"}) {
    const Ease ease = Ease::named(word).value();
    for (const double from : absurd_values)
      for (const double to : absurd_values)
        for (const double duration : {1.0, 5e-324, 1e-300, 1e-160, 1e-20, 1e20, 1e300}) {
          CAPTURE(word);
          CAPTURE(from);
          CAPTURE(to);
          CAPTURE(duration);
          CHECK(is_finite_or_refused([&] { return keyed_curve<double>({{0, from, ease}, {duration, to}}); }));
        }
  }
}

TEST_CASE("values and times that leave room for rates are taken, however large or small") {
  for (const char* word : {"linear", "smooth", "quad-in-out", "elastic-out"})
    for (const double value : {1e-300, 1e-100, 1e100, -1e200})
      for (const double duration : {1e-20, 1.0, 1e20}) {
        CAPTURE(word);
        CAPTURE(value);
        const Ease ease = Ease::named(word).value();
        CHECK(keyed_curve<double>({{0, 0, ease}, {duration, value}}).value(duration) == value);
      }
}

TEST_CASE("angles of absurd size make finite turns or are refused") {
  for (const double from : absurd_values)
    for (const double to : absurd_values) {
      CAPTURE(from);
      CAPTURE(to);
      const auto angle = [&] { return keyed_curve<double>({{0, from, Ease::smooth()}, {1, to}}); };
      CHECK(is_finite_or_refused([&] { return axis_curve({0, 0, 1}, angle()); }));
      CHECK(is_finite_or_refused([&] {
        return euler_curve(keyed_curve<Vec3>({{0, {from, to, from}, Ease::smooth()}, {1, {to, from, 1}}}),
                           EulerOrder{});
      }));
    }
  CHECK_THROWS_WITH_AS((void)axis_curve({0, 0, 1}, Curve<double>(1e200)), doctest::Contains("within 1e15 rad"),
                       std::invalid_argument);
}
