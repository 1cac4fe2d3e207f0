#include <tweenfall/curves/barycentric.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

#include <stdexcept>

#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;

namespace {

// Three weights that move, and their rates, in closed form: fractions of quadratics.
std::vector<Sample<double>> weights_at(double t) {
  return {{1 + t, 1, 0}, {0.5 + t * t, 2 * t, 2}, {0.7 - 0.2 * t, -0.2, 0}};
}

template <class T>
std::vector<Curve<T>> three_curves(test::Random& random);

template <>
std::vector<Curve<double>> three_curves(test::Random& random) {
  std::vector<Curve<double>> result;
  for (int i = 0; i < 3; ++i)
    result.push_back(keyed_curve<double>({{-1, random.between(-2, 2), Ease::natural()},
                                          {0.4, random.between(-2, 2), Ease::natural()},
                                          {2, random.between(-2, 2)}}));
  return result;
}
template <>
std::vector<Curve<Vec3>> three_curves(test::Random& random) {
  std::vector<Curve<Vec3>> result;
  for (int i = 0; i < 3; ++i)
    result.push_back(keyed_curve<Vec3>(
        {{-1, random.vector(2), Ease::natural()}, {0.4, random.vector(2), Ease::natural()}, {2, random.vector(2)}}));
  return result;
}
template <>
std::vector<Curve<Quat>> three_curves(test::Random& random) {
  std::vector<Curve<Quat>> result;
  const Quat near = random.rotation();
  const auto one = [&] { return Quat(near * exp_map(random.vector(0.8))); };
  for (int i = 0; i < 3; ++i) {
    const Quat a = one(), b = one(), c = one();
    result.push_back(keyed_curve<Quat>({{-1, a, Ease::natural()}, {0.4, b, Ease::natural()}, {2, c}}));
  }
  return result;
}
template <>
std::vector<Curve<Color>> three_curves(test::Random& random) {
  std::vector<Curve<Color>> result;
  const auto one = [&] {
    Vec4 c(0, 0, 0, 0);
    for (int i = 0; i < 4; ++i) c[i] = random.between(0.1, 0.9);
    return Color{c};
  };
  for (int i = 0; i < 3; ++i) {
    const Color a = one(), b = one();
    result.push_back(keyed_curve<Color>({{-1, a, Ease::linear()}, {2, b}}, {.space = ColorSpace::linear}));
  }
  return result;
}

template <class T>
std::vector<Sample<T>> samples(const std::vector<Curve<T>>& curves, double t) {
  std::vector<Sample<T>> result;
  for (const Curve<T>& curve : curves) result.push_back(curve.sample(t));
  return result;
}

// Central differences, for tests alone.
template <class F>
auto central_difference(const F& f, double h) {
  using V = std::decay_t<decltype(f(0.0))>;
  return V((8 * (f(h) - f(-h)) - (f(2 * h) - f(-2 * h))) / (12 * h));
}

template <class T>
void check_corners(const std::vector<Curve<T>>& curves) {
  const auto values = samples(curves, 0.1);
  for (std::size_t i = 0; i < 3; ++i) {
    std::vector<Sample<double>> corner(3, {0, 0, 0});
    corner[i].value = i == 1 ? 0.3 : 1;
    const Sample<T> mixed = barycentric(std::span<const Sample<T>>(values), corner);
    if constexpr (std::is_same_v<T, Quat>)
      CHECK(mixed.value.coeffs() == values[i].value.coeffs());
    else
      CHECK(mixed.value == values[i].value);
  }
}

}  // namespace

TEST_CASE("the rates of a mix are the derivatives of its value, moving weights included") {
  test::Random random(21);
  for (int round = 0; round < 10; ++round) {
    const auto numbers = three_curves<double>(random);
    const auto vectors = three_curves<Vec3>(random);
    const auto turns = three_curves<Quat>(random);
    const auto colors = three_curves<Color>(random);
    for (const double t : {-0.3, 0.1, 0.6}) {
      const auto number = [&](double x) { return barycentric<double>(samples(numbers, t + x), weights_at(t + x)); };
      CHECK(test::near(number(0).rate, central_difference([&](double x) { return number(x).value; }, 1e-3), 1e-9));
      CHECK(
          test::near(number(0).acceleration, central_difference([&](double x) { return number(x).rate; }, 1e-3), 1e-9));
      const auto vector = [&](double x) { return barycentric<Vec3>(samples(vectors, t + x), weights_at(t + x)); };
      CHECK(test::near(vector(0).rate, central_difference([&](double x) { return vector(x).value; }, 1e-3), 1e-9));
      CHECK(
          test::near(vector(0).acceleration, central_difference([&](double x) { return vector(x).rate; }, 1e-3), 1e-9));
      const auto turn = [&](double x) { return barycentric<Quat>(samples(turns, t + x), weights_at(t + x)); };
      const Quat here = turn(0).value;
      const auto turned = [&](double x) { return log_map(turn(x).value * here.conjugate()); };
      CHECK(test::near(turn(0).rate, central_difference(turned, 1e-3), 1e-9));
      CHECK(test::near(turn(0).acceleration, central_difference([&](double x) { return turn(x).rate; }, 1e-3), 1e-9));
      for (const ColorSpace space : {ColorSpace::linear, ColorSpace::oklab, ColorSpace::oklch, ColorSpace::hsl}) {
        const auto color = [&](double x) { return barycentric(samples(colors, t + x), weights_at(t + x), space); };
        CHECK(test::near(color(0).rate, central_difference([&](double x) { return color(x).value.rgba; }, 1e-4), 1e-6));
        CHECK(
            test::near(color(0).acceleration, central_difference([&](double x) { return color(x).rate; }, 1e-4), 1e-5));
      }
    }
  }
}

TEST_CASE("a corner is its value to the bit, however large its weight") {
  test::Random random(22);
  check_corners(three_curves<double>(random));
  check_corners(three_curves<Vec3>(random));
  check_corners(three_curves<Quat>(random));
  const auto colors = samples(three_curves<Color>(random), 0.1);
  const std::vector<Sample<double>> second = {{0, 0, 0}, {2, 0, 0}, {0, 0, 0}};
  for (const ColorSpace space : {ColorSpace::linear, ColorSpace::oklab, ColorSpace::hsl})
    CHECK(barycentric(colors, second, space).value == colors[1].value);
}

TEST_CASE("weights are parts of a whole, and what is done to all values is done to the mix") {
  test::Random random(23);
  for (int n = 0; n < 50; ++n) {
    std::vector<Sample<double>> weights, larger;
    std::vector<Sample<Vec3>> same, values, moved;
    std::vector<Sample<Quat>> turns, turned;
    const Quat about = random.rotation(), near = random.rotation();
    const Vec3 shift = random.vector(3), zero(0, 0, 0);
    const Mat3 matrix = about.toRotationMatrix() * 1.7;
    const std::size_t count = 2 + n % 5;
    for (std::size_t i = 0; i < count; ++i) {
      weights.push_back({random.between(0.1, 1), random.between(-1, 1), random.between(-1, 1)});
      larger.push_back({7 * weights[i].value, 7 * weights[i].rate, 7 * weights[i].acceleration});
      same.push_back({shift, zero, zero});
      values.push_back({random.vector(2), random.vector(2), random.vector(2)});
      moved.push_back({matrix * values[i].value + shift, matrix * values[i].rate, matrix * values[i].acceleration});
      turns.push_back({near * exp_map(random.vector(0.8)), random.vector(2), random.vector(2)});
      turned.push_back({about * turns[i].value, about * turns[i].rate, about * turns[i].acceleration});
    }
    const Sample<Vec3> level = barycentric<Vec3>(same, weights);
    CHECK(test::near(level.value, shift, 1e-14));
    CHECK(test::near(level.rate, zero, 1e-12));
    CHECK(test::near(level.acceleration, zero, 1e-10));
    const Sample<Vec3> mixed = barycentric<Vec3>(values, weights), scaled = barycentric<Vec3>(values, larger);
    CHECK(test::near(scaled.value, mixed.value, 1e-14));
    CHECK(test::near(scaled.rate, mixed.rate, 1e-12));
    const Sample<Vec3> after = barycentric<Vec3>(moved, weights);
    CHECK(test::near(after.value, Vec3(matrix * mixed.value + shift), 1e-14));
    CHECK(test::near(after.rate, Vec3(matrix * mixed.rate), 1e-12));
    CHECK(test::near(after.acceleration, Vec3(matrix * mixed.acceleration), 1e-10));
    const Sample<Quat> turn = barycentric<Quat>(turns, weights), other = barycentric<Quat>(turned, weights);
    CHECK(test::near(other.value, about * turn.value, 1e-14));
    CHECK(test::near(other.rate, Vec3(about * turn.rate), 1e-11));
    CHECK(test::near(other.acceleration, Vec3(about * turn.acceleration), 1e-10));
    Vec3 left = zero;
    for (std::size_t i = 0; i < count; ++i) left += weights[i].value * log_map(turn.value.conjugate() * turns[i].value);
    CHECK(left.norm() < 1e-14);
  }
}

TEST_CASE("of two rotations the mix is their slerp, and of two motions what mix gives") {
  test::Random random(24);
  for (int n = 0; n < 40; ++n) {
    const auto motion = [&] {
      const Vec3 position = random.vector(2), scale = Vec3(1.5, 1.5, 1.5) + random.vector(1);
      const Quat rotation = random.rotation();
      const Vec3 linear = random.vector(2), angular = random.vector(2), rate = random.vector(1);
      return Motion{{position, rotation, scale}, {linear, angular}, rate};
    };
    const std::vector<Motion> two = {motion(), motion()};
    const double w = random.between(0, 1), rate = random.between(-2, 2);
    const std::vector<Sample<double>> weights = {{1 - w, -rate, 0}, {w, rate, 0}};
    const Motion found = barycentric(two, weights), expected = mix(two[0], two[1], w, rate);
    CHECK(test::near(found.pose.rotation, slerp(two[0].pose.rotation, two[1].pose.rotation, w), 1e-12));
    CHECK(test::near(found.pose.position, expected.pose.position, 1e-14));
    CHECK(test::near(found.twist.linear, expected.twist.linear, 1e-13));
    CHECK(test::near(found.twist.angular, expected.twist.angular, 1e-9));
    CHECK(test::near(found.scale_rate, expected.scale_rate, 1e-13));
  }
}

TEST_CASE("the weights of a point in a triangle give the point back, with its rates") {
  test::Random random(25);
  for (int n = 0; n < 50; ++n) {
    const Vec3 a = random.vector(3), b = random.vector(3), c = random.vector(3), zero(0, 0, 0);
    const Vec3 corners[] = {a, b, c};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto corner = triangle_weights({corners[i], zero, zero}, a, b, c);
      for (std::size_t k = 0; k < 3; ++k) CHECK(corner[k].value == (i == k ? 1 : 0));
    }
    const Vec3 ab = b - a, ac = c - a;
    const Sample<Vec3> point{a + 0.3 * ab + 0.5 * ac, 2 * ab - 0.4 * ac, -1 * ab + 3 * ac};
    const auto weights = triangle_weights(point, a, b, c);
    CHECK(test::near(weights[0].value, 0.2, 1e-11));
    CHECK(test::near(weights[1].value, 0.3, 1e-11));
    CHECK(test::near(weights[2].rate, -0.4, 1e-11));
    CHECK(test::near(weights[0].acceleration, -2, 1e-11));
    const std::vector<Sample<Vec3>> values = {{a, zero, zero}, {b, zero, zero}, {c, zero, zero}};
    const Sample<Vec3> back = barycentric<Vec3>(values, weights);
    CHECK(test::near(back.value, point.value, 1e-11));
    CHECK(test::near(back.rate, point.rate, 1e-11));
    CHECK(test::near(back.acceleration, point.acceleration, 1e-11));
    const Vec3 above = point.value + 4 * ab.cross(ac);
    CHECK(test::near(triangle_weights({above, zero, zero}, a, b, c)[1].value, 0.3, 1e-10));
  }
  const Vec3 origin(0, 0, 0), one(1, 1, 1);
  CHECK_THROWS_WITH_AS((void)triangle_weights({one, one, one}, origin, one, Vec3(2 * one)),
                       doctest::Contains("on one line"), std::invalid_argument);
}

TEST_CASE("a mix without values, with weights that do not fit or sum to zero is refused") {
  const std::vector<Sample<double>> two = {{1, 0, 0}, {2, 0, 0}};
  const auto refused = [&](std::vector<Sample<double>> values, std::vector<Sample<double>> weights, const char* text) {
    CHECK_THROWS_WITH_AS((void)barycentric<double>(values, weights), doctest::Contains(text), std::invalid_argument);
  };
  refused({}, {}, "at least one value");
  refused(two, {{1, 0, 0}}, "1 weights and 2 values");
  refused(two, {{1, 0, 0}, {-1, 0, 0}}, "sum to zero");
  refused(two, {{1, 0, 0}, {std::nan(""), 0, 0}}, "weight 1");
}

TEST_CASE("an aspect ratio keeps the area, and mixed by its logarithm passes the square between 1:4 and 4:1") {
  const Curve<Vec2> shape =
      aspect_curve(keyed_curve<double>({{0, 0.25, Ease::linear()}, {2, 4}}, {.logarithmic = true}));
  for (int k = 0; k <= 20; ++k) {
    const Sample<Vec2> s = shape.sample(0.1 * k);
    CHECK(s.value[0] * s.value[1] == doctest::Approx(1).epsilon(1e-15));
    CHECK(s.rate[0] / s.value[0] == doctest::Approx(-s.rate[1] / s.value[1]).epsilon(1e-14));
  }
  CHECK(test::near(shape.value(0), Vec2(0.5, 2), 1e-15));
  CHECK(test::near(shape.value(1), Vec2(1, 1), 1e-15));
  // Width 2^(t - 1): its rate and acceleration are log 2 and its square times it.
  const double log_2 = std::log(2.0), width = std::pow(2.0, -0.3);
  CHECK(shape.sample(0.7).rate[0] == doctest::Approx(log_2 * width).epsilon(1e-14));
  CHECK(shape.sample(0.7).acceleration[0] == doctest::Approx(log_2 * log_2 * width).epsilon(1e-13));
  CHECK(shape.sample(0.7).acceleration[1] == doctest::Approx(log_2 * log_2 / width).epsilon(1e-13));
}

namespace {

// `mix` equals the samples of curves and weights combined.
template <class T, class Mix>
void check_mixed(const std::vector<Curve<T>>& values, const std::vector<Curve<double>>& weights, const Curve<T>& curve,
                 const Mix& mix) {
  for (const double t : {-2.0, -0.3, 0.1, 0.6, 5.0}) {
    CAPTURE(t);
    const Sample<T> expected = mix(samples(values, t), samples(weights, t));
    const std::size_t before = test::allocations();
    const Sample<T> found = curve.sample(t);
    CHECK(test::allocations() == before);
    if constexpr (std::is_same_v<T, Quat>)
      CHECK(found.value.coeffs() == expected.value.coeffs());
    else
      CHECK(found.value == expected.value);
    CHECK(found.rate == expected.rate);
    CHECK(found.acceleration == expected.acceleration);
  }
}

}  // namespace

TEST_CASE("curves mixed over time are the mix of their samples, and nothing is allocated") {
  test::Random random(31);
  const std::vector<Curve<double>> weights = {
      keyed_curve<double>({{-1, 1.0, Ease::natural()}, {0.5, 0.2, Ease::natural()}, {2, 1.0}}),
      keyed_curve<double>({{-1, 0.3, Ease::linear()}, {2, 2.0}}), Curve<double>(0.5)};
  const auto plain = [](const auto& values, const auto& shares) {
    using T = std::decay_t<decltype(values.front().value)>;
    return barycentric<T>(values, shares);
  };
  const auto numbers = three_curves<double>(random);
  check_mixed(numbers, weights, barycentric_curve<double>(numbers, weights), plain);
  const auto vectors = three_curves<Vec3>(random);
  check_mixed(vectors, weights, barycentric_curve<Vec3>(vectors, weights), plain);
  const auto turns = three_curves<Quat>(random);
  check_mixed(turns, weights, barycentric_curve<Quat>(turns, weights), plain);
  const auto colors = three_curves<Color>(random);
  check_mixed(colors, weights, barycentric_curve(colors, weights, ColorSpace::oklch),
              [](const auto& values, const auto& shares) { return barycentric(values, shares, ColorSpace::oklch); });
}

TEST_CASE("a mix whose weights sum to zero for a while is even there, and one without a weight each is refused") {
  const std::vector<Curve<double>> values = {Curve<double>(2), Curve<double>(6)};
  const std::vector<Curve<double>> weights = {
      keyed_curve<double>({{0, 1.0, Ease::linear()}, {1, 0.0, Ease::hold()}, {2, 0.0}}), Curve<double>(0)};
  const Curve<double> mix = barycentric_curve<double>(values, weights);
  CHECK(mix.value(0.5) == 2);
  CHECK(mix.value(1.5) == 4);
  CHECK(mix.rate(1.5) == 0);
  CHECK_THROWS_AS((void)barycentric_curve<double>(values, std::span(weights).first(1)), std::invalid_argument);
  CHECK_THROWS_AS((void)barycentric_curve<double>({}, {}), std::invalid_argument);
  const std::vector<Curve<double>> many(most_mixed_curves + 1, Curve<double>(1));
  CHECK_THROWS_AS((void)barycentric_curve<double>(many, many), std::invalid_argument);
}
