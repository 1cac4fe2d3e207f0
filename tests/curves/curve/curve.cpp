#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/keys.h>

#include <stdexcept>

#include "support.h"

using namespace tweenfall;

namespace {

Span<double> line(double start, double duration, double from, double to) {
  Span<double> s{};
  s.start = start;
  s.duration = duration;
  s.degree = 1;
  s.coefficients = {from, to - from, 0, 0, 0, 0};
  s.end = to;
  return s;
}

Curve<double> saw() {
  const Span<double> spans[] = {line(1, 1, 0, 4), line(2, 2, 10, 6)};
  return Curve<double>(std::span<const Span<double>>(spans));
}

// Derivatives against five-point stencils, at a time away from knots.
template <class Of>
void check_rates(const Of& curve, double t, double h, double tolerance) {
  const auto at = [&](double x) { return curve.sample(x); };
  const auto s = at(t);
  const Vec3 velocity =
      (8 * (at(t + h).value - at(t - h).value) - (at(t + 2 * h).value - at(t - 2 * h).value)) / (12 * h);
  const Vec3 acceleration =
      (8 * (at(t + h).rate - at(t - h).rate) - (at(t + 2 * h).rate - at(t - 2 * h).rate)) / (12 * h);
  CHECK(test::near(s.rate, velocity, tolerance));
  CHECK(test::near(s.acceleration, acceleration, tolerance));
}

}  // namespace

TEST_CASE("a knot belongs to the span that leaves it, and both limits can be asked for") {
  const Curve<double> c = saw();
  CHECK(c.value(2) == 10);
  CHECK(c.rate(2) == -2);
  CHECK(c.value(2, Side::in) == 4);
  CHECK(c.rate(2, Side::in) == 4);
  CHECK(c.value(1) == 0);
  CHECK(c.value(4, Side::in) == 6);
  CHECK(c.rate(4, Side::in) == -2);
  CHECK(c.rate(4) == 0);
  CHECK(c.knots().size() == 3);
  CHECK(c.spans().size() == 2);
}

TEST_CASE("beyond its knots a curve continues as its rules say") {
  const Curve<double> held = saw();
  CHECK(held.value(-5) == 0);
  CHECK(held.value(50) == 6);
  CHECK(held.rate(50) == 0);
  const Curve<double> straight = saw().with_outside(Outside::linear, Outside::linear);
  CHECK(straight.value(0) == -4);
  CHECK(straight.value(6) == 2);
  CHECK(straight.rate(6) == -2);
  const Curve<double> again = saw().with_outside(Outside::repeat, Outside::repeat);
  CHECK(again.value(4) == 0);
  CHECK(again.value(4, Side::in) == 6);
  CHECK(again.value(1, Side::in) == 6);
  CHECK(again.value(4.5) == 2);
  CHECK(again.value(-1.5) == 2);
  const Curve<double> on = saw().with_outside(Outside::repeat_offset, Outside::repeat_offset);
  CHECK(on.value(4.5) == 8);
  CHECK(on.value(-1.5) == -4);
  CHECK(on.value(7) == 12);
  const Curve<double> back = saw().with_outside(Outside::pingpong, Outside::pingpong);
  CHECK(back.value(4.5) == 7);
  CHECK(back.rate(4.5) == 2);
  CHECK(back.value(0.5) == 2);
  CHECK(back.rate(0.5) == -4);
  CHECK(back.value(7.5) == 2);
}

TEST_CASE("a constant is at rest and a formula answers for itself") {
  const Curve<double> c(3.5);
  CHECK(c.value(-1e9) == 3.5);
  CHECK(c.rate(2) == 0);
  CHECK(c.knots().empty());
  const Curve<double> square([](double t, Side) { return Sample<double>{t * t, 2 * t, 2}; }, 0, 3);
  CHECK(square.value(2) == 4);
  CHECK(square.value(7) == 9);
  CHECK(square.with_outside(Outside::hold, Outside::linear).value(4) == 15);
}

TEST_CASE("spans with a gap, no length or a number that is none are refused by index") {
  const Span<double> gap[] = {line(0, 1, 0, 1), line(1.5, 1, 0, 1)};
  CHECK_THROWS_WITH_AS(Curve<double>(std::span<const Span<double>>(gap)), doctest::Contains("span 1"),
                       std::invalid_argument);
  const Span<double> flat[] = {line(0, 0, 0, 1)};
  CHECK_THROWS_WITH_AS(Curve<double>(std::span<const Span<double>>(flat)), doctest::Contains("duration > 0"),
                       std::invalid_argument);
  const Span<double> wild[] = {line(0, 1, 0, std::nan(""))};
  CHECK_THROWS_AS(Curve<double>(std::span<const Span<double>>(wild)), std::invalid_argument);
  CHECK_THROWS_AS(Curve<double>(std::span<const Span<double>>{}), std::invalid_argument);
}

TEST_CASE("unevenly placed knots are all found") {
  std::vector<Key<double>> keys;
  double t = 0;
  test::Random random(9);
  for (int i = 0; i < 400; ++i) {
    keys.push_back({t, random.between(-1, 1), Ease::linear()});
    t += i % 7 == 0 ? 10.0 : 1e-6 * (1 + random.unit());
  }
  const Curve<double> c = keyed_curve<double>(keys);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    CHECK(c.value(keys[i].time, Side::in) == keys[i].value);
    if (i + 1 == keys.size()) break;
    CHECK(c.value(keys[i].time) == keys[i].value);
    const double middle = 0.5 * (keys[i].time + keys[i + 1].time);
    CHECK(test::near(c.value(middle), 0.5 * (keys[i].value + keys[i + 1].value), 1e-7));
  }
}

TEST_CASE("angles as a rotation have the angular velocity that the rotation really has") {
  const Curve<Vec3> angles = keyed_curve<Vec3>(
      {{0, {0.2, -0.4, 1}, Ease::smooth()}, {1, {1.5, 0.8, -2}, Ease::smooth()}, {2.5, {-1, 2, 0.5}, Ease::smooth()}});
  for (const bool intrinsic : {true, false})
    for (const EulerOrder& order : {EulerOrder{{0, 1, 2}, intrinsic}, EulerOrder{{2, 0, 2}, intrinsic}}) {
      const Curve<Quat> c = euler_curve(angles, order);
      for (const double t : {0.3, 0.9, 1.7}) {
        CHECK(test::near(c.value(t), from_euler(angles.value(t), order), 1e-15));
        const Quat here = c.value(t);
        const double h = 1e-3;
        const auto turned = [&](double x) { return log_map(c.value(x) * here.conjugate()); };
        const Vec3 stencil = (8 * (turned(t + h) - turned(t - h)) - (turned(t + 2 * h) - turned(t - 2 * h))) / (12 * h);
        CHECK(test::near(c.rate(t), stencil, 1e-8));
        const Vec3 change = (8 * (c.rate(t + h) - c.rate(t - h)) - (c.rate(t + 2 * h) - c.rate(t - 2 * h))) / (12 * h);
        CHECK(test::near(c.sample(t).acceleration, change, 1e-8));
      }
    }
}

TEST_CASE("an angle about an axis keeps its turns and its rules outside") {
  const Curve<double> angle = keyed_curve<double>({{0, 0, Ease::linear()}, {1, 14, Ease::linear()}});
  const Curve<Quat> c = axis_curve({0, 0, 2}, angle).with_outside(Outside::hold, Outside::repeat_offset);
  CHECK(c.rate(0.5) == Vec3(0, 0, 14));
  CHECK(c.end() == 1);
  CHECK(c.knots().size() == 2);
  CHECK(test::near(c.value(2.5), exp_map({0, 0, 35}), 1e-14));
  CHECK_THROWS_AS(static_cast<void>(axis_curve({0, 0, 0}, angle)), std::invalid_argument);
}

TEST_CASE("the rates of a vector curve are those of its values for every rule") {
  for (const std::string word : {"smooth",
                                 "smooth-clamped",
                                 "monotone",
                                 "natural",
                                 "catmull-rom",
                                 "centripetal",
                                 "tcb(0.2,0.3,-0.4)",
                                 "ease",
                                 "sine-in-out",
                                 "expo-out",
                                 "circ-in",
                                 "back-in-out",
                                 "elastic-out(1,0.3)",
                                 "bounce-in",
                                 "spring(0.3s,0.5)",
                                 "spring(0.4s,1)",
                                 "spring(0.4s,1.7)",
                                 "akima",
                                 "makima",
                                 "natural(1,-2)",
                                 "clamped",
                                 "clamped(1,-2)",
                                 "periodic",
                                 "not-a-knot",
                                 "catmull-rom-monotone",
                                 "uniform",
                                 "chordal",
                                 "poly-in-out(2.7)",
                                 "poly-out(0.7)",
                                 "linear(0, 0.5 25% 75%, 1)",
                                 "step-next"}) {
    CAPTURE(word);
    const Ease ease = Ease::named(word).value();
    const Curve<Vec3> c = keyed_curve<Vec3>(
        {{0, {1, 2, 3}, ease}, {0.8, {-2, 1, 4}, ease}, {2, {0, 5, 4.5}, ease}, {3, {1, 1, 1}, ease}});
    for (const double t : {0.11, 0.5, 1.21, 1.77, 2.3, 2.9}) check_rates(c, t, 1e-4, 1e-6);
  }
}

TEST_CASE("outside, a slope can be given and plays can be counted") {
  const Curve<double> c = saw();
  const Curve<double> sloped = c.with_outside(OutsideRule<double>{Outside::linear, -3}, {Outside::linear, 0.5});
  CHECK(sloped.value(0) == 3);
  CHECK(sloped.rate(0) == -3);
  CHECK(sloped.rate(1, Side::in) == -3);
  CHECK(sloped.rate(1) == 4);
  CHECK(sloped.value(6) == 7);
  const Curve<double> twice =
      c.with_outside(OutsideRule<double>{Outside::repeat, {}, 1}, OutsideRule<double>{Outside::repeat_offset, {}, 2});
  CHECK(twice.value(9.9) == doctest::Approx(12 + 6.2));
  CHECK(twice.value(10, Side::in) == 18);
  CHECK(twice.rate(10, Side::in) == -2);
  CHECK(twice.value(10) == 18);
  CHECK(twice.rate(10) == 0);
  CHECK(twice.value(50) == 18);
  CHECK(twice.value(-2) == 0);
  CHECK(twice.rate(-2) == 4);
  CHECK(twice.rate(-2, Side::in) == 0);
  CHECK(twice.value(-40) == 0);
  const Curve<double> half = c.with_outside({}, OutsideRule<double>{Outside::pingpong, {}, 0.5});
  CHECK(half.value(5.5, Side::in) == 9);
  CHECK(half.value(9) == 9);
  CHECK(half.rule_after().plays == 0.5);
  // Seen through a conversion it is the same.
  const Curve<Quat> turned =
      axis_curve({0, 0, 1}, c).with_outside({}, OutsideRule<Quat>{Outside::linear, Vec3(0, 1, 0)});
  CHECK(test::near(turned.rate(5), Vec3(0, 1, 0), 1e-15));
  CHECK(test::near(turned.value(5), Quat(exp_map({0, 1, 0}) * exp_map({0, 0, 6})), 1e-14));
  CHECK_THROWS_WITH_AS((void)c.with_outside({}, OutsideRule<double>{Outside::repeat, {}, -1}),
                       doctest::Contains("must be >= 0; they are -1"), std::invalid_argument);
}

TEST_CASE("a key's outer tangents say how a straight continuation goes on") {
  std::vector<Key<double>> keys = {{0, 1}, {2, 5}};
  keys[0].in = Tangent<double>{TangentKind::given, -2};
  keys[1].out = Tangent<double>{TangentKind::flat};
  const Curve<double> c = keyed_curve<double>(keys).with_outside(Outside::linear, Outside::linear);
  CHECK(c.value(-1) == 3);
  CHECK(c.value(3) == 5);
  CHECK(c.rate(0) == doctest::Approx(2));
}
