#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/splines.h>

#include "curves/span_derivative.h"
#include "support.h"

using namespace tweenfall;

namespace {

struct Rule {
  Ease ease;
  bool second;  // the second derivative is continuous over a run
};

// Every rule that chooses slopes from the neighbors, for `ends` as it is.
std::vector<Rule> automatic_rules() {
  return {{Ease::smooth(), false},
          {Ease::smooth_clamped(), false},
          {Ease::monotone(), false},
          {Ease::akima(), false},
          {Ease::makima(), false},
          {Ease::catmull_rom(), false},
          {Ease::catmull_rom_monotone(), false},
          {Ease::uniform(), false},
          {Ease::centripetal(), false},
          {Ease::chordal(), false},
          {Ease::tcb(0.2, 0, -0.4), false},
          {Ease::natural(), true},
          {Ease::not_a_knot(), true},
          {Ease::periodic(), true}};
}

std::vector<Rule> all_rules() {
  std::vector<Rule> rules = automatic_rules();
  rules.push_back({Ease::tcb(-0.5, 0.7, 0.3), false});
  rules.push_back({Ease::clamped(), true});
  rules.push_back({Ease::clamped(-3, 2), true});
  rules.push_back({Ease::natural(4, -1), true});
  return rules;
}

std::vector<Key<double>> random_keys(test::Random& random, int count, const Ease& ease) {
  std::vector<Key<double>> keys;
  double time = random.between(-3, 3);
  for (int i = 0; i < count; ++i) {
    keys.push_back({time, random.between(-5, 5), ease});
    time += random.between(0.05, 2);
  }
  return keys;
}

bool by_distance(const Ease& ease) {
  return ease == Ease::uniform() || ease == Ease::centripetal() || ease == Ease::chordal();
}

// The rate of a cubic spline, span by span.
Curve<double> derivative_of(const Curve<double>& curve) {
  std::vector<Span<double>> spans = curve.spans();
  for (Span<double>& span : spans) {
    span.end = 0;
    for (int k = 1; k <= span.degree; ++k) {
      const std::size_t at = static_cast<std::size_t>(k);
      span.coefficients[at - 1] = k * span.coefficients[at] / span.duration;
      span.end += span.coefficients[at - 1];
    }
    span.degree = std::max(span.degree - 1, 0);
  }
  return Curve<double>(spans);
}

}  // namespace

TEST_CASE("every rule is smooth at inner keys, and those that say so in the second derivative too") {
  test::Random random(11);
  for (const Rule& rule : all_rules())
    for (int n = 0; n < 20; ++n) {
      CAPTURE(rule.ease.name());
      const auto keys = random_keys(random, 2 + n % 8, rule.ease);
      const Curve<double> curve = keyed_curve<double>(keys);
      for (std::size_t i = 1; i + 1 < keys.size(); ++i) {
        const Sample<double> in = curve.sample(keys[i].time, Side::in), out = curve.sample(keys[i].time);
        CHECK(in.value == out.value);
        if (by_distance(rule.ease))
          CHECK(in.rate * out.rate >= -1e-20);  // one direction, at each span's own speed
        else if (rule.ease != Ease::tcb(-0.5, 0.7, 0.3))
          CHECK(test::near(in.rate, out.rate, 1e-12));
        if (rule.second) CHECK(std::abs(in.acceleration - out.acceleration) <= 1e-8 * (1 + std::abs(in.acceleration)));
      }
    }
}

TEST_CASE("the ends of a C2 run are as its word says") {
  test::Random random(12);
  for (int n = 0; n < 30; ++n) {
    const int count = 2 + n % 7;
    const auto curve = [&](const Ease& ease, Ends ends = Ends::secant) {
      test::Random same(static_cast<std::uint64_t>(n));
      return keyed_curve<double>(random_keys(same, count, ease), {.ends = ends});
    };
    const auto start = [](const Curve<double>& c) { return c.sample(c.start()); };
    const auto end = [](const Curve<double>& c) { return c.sample(c.end(), Side::in); };
    const Curve<double> natural = curve(Ease::natural()), bent = curve(Ease::natural(4, -1));
    CHECK(std::abs(start(natural).acceleration) < 1e-9);
    CHECK(std::abs(end(natural).acceleration) < 1e-9);
    CHECK(test::near(start(bent).acceleration, 4, 1e-9));
    CHECK(test::near(end(bent).acceleration, -1, 1e-9));
    const Curve<double> clamped = curve(Ease::clamped(-3, 2)), flat = curve(Ease::natural(), Ends::flat);
    CHECK(test::near(start(clamped).rate, -3, 1e-12));
    CHECK(test::near(end(clamped).rate, 2, 1e-12));
    CHECK(std::abs(start(flat).rate) < 1e-12);
    CHECK(std::abs(end(flat).rate) < 1e-12);
    const Curve<double> periodic = curve(Ease::periodic());
    CHECK(test::near(start(periodic).rate, end(periodic).rate, 1e-10));
    CHECK(test::near(start(periodic).acceleration, end(periodic).acceleration, 1e-8));
    const Curve<double> free = curve(Ease::not_a_knot());
    const auto knots = free.knots();
    if (count < 4) continue;
    for (const double t : {knots[1], knots[knots.size() - 2]}) {
      const double in = test::derivative_of_spans(free, 3, t, Side::in);
      const double out = test::derivative_of_spans(free, 3, t, Side::out);
      CHECK(std::abs(in - out) <= 1e-7 * (1 + std::abs(in)));
    }
  }
}

TEST_CASE("not-a-knot gives a cubic back, and clamped one whose end slopes it is told") {
  const auto cubic = [](double t) { return ((0.3 * t - 1) * t + 2) * t - 4; };
  const auto slope = [](double t) { return (0.9 * t - 2) * t + 2; };
  const std::vector<double> times = {-1, -0.2, 0.1, 1.7, 2, 4};
  const Ease free = Ease::not_a_knot(), clamped = Ease::clamped(slope(-1), slope(4));
  for (const Ease& ease : {free, clamped}) {
    std::vector<Key<double>> keys;
    for (const double t : times) keys.push_back({t, cubic(t), ease});
    const Curve<double> curve = keyed_curve<double>(keys);
    for (double t = -1; t <= 4; t += 0.07) {
      CHECK(test::near(curve.value(t), cubic(t), 1e-13));
      CHECK(test::near(curve.rate(t), slope(t), 1e-12));
    }
  }
}

TEST_CASE("every automatic rule joins smoothly over a loop") {
  test::Random random(13);
  for (const Rule& rule : automatic_rules())
    for (int n = 0; n < 10; ++n) {
      CAPTURE(rule.ease.name());
      auto keys = random_keys(random, 3 + n % 6, rule.ease);
      keys.back().value = keys.front().value;
      // A last key's own ease says nothing, since nothing leaves it.
      if (n % 2 == 0) keys.back().ease = Ease::linear();
      const Curve<double> curve =
          keyed_curve<double>(keys, {.ends = Ends::wrap}).with_outside(Outside::repeat, Outside::repeat);
      const Sample<double> in = curve.sample(curve.end(), Side::in), out = curve.sample(curve.end());
      CHECK(test::near(in.value, out.value, 1e-14));
      if (by_distance(rule.ease))
        CHECK(in.rate * out.rate >= -1e-20);
      else
        CHECK(test::near(in.rate, out.rate, 1e-10));
      if (rule.second) CHECK(std::abs(in.acceleration - out.acceleration) <= 1e-8 * (1 + std::abs(in.acceleration)));
    }
}

TEST_CASE("a run that crosses the seam of a loop is one run, wherever the loop is cut") {
  // The same periodic motion started at each of its keys in turn; one span is straight.
  const std::vector<double> durations = {0.5, 1, 0.25, 2, 0.75, 1.5}, values = {1, -2, 0.5, 3, 2.5, -1};
  const std::size_t n = values.size();
  for (const Rule& rule : automatic_rules()) {
    CAPTURE(rule.ease.name());
    const auto cut_at = [&](std::size_t first) {
      std::vector<Key<double>> keys;
      double time = 0;
      for (std::size_t i = 0; i <= n; ++i) {
        const std::size_t k = (first + i) % n;
        keys.push_back({time, values[k], k == 3 ? Ease::linear() : rule.ease});
        time += durations[k];
      }
      return keyed_curve<double>(keys, {.ends = Ends::wrap}).with_outside(Outside::repeat, Outside::repeat);
    };
    const Curve<double> whole = cut_at(4);  // where no run crosses the seam
    double offset = durations[4] + durations[5];
    for (std::size_t first = 0; first < n; ++first) {
      const Curve<double> curve = cut_at(first);
      for (double t = 0.01; t < 6; t += 0.13) {
        CHECK(test::near(curve.value(t), whole.value(t + offset), 1e-11));
        CHECK(test::near(curve.rate(t), whole.rate(t + offset), 1e-10));
      }
      offset += durations[first];
    }
  }
}

TEST_CASE("a curve gains what its rate integrates to") {
  test::Random random(14);
  for (const Rule& rule : all_rules())
    for (int n = 0; n < 5; ++n) {
      CAPTURE(rule.ease.name());
      const Curve<double> curve = keyed_curve<double>(random_keys(random, 6, rule.ease));
      const double a = random.between(curve.start(), curve.end()), b = random.between(curve.start(), curve.end());
      CHECK(test::near(integral(derivative_of(curve), a, b), curve.value(b) - curve.value(a), 1e-11));
    }
}

TEST_CASE("monotone rules do not turn between values that do not") {
  test::Random random(15);
  for (const Ease& ease : {Ease::monotone(), Ease::smooth_clamped(), Ease::catmull_rom_monotone()})
    for (int n = 0; n < 40; ++n) {
      CAPTURE(ease.name());
      auto keys = random_keys(random, 7, ease);
      const double scale = std::pow(10, random.between(-3, 3));
      for (std::size_t i = 1; i < keys.size(); ++i)
        keys[i].value = keys[i - 1].value + (n % 3 == 0 && i == 3 ? 0 : scale * std::pow(random.unit(), 4));
      const Curve<double> curve = keyed_curve<double>(keys);
      for (int k = 0; k <= 200; ++k) {
        const double t = curve.start() + k / 200.0 * curve.duration();
        CHECK(curve.rate(t, k == 200 ? Side::in : Side::out) >= -1e-12 * scale);
      }
    }
}

TEST_CASE("outliers stay where they are under Akima's rules, and flat stretches flat under the modified one") {
  const std::vector<double> values = {0, 0, 0, 0, 5, 0, 0, 0, 0};
  const auto curve = [&values](const Ease& ease) {
    std::vector<Key<double>> keys;
    for (std::size_t i = 0; i < values.size(); ++i) keys.push_back({double(i), values[i], ease});
    return keyed_curve<double>(keys);
  };
  for (const Ease& ease : {Ease::akima(), Ease::makima()}) CHECK(curve(ease).value(1.5) == 0);
  CHECK(curve(Ease::natural()).value(1.5) != 0);
  // Where a flat stretch turns into a slope, Akima takes half the slope, the modified rule none of it.
  const std::vector<double> rise = {0, 0, 0, 1, 2, 3};
  const auto slope_at_corner = [&rise](const Ease& ease) {
    std::vector<Key<double>> keys;
    for (std::size_t i = 0; i < rise.size(); ++i) keys.push_back({double(i), rise[i], ease});
    return keyed_curve<double>(keys).rate(2);
  };
  CHECK(slope_at_corner(Ease::akima()) == 0.5);
  CHECK(slope_at_corner(Ease::makima()) == 0);
}

TEST_CASE("step-next shows the next value right after the key, and its own up to it") {
  const Curve<double> curve =
      keyed_curve<double>({{0, 1, Ease::step_next()}, {1, 5, Ease::step_next()}, {2, -3, Ease::linear()}, {3, 0}});
  CHECK(curve.value(0) == 5);
  CHECK(curve.value(0.5) == 5);
  CHECK(curve.value(1, Side::in) == 5);
  CHECK(curve.value(1) == -3);
  CHECK(curve.value(2, Side::in) == -3);
  CHECK(curve.value(2) == -3);
  CHECK(curve.rate(0.5) == 0);
}

TEST_CASE("turns follow every rule too: rotations about one axis are the curve of their angle") {
  for (const Rule& rule : all_rules()) {
    if (by_distance(rule.ease)) continue;
    CAPTURE(rule.ease.name());
    const std::vector<double> times = {0, 0.4, 1.5, 2, 3.2}, angles = {0.1, 1.2, -0.7, 0.4, 2};
    std::vector<Key<double>> numbers;
    std::vector<Key<Quat>> turns;
    for (std::size_t i = 0; i < times.size(); ++i) {
      numbers.push_back({times[i], angles[i], rule.ease});
      turns.push_back({times[i], exp_map({0, 0, angles[i]}), rule.ease});
    }
    // Numbers in a word apply to every component, also those of the other two axes.
    if (rule.ease == Ease::clamped(-3, 2) || rule.ease == Ease::natural(4, -1)) continue;
    const Curve<double> angle = keyed_curve<double>(numbers);
    const Curve<Quat> turn = keyed_curve<Quat>(turns);
    for (double t = 0; t < 3.2; t += 0.1) {
      CHECK(test::near(turn.value(t), exp_map({0, 0, angle.value(t)}), 1e-12));
      CHECK(test::near(turn.rate(t), Vec3(0, 0, angle.rate(t)), 1e-10));
    }
  }
}

TEST_CASE("a museum of nasty keys under every rule: finite, and met at every key") {
  const double after_one = std::nextafter(1.0, 2.0), after_billion = std::nextafter(1e9, 2e9);
  const std::vector<std::vector<std::pair<double, double>>> museum = {
      {{3, 7}},
      {{0, 1}, {1e-9, 2}},
      {{0, 1}, {1e9, 2}},
      {{0, 1}, {1e-9, -1}, {1e9, 5}},
      {{0, 1}, {1, 2}, {after_one, -3}, {2, 4}},
      {{0, 1}, {1e9, 2}, {after_billion, -3}, {2e9, 4}},
      {{-1e9, 0}, {0, 1}, {1e-9, 0}, {2e-9, 1}, {1e9, 0}},
      {{0, 1e150}, {1, -1e150}, {2, 1e150}, {2 + 1e-9, 0}, {3, 1e-150}},
      {{0, 1e-300}, {1, 2e-300}, {2, 0}, {3, -1e-300}},
      {{0, 5}, {1, 5}, {2, 5}, {3, 5}},
      {{0, 0}, {1, 0}, {2, 1}, {3, 1}, {4, 0}, {5, 0}},
      {{0, 1e9}, {1e-3, 1e9 + 1e-6}, {2e-3, 1e9}, {1e3, -1e9}},
  };
  for (const Rule& rule : all_rules())
    for (const Ends ends : {Ends::secant, Ends::flat, Ends::wrap})
      for (const auto& exhibit : museum) {
        CAPTURE(rule.ease.name());
        CAPTURE(&exhibit - museum.data());
        std::vector<Key<double>> keys;
        for (const auto& [time, value] : exhibit) keys.push_back({time, value, rule.ease});
        const Curve<double> curve = keyed_curve<double>(keys, {.ends = ends});
        for (std::size_t i = 0; i < keys.size(); ++i) {
          CHECK(curve.value(keys[i].time) == keys[i].value);
          CHECK(curve.value(keys[i].time, Side::in) == keys[i].value);
        }
        bool finite = true;
        for (std::size_t i = 0; i + 1 < keys.size(); ++i)
          for (int k = 0; k <= 16; ++k) {
            const double t = keys[i].time + k / 16.0 * (keys[i + 1].time - keys[i].time);
            const Sample<double> s = curve.sample(t, k == 16 ? Side::in : Side::out);
            finite = finite && std::isfinite(s.value) && std::isfinite(s.rate) && std::isfinite(s.acceleration);
          }
        CHECK(finite);
      }
}

TEST_CASE("an ease in another unit states its slopes in it, and any other ease is itself") {
  CHECK(Ease::clamped(90, -45).scaled(0.5) == Ease::clamped(45, -22.5));
  CHECK(Ease::natural(2, 0).scaled(3) == Ease::natural(6, 0));
  for (const Ease& ease : {Ease::clamped(), Ease::natural(), Ease::tcb(0.1, 0.2, 0.3), Ease::spring(0.3, 0.5)})
    CHECK(ease.scaled(2) == ease);
}

TEST_CASE("keys of one ease make the C2 spline through their values, however many they are and its ends are held") {
  using End = SplineEnd<double>;
  struct Held {
    Ease ease;
    SplineEnds<double> ends;
  };
  const Held all[] = {
      {Ease::natural(), {}},
      {Ease::natural(4, -1), {.start = {End::Kind::acceleration, 4}, .end = {End::Kind::acceleration, -1}}},
      {Ease::clamped(-3, 2), {.start = {End::Kind::rate, -3}, .end = {End::Kind::rate, 2}}},
      {Ease::not_a_knot(), {.start = {End::Kind::not_a_knot}, .end = {End::Kind::not_a_knot}}}};
  test::Random random(19);
  for (int count = 2; count < 40; ++count)
    for (const Held& held : all) {
      const std::vector<Key<double>> keys = random_keys(random, count, held.ease);
      std::vector<double> times, values;
      for (const Key<double>& key : keys) {
        times.push_back(key.time);
        values.push_back(key.value);
      }
      const Curve<double> curve = keyed_curve<double>(std::span<const Key<double>>(keys));
      const Curve<double> spline = c2_spline<double>(times, values, held.ends);
      CAPTURE(count);
      CAPTURE(held.ease.name());
      for (int i = 0; i < count; ++i) {
        const double t = times[static_cast<std::size_t>(i)];
        CHECK(curve.sample(t).rate == spline.sample(t).rate);
        if (i > 0 && i + 1 < count)
          CHECK(test::near(curve.sample(t, Side::in).acceleration, curve.sample(t).acceleration, 1e-8));
      }
    }
}

TEST_CASE("what is wrong with keys of one ease is told at the key") {
  const auto refusal = [](const std::vector<Key<double>>& keys) {
    try {
      static_cast<void>(keyed_curve<double>(std::span<const Key<double>>(keys)));
    } catch (const std::invalid_argument& problem) {
      return std::string(problem.what());
    }
    return std::string();
  };
  const Ease ease = Ease::natural();
  CHECK(refusal({{0, 1, ease}, {2, 3, ease}, {2, 4, ease}}) ==
        "key 2 (time 2 s, value 4) must come after the key before it, at 2 s");
  CHECK(refusal({{0, 1, ease}, {1, INFINITY, ease}, {2, 4, ease}}) ==
        "key 1 (time 1 s, value inf) must have a finite value");
  CHECK(refusal({{0, 1, ease}, {NAN, 2, ease}}).starts_with("key 1"));
}
