#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/modifiers.h>

#include "support.h"

using namespace tweenfall;

namespace {

template <class T>
using Rules = std::pair<OutsideRule<T>, OutsideRule<T>>;

// Every rule on both ends, for ever and counted, with a slope and without.
template <class T>
std::vector<Rules<T>> all_rules(const Rate<T>& slope) {
  const Rate<T> other = -0.5 * slope;
  return {{{Outside::hold}, {Outside::hold}},
          {{Outside::linear}, {Outside::linear}},
          {{Outside::linear, slope}, {Outside::linear, other}},
          {{Outside::repeat}, {Outside::repeat, {}, 1.4}},
          {{Outside::repeat_offset, {}, 0.7}, {Outside::repeat_offset}},
          {{Outside::repeat_offset}, {Outside::repeat_offset, {}, 2}},
          {{Outside::pingpong, {}, 1}, {Outside::pingpong, {}, 2.3}},
          {{Outside::pingpong}, {Outside::linear, slope}},
          {{Outside::linear}, {Outside::repeat, {}, 3}}};
}

template <class T>
Tangent<T> slope(const Rate<T>& rate) {
  return {TangentKind::given, rate};
}

// Keys whose ends use everything that ends can have: another value before the first span than at its start, another
// after last one than at its end, and slopes on the outer sides.
template <class T>
Curve<T> curve_through(const T& a, const T& b, const T& c, const Rate<T>& rate) {
  Key<T> first{1, a, *Ease::named("step-next")}, second{2, b, Ease::smooth()}, third{2.75, a, Ease::smooth()},
      last{4, c};
  first.in = slope<T>(rate);
  last.out = slope<T>(Rate<T>(-rate));
  last.value_in = b;
  return keyed_curve<T>({first, second, third, last});
}

double apart(double a, double b) {
  return std::abs(a - b);
}
template <class V>
double apart(const Eigen::MatrixBase<V>& a, const Eigen::MatrixBase<V>& b) {
  return (a - b).norm();
}
double apart(const Color& a, const Color& b) {
  return (a.rgba - b.rgba).norm();
}
double apart(const Quat& a, const Quat& b) {
  return std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm());
}

// Times all around the curve, including its knots and seams from both sides.
template <class T, class F>
void at_times(const Curve<T>& curve, const F& look) {
  const double reach = 3.3 * curve.duration();
  for (int i = 0; i <= 130; ++i) look(curve.start() - reach + (2 * reach + curve.duration()) * i / 130.7, Side::out);
  for (const double knot : curve.knots())
    for (const Side side : {Side::in, Side::out}) look(knot, side);
}

template <class T>
void check_same(const Curve<T>& a, const Curve<T>& b) {
  at_times(a, [&](double t, Side side) {
    CAPTURE(t);
    CAPTURE((side == Side::in));
    const Sample<T> x = a.sample(t, side), y = b.sample(t, side);
    CHECK(apart(x.value, y.value) < 1e-11);
    CHECK(apart(x.rate, y.rate) < 1e-10);
    CHECK(apart(x.acceleration, y.acceleration) < 1e-8);
  });
}

// `test` with a curve of each type and conversion under all rules.
template <class F>
void with_all_curves(const F& test) {
  const auto under_rules = [&test](const char* name, const auto& curve, const auto& rate) {
    using T = std::decay_t<decltype(curve.value(0))>;
    const std::vector<Rules<T>> rules = all_rules<T>(rate);
    for (std::size_t i = 0; i < rules.size(); ++i) {
      CAPTURE(name);
      CAPTURE(i);
      test(curve.with_outside(rules[i].first, rules[i].second));
    }
  };
  const Curve<double> number = curve_through<double>(3, -1, 2.5, 0.75);
  under_rules("a number", number, 1.5);
  const Curve<Vec3> place = curve_through<Vec3>({1, 2, 3}, {-1, 0, 2}, {0, 5, 1}, {1, -1, 0.5});
  under_rules("a place", place, Vec3(0.5, 1, -2));
  const Curve<Color> color = curve_through<Color>(Color{{0.1, 0.2, 0.9, 1}}, Color{{0.8, 0.5, 0.3, 0.5}},
                                                  Color{{0.4, 0.3, 0.2, 1}}, Vec4(0.1, 0, -0.1, 0));
  under_rules("a color", color, Vec4(0.05, 0.1, 0, -0.1));
  const Quat a = exp_map(Vec3(0.3, -0.2, 0.5)), b = exp_map(Vec3(-0.6, 0.9, 0.1)), c = exp_map(Vec3(1, 1, 0.2));
  under_rules("a turn", curve_through<Quat>(a, b, c, Vec3(0.4, 0, 0.2)), Vec3(0.5, -0.25, 1));
  under_rules("angles", euler_curve(place, EulerOrder{}), Vec3(0.5, -0.25, 1));
  under_rules("an angle", axis_curve(Vec3(1, 2, 2), number), Vec3(0.5, -0.25, 1));
  under_rules("a formula", Curve<double>([](double t, Side) { return Sample<double>{t * t, 2 * t, 2}; }, -1, 2), 1.5);
  KeyOptions ratio;
  ratio.logarithmic = true;
  under_rules("by ratio", keyed_curve<double>({{0, 1, Ease::smooth()}, {1, 2, Ease::smooth()}, {3, 0.5}}, ratio), 0.1);
}

}  // namespace

TEST_CASE("beyond counted plays a curve rests, and a stated slope is gone on at, whatever the curve is made of") {
  with_all_curves([](const auto& curve) {
    using T = std::decay_t<decltype(curve.value(0))>;
    for (const bool early : {true, false}) {
      CAPTURE(early);
      const OutsideRule<T>& rule = early ? curve.rule_before() : curve.rule_after();
      const double end = early ? curve.start() : curve.end(), away = early ? -1 : 1;
      if (rule.slope) {
        CHECK(apart(curve.rate(end + 2.5 * away), *rule.slope) == 0);
        const T here = curve.value(end, early ? Side::in : Side::out);
        if constexpr (std::is_same_v<T, Quat>)
          CHECK(apart(curve.value(end + 2.5 * away), exp_map(2.5 * away * *rule.slope) * here) < 1e-12);
      }
      if (!(rule.plays > 0)) continue;
      const double last = end + away * rule.plays * curve.duration();
      const auto rest = curve.sample(last + 1.25 * away);
      CHECK(apart(rest.value, curve.value(last, early ? Side::out : Side::in)) < 1e-12);
      CHECK(apart(rest.rate, zero<Rate<T>>()) == 0);
      // Until then it plays as it does forever.
      const auto endless = curve.with_outside({rule.rule}, {rule.rule});
      CHECK(apart(curve.value(last - 0.1 * away), endless.value(last - 0.1 * away)) < 1e-12);
    }
  });
}

TEST_CASE("edited curves do outside what the curve did") {
  with_all_curves([](const auto& curve) {
    using T = std::decay_t<decltype(curve.value(0))>;
    const auto back = reversed(curve), slower = time_scaled(curve, 2.5, 1), later = shifted(curve, 2);
    at_times(curve, [&](double t, Side side) {
      CAPTURE(t);
      const Sample<T> s = curve.sample(t, side);
      const Sample<T> r = back.sample(curve.start() + curve.end() - t, side == Side::in ? Side::out : Side::in);
      CHECK(apart(r.value, s.value) < 1e-11);
      CHECK(apart(r.rate, Rate<T>(-s.rate)) < 1e-10);
      const Sample<T> slow = slower.sample(1 + 2.5 * (t - 1), side), late = later.sample(t + 2, side);
      CHECK(apart(slow.value, s.value) < 1e-11);
      CHECK(apart(slow.rate, Rate<T>(s.rate / 2.5)) < 1e-10);
      CHECK(apart(late.value, s.value) < 1e-11);
      CHECK(apart(late.rate, s.rate) < 1e-10);
    });
    check_same(curve, reversed(back));
    CHECK(later.rule_before().plays == curve.rule_before().plays);
    CHECK(back.rule_before().plays == curve.rule_after().plays);
    // New rules are applied.
    const auto [before, after] = all_rules<T>(curve.rate(curve.start()))[6];
    check_same(shifted(curve.with_outside(before, after), 2), later.with_outside(before, after));
    check_same(reversed(curve.with_outside(before, after)), back.with_outside(after, before));
    if (curve.spans().empty()) return;
    const double middle = curve.start() + 0.4 * curve.duration();
    check_same(curve, with_knot(curve, middle));
    const auto whole = split(curve, middle);
    check_same(curve, joined(whole.first, whole.second).with_outside(curve.rule_before(), curve.rule_after()));
  });
}

TEST_CASE("scaled values go on outside at scaled slopes") {
  with_all_curves([](const auto& curve) {
    using T = std::decay_t<decltype(curve.value(0))>;
    if constexpr (std::is_same_v<T, double>) {
      const Curve<double> larger = value_scaled(curve, -2.0, 7.0), none = value_scaled(curve, 0.0, 7.0);
      at_times(curve, [&](double t, Side side) {
        CAPTURE(t);
        CHECK(larger.value(t, side) == doctest::Approx(7 - 2 * curve.value(t, side)));
        CHECK(larger.rate(t, side) == doctest::Approx(-2 * curve.rate(t, side)));
        CHECK(none.value(t, side) == 7);
      });
    }
  });
}

TEST_CASE("what a curve does outside is written out as spans") {
  with_all_curves([](const auto& curve) {
    const double from = curve.start() - 2.2 * curve.duration(), to = curve.end() + 3.1 * curve.duration();
    const auto baked = trimmed(curve, from, to);
    for (int i = 1; i < 200; ++i) {
      const double t = from + (to - from) * i / 200.3;
      CAPTURE(t);
      CHECK(apart(baked.value(t), curve.value(t)) < 1e-11);
      CHECK(apart(baked.rate(t), curve.rate(t)) < 1e-10);
    }
  });
}

TEST_CASE("integral, derivative and range count what happens outside") {
  with_all_curves([](const auto& curve) {
    using T = std::decay_t<decltype(curve.value(0))>;
    if constexpr (std::is_same_v<T, double> || std::is_same_v<T, Vec3>) {
      const double from = curve.start() - 2.2 * curve.duration(), to = curve.end() + 3.1 * curve.duration();
      // Two-point Gauss rule between all places where the curve may kink or jump.
      std::vector<double> marks = {from, to};
      for (int k = -4; k <= 4; ++k)
        for (const double knot : curve.knots()) {
          marks.push_back(knot + k * curve.duration());
          marks.push_back(curve.start() + curve.end() - knot + k * curve.duration());
        }
      for (int k = -4; k <= 4; ++k) marks.push_back(curve.start() + k * curve.duration());
      marks.push_back(curve.start() - curve.rule_before().plays * curve.duration());
      marks.push_back(curve.end() + curve.rule_after().plays * curve.duration());
      std::erase_if(marks, [&](double t) { return t < from || t > to; });
      std::sort(marks.begin(), marks.end());
      T area = zero<T>();
      double low = 1e300, high = -1e300;
      for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
        const int parts = 60;
        const double half = 0.5 * (marks[i + 1] - marks[i]) / parts;
        for (int k = 0; k < parts; ++k)
          for (const double node : {-1 / std::sqrt(3.0), 1 / std::sqrt(3.0)}) {
            const T value = curve.value(marks[i] + (2 * k + 1 + node) * half);
            area += half * value;
            if constexpr (std::is_same_v<T, double>) {
              low = std::min(low, value);
              high = std::max(high, value);
            }
          }
      }
      CHECK(apart(integral(curve, from, to), area) < 1e-8 * (1 + apart(area, zero<T>())));
      if constexpr (std::is_same_v<T, double>) {
        const Range r = range(curve, from, to);
        CHECK(r.low <= low + 1e-12);
        CHECK(r.high >= high - 1e-12);
        CHECK(r.low > low - 0.02 * (1 + high - low));
        CHECK(r.high < high + 0.02 * (1 + high - low));
        for (const double level : {0.5 * (low + high), 0.9 * low + 0.1 * high})
          for (const double t : solve(curve, level, from, to)) {
            const double near = std::min(apart(curve.value(t), level), apart(curve.value(t, Side::in), level));
            const bool crosses = (curve.value(t) - level) * (curve.value(t, Side::in) - level) <= 0;
            CHECK((near < 1e-9 || crosses));
          }
      }
      if (curve.spans().empty()) return;
      const Curve<T> rate = derivative(curve);
      at_times(curve, [&](double t, Side side) {
        CAPTURE(t);
        CHECK(apart(rate.value(t, side), curve.rate(t, side)) < 1e-10);
        CHECK(apart(rate.rate(t, side), curve.sample(t, side).acceleration) < 1e-9);
      });
    }
  });
}

TEST_CASE("areas climb on outside at what the curve holds, and for as long as it plays") {
  const Curve<double> c = curve_through<double>(3, -1, 2.5, 0.75);
  const Curve<double> held = antiderivative(c);
  for (const double t : {-2.0, 0.0, 5.0, 9.0}) {
    CHECK(held.value(t) == doctest::Approx(integral(c, c.start(), t)));
    CHECK(held.rate(t) == doctest::Approx(t < 1 ? 3 : 2.5));
  }
  const Curve<double> loop = c.with_outside(OutsideRule<double>{Outside::repeat, {}, 2}, {Outside::repeat, {}, 1.5});
  const Curve<double> area = antiderivative(loop);
  for (const double t : {-4.5, -1.0, 0.0, 5.0, 8.4}) CHECK(area.value(t) == doctest::Approx(integral(loop, 1, t)));
}

TEST_CASE("keys keep the slopes on the outer sides of a curve's ends") {
  const Curve<double> c = curve_through<double>(3, -1, 2.5, 0.75).with_outside(Outside::linear, Outside::linear);
  const std::vector<Key<double>> keys = keys_of(c);
  REQUIRE(keys.front().in);
  CHECK(keys.front().in->rate == 0.75);
  REQUIRE(keys.back().out);
  CHECK(keys.back().out->rate == -0.75);
  CHECK(keys.back().value == 2.5);
  CHECK(keys.back().value_in == -1.0);
}

TEST_CASE("rotations go straight on at the angular velocity of their outer tangents") {
  const Quat a = exp_map(Vec3(0.3, -0.2, 0.5)), b = exp_map(Vec3(-0.6, 0.9, 0.1));
  const Vec3 rate(0.4, 0, 0.2);
  const Curve<Quat> c = curve_through<Quat>(a, b, b, rate).with_outside(Outside::linear, Outside::linear);
  CHECK(apart(c.rate(-1), rate) == 0);
  CHECK(apart(c.value(-1), exp_map(-2 * rate) * a) < 1e-14);
  CHECK(apart(c.rate(5), Vec3(-rate)) == 0);
  CHECK(apart(c.value(5), exp_map(-rate) * b) < 1e-14);
}

TEST_CASE("modifiers go on over a stated slope and over counted plays") {
  const Curve<double> line = keyed_curve<double>({{0, 0, Ease::linear()}, {1, 2}});
  modifiers::Generator cubic{{0, 0, 0, 1}};
  cubic.additive = true;
  const std::vector<Modifier> list = {{cubic}};
  const Curve<double> c =
      modified(line, list)
          .with_outside(OutsideRule<double>{Outside::linear, -1}, OutsideRule<double>{Outside::repeat_offset, {}, 2});
  CHECK(c.value(-2) == doctest::Approx(2 - 8));
  CHECK(c.rate(-2) == doctest::Approx(-1 + 12));
  CHECK(c.value(2.5) == doctest::Approx(5 + 15.625));
  CHECK(c.value(4) == doctest::Approx(6 + 64));
  CHECK(c.rate(4) == doctest::Approx(48));
  CHECK(integral(c, 3, 5) == doctest::Approx(12 + (625 - 81) / 4.0));
  CHECK(integral(modified(Curve<double>(2), list), 0, 2) == doctest::Approx(4 + 4));
}

TEST_CASE("functions combined rest together, and slopes of their own are kept") {
  const Curve<double> x = keyed_curve<double>({{0, 0, Ease::linear()}, {1, 2}});
  const Curve<double> y = keyed_curve<double>({{0, 1, Ease::linear()}, {1, 0}});
  const OutsideRule<double> twice{Outside::repeat_offset, {}, 2};
  const Curve<Vec2> both = parametric(x.with_outside({}, twice), y.with_outside({}, twice));
  CHECK(test::near(both.value(2.5), Vec2(5, -1.5), 1e-14));
  CHECK(test::near(both.value(7), Vec2(6, -2), 1e-14));
  CHECK(both.end() == 1);
  const Curve<Vec2> apart_ones = parametric(x.with_outside({}, OutsideRule<double>{Outside::linear, 5}), y);
  CHECK(test::near(apart_ones.value(3), Vec2(12, 0), 1e-14));
}

TEST_CASE("before a step at the first key a curve has that key's own value") {
  const auto check = [](const auto& own, const auto& next) {
    using T = std::decay_t<decltype(own)>;
    const Curve<T> c = keyed_curve<T>({Key<T>{1, own, *Ease::named("step-next")}, Key<T>{2, next}});
    for (const Outside rule : {Outside::hold, Outside::linear}) {
      const Curve<T> curve = c.with_outside(rule, rule);
      CHECK(apart(curve.value(1, Side::in), own) == 0);
      CHECK(apart(curve.value(0), own) <= (rule == Outside::hold ? 0 : 1e-14));
      CHECK(apart(curve.value(1), next) < 1e-15);
      CHECK(apart(reversed(curve).value(2, Side::out), own) == 0);
      CHECK(apart(curve.rate(0), zero<Rate<T>>()) == 0);
    }
  };
  check(3.1, 7.3);
  check(Vec2(1.1, 2.3), Vec2(4, 5));
  check(Vec3(1.1, 2.3, 0.7), Vec3(4, 5, 6));
  check(Vec4(1.1, 2.3, 0.7, 0.1), Vec4(4, 5, 6, 7));
  check(Color{{0.1, 0.2, 0.7, 0.5}}, Color{{0.3, 0.9, 0.1, 1}});
  check(exp_map(Vec3(0.1, 0.2, 0.7)), exp_map(Vec3(-0.3, 1, 0.4)));
}
