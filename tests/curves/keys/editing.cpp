#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/inspection.h>

#include "curves/museum.h"

using namespace tweenfall;

namespace {

void check_same(const Curve<double>& a, const Curve<double>& b, double from, double to, double tolerance = 1e-12) {
  const Range r = range(a, from, to);
  CHECK(test::seen_apart(a, b, from, to) <= tolerance * std::max({1.0, std::abs(r.low), std::abs(r.high)}));
}

}  // namespace

TEST_CASE("a curve split and joined again is the same, in rates too") {
  test::Random random(11);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random);
    const double time = curve.start() + random.between(0.05, 0.95) * curve.duration();
    const auto parts = split(curve, time);
    CHECK(parts.first.end() == time);
    CHECK(parts.second.start() == time);
    CHECK(parts.first.value(time) == doctest::Approx(curve.value(time)).epsilon(1e-13));
    const Curve<double> whole = joined(parts.first, parts.second);
    check_same(curve, whole, curve.start(), curve.end());
    for (int i = 1; i < 50; ++i) {
      const double t = curve.start() + curve.duration() * i / 50;
      // Steep handles turn the rounding of time into one of the rate.
      const double slack = 1e-9 * (1 + std::abs(curve.sample(t).acceleration));
      CHECK(std::abs(whole.rate(t) - curve.rate(t)) <= slack * (1 + std::abs(curve.rate(t))));
    }
    CHECK(without_redundant_knots(whole, 1e-10).knots().size() <= curve.knots().size());
  }
}

TEST_CASE("a knot more changes nothing, and is known as redundant") {
  test::Random random(12);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random);
    const double time = curve.start() + random.between(0.05, 0.95) * curve.duration();
    const Curve<double> more = with_knot(curve, time);
    CHECK(more.knots().size() == curve.knots().size() + 1);
    check_same(curve, more, curve.start() - 1, curve.end() + 1);
    CHECK(differences(curve, more, curve.start() - 1, curve.end() + 1, 1e-11).empty());
    CHECK(!redundant_knots(more, 1e-11).empty());
    CHECK(with_knot(more, time).knots().size() == more.knots().size());
  }
  CHECK_THROWS_AS((void)with_knot(keyed_curve<double>({{0, 1}, {1, 2}}), 1.5), std::invalid_argument);
}

TEST_CASE("played backwards twice a curve is itself, and once it is its mirror image") {
  test::Random random(13);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random).with_outside(Outside::repeat_offset, Outside::linear);
    const Curve<double> back = reversed(curve);
    CHECK(back.before() == Outside::linear);
    CHECK(back.after() == Outside::repeat_offset);
    for (int i = 0; i <= 60; ++i) {
      const double t = curve.start() + curve.duration() * (i - 20) / 20.3;
      const double there = curve.start() + curve.end() - t;
      CHECK(std::abs(back.value(t) - curve.value(there, Side::in)) <= 1e-10 * (1 + std::abs(curve.value(there))));
    }
    const Curve<double> twice = reversed(back);
    check_same(curve, twice, curve.start(), curve.end());
    CHECK(twice.before() == curve.before());
  }
}

TEST_CASE("loops are baked to spans that go the same way") {
  for (const Outside rule :
       {Outside::hold, Outside::linear, Outside::repeat, Outside::repeat_offset, Outside::pingpong}) {
    CAPTURE(static_cast<int>(rule));
    test::Random random(14);
    for (int round = 0; round < 8; ++round) {
      const Curve<double> curve = test::random_curve(random).with_outside(rule, rule);
      const double from = curve.start() - 2.3 * curve.duration(), to = curve.end() + 1.7 * curve.duration();
      const Curve<double> baked = trimmed(curve, from, to);
      CHECK(baked.start() == from);
      CHECK(baked.end() == to);
      check_same(curve, baked, from + 1e-9, to - 1e-9, 1e-9);
    }
    // Rotations keep turning.
    const Quat a = Quat::Identity(), b = exp_map(Vec3(0.3, 0.9, -0.2));
    const Curve<Quat> turn =
        keyed_curve<Quat>({{0, a, Ease::smooth()}, {1, b, Ease::smooth()}, {3, a * b * b}}).with_outside(rule, rule);
    const Curve<Quat> baked = trimmed(turn, -4, 8);
    for (double t = -3.95; t < 8; t += 0.1) {
      CHECK(test::near(baked.value(t), turn.value(t), 1e-12));
      CHECK(test::near(baked.rate(t), turn.rate(t), 1e-11));
    }
  }
}

TEST_CASE("shifting and scaling move time and values, rates and rules with them") {
  test::Random random(15);
  for (int round = 0; round < 40; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random).with_outside(Outside::pingpong, Outside::repeat_offset);
    const Curve<double> later = shifted(curve, 2.5), slower = time_scaled(curve, 3, 1);
    const Curve<double> larger = value_scaled(curve, -2.0, 7.0);
    for (int i = 0; i <= 40; ++i) {
      const double t = curve.start() + curve.duration() * (i - 13.7) / 13.1;
      const double close = 1e-8 * (1 + std::abs(curve.value(t)) + std::abs(curve.rate(t)));
      CHECK(std::abs(later.value(t + 2.5) - curve.value(t)) <= close);
      CHECK(std::abs(slower.value(1 + 3 * (t - 1)) - curve.value(t)) <= close);
      CHECK(std::abs(3 * slower.rate(1 + 3 * (t - 1)) - curve.rate(t)) <=
            close * (1 + std::abs(curve.sample(t).acceleration)));
      CHECK(std::abs(larger.value(t) - (7 - 2 * curve.value(t))) <= close);
      CHECK(std::abs(larger.rate(t) + 2 * curve.rate(t)) <= close);
    }
  }
  const Curve<double> line = keyed_curve<double>({{0, 0}, {1, 1}});
  CHECK_THROWS_AS((void)time_scaled(line, 0), std::invalid_argument);
  CHECK_THROWS_AS((void)joined(line, line), std::invalid_argument);
  CHECK_THROWS_AS((void)trimmed(line, 1, 1), std::invalid_argument);
  CHECK_THROWS_AS((void)split(line, 1), std::invalid_argument);
}

TEST_CASE("formulas and converted curves are edited as well, and stay what they are") {
  const Curve<double> cube([](double t, Side) { return Sample<double>{t * t * t, 3 * t * t, 6 * t}; }, -1, 2);
  const auto parts = split(cube, 1);
  CHECK(joined(parts.first, parts.second).value(1.5) == 1.5 * 1.5 * 1.5);
  CHECK(reversed(cube).value(0) == 1);
  CHECK(reversed(cube).rate(0) == -3);
  CHECK(shifted(cube, 1).value(3) == 8);
  CHECK(time_scaled(cube, 2).rate(2) == 1.5);
  CHECK(value_scaled(cube, 2.0, 1.0).sample(1).acceleration == 12);
  const Curve<Color> fade = keyed_curve<Color>({{0, Color{{1, 0, 0, 1}}}, {1, Color{{0, 0, 1, 0.5}}}});
  const Curve<Color> later = shifted(fade, 3).with_outside(Outside::repeat, Outside::repeat);
  CHECK(test::near(later.value(5.25).rgba, fade.value(0.25).rgba, 1e-12));
  CHECK(later.knots()[1] == 4);
}

TEST_CASE("keys taken from a curve make the same curve") {
  test::Random random(16);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random, false);
    const std::vector<Key<double>> keys = keys_of(curve);
    CHECK(keys.size() == curve.knots().size());
    check_same(curve, keyed_curve<double>(std::span<const Key<double>>(keys)), curve.start(), curve.end());
  }
  const Curve<double> jump =
      keyed_curve<double>({{0, 0, Ease::linear()}, {1, 5, Ease::hold(), {}, {}, 1.0}, {2, 4, Ease::natural()}, {3, 7}});
  const std::vector<Key<double>> keys = keys_of(jump);
  CHECK(keys[1].value_in == 1.0);
  CHECK(keys[1].ease == Ease::hold());
  CHECK(!keys[2].value_in);
  check_same(jump, keyed_curve<double>(std::span<const Key<double>>(keys)), 0, 3);
  CHECK_THROWS_AS((void)keys_of(keyed_curve<double>({{0, 0, *Ease::named("elastic-out")}, {1, 1}})),
                  std::invalid_argument);
  // A Bezier ease gives its handles.
  const std::vector<Key<double>> ease = keys_of(keyed_curve<double>({{0, 0, Ease::bezier(0.25, 0.1, 0.4, 1)}, {2, 4}}));
  CHECK(ease[0].out->weight == doctest::Approx(0.25));
  CHECK(ease[0].out->rate == doctest::Approx(0.1 * 4 / (0.25 * 2)));
  CHECK(ease[1].in->weight == doctest::Approx(0.6));
  CHECK(std::abs(ease[1].in->rate) < 1e-12);
}

TEST_CASE("a key put between keys changes nothing") {
  test::Random random(17);
  int refused = 0;
  for (int round = 0; round < 100; ++round) {
    CAPTURE(round);
    std::vector<Key<double>> keys;
    const char* words[] = {"hold", "linear", "smooth", "natural", "catmull-rom", "cubic-in", "bezier(0.4,0,0.2,1)"};
    for (int i = 0; i < 6; ++i) {
      Key<double> key{i + random.between(0, 0.5), random.between(-5, 5)};
      key.ease = *Ease::named(words[static_cast<int>(random.between(0, 7))]);
      if (i == 3) key.in = Tangent<double>{Tangent<double>::Kind::given, 2.0, 0.7};
      keys.push_back(key);
    }
    const std::span<const Key<double>> given(keys);
    const Curve<double> curve = keyed_curve<double>(given);
    check_same(curve, keyed_curve<double>(std::span<const Key<double>>(with_given_slopes(given))), curve.start(),
               curve.end());
    const double time = curve.start() + random.between(0.01, 0.99) * curve.duration();
    try {
      const std::vector<Key<double>> more = with_key(given, time);
      CHECK(more.size() == keys.size() + 1);
      check_same(curve, keyed_curve<double>(std::span<const Key<double>>(more)), curve.start(), curve.end());
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  // Only handles that would leave their spans may be refused.
  CHECK(refused < 5);
  CHECK_THROWS_AS((void)with_key<double>(std::vector<Key<double>>{{0, 1}, {1, 2}}, 2), std::invalid_argument);
}

TEST_CASE("keys are put between those of colors, ratios and turns as well") {
  KeyOptions ratio;
  ratio.logarithmic = true;
  const std::vector<Key<double>> doubling = {{0, 1, Ease::smooth()}, {1, 2, Ease::smooth()}, {3, 16}};
  const std::vector<Key<double>> more = with_key<double>(doubling, 1.7, ratio);
  check_same(keyed_curve<double>(std::span<const Key<double>>(doubling), ratio),
             keyed_curve<double>(std::span<const Key<double>>(more), ratio), 0, 3);
  const std::vector<Key<Color>> fade = {{0, Color{{1, 0.2, 0, 1}}, Ease::smooth()},
                                        {1, Color{{0, 0.3, 1, 0.5}}, Ease::smooth()},
                                        {2, Color{{1, 1, 1, 1}}}};
  const auto mixed = keyed_curve<Color>(std::span<const Key<Color>>(fade));
  const auto cut = keyed_curve<Color>(std::span<const Key<Color>>(with_key<Color>(fade, 0.4)));
  for (double t = 0; t <= 2; t += 0.05) CHECK(test::near(cut.value(t).rgba, mixed.value(t).rgba, 1e-10));
  const std::vector<Key<Quat>> turns = {
      {0, Quat::Identity(), Ease::linear()}, {1, exp_map(Vec3(1, 1, 0)), Ease::smooth()}, {2, exp_map(Vec3(0, 1, 1))}};
  const auto way = keyed_curve<Quat>(std::span<const Key<Quat>>(turns));
  const auto way_cut = keyed_curve<Quat>(std::span<const Key<Quat>>(with_key<Quat>(turns, 0.3)));
  for (double t = 0; t <= 2; t += 0.05) CHECK(test::near(way_cut.value(t), way.value(t), 1e-12));
  CHECK_THROWS_AS((void)with_key<Quat>(turns, 1.5), std::invalid_argument);
}

TEST_CASE("cubic spans go to Bezier points and back, and their points are those of the definition") {
  // value' at the ends is 3 (P1 - P0) and 3 (P3 - P2) over the duration.
  const auto points = bezier_points(keyed_curve<double>({test::sloped(1, 2, 3), test::sloped(4, 5, -6)}));
  REQUIRE(points.size() == 1);
  CHECK(points[0].times == std::array<double, 4>{1, 2, 3, 4});
  CHECK(points[0].values[1] == doctest::Approx(2 + 3));
  CHECK(points[0].values[2] == doctest::Approx(5 + 6));
  const auto ease = bezier_points(keyed_curve<double>({{0, 1, Ease::bezier(0.1, 0.7, 0.4, 1.2)}, {2, 3}}));
  CHECK(ease[0].times[1] == doctest::Approx(0.2));
  CHECK(ease[0].times[2] == doctest::Approx(0.8));
  CHECK(ease[0].values[1] == doctest::Approx(1 + 2 * 0.7));
  CHECK(ease[0].values[2] == doctest::Approx(1 + 2 * 1.2));
  test::Random random(18);
  for (int round = 0; round < 40; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random, false);
    const std::vector<BezierPoints<double>> spans = bezier_points(curve);
    const std::vector<Key<double>> keys = keys_of<double>(std::span<const BezierPoints<double>>(spans));
    check_same(curve, keyed_curve<double>(std::span<const Key<double>>(keys)), curve.start(), curve.end());
  }
  const BezierPoints<double> backward{{0, 1.5, 0.5, 1}, {0, 0, 1, 1}};
  CHECK_THROWS_AS((void)keys_of<double>(std::span<const BezierPoints<double>>(&backward, 1)), std::invalid_argument);
  CHECK_THROWS_AS((void)bezier_points(keyed_curve<double>({{0, 0, *Ease::named("sine-in")}, {1, 1}})),
                  std::invalid_argument);
}

TEST_CASE("turns are cut and played backwards, whatever the form of their spans") {
  const Quat a = Quat::Identity(), b = exp_map(Vec3(0.3, 0.9, -0.2)), c = exp_map(Vec3(-1, 0.4, 0.7));
  const Curve<Quat> turn =
      keyed_curve<Quat>({{0, a, Ease::smooth()}, {1, b, *Ease::named("sine-in-out")}, {3, c, Ease::linear()}, {4, a}});
  const auto parts = split(turn, 0.4);
  const Curve<Quat> whole = joined(parts.first, parts.second), back = reversed(turn), twice = reversed(back);
  for (double t = 0.05; t < 4; t += 0.1) {
    const Sample<Quat> s = turn.sample(t), w = whole.sample(t), r = back.sample(4 - t, Side::in),
                       again = twice.sample(t);
    CHECK(test::near(w.value, s.value, 1e-13));
    CHECK(test::near(w.rate, s.rate, 1e-12));
    CHECK(test::near(w.acceleration, s.acceleration, 1e-11));
    CHECK(test::near(r.value, s.value, 1e-13));
    CHECK(test::near(r.rate, Vec3(-s.rate), 1e-12));
    CHECK(test::near(again.value, s.value, 1e-13));
  }
  const std::vector<Key<Quat>> keys = keys_of(split(turn, 3.25).second);
  REQUIRE(keys.size() == 2);
  CHECK(test::near(keys[0].value, turn.value(3.25), 1e-13));
  CHECK(keys[0].ease == Ease::linear());
}
