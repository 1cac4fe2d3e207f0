#include <tweenfall/curves/elementary.h>

#include <bit>
#include <limits>

#include "support.h"

using namespace tweenfall;

namespace {

// Distance in units in the last place of the expected number.
double ulps(double actual, double expected) {
  if (actual == expected) return 0;
  const double unit = std::nextafter(std::abs(expected), std::numeric_limits<double>::infinity()) - std::abs(expected);
  return std::abs(actual - expected) / unit;
}

template <class Ours, class Theirs, class Pick>
double worst(const Ours& ours, const Theirs& theirs, const Pick& pick) {
  double result = 0;
  for (int i = 0; i < 20000; ++i) {
    const double x = pick();
    const double distance = ulps(ours(x), theirs(x));
    if (!(distance <= result)) result = distance;
  }
  return result;
}

}  // namespace

TEST_CASE("elementary functions are within two units in the last place of the C library's") {
  test::Random random(1);
  for (const double reach : {1e-6, 1.0, 30.0, 1e5, 1e9}) {
    const auto pick = [&] { return random.between(-reach, reach); };
    CAPTURE(reach);
    CHECK(worst(
              &elementary::sin, [](double x) { return std::sin(x); }, pick) <= 2);
    CHECK(worst(
              &elementary::cos, [](double x) { return std::cos(x); }, pick) <= 2);
    CHECK(worst(
              &elementary::tan, [](double x) { return std::tan(x); }, pick) <= 2);
    CHECK(worst(
              &elementary::atan, [](double x) { return std::atan(x); }, pick) <= 2);
  }
  const auto unit = [&] { return random.between(-1, 1); };
  CHECK(worst(
            &elementary::asin, [](double x) { return std::asin(x); }, unit) <= 2);
  CHECK(worst(
            &elementary::acos, [](double x) { return std::acos(x); }, unit) <= 2);
  CHECK(worst(
            &elementary::exp, [](double x) { return std::exp(x); }, [&] { return random.between(-745, 709.7); }) <= 2);
  const auto wide = [&] { return std::exp(random.between(-700, 700)); };
  CHECK(worst(
            &elementary::log, [](double x) { return std::log(x); }, wide) <= 2);
  CHECK(worst(
            &elementary::cbrt, [](double x) { return static_cast<double>(std::cbrt(static_cast<long double>(x))); },
            wide) <= 2);
  CHECK(worst(
            &elementary::log, [](double x) { return std::log(x); }, [&] { return random.between(0.99, 1.01); }) <= 2);
  for (const double y : {-3.7, 1 / 2.4, 2.4, 17.0, 300.0})
    CHECK(worst([y](double x) { return elementary::pow(x, y); }, [y](double x) { return std::pow(x, y); },
                [&] { return std::exp(random.between(-2, 2)); }) <= 2);
}

TEST_CASE("hyperbolic functions are within three units in the last place of the C library's") {
  test::Random random(2);
  const auto exact = [](auto function) {
    return [function](double x) { return static_cast<double>(function(static_cast<long double>(x))); };
  };
  for (const double reach : {1e-6, 0.5, 2.0, 20.0, 710.0}) {
    CAPTURE(reach);
    const auto pick = [&] { return random.between(-reach, reach); };
    CHECK(worst(&elementary::sinh, exact([](long double x) { return std::sinh(x); }), pick) <= 3);
    CHECK(worst(&elementary::cosh, exact([](long double x) { return std::cosh(x); }), pick) <= 3);
    CHECK(worst(&elementary::tanh, exact([](long double x) { return std::tanh(x); }), pick) <= 3);
    CHECK(worst(&elementary::asinh, exact([](long double x) { return std::asinh(x); }), pick) <= 3);
  }
  CHECK(elementary::sinh(-1e5) == -std::numeric_limits<double>::infinity());
  CHECK(elementary::tanh(-1e5) == -1);
}

TEST_CASE("elementary functions are exact where the answer is a round number") {
  CHECK(elementary::sin(0) == 0);
  CHECK(elementary::cos(0) == 1);
  CHECK(elementary::exp(0) == 1);
  CHECK(elementary::log(1) == 0);
  CHECK(elementary::atan2(0, 0) == 0);
  CHECK(elementary::acos(1) == 0);
  CHECK(elementary::acos(2) == 0);
  CHECK(elementary::asin(1) == std::acos(0.0));
  CHECK(elementary::cbrt(-27) == -3);
  CHECK(elementary::pow(2, 10) == 1024);
  CHECK(elementary::pow(0, 2) == 0);
  CHECK(elementary::pow(7.25, 0) == 1);
  CHECK(elementary::pow(7.25, 1) == 7.25);
}

TEST_CASE("the bits of elementary functions are the same with every compiler") {
  test::Random random(2);
  std::uint64_t hash = 14695981039346656037u;
  const auto mix = [&hash](double v) { hash = (hash ^ std::bit_cast<std::uint64_t>(v)) * 1099511628211u; };
  for (int i = 0; i < 10000; ++i) {
    const double x = random.between(-50, 50), y = random.between(-1, 1);
    mix(elementary::sin(x));
    mix(elementary::cos(x));
    mix(elementary::tan(x));
    mix(elementary::exp(x));
    mix(elementary::log(x * x + 1e-9));
    mix(elementary::atan2(x, y));
    mix(elementary::asin(y));
    mix(elementary::acos(y));
    mix(elementary::cbrt(x));
    mix(elementary::pow(x * x, y));
  }
  CHECK(hash == 8666532269440720174u);
}
