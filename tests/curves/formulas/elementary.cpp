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

TEST_CASE("sine, cosine and tangent are right for numbers of any size, and not numbers for infinities") {
  // x, sine, cosine, tangent to the nearest double, of 1500 bits. Source: mpmath 1.3.
  constexpr double cases[][4] = {
      {0x1.dcd6500000000p+29, 0x1.1778cae83c69bp-1, 0x1.acff8c7364234p-1, 0x1.4d8b249e3dba7p-1},
      {0x1.0000000000000p+30, -0x1.3c12353728cafp-1, 0x1.92cb46a920144p-1, -0x1.91c3c126f9d13p-1},
      {0x1.0000000000001p+30, -0x1.3c122eebfba67p-1, 0x1.92cb4b9968dc8p-1, -0x1.91c3b439ec482p-1},
      {0x1.65a0bc0000000p+30, -0x1.860b27d27a306p-1, -0x1.4bad75099d5bfp-1, 0x1.2d0c828096effp+0},
      {0x1.c6bf526340000p+49, 0x1.b76f88136cebap-1, -0x1.06c154609d33fp-1, -0x1.ac23600a95be4p+0},
      {0x1.6345785d8a000p+56, -0x1.dbadc7a119fc8p-2, -0x1.c567c5278afcbp-1, 0x1.0c93726adf98cp-1},
      {0x1.6345785d8a001p+56, 0x1.664e5adcf4d0cp-1, 0x1.6dbbb18ac05e4p-1, 0x1.f59a43731b3c9p-1},
      {0x1.0f0cf064dd592p+73, -0x1.b453ab76bf397p-1, 0x1.0be2cef01c8f4p-1, -0x1.a0f79c1b6b257p+0},
      {0x1.11b0ec57e649ap+166, -0x1.ec083ac81db28p-2, 0x1.c105714551003p-1, -0x1.1885916b6549dp-1},
      {0x1.249ad2594c37dp+332, -0x1.85c5e5b929359p-2, 0x1.d9757496841f5p-1, -0x1.a5807d6f76f7dp-2},
      {0x1.4e718d7d7625ap+664, -0x1.49b644938c64cp-1, 0x1.87b4df51f679ep-1, -0x1.aef7845d41e88p-1},
      {-0x1.4e718d7d7625ap+664, 0x1.49b644938c64cp-1, 0x1.87b4df51f679ep-1, 0x1.aef7845d41e88p-1},
      {0x1.7e43c8800759cp+996, -0x1.a2c16b010e385p-1, -0x1.2699022adc4c1p-1, 0x1.6be411f37ac77p+0},
      {0x1.6ac5b262ca1ffp+849, 0x1.0000000000000p+0, -0x1.14ae72e6ba22fp-61, -0x1.d9ba9a7975636p+60},
      {0x1.0000000000000p+1023, 0x1.205248cbdb760p-1, -0x1.a719f26c232bfp-1, -0x1.5ce6b4c0d02a3p-1},
      {0x1.fffffffffffffp+1023, 0x1.452fc98b34e97p-8, -0x1.fffe62ecfab75p-1, -0x1.4530cfe729484p-8},
      {-0x1.fffffffffffffp+1023, -0x1.452fc98b34e97p-8, -0x1.fffe62ecfab75p-1, 0x1.4530cfe729484p-8},
      {0x1.000007d0b6db8p+31, 0x1.4c3e36115a437p-23, 0x1.fffffffffff94p-1, 0x1.4c3e36115a47dp-23},
      {0x1.00000001998f6p+40, -0x1.fffffffb6b63cp-1, -0x1.11f27b1b0af09p-15, 0x1.de75099fed0dbp+14},
      {0x1.0000000000005p+60, 0x1.6b880dfdb1a8cp-1, -0x1.688a29c25ad89p-1, -0x1.021fd19681993p+0},
      {0x1.0000000000000p+100, -0x1.be8ed97ac1f59p-1, 0x1.f4eb3ff66e36dp-2, -0x1.c86fbfa8cecc3p+0},
      {0x1.0000000000000p+300, 0x1.f45bc0cf32e45p-1, 0x1.b23e529a72db7p-3, 0x1.26fa112526b60p+2},
      {0x1.0000000000000p+700, -0x1.d79a0a9e0e9e3p-2, 0x1.c67807d529ad4p-1, -0x1.09a69e1a9c295p-1},
      {0x1.0000000000000p+1000, -0x1.460b8ae1c886ep-3, 0x1.f9785160c8815p-1, -0x1.4a41d560c08ccp-3},
      {-0x1.536600aad60b5p+801, 0x1.0fa3709c94062p-3, 0x1.fb79f49a281f0p-1, 0x1.120f4f56dd43fp-3},
      {-0x1.3ea25ccf8749bp+925, -0x1.1f6138ae30c24p-1, -0x1.a7bdd3967d96bp-1, 0x1.5b3c7f8415d9dp-1},
      {-0x1.c4b2810b1a88ap+892, -0x1.b97c05147ce44p-4, -0x1.fd046a14aa56bp-1, 0x1.bc124c60befd0p-4},
      {0x1.76d19281e3709p+600, 0x1.fc1b1fa3be7b4p-1, 0x1.f8364f42e2958p-4, 0x1.01fa1aecf1764p+3},
      {-0x1.0fadb026bc81ap+436, -0x1.aee5e1a87680ep-1, -0x1.1488a649f555bp-1, 0x1.8ee6e99ef546ep+0},
      {-0x1.3bfd36c482d17p+791, 0x1.004a106cda380p-2, 0x1.efb459d375eafp-1, 0x1.08b6e443bb1a8p-2},
      {-0x1.2f75f80017bdcp+102, -0x1.d7490fbed0d66p-2, -0x1.c68d07a4aa619p-1, 0x1.096cbcdbf7183p-1},
      {0x1.e949c5fbd579ap+31, -0x1.d76cefc0b006ap-1, 0x1.8f8270aeb2e34p-2, -0x1.2e152edb183d6p+1},
      {-0x1.2fd698ccf563fp+244, -0x1.e99c65a64366bp-2, 0x1.c1aeb38b71016p-1, -0x1.16bb1da353d45p-1},
      {-0x1.2302a0a322dc9p+318, -0x1.6dce37bbcfcbdp-5, 0x1.ff7d41e254583p-1, -0x1.6e2bb8cd2db62p-5},
  };
  for (const auto& numbers : cases) {
    const double x = numbers[0], sine = numbers[1], cosine = numbers[2], tangent = numbers[3];
    CAPTURE(x);
    CHECK(ulps(elementary::sin(x), sine) <= 1);
    CHECK(ulps(elementary::cos(x), cosine) <= 1);
    CHECK(ulps(elementary::tan(x), tangent) <= 1);
    CHECK(elementary::sin(-x) == -elementary::sin(x));
    CHECK(elementary::cos(-x) == elementary::cos(x));
  }
  constexpr double endless = std::numeric_limits<double>::infinity();
  for (const double x : {endless, -endless, std::numeric_limits<double>::quiet_NaN()}) {
    CHECK(std::isnan(elementary::sin(x)));
    CHECK(std::isnan(elementary::cos(x)));
    CHECK(std::isnan(elementary::tan(x)));
    CHECK(std::isnan(elementary::sin_cos(x).cos));
  }
}

TEST_CASE("the sine does not jump where its way of reducing changes") {
  for (double x = 0x1p30 - 1e-3; x < 0x1p30 + 1e-3; x += 1e-6)
    CHECK(std::abs(elementary::sin(x) - elementary::sin(std::nextafter(x, 0.0))) <= 2e-7);
}
