#include <tweenfall/curves/arc_length.h>
#include <tweenfall/curves/keys.h>

#include "curves/stated.h"

using namespace tweenfall;

namespace {

template <class V>
V vector_of(const nlohmann::json& list) {
  V result = V::Zero();
  for (int i = 0; i < V::RowsAtCompileTime; ++i) result[i] = list[static_cast<std::size_t>(i)];
  return result;
}

template <class V>
void check_case(const nlohmann::json& c, double lengths, double times) {
  const auto& in = c["input"];
  std::vector<Key<V>> keys;
  for (std::size_t i = 0; i < in["x"].size(); ++i) {
    const Tangent<V> slope{Tangent<V>::Kind::given, vector_of<V>(in["tangents"][i])};
    keys.push_back({in["x"][i], vector_of<V>(in["points"][i]), Ease::smooth_clamped(), slope, slope});
  }
  const Curve<V> path = keyed_curve<V>(std::span<const Key<V>>(keys));
  const double total = c["total"];
  for (std::size_t i = 0; i + 1 < keys.size(); ++i)
    CHECK(std::abs(arc_length(path, keys[i].time, keys[i + 1].time) - c["segment_lengths"][i].get<double>()) <=
          lengths * total);
  const MeasuredPath<V> measured(path);
  CHECK(std::abs(measured.length() - total) <= lengths * total);
  const Curve<V> even = at_even_speed(path, 10, 2);
  for (std::size_t k = 0; k < c["fraction"].size(); ++k) {
    const double fraction = c["fraction"][k];
    const V point = vector_of<V>(c["value"][k]);
    const double size = std::max(1.0, point.cwiseAbs().maxCoeff());
    CHECK(std::abs(measured.time_at(fraction * measured.length()) - c["t"][k].get<double>()) <= times);
    CHECK(std::abs(measured.length_at(c["t"][k]) - fraction * total) <= 1e-6 * total);
    CHECK((measured.sample_at(fraction * measured.length()).value - point).norm() <= times * size);
    const Sample<V> s = even.sample(10 + 2 * fraction, Side::in);
    CHECK((s.value - point).norm() <= times * size);
    if (fraction > 0) CHECK(s.rate.norm() == doctest::Approx(total / 2));
  }
}

}  // namespace

TEST_CASE("lengths, and the time and point at a share of the length, agree with scipy's quadrature") {
  for (const auto& file : test::vector_family("arc_length")) {
    const double lengths = test::stated(file, "tolerance", "lengths"), times = test::stated(file, "tolerance", "t ");
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      if (c["input"]["points"][0].size() == 2)
        check_case<Vec2>(c, lengths, times);
      else
        check_case<Vec3>(c, lengths, times);
    }
  }
}

TEST_CASE("the rates of a path at even speed are its derivatives: constant speed, acceleration across the path") {
  test::Random random(7);
  std::vector<Key<Vec3>> keys;
  for (int i = 0; i < 6; ++i) keys.push_back({i + 0.5 * random.unit(), random.vector(3), Ease::catmull_rom()});
  const Curve<Vec3> even = at_even_speed(keyed_curve<Vec3>(std::span<const Key<Vec3>>(keys)), 0, 4);
  for (double t = 0.05; t < 4; t += 0.1) {
    const Sample<Vec3> s = even.sample(t);
    const double h = 1e-5;
    CHECK((s.rate - (even.value(t + h) - even.value(t - h)) / (2 * h)).norm() <= 1e-6 * s.rate.norm());
    // A difference across one of the knots, where the curvature jumps, says nothing.
    const Vec3 before = even.sample(t - h).acceleration, after = even.sample(t + h).acceleration;
    if ((after - before).norm() > 1e-2 * (1 + s.acceleration.norm())) continue;
    CHECK((s.acceleration - (even.rate(t + h) - even.rate(t - h)) / (2 * h)).norm() <=
          1e-4 * (1 + s.acceleration.norm()));
    CHECK(std::abs(s.acceleration.dot(s.rate)) <= 1e-9 * (1 + s.acceleration.norm()) * s.rate.norm());
  }
}

TEST_CASE("a path's length does not depend on its timing, and turning back counts") {
  const Vec2 a{0, 0}, b{3, 4};
  const auto line = [&](const Ease& ease) { return keyed_curve<Vec2>({{1, a, ease}, {2, b}}); };
  CHECK(arc_length(line(Ease::linear()), 1, 2) == doctest::Approx(5).epsilon(1e-14));
  CHECK(arc_length(line(Ease::bezier(0.9, 0, 0.1, 1)), 1, 2) == doctest::Approx(5).epsilon(1e-13));
  CHECK(arc_length(line(*Ease::named("sine-in-out")), 1, 2) == doctest::Approx(5).epsilon(1e-12));
  CHECK(arc_length(line(Ease::linear()), 2, 1) == doctest::Approx(-5).epsilon(1e-14));
  // u^2 ((c + 1) u - c) falls to -4 c^3 / (27 (c + 1)^2) first.
  const double c = 1.70158, dip = 4 * c * c * c / (27 * (c + 1) * (c + 1));
  CHECK(arc_length(line(*Ease::named("back-in")), 1, 2) == doctest::Approx(5 * (1 + 2 * dip)).epsilon(1e-12));
  // A cusp: (s^3, s^2) from -1 to 1 is 2 (13 sqrt 13 - 8) / 27 long.
  Span<Vec2> cusp{};
  cusp.start = 0;
  cusp.duration = 2;
  cusp.degree = 3;
  cusp.coefficients = {Vec2(-1, 1), Vec2(6, -4), Vec2(-12, 4), Vec2(8, 0), a, a};
  cusp.end = {1, 1};
  const Curve<Vec2> path{std::span<const Span<Vec2>>(&cusp, 1)};
  CHECK(arc_length(path, 0, 2) == doctest::Approx(2 * (13 * std::sqrt(13.0) - 8) / 27).epsilon(1e-12));
  const Curve<Vec2> even = at_even_speed(path, 0, 1);
  CHECK(even.value(0.5).norm() < 1e-7);
  CHECK(even.rate(0.5).allFinite());
  CHECK(even.value(1, Side::in) == Vec2(1, 1));
}

TEST_CASE("a straight walk by loops is as long as its plays, and a point has no length") {
  const Curve<double> back_and_forth =
      keyed_curve<double>({{0, 0, Ease::linear()}, {1, 2}}).with_outside(Outside::pingpong, Outside::pingpong);
  CHECK(arc_length(back_and_forth, -3, 4.5) == doctest::Approx(15).epsilon(1e-14));
  CHECK(arc_length(Curve<Vec3>(Vec3(1, 2, 3)), 0, 1) == 0);
  CHECK_THROWS_AS((void)at_even_speed(back_and_forth, 0, 0), std::invalid_argument);
  CHECK_THROWS_AS((void)arc_length(back_and_forth, 0, 1e9), std::invalid_argument);
}
