#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/fitting.h>

#include "curves/museum.h"

using namespace tweenfall;

namespace {

template <class T>
Curve<T> built(const std::vector<Key<T>>& keys, const KeyOptions& options = {}) {
  return keyed_curve<T>(std::span<const Key<T>>(keys), options);
}

double angle_apart(const Quat& a, const Quat& b) {
  return 2 *
         std::asin(std::min(1.0, 0.5 * std::min((a.coeffs() - b.coeffs()).norm(), (a.coeffs() + b.coeffs()).norm()))) *
         (1 + 1e-12);
}

}  // namespace

TEST_CASE("fitted keys stay within their error at all times, for curves of all kinds") {
  test::Random random(31);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    const Curve<double> curve = test::random_curve(random);
    for (const double error : {1.0, 0.1, 1e-3, 1e-6}) {
      CAPTURE(error);
      for (const FitSlopes slopes : {FitSlopes::own, FitSlopes::least_squares}) {
        const std::vector<Key<double>> keys = fit(curve, error, {.slopes = slopes});
        CHECK(keys.front().time == curve.start());
        CHECK(keys.back().time == curve.end());
        CHECK(test::seen_apart(curve, built(keys), curve.start(), curve.end()) <= error * (1 + 1e-9));
      }
      const Curve<double> straight = built(fit_linear(curve, error));
      CHECK(test::seen_apart(curve, straight, curve.start(), curve.end()) <= error * (1 + 1e-9));
      if (error < 1e-2) break;  // many straight keys take long
    }
  }
}

TEST_CASE("a fit takes about as many keys as theory says it must") {
  // Cubics through value and slope are off by h^4 max|y''''| / 384 at most, so a sine over one turn with the error e
  // takes at least 2 pi (1 / (384 e))^(1/4) times the mean of |sin|^(1/4) spans.
  constexpr double turn = 0x1.921fb54442d18p+2;
  const Curve<double> sine(
      [](double t, Side) {
        const elementary::SinCos s = elementary::sin_cos(t);
        return Sample<double>{s.sin, s.cos, -s.sin};
      },
      0, turn);
  for (const double error : {1e-3, 1e-5, 1e-7}) {
    double mean = 0;
    for (int i = 0; i < 1000; ++i) mean += std::pow(std::abs(std::sin((i + 0.5) * turn / 1000)), 0.25) / 1000;
    const double least = turn * std::pow(1 / (384 * error), 0.25) * mean;
    const auto spans = static_cast<double>(fit(sine, error).size() - 1);
    CHECK(spans >= least - 1);
    CHECK(spans <= 1.2 * least + 2);
    const auto suited = static_cast<double>(fit(sine, error, {.slopes = FitSlopes::least_squares}).size() - 1);
    CHECK(suited <= spans);
  }
  // A polyline needs sqrt(|y''| / (8 e)) lines per unit of time, and allowing half the height both ways does
  // not help.
  CHECK(fit_linear(sine, 1e-4).size() <= 1.2 * turn * 0.763 / std::sqrt(8e-4) + 2);
}

TEST_CASE("fitting a curve of cubic keys finds those keys again") {
  const std::vector<Key<double>> keys = {{0, 0, Ease::catmull_rom()},
                                         {1, 3, Ease::catmull_rom()},
                                         {2.5, -1, Ease::catmull_rom()},
                                         {3, 0, Ease::catmull_rom()},
                                         {5, 2, Ease::hold()},
                                         {6, 4, Ease::linear()},
                                         {8, 0}};
  const std::vector<Key<double>> found = fit(built(keys), 1e-9);
  REQUIRE(found.size() == keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    CHECK(found[i].time == doctest::Approx(keys[i].time).epsilon(1e-3));
    CHECK(found[i].value == doctest::Approx(keys[i].value).epsilon(1e-3));
  }
  CHECK(found[4].ease == Ease::linear());
  CHECK(found[5].value_in == 2.0);
  CHECK(found[5].ease == Ease::linear());
  CHECK(found[0].out.has_value());
}

TEST_CASE("samples are fitted by few keys that pass each of them within the error") {
  test::Random random(33);
  std::vector<double> times, values;
  for (int i = 0; i <= 600; ++i) {
    times.push_back(i / 60.0);
    values.push_back(std::sin(times.back()) + 0.3 * std::cos(2.7 * times.back()));
  }
  const double error = 1e-3;
  const std::vector<Key<double>> keys = fit_samples<double>(times, values, error);
  CHECK(keys.size() < 40);
  const Curve<double> curve = built(keys);
  for (std::size_t i = 0; i < times.size(); ++i) CHECK(std::abs(curve.value(times[i]) - values[i]) <= error);
  // With noise, least-squares slopes are much better than those of the noise.
  for (double& v : values) v += random.between(-0.01, 0.01);
  const std::vector<Key<double>> own = fit_samples<double>(times, values, 0.03);
  const std::vector<Key<double>> suited =
      fit_samples<double>(times, values, 0.03, {.slopes = FitSlopes::least_squares});
  CHECK(suited.size() < own.size());
  const Curve<double> smooth = built(suited);
  for (std::size_t i = 0; i < times.size(); ++i) CHECK(std::abs(smooth.value(times[i]) - values[i]) <= 0.03);
  CHECK_THROWS_AS((void)fit_samples<double>(std::vector<double>{0, 1}, std::vector<double>{1}, 1),
                  std::invalid_argument);
  CHECK_THROWS_AS((void)fit_samples<double>(std::vector<double>{0, 0}, std::vector<double>{1, 2}, 1),
                  std::invalid_argument);
}

TEST_CASE("reduced keys are some of the given ones and never farther off than the error") {
  test::Random random(34);
  for (int round = 0; round < 60; ++round) {
    CAPTURE(round);
    std::vector<Key<double>> keys;
    const char* words[] = {"hold", "linear", "smooth", "natural", "quad-in-out", "elastic-out", "bezier(0.4,0,0.2,1)"};
    for (int i = 0; i < 40; ++i) {
      Key<double> key{0.1 * i + random.between(0, 0.05), std::sin(0.1 * i) + random.between(-0.02, 0.02),
                      Ease::smooth()};
      if (random.unit() < 0.1) key.ease = *Ease::named(words[static_cast<int>(random.between(0, 7))]);
      if (random.unit() < 0.02) key.value += 1;
      keys.push_back(key);
    }
    const Curve<double> curve = built(keys);
    std::size_t before = keys.size() + 1;
    for (const double error : {1e-6, 0.03, 0.3}) {
      const std::vector<Key<double>> fewer = reduce<double>(keys, error);
      CHECK(test::seen_apart(curve, built(fewer), curve.start(), curve.end()) <= error * (1 + 1e-9));
      for (const Key<double>& key : fewer)
        CHECK(std::ranges::any_of(keys,
                                  [&](const Key<double>& k) { return k.time == key.time && k.value == key.value; }));
      CHECK(fewer.size() <= before);
      before = fewer.size();
    }
    CHECK(before < keys.size());
  }
  // Keys on a line and keys that only repeat are removed entirely.
  const std::vector<Key<double>> line = {{0, 0, Ease::linear()}, {1, 1, Ease::linear()}, {2, 2, Ease::linear()},
                                         {3, 3, Ease::smooth()}, {4, 3, Ease::smooth()}, {5, 3}};
  CHECK(reduce<double>(line, 1e-9).size() <= 4);
}

TEST_CASE("vectors, colors, ratios and rotations are fitted and reduced within their error as well") {
  test::Random random(35);
  std::vector<Key<Vec3>> path;
  std::vector<Key<Quat>> turns;
  std::vector<Key<Color>> colors;
  for (int i = 0; i < 24; ++i) {
    const double t = 0.25 * i;
    path.push_back({t, Vec3(std::sin(t), std::cos(t), t), Ease::natural()});
    turns.push_back({t, exp_map(Vec3(std::sin(t), 0.3 * t, 0.2)), Ease::smooth()});
    colors.push_back({t, Color{{0.5 + 0.4 * std::sin(t), 0.5, 0.5 + 0.3 * std::cos(t), 0.7 + 0.2 * std::sin(2 * t)}},
                      Ease::smooth()});
  }
  const double error = 1e-2;
  const Curve<Vec3> way = built(path);
  const Curve<Quat> turn = built(turns);
  const Curve<Color> color = built(colors);
  const std::vector<Key<Vec3>> path_keys = fit(way, error), path_fewer = reduce<Vec3>(path, error);
  const std::vector<Key<Quat>> turn_keys = fit(turn, error), turn_fewer = reduce<Quat>(turns, error);
  const std::vector<Key<Quat>> turn_straight = fit_linear(turn, error);
  const std::vector<Key<Color>> color_keys = fit(color, error), color_fewer = reduce<Color>(colors, error);
  CHECK(path_keys.size() < path.size());
  CHECK(path_fewer.size() < path.size());
  CHECK(turn_keys.size() < turns.size());
  CHECK(turn_fewer.size() < turns.size());
  CHECK(color_keys.size() < colors.size());
  CHECK(color_fewer.size() < colors.size());
  for (double t = 0; t <= 5.75; t += 0.003) {
    CHECK((built(path_keys).value(t) - way.value(t)).norm() <= error);
    CHECK((built(path_fewer).value(t) - way.value(t)).norm() <= error);
    CHECK(angle_apart(built(turn_keys).value(t), turn.value(t)) <= error);
    CHECK(angle_apart(built(turn_fewer).value(t), turn.value(t)) <= error);
    CHECK(angle_apart(built(turn_straight).value(t), turn.value(t)) <= error);
    CHECK((built(color_keys).value(t).rgba - color.value(t).rgba).norm() <= error);
    CHECK((built(color_fewer).value(t).rgba - color.value(t).rgba).norm() <= error);
  }
  KeyOptions ratio;
  ratio.logarithmic = true;
  const Curve<double> growth = keyed_curve<double>({{0, 1}, {1, 10}, {2, 1000}}, ratio);
  const std::vector<Key<double>> plain = fit(growth, 0.1), by_ratio = fit(growth, 0.1, {.keys = ratio});
  CHECK(by_ratio.size() == 3);
  CHECK(test::seen_apart(growth, built(plain), 0, 2) <= 0.1);
  CHECK(test::seen_apart(growth, built(by_ratio, ratio), 0, 2) <= 0.1);
}

TEST_CASE("an error that cannot be is refused") {
  const Curve<double> line = keyed_curve<double>({{0, 0}, {1, 1}});
  CHECK_THROWS_AS((void)fit(line, 0), std::invalid_argument);
  CHECK_THROWS_AS((void)fit(line, -1), std::invalid_argument);
  CHECK_THROWS_AS((void)fit(line, 1e-30), std::invalid_argument);
  CHECK_THROWS_AS((void)fit(oscillator({}), 0.1), std::invalid_argument);
  CHECK_THROWS_AS((void)reduce<double>(std::vector<Key<double>>{{0, 0}, {1, 1}, {2, 5}}, 0), std::invalid_argument);
}
