#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/keys.h>

#include "support.h"

using namespace tweenfall;

TEST_CASE("Hermite curves agree with scipy in value, rates, integral, extremes and levels") {
  for (const auto& file : test::vector_family("hermite_cubic"))
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const std::vector<double> x = c["input"]["x"], y = c["input"]["y"], m = c["input"]["slopes"], t = c["t"];
      std::vector<Key<double>> keys;
      for (std::size_t i = 0; i < x.size(); ++i) {
        const Tangent<double> slope{Tangent<double>::Kind::given, m[i]};
        keys.push_back({x[i], y[i], Ease::smooth_clamped(), slope, slope});
      }
      const Curve<double> curve = keyed_curve<double>(keys);
      const double whole = x.back() - x.front();
      const auto largest = [](const nlohmann::json& list) {
        double top = 1e-300;
        for (const double v : list) top = std::max(top, std::abs(v));
        return top;
      };
      const double value_size = largest(c["value"]), rate_size = largest(c["derivative"]);
      for (std::size_t k = 0; k < t.size(); ++k) {
        const Sample<double> s = curve.sample(t[k], k + 1 == t.size() ? Side::in : Side::out);
        CHECK(std::abs(s.value - c["value"][k].get<double>()) <= 1e-10 * value_size);
        CHECK(std::abs(s.rate - c["derivative"][k].get<double>()) <= 1e-10 * rate_size);
        CHECK(std::abs(integral(curve, x.front(), t[k]) - c["antiderivative_from_first"][k].get<double>()) <=
              1e-10 * value_size * whole);
      }
      CHECK(std::abs(integral(curve, c["integral"]["a"], c["integral"]["b"]) - c["integral"]["value"].get<double>()) <=
            1e-10 * value_size * whole);
      const Range r = range(curve, x.front(), x.back());
      CHECK(std::abs(r.low - c["min"].get<double>()) <= 1e-10 * value_size);
      CHECK(std::abs(r.high - c["max"].get<double>()) <= 1e-10 * value_size);
      const auto same_times = [&](const std::vector<double>& ours, const nlohmann::json& theirs) {
        if (!theirs.is_array()) return;
        for (const double time : theirs) {
          bool found = false;
          for (const double ours_time : ours) found = found || std::abs(ours_time - time) <= 1e-7 * whole;
          CHECK_MESSAGE(found, "no time near " << time);
        }
        CHECK(ours.size() == theirs.size());
      };
      if (r.high > r.low) {
        same_times(solve(curve, c["solve"]["level"], x.front(), x.back()), c["solve"]["t"]);
        // Theirs also has times at which the rate only touches zero; ours are those at which it changes sign.
        for (const double ours : extrema(curve)) {
          bool found = false;
          for (const double theirs : c["extrema_t"]) found = found || std::abs(ours - theirs) <= 1e-7 * whole;
          CHECK_MESSAGE(found, "an extreme of ours at " << ours);
        }
      }
    }
}

TEST_CASE("integrals and levels go on outside the knots as the curve does") {
  const Curve<double> line = keyed_curve<double>({{0, 0, Ease::linear()}, {1, 2}});
  CHECK(integral(line, -1, 3) == doctest::Approx(1 + 4));
  CHECK(integral(line, 3, -1) == doctest::Approx(-5));
  const Curve<double> straight = line.with_outside(Outside::linear, Outside::linear);
  CHECK(integral(straight, -1, 3) == doctest::Approx(9 - 1));
  CHECK(solve(straight, 5, -1, 3) == std::vector<double>{2.5});
  const Curve<double> again = line.with_outside(Outside::repeat, Outside::repeat);
  CHECK(integral(again, 0, 10.5) == doctest::Approx(10.25));
  CHECK(solve(again, 1, 0, 3).size() == 3);
  const Curve<double> back = line.with_outside(Outside::pingpong, Outside::pingpong);
  CHECK(integral(back, 0, 1.5) == doctest::Approx(1.75));
}

TEST_CASE("a curve that rests on the level gives the two ends of the rest") {
  const Curve<double> c = keyed_curve<double>(
      {{0, 0, Ease::linear()}, {1, 2, Ease::linear()}, {2, 2, Ease::linear()}, {3, 2, Ease::linear()}, {4, 0}});
  CHECK(solve(c, 2, 0, 4) == std::vector<double>{1, 3});
  CHECK(range(c, 0.5, 4).low == 0);
  CHECK(range(c, 0.5, 3).low == 1);
}
