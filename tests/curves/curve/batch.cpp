#include <tweenfall/curves/batch.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>

#include "support.h"

using namespace tweenfall;

namespace {

// Curves of every sort: cubic, straight, held, eased, weighted, of one key, of two, repeating, a formula.
std::vector<Curve<double>> mixed_curves() {
  test::Random random(11);
  std::vector<Curve<double>> curves;
  for (int i = 0; i < 40; ++i) {
    std::vector<Key<double>> keys;
    double time = random.between(-1, 1);
    const int count = 1 + i % 13;
    for (int k = 0; k < count; ++k) {
      Key<double> key{time, random.between(-2, 2)};
      if (i % 4 == 1) key.ease = k % 2 ? Ease::linear() : Ease::hold();
      if (i % 4 == 2) key.ease = Ease::natural();
      if (i % 10 == 3) key.ease = *Ease::named("bounce-out");
      keys.push_back(key);
      time += i % 5 == 4 && k % 3 ? 1e-6 : random.between(0.1, 1);
    }
    const Curve<double> curve = keyed_curve<double>(keys);
    curves.push_back(i % 7 == 6 ? curve.with_outside(Outside::repeat, Outside::linear) : curve);
  }
  curves.push_back(oscillator({1, 2}));
  curves.emplace_back(4.0);
  return curves;
}

void check_same(CurveBatch& batch, const std::vector<Curve<double>>& curves, double time) {
  std::vector<double> values(curves.size()), rates(curves.size());
  batch.sample(time, values, rates);
  for (std::size_t i = 0; i < curves.size(); ++i) {
    CAPTURE(i);
    CAPTURE(time);
    const Sample<double> expected = curves[i].sample(time);
    CHECK(values[i] == expected.value);
    CHECK(rates[i] == expected.rate);
  }
}

}  // namespace

TEST_CASE("a batch gives the very numbers of its curves, forwards, backwards, anywhere and at their knots") {
  const std::vector<Curve<double>> curves = mixed_curves();
  CurveBatch batch(curves);
  for (int i = -200; i < 600; ++i) check_same(batch, curves, i / 60.0);
  for (int i = 600; i > -200; i -= 7) check_same(batch, curves, i / 60.0);
  test::Random random(3);
  for (int i = 0; i < 200; ++i) check_same(batch, curves, random.between(-3, 12));
  for (int i = 0; i < 2000; ++i)  // played here and there, forwards and backwards
    check_same(batch, curves, i % 20 == 0 ? random.between(-3, 12) : i / 200.0 + (i % 40 < 20 ? i : -i) % 20 / 60.0);
  for (const Curve<double>& curve : curves)
    for (const double knot : curve.knots()) check_same(batch, curves, knot);
}

TEST_CASE("value alone has the bits of the whole sample") {
  test::Random random(5);
  for (const Curve<double>& curve : mixed_curves())
    for (int i = 0; i < 200; ++i) {
      const double time = random.between(-2, 8);
      CHECK(curve.value(time) == curve.sample(time).value);
    }
}

TEST_CASE("a batch refuses results of another size") {
  const std::vector<Curve<double>> curves{Curve<double>(1.0), Curve<double>(2.0)};
  CurveBatch batch(curves);
  std::vector<double> two(2), three(3);
  CHECK_THROWS_WITH_AS(batch.sample(0, three), "a batch of 2 curves needs as many values; 3 were given",
                       std::invalid_argument);
  CHECK_THROWS_AS(batch.sample(0, two, three), std::invalid_argument);
  CHECK_NOTHROW(batch.sample(0, two));
}
