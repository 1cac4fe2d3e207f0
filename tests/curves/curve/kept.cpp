#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/splines.h>

#include "curves/counted_allocations.h"
#include "random.h"
#include "support.h"

using namespace tweenfall;

namespace {

constexpr std::size_t keys_kept = 200000;
constexpr double whole_pages = 0.1;  // bytes per key, since memory comes in whole pages

double time_of(std::size_t i) {
  return 0.1 * static_cast<double>(i) + 0.03 * static_cast<double>(i % 3);
}

template <class T, class ValueAt>
double bytes_per_key(const Ease& ease, const ValueAt& value_at) {
  std::vector<Key<T>> keys;
  keys.reserve(keys_kept);
  for (std::size_t i = 0; i < keys_kept; ++i) keys.push_back({time_of(i), value_at(static_cast<double>(i)), ease});
  const std::size_t before = test::bytes_held();
  const Curve<T> curve = keyed_curve<T>(keys);
  return static_cast<double>(test::bytes_held() - before) / static_cast<double>(keys_kept);
}

double number_at(double i) {
  return std::sin(i);
}
Vec3 vector_at(double i) {
  return {std::sin(i), std::cos(2 * i), i};
}

template <class T>
void same_through_spans(const Curve<T>& curve) {
  const auto spans = curve.spans();
  const Curve<T> again(spans);
  for (const double time : {curve.start(), 0.3, 1.0, 1.7, 2.3, curve.end()})
    for (const Side side : {Side::in, Side::out}) {
      const Sample<T> a = curve.sample(time, side), b = again.sample(time, side);
      CHECK(a.value == b.value);
      CHECK(a.rate == b.rate);
      CHECK(a.acceleration == b.acceleration);
    }
}

}  // namespace

TEST_CASE("a key of a linear number takes 40 bytes at most, of a rotation 90") {
  CHECK(bytes_per_key<double>(Ease::linear(), number_at) <= 40 + whole_pages);
  CHECK(bytes_per_key<Quat>(Ease::linear(), [](double i) { return exp_map(Vec3(std::sin(i), 0.5, 0.1)); }) <=
        90 + whole_pages);
}

TEST_CASE("a key of cubics takes its value and its rate, not four coefficients, where it has more numbers than one") {
  CHECK(bytes_per_key<double>(Ease::smooth(), number_at) <= 56 + whole_pages);
  CHECK(bytes_per_key<Vec3>(Ease::smooth(), vector_at) <= 72 + whole_pages);
  CHECK(bytes_per_key<Vec3>(Ease::natural(), vector_at) <= 72 + whole_pages);
}

TEST_CASE("a curve that is nothing but cubics is the curve of its spans, to the bit") {
  const std::vector<double> times{0, 0.3, 1, 1.7, 2.3, 4};
  const std::vector<double> numbers{1, -2, 5, 5, 0.25, 3};
  std::vector<Vec3> vectors;
  vectors.reserve(numbers.size());
  for (const double number : numbers) vectors.emplace_back(number, 2 - number, number * number);
  same_through_spans(c2_spline<double>(times, numbers));
  same_through_spans(c2_spline<Vec3>(times, vectors));
  std::vector<Key<double>> keys;
  std::vector<Key<Vec3>> vector_keys;
  for (std::size_t i = 0; i < times.size(); ++i) {
    keys.push_back({times[i], numbers[i], Ease::natural()});
    vector_keys.push_back({times[i], vectors[i], Ease::smooth()});
  }
  same_through_spans(keyed_curve<double>(keys));
  same_through_spans(keyed_curve<Vec3>(vector_keys));
}

TEST_CASE("cubics near the end of numbers are looked at span by span") {
  const std::vector<double> times{0, 1, 2}, small{0, 1e-200, 2e-200};
  CHECK(c2_spline<double>(times, std::vector<double>{0, 1e150, 0}).value(1) == 1e150);
  CHECK_THROWS_WITH((void)c2_spline<double>(small, std::vector<double>{0, 1e200, 0}), doctest::Contains("span 0"));
  const std::vector<Key<double>> keys{{0, 0, Ease::smooth()}, {1e-200, 1e200, Ease::smooth()}};
  CHECK_THROWS_WITH((void)keyed_curve<double>(keys), doctest::Contains("span 0"));
}
