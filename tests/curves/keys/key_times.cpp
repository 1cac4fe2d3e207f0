// Which knots are keys that somebody wrote.

#include "support.h"

#include <tweenfall/curves/barycentric.h>
#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/modifiers.h>

using namespace tweenfall;

namespace {

using Times = std::vector<double>;

template <class T>
Times keys_in(const Curve<T>& curve) {
  return {curve.key_times().begin(), curve.key_times().end()};
}

template <class T>
Curve<T> through(const T& a, const T& b, const T& c, const char* word, const KeyOptions& options = {}) {
  const Ease ease = Ease::named(word).value();
  const std::vector<Key<T>> keys = {{0, a, ease}, {1, b, ease}, {3, c}};
  return keyed_curve<T>(std::span<const Key<T>>(keys), options);
}

Curve<double> bouncing() {
  return through<double>(1, 2, 4, "bounce-in-out");
}

}  // namespace

TEST_CASE("no word of an ease adds a key") {
  for (const char* word : {"quad-in-out", "bounce-out", "elastic-in-out", "steps(5,jump-both)", "linear(0,0.2 30%,1)",
                           "step-next", "spring(0.3s,0.2)", "hold", "smooth", "bezier(0.4,0,0.2,1)"}) {
    CAPTURE(word);
    CHECK(keys_in(through<double>(1, 2, 4, word)) == Times{0, 1, 3});
    CHECK(keys_in(through<Vec3>({1, 2, 3}, {2, 2, 2}, {4, 1, 0}, word)) == Times{0, 1, 3});
    CHECK(keys_in(through<Color>({{1, 0, 0, 1}}, {{0, 1, 0, 1}}, {{0, 0, 1, 1}}, word)) == Times{0, 1, 3});
    CHECK(keys_in(through<Quat>({1, 0, 0, 0}, {0.8, 0.6, 0, 0}, {0.6, 0, 0.8, 0}, word)) == Times{0, 1, 3});
    KeyOptions options;
    options.logarithmic = true;
    CHECK(keys_in(through<double>(1, 2, 4, word, options)) == Times{0, 1, 3});
  }
}

TEST_CASE("an ease of several pieces keeps its inner knots, which evaluation needs") {
  const Curve<double> curve = through<double>(1, 2, 4, "quad-in-out");
  CHECK(Times(curve.knots().begin(), curve.knots().end()) == Times{0, 0.5, 1, 2, 3});
}

TEST_CASE("what is made of a curve has its keys") {
  const Curve<double> curve = bouncing();
  CHECK(keys_in(Curve<double>(curve.spans())) == Times{0, 1, 3});
  CHECK(keys_in(shifted(curve, 2)) == Times{2, 3, 5});
  CHECK(keys_in(time_scaled(curve, 2.0, 0.0)) == Times{0, 2, 6});
  CHECK(keys_in(reversed(curve)) == Times{0, 2, 3});
  CHECK(keys_in(value_scaled(curve, 2.0, 1.0)) == Times{0, 1, 3});
  CHECK(keys_in(derivative(curve)) == Times{0, 1, 3});
  CHECK(keys_in(antiderivative(curve, 0.0)) == Times{0, 1, 3});
  CHECK(keys_in(curve.with_outside(Outside::repeat, Outside::pingpong)) == Times{0, 1, 3});
  CHECK(keys_in(joined(curve, shifted(curve, 3))) == Times{0, 1, 3, 4, 6});
  CHECK(keys_in(modified(curve, std::vector<Modifier>{})) == Times{0, 1, 3});
  const std::vector<Curve<double>> both = {curve, shifted(curve, 1)}, weights = {Curve<double>(1.0), curve};
  CHECK(keys_in(barycentric_curve<double>(both, weights)) == Times{0, 1, 2, 3, 4});
}

TEST_CASE("a cut and a knot put in are keys") {
  const Curve<double> curve = through<double>(1, 2, 4, "quad-in-out");
  CHECK(keys_in(trimmed(curve, 0.25, 2.5)) == Times{0.25, 1, 2.5});
  CHECK(keys_in(with_knot(curve, 0.75)) == Times{0, 0.75, 1, 3});
  // Loops written out: backwards the pieces come in the other order.
  const Curve<double> back = trimmed(curve.with_outside(Outside::pingpong, Outside::pingpong), -3.0, 3.0);
  CHECK(keys_in(back) == Times{-3, -1, 0, 1, 3});
}

TEST_CASE("formulas and constants have no keys, one key has one") {
  CHECK(Curve<double>(2.0).key_times().empty());
  const std::vector<Key<double>> one = {{4, 2}};
  CHECK(keys_in(keyed_curve<double>(one)) == Times{4});
}
