#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/inspection.h>

#include "curves/museum.h"

using namespace tweenfall;

TEST_CASE("each kind of key is as smooth as its rule says") {
  const auto middle = [](const Ease& ease) {
    return continuity(keyed_curve<double>({{0, 0, ease}, {1, 3, ease}, {3, 1, ease}, {4, 2}}))[1];
  };
  CHECK(middle(Ease::hold()) == Continuity::jump);
  CHECK(middle(Ease::linear()) == Continuity::value);
  CHECK(middle(Ease::smooth()) == Continuity::rate);
  CHECK(middle(Ease::catmull_rom()) == Continuity::rate);
  CHECK(middle(Ease::natural()) == Continuity::acceleration);
  const Curve<double> cut =
      with_knot(keyed_curve<double>({{0, 0, Ease::smooth()}, {1, 3, Ease::smooth()}, {3, 1}}), 0.4);
  CHECK(continuity(cut)[1] == Continuity::smooth);
  CHECK(continuity(cut)[2] == Continuity::rate);
  // Cut within the handles' span, derivatives of every order are continuous.
  const Curve<double> handles = with_knot(keyed_curve<double>({{0, 0, Ease::bezier(0.7, 0, 0.5, 1)}, {2, 5}}), 0.6);
  CHECK(continuity(handles)[1] == Continuity::smooth);
  // The seam of a loop is judged with what follows around it.
  const Curve<double> wheel = keyed_curve<double>({{0, 0, Ease::linear()}, {1, 2}});
  CHECK(continuity(wheel)[1] == Continuity::value);
  CHECK(continuity(wheel.with_outside(Outside::hold, Outside::repeat))[1] == Continuity::jump);
  CHECK(continuity(wheel.with_outside(Outside::hold, Outside::repeat_offset))[1] == Continuity::smooth);
  const Curve<Vec3> path =
      keyed_curve<Vec3>({{0, Vec3(0, 0, 0), Ease::natural()}, {1, Vec3(1, 2, 3), Ease::natural()}, {2, Vec3(4, 0, 0)}});
  CHECK(continuity(path)[1] == Continuity::acceleration);
}

TEST_CASE("derivatives of weighted handles agree with differences of those one lower") {
  const Curve<double> curve = keyed_curve<double>({{1, 2, Ease::bezier(0.7, 0.2, 0.5, 1.3)}, {3, 5}});
  for (double t = 1.1; t < 3; t += 0.17)
    for (int order = 1; order <= 5; ++order) {
      const double h = 1e-5;
      const double difference =
          (derivative_at(curve, order - 1, t + h) - derivative_at(curve, order - 1, t - h)) / (2 * h);
      CHECK(derivative_at(curve, order, t) == doctest::Approx(difference).epsilon(1e-5));
    }
  CHECK_THROWS_AS((void)derivative_at(curve, 9, 2), std::invalid_argument);
  CHECK_THROWS_AS((void)derivative_at(keyed_curve<double>({{0, 0, *Ease::named("sine-in")}, {1, 1}}), 3, 0.5),
                  std::invalid_argument);
  const Curve<double> speed = derivative(curve);
  CHECK(speed.value(2) == curve.rate(2));
  CHECK(speed.sample(2).acceleration == derivative_at(curve, 3, 2));
}

TEST_CASE("flat, straight and monotone curves are told from those that are nearly so") {
  CHECK(is_flat(keyed_curve<double>({{0, 2}, {1, 2}, {2, 2}})));
  CHECK(is_flat(keyed_curve<double>({{3, 2}})));
  const Curve<double> bump = keyed_curve<double>({test::sloped(0, 2, 0.27), test::sloped(1, 2, 0)});
  CHECK(!is_flat(bump));
  CHECK(!is_flat(bump, 0.0399));  // its height is 4/27 of the slope
  CHECK(is_flat(bump, 0.0401));
  CHECK(is_linear(keyed_curve<double>({{0, 0, Ease::linear()}, {1, 1, Ease::linear()}, {3, 3}})));
  CHECK(is_linear(keyed_curve<double>({test::sloped(0, 0, 2), test::sloped(3, 6, 2)})));
  CHECK(!is_linear(keyed_curve<double>({{0, 0, Ease::linear()}, {1, 1.01, Ease::linear()}, {3, 3}})));
  CHECK(is_linear(keyed_curve<double>({{0, 0, Ease::linear()}, {1, 1.01, Ease::linear()}, {3, 3}}), 0.011));
  CHECK(!is_linear(keyed_curve<double>({{0, 0, Ease::hold()}, {1, 1, Ease::linear()}, {2, 2}})));
  CHECK(is_linear(keyed_curve<double>({{0, 1, Ease::bezier(0.3, 0.3, 0.6, 0.6)}, {1, 3}})));
  CHECK(is_monotone(keyed_curve<double>({{0, 0, Ease::monotone()}, {1, 1, Ease::monotone()}, {2, 5}})));
  CHECK(is_monotone(keyed_curve<double>({{0, 5, Ease::hold()}, {1, 1, Ease::linear()}, {2, 1}})));
  CHECK(is_monotone(keyed_curve<double>({{0, 0, *Ease::named("circ-in-out")}, {1, 1}})));
  CHECK(!is_monotone(keyed_curve<double>({{0, 0, *Ease::named("back-in")}, {1, 1}})));
  CHECK(!is_monotone(keyed_curve<double>({test::sloped(0, 0, -1e-6), test::sloped(1, 1, 1)})));
  const Curve<Vec2> way = keyed_curve<Vec2>({{0, Vec2(0, 0), Ease::linear()}, {2, Vec2(2, 4)}});
  CHECK(is_linear(way));
  CHECK(!is_flat(way));
}

TEST_CASE("curves differ exactly where one was changed") {
  const auto built = [](double changed) {
    return keyed_curve<double>({{0, 0, Ease::catmull_rom()},
                                {1, 1, Ease::catmull_rom()},
                                {2, 0, Ease::catmull_rom()},
                                {3, changed, Ease::catmull_rom()},
                                {4, 1, Ease::catmull_rom()},
                                {5, 0, Ease::catmull_rom()},
                                {6, 2}});
  };
  // A key of Catmull and Rom's reaches two spans to each side.
  const std::vector<Interval> found = differences(built(2), built(2.5), -1, 7);
  REQUIRE(found.size() == 1);
  CHECK(found[0].from == 1);
  CHECK(found[0].to == 5);
  CHECK(differences(built(2), built(2), -1, 7).empty());
  // Straight lines that cross: apart by more than 1 before 1 and after 3.
  const Curve<double> up = keyed_curve<double>({{0, 0, Ease::linear()}, {4, 4}});
  const Curve<double> level = keyed_curve<double>({{0, 2, Ease::linear()}, {4, 2}});
  const std::vector<Interval> apart = differences(up, level, 0, 4, 1);
  REQUIRE(apart.size() == 2);
  CHECK(apart[0].from == 0);
  CHECK(apart[0].to == doctest::Approx(1));
  CHECK(apart[1].from == doctest::Approx(3));
  CHECK(apart[1].to == 4);
  // Two different timings of the same path, both with handles.
  const Curve<double> early = keyed_curve<double>({{0, 0, Ease::bezier(0.1, 0.5, 0.5, 1)}, {1, 1}});
  const Curve<double> late = keyed_curve<double>({{0, 0, Ease::bezier(0.9, 0.1, 0.9, 0.5)}, {1, 1}});
  CHECK(differences(early, late, 0, 1).size() == 1);
  CHECK(differences(early, late, 0, 1, 1.1).empty());
  CHECK(differences(early, early, 0, 1).empty());
  const std::vector<Interval> far = differences(early, late, 0, 1, 0.3);
  REQUIRE(far.size() == 1);
  CHECK(early.value(far[0].from) - late.value(far[0].from) == doctest::Approx(0.3).epsilon(1e-9));
  CHECK(early.value(far[0].to) - late.value(far[0].to) == doctest::Approx(0.3).epsilon(1e-9));
}

TEST_CASE("intervals of difference hold all and only the times that differ, whatever the curves") {
  test::Random random(21);
  for (int round = 0; round < 40; ++round) {
    CAPTURE(round);
    const Curve<double> a = test::random_curve(random), b = test::random_curve(random);
    const double from = std::min(a.start(), b.start()), to = std::max(a.end(), b.end()), tolerance = 0.5;
    const std::vector<Interval> found = differences(a, b, from, to, tolerance);
    for (int i = 0; i < 500; ++i) {
      const double t = random.between(from, to), apart = std::abs(a.value(t) - b.value(t));
      if (std::abs(apart - tolerance) < 1e-6) continue;
      const bool inside = std::ranges::any_of(found, [t](const Interval& x) { return x.from <= t && t <= x.to; });
      CHECK(inside == (apart > tolerance));
    }
  }
}

TEST_CASE("straight lines through a polyline's points stay within its error, and few are used") {
  test::Random random(22);
  for (int round = 0; round < 40; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random);
    const double error = 0.01;
    const std::vector<PolylinePoint<double>> points = polyline(curve, curve.start(), curve.end(), error);
    CHECK(points.front().time == curve.start());
    CHECK(points.back().time == curve.end());
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const auto &p = points[i], &q = points[i + 1];
      REQUIRE(p.time <= q.time);
      for (int k = 0; p.time < q.time && k <= 20; ++k) {
        const double u = k / 20.0, t = p.time + u * (q.time - p.time);
        const double straight = p.value + u * (q.value - p.value);
        CHECK(std::abs(curve.value(t, k == 20 ? Side::in : Side::out) - straight) <= error * (1 + 1e-9));
      }
    }
  }
  // A parabola of height 1 over its chord needs, for the error e, sqrt(1/e) chords; halving takes the next power of
  // two.
  const Curve<double> parabola = keyed_curve<double>({test::sloped(0, 0, 4), test::sloped(1, 0, -4)});
  CHECK(polyline(parabola, 0, 1, 1.0 / 255).size() == 17);
  CHECK_THROWS_AS((void)polyline(parabola, 0, 1, 0), std::invalid_argument);
  const auto jump = polyline(keyed_curve<double>({{0, 0, Ease::hold()}, {1, 5}}), 0, 1.5, 0.1);
  REQUIRE(jump.size() == 4);
  CHECK(jump[1].time == jump[2].time);
}
