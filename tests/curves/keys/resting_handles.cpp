// Rates at keys whose handle has no length: there time rests over the position on the handles, and the value rests with
// it. The rate is the limit from inside, in closed form.

#include "support.h"

#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/rotation.h>

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("CSS's ease-in arrives with a rate, and its ease-out leaves with one") {
  // x = 3 x2 s^2 (1 - s) + s^3, y = 3 s^2 (1 - s) + s^3 near 0 of ease-out: dy/dx = 1 / x2; ease-in is its mirror
  // image.
  const double steepest = 1 / 0.58;
  CHECK(Ease::named("ease-out")->progress(0).rate == doctest::Approx(steepest).epsilon(1e-14));
  CHECK(Ease::named("ease-in")->progress(1, Side::in).rate == doctest::Approx(steepest).epsilon(1e-14));
  CHECK(Ease::named("ease-in")->progress(0).rate == 0);
  CHECK(Ease::bezier(0, 0, 1, 1).progress(0).rate == doctest::Approx(1).epsilon(1e-14));
  CHECK(Ease::bezier(0, 0, 1, 1).progress(1, Side::in).rate == doctest::Approx(1).epsilon(1e-14));
  CHECK(Ease::bezier(0, 0, 0, 0).progress(0).rate == doctest::Approx(1).epsilon(1e-14));
  // A vertical tangent stays what it is said to be: a million.
  CHECK(Ease::bezier(0, 1, 1, 1).progress(0).rate == doctest::Approx(3e6).epsilon(1e-9));
}

TEST_CASE("keyed numbers, vectors, colors and rotations have the rate of the limit at keys with such eases") {
  const double seconds = 0.7, steepest = 1 / (0.58 * seconds);
  const auto out = *Ease::named("ease-out"), in = *Ease::named("ease-in");
  const auto number = keyed_curve<double>({{1, 2, out}, {1 + seconds, 5, in}, {1 + 2 * seconds, 2}});
  CHECK(number.sample(1).rate == doctest::Approx(3 * steepest).epsilon(1e-13));
  CHECK(number.sample(1 + 2 * seconds, Side::in).rate == doctest::Approx(-3 * steepest).epsilon(1e-13));
  CHECK(number.sample(1).value == 2);
  CHECK(std::isfinite(number.sample(1).acceleration));
  // And it is what all times nearby have.
  CHECK(number.sample(1 + 1e-9).rate == doctest::Approx(3 * steepest).epsilon(1e-4));
  CHECK(derivative(number).sample(1).value == doctest::Approx(3 * steepest).epsilon(1e-13));

  const Vec3 way(1, -2, 0.5);
  const auto vector = keyed_curve<Vec3>({{0, Vec3(0, 0, 0), in}, {seconds, way}});
  CHECK((vector.sample(seconds, Side::in).rate - steepest * way).norm() < 1e-12);

  const Vec3 turn(0.3, 0.9, -0.4);
  const auto rotation = keyed_curve<Quat>({{0, Quat(1, 0, 0, 0), in}, {seconds, exp_map(turn)}});
  CHECK((rotation.sample(seconds, Side::in).rate - steepest * turn).norm() < 1e-12);

  // Parts of such a span have the rate of the whole.
  const Curve<double> part = trimmed(number, 1.2, 1 + 2 * seconds);
  CHECK(part.sample(1 + 2 * seconds, Side::in).rate == doctest::Approx(-3 * steepest).epsilon(1e-12));
}

TEST_CASE("where time rests and the value does not, a curve that rises has a rate that is large and above 0") {
  for (const double y1 : {0.0, 0.2, -0.5, 0.4}) {
    CAPTURE(y1);
    const Ease steep = Ease::bezier(1, y1, 0, 1 - y1);  // vertical in the middle
    CHECK(steep.progress(0.5).rate > 1e5);
    const auto curve = keyed_curve<double>({{0, 0, steep}, {2, 1}});
    CHECK(curve.sample(1).rate > 5e4);
  }
  // Material's deceleration: y ~ (27 t^2)^(1/3) at its start.
  const Ease slowing = Ease::bezier(0, 0, 0, 1), hastening = Ease::bezier(1, 0, 1, 1);
  for (const double t : {0.0, 1e-15, 1e-12, 1e-10}) {
    CAPTURE(t);
    CHECK(slowing.progress(t).rate > 1000);
    CHECK(hastening.progress(1 - t, Side::in).rate > 1000);
  }
  CHECK(slowing.progress(1e-6).rate == doctest::Approx(2e2).epsilon(0.05));
  CHECK(slowing.progress(0).rate >= slowing.progress(1e-9).rate);
}
