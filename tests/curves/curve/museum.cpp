#include <tweenfall/curves/arc_length.h>
#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/fitting.h>
#include <tweenfall/curves/inspection.h>

#include "curves/museum.h"

using namespace tweenfall;

namespace {

bool in_order(const std::vector<double>& times, double from, double to) {
  return std::ranges::all_of(times, [&](double t) { return from <= t && t <= to; }) && std::ranges::is_sorted(times);
}

double size_of(const Curve<double>& curve) {
  const Range r = range(curve, curve.start(), curve.end());
  return std::max(std::abs(r.low), std::abs(r.high));
}

}  // namespace

TEST_CASE("every question about every curve of the museum has a finite answer that fits what is seen") {
  for (const test::Exhibit& exhibit : test::museum()) {
    CAPTURE(exhibit.name);
    const Curve<double>& curve = exhibit.curve;
    const double from = curve.start(), to = curve.end();
    const Range r = range(curve, from, to);
    const double size = size_of(curve), slack = 1e-9 * size;
    CHECK(std::isfinite(r.low));
    CHECK(std::isfinite(r.high));
    double seen_low = curve.value(from), seen_high = seen_low, sum = 0;
    constexpr int samples = 20000;
    for (int i = 0; i < samples; ++i) {
      const double v = curve.value(from + (to - from) * (i + 0.5) / samples);
      seen_low = std::min(seen_low, v);
      seen_high = std::max(seen_high, v);
      sum += v / samples;
    }
    CHECK(seen_low >= r.low - slack);
    CHECK(seen_high <= r.high + slack);
    // A missed stretch may be narrow, but only as narrow as the curve's own spans.
    const double whole = integral(curve, from, to);
    CHECK(std::isfinite(whole));
    if (curve.duration() > 0) CHECK(std::abs(whole / curve.duration() - sum) <= 1e-3 * (std::abs(sum) + size));
    const Curve<double> area = antiderivative(curve);
    CHECK(std::abs(area.value(to, Side::in) - area.value(from) - whole) <=
          1e-9 * (std::abs(whole) + size * curve.duration()));
    CHECK(in_order(extrema(curve), from, to));
    for (const double level : {r.low, r.high, 0.5 * r.low + 0.5 * r.high, 0.0}) {
      const std::vector<double> times = solve(curve, level, from, to);
      CHECK(in_order(times, from, to));
      for (const double t : times) {
        // A root is known to the last bit of its time, and the value there as well as that allows.
        const double step = std::max(1e-15 * std::max(std::abs(from), std::abs(to)), 1e-12 * (to - from));
        const double low =
            std::min({curve.value(t - step), curve.value(t, Side::in), curve.value(t), curve.value(t + step)});
        const double high =
            std::max({curve.value(t - step), curve.value(t, Side::in), curve.value(t), curve.value(t + step)});
        CHECK(low <= level + 1e-6 * size);
        CHECK(high >= level - 1e-6 * size);
      }
    }
    CHECK(std::isfinite(arc_length(curve, from, to)));
    const std::vector<Continuity> smoothness = continuity(curve);
    const bool jumps = smoothness.size() < 2 || std::any_of(smoothness.begin() + 1, smoothness.end() - 1,
                                                            [](Continuity c) { return c == Continuity::jump; });
    if (!jumps) CHECK(arc_length(curve, from, to) >= (r.high - r.low) * (1 - 1e-9));
    CHECK(smoothness.size() == curve.knots().size());
    if (is_flat(curve)) CHECK(is_linear(curve));
    if (is_linear(curve)) CHECK(is_monotone(curve));
    CHECK(differences(curve, curve, from, to).empty());
    if (size > 0 && curve.duration() > 0) {
      const auto points = polyline(curve, from, to, 1e-3 * size);
      CHECK(points.size() < 100000);
      CHECK(std::ranges::is_sorted(points, {}, &PolylinePoint<double>::time));
    }
  }
}

TEST_CASE("every curve of the museum can be edited and comes back as it was") {
  for (const test::Exhibit& exhibit : test::museum()) {
    CAPTURE(exhibit.name);
    const Curve<double>& curve = exhibit.curve;
    if (!(curve.duration() > 0)) continue;
    const double size = size_of(curve), from = curve.start(), to = curve.end();
    const double middle = from + 0.37 * (to - from);
    const auto parts = split(curve, middle);
    CHECK(test::seen_apart(curve, joined(parts.first, parts.second), from, to) <= 1e-9 * size);
    CHECK(std::isfinite(reversed(reversed(curve)).value(middle)));
    CHECK(shifted(curve, 0).value(middle) == curve.value(middle));
    CHECK(time_scaled(curve, 0.5, from).value(from + 0.5 * (middle - from)) ==
          doctest::Approx(curve.value(middle)).epsilon(1e-6));
    CHECK(trimmed(curve.with_outside(Outside::pingpong, Outside::repeat), from - (to - from), to + 2 * (to - from))
              .duration() > 0);
  }
}

TEST_CASE("every curve of the museum is fitted within its error") {
  for (const test::Exhibit& exhibit : test::museum()) {
    CAPTURE(exhibit.name);
    const Curve<double>& curve = exhibit.curve;
    const double size = size_of(curve);
    for (const double share : {0.1, 1e-3}) {
      CAPTURE(share);
      const double error = size > 0 ? share * size : share;
      for (const FitSlopes slopes : {FitSlopes::own, FitSlopes::least_squares}) {
        const std::vector<Key<double>> keys = fit(curve, error, {.slopes = slopes});
        CHECK(keys.size() < 2000);
        const Curve<double> found = keyed_curve<double>(std::span<const Key<double>>(keys));
        if (curve.duration() > 0)
          CHECK(test::seen_apart(curve, found, curve.start(), curve.end()) <= error * (1 + 1e-6));
      }
    }
  }
}

TEST_CASE("the inverse of a monotone curve takes each value back to its time") {
  test::Random random(41);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    std::vector<Key<double>> keys;
    double time = 0, value = random.between(-3, 3);
    const double way = round % 2 ? 1 : -1;
    for (int i = 0; i < 6; ++i) {
      keys.push_back({time, value, i == 2 ? Ease::linear() : i == 3 ? *Ease::named("sine-in-out") : Ease::monotone()});
      if (i == 4) keys.back().ease = Ease::bezier(0.7, 0.1, 0.2, 0.9);
      time += random.between(0.1, 2);
      value += way * random.between(0.1, 3);
    }
    const Curve<double> curve = keyed_curve<double>(std::span<const Key<double>>(keys));
    const Curve<double> time_of = inverse(curve);
    for (int i = 1; i < 100; ++i) {
      const double t = curve.start() + curve.duration() * i / 100;
      const Sample<double> s = curve.sample(t), back = time_of.sample(s.value);
      if (std::abs(s.rate) < 1e-3) continue;
      CHECK(std::abs(back.value - t) <= 1e-13 * (1 + std::abs(s.value)) / std::abs(s.rate) + 1e-13 * (1 + std::abs(t)));
      CHECK(back.rate * s.rate == doctest::Approx(1).epsilon(1e-6));
    }
    CHECK(time_of.value(curve.value(curve.end())) == doctest::Approx(curve.end()));
  }
  // Rests and jumps: the first and the last time, and a time in between that is at rest.
  const Curve<double> stairs = keyed_curve<double>(
      {{0, 0, Ease::linear()}, {1, 1, Ease::linear()}, {2, 1, Ease::hold()}, {3, 4, Ease::linear()}, {4, 5}});
  const Curve<double> back = inverse(stairs);
  CHECK(back.value(1, Side::in) == 1);
  CHECK(back.value(1, Side::out) == 3);
  CHECK(back.value(2.5) == 3);
  CHECK(back.rate(2.5) == 0);
  CHECK(back.value(4.5) == doctest::Approx(3.5));
  CHECK_THROWS_AS((void)inverse(keyed_curve<double>({{0, 0}, {1, 1}, {2, 0.5}})), std::invalid_argument);
  CHECK_THROWS_AS((void)inverse(Curve<double>(2.0)), std::invalid_argument);
}

TEST_CASE("a curve's rate, integrated, and its integral, derived, are the curve") {
  test::Random random(42);
  for (int round = 0; round < 40; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random, false), area = antiderivative(curve, 1.5);
    const double from = curve.start(), to = curve.end();
    const Curve<double> speed = derivative(curve), again = derivative(area.spans().empty() ? curve : area);
    const Range r = range(curve, from, to);
    const double size = std::max({1.0, std::abs(r.low), std::abs(r.high)});
    for (int i = 0; i < 60; ++i) {
      const double a = random.between(from, to), b = random.between(from, to);
      CHECK(std::abs(integral(speed, a, b) - (curve.value(b) - curve.value(a))) <=
            1e-8 * size * (1 + std::abs(curve.rate(a))));
      CHECK(std::abs(area.value(b) - area.value(a) - integral(curve, a, b)) <= 1e-12 * size * (1 + curve.duration()));
      CHECK(std::abs(area.rate(a) - curve.value(a)) <= 1e-12 * size);
      if (!area.spans().empty()) CHECK(std::abs(again.value(a) - curve.value(a)) <= 1e-11 * size);
    }
    // Outside, where the curve holds or repeats.
    const Curve<double> loop = antiderivative(curve.with_outside(Outside::hold, Outside::repeat));
    const double later = to + 2.4 * curve.duration();
    CHECK(std::abs(loop.value(later) - integral(curve.with_outside(Outside::hold, Outside::repeat), from, later)) <=
          1e-11 * size * (1 + 4 * curve.duration()));
    CHECK(std::abs(loop.value(from - 2) + 2 * curve.value(from)) <= 1e-11 * size);
  }
}

TEST_CASE("bad times are refused by all questions") {
  const double none = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
  const Curve<double> line = keyed_curve<double>({{0, 0}, {1, 1}});
  CHECK_THROWS_AS((void)integral(line, 0, none), std::invalid_argument);
  CHECK_THROWS_AS((void)range(line, -endless, 0), std::invalid_argument);
  CHECK_THROWS_AS((void)solve(line, 1, 0, endless), std::invalid_argument);
  CHECK_THROWS_AS((void)arc_length(line, none, 0), std::invalid_argument);
  CHECK_THROWS_AS((void)trimmed(line, 0, endless), std::invalid_argument);
  CHECK_THROWS_AS((void)shifted(line, none), std::invalid_argument);
  CHECK_THROWS_AS((void)antiderivative(oscillator({})), std::invalid_argument);
  CHECK_THROWS_AS((void)extrema(oscillator({})), std::invalid_argument);
  CHECK_THROWS_AS((void)range(line.with_outside(Outside::repeat, Outside::repeat), 0, 1e9), std::invalid_argument);
}
