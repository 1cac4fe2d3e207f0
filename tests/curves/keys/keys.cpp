#include <tweenfall/curves/calculus.h>
#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/quaternion_cubic.h>

#include <limits>
#include <stdexcept>

#include "curves/stated.h"
#include "random.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

Tangent<double> given(double rate, double weight = 1.0 / 3) {
  return {Tangent<double>::Kind::given, rate, weight};
}

// One component of a track of three's, as a curve.
Curve<double> three_curve(const nlohmann::json& input, std::size_t component) {
  const auto& times = input["times"];
  const std::size_t stride = input["stride"];
  const std::string mode = input["mode"];
  const auto handle = [&](const char* which, std::size_t i, std::size_t part) {
    return input[which][(i * stride + component) * 2 + part].get<double>();
  };
  std::vector<Key<double>> keys;
  for (std::size_t i = 0; i < times.size(); ++i) {
    const auto& value = input["values"][i * stride + component];
    Key<double> key{times[i], value.is_boolean() ? double(value.get<bool>()) : value.get<double>()};
    if (mode == "discrete") key.ease = Ease::hold();
    if (mode == "linear") key.ease = Ease::linear();
    if (mode == "smooth") key.ease = Ease::smooth();
    if (mode == "bezier") {
      if (i > 0) {
        const double share = key.time - handle("in_handles", i, 0), span = key.time - times[i - 1].get<double>();
        key.in = given((key.value - handle("in_handles", i, 1)) / share, share / span);
      }
      if (i + 1 < times.size()) {
        const double share = handle("out_handles", i, 0) - key.time, span = times[i + 1].get<double>() - key.time;
        key.out = given((handle("out_handles", i, 1) - key.value) / share, share / span);
      }
    }
    keys.push_back(key);
  }
  const std::string ending = input.value("ending", "zero_curvature");
  // three's ZeroSlopeEnding is flat at the first key only. Its cubic has at the end of a span the slope
  // (v1 - v0) / 2 + w (v - v1) per span, with w = 1/2 there; for a flat end v must be v0, as `Ends::flat` has it, but
  // three takes v1 and arrives with half the secant. So these tracks are its numbers only with that slope given.
  // Source: three.js, src/math/interpolants/CubicInterpolant.js, intervalChanged_ (iNext = i1) and interpolate_.
  if (mode == "smooth" && ending == "zero_slope" && keys.size() > 1) {
    const Key<double>&before = keys[keys.size() - 2], &last = keys.back();
    keys.back().in = given(0.5 * (last.value - before.value) / (last.time - before.time));
  }
  return keyed_curve<double>(keys, {.ends = ending == "wrap"         ? Ends::wrap
                                            : ending == "zero_slope" ? Ends::flat
                                                                     : Ends::secant});
}

}  // namespace

TEST_CASE("tracks agree with three.js") {
  for (const auto& file : test::vector_family("three_tracks")) {
    const double tolerance = test::tolerance(file);
    const double turned = test::stated(file, "quaternion", "else"), blended = test::stated(file, "quaternion", "allow");
    for (const auto& c : file["cases"]) {
      const std::string name = c["name"];
      CAPTURE(name);
      const auto& input = c["input"];
      const auto& t = c["t"];
      if (input["kind"] == "quaternion") {
        std::vector<Key<Quat>> keys;
        for (std::size_t i = 0; i < input["times"].size(); ++i)
          keys.push_back({input["times"][i], quat(input["values"], 4 * i), Ease::linear()});
        const Curve<Quat> curve = keyed_curve<Quat>(keys);
        for (std::size_t k = 0; k < t.size(); ++k) {
          const double at = t[k];
          CAPTURE(at);
          // Between keys this close, three does not slerp.
          bool close = false;
          for (std::size_t i = 0; i + 1 < keys.size(); ++i)
            close = close || (at >= keys[i].time && at <= keys[i + 1].time &&
                              std::abs(keys[i].value.normalized().dot(keys[i + 1].value.normalized())) > 0.9995);
          CHECK(test::near(curve.value(at), quat(c["value"][k]), close ? blended : turned));
        }
        continue;
      }
      for (std::size_t component = 0; component < input["stride"].get<std::size_t>(); ++component) {
        const Curve<double> curve = three_curve(input, component);
        for (std::size_t k = 0; k < t.size(); ++k) {
          const auto& cell = c["value"][k][component];
          const double expected = cell.is_boolean() ? double(cell.get<bool>()) : cell.get<double>();
          const double at = t[k];
          // Times are float32 rounded to nine digits: at a jump either side may be meant.
          CAPTURE(at);
          CHECK((test::near(curve.value(at), expected, tolerance) ||
                 test::near(curve.value(at, Side::in), expected, tolerance)));
        }
      }
    }
  }
}

TEST_CASE("flat ends are at rest at both, unlike three's") {
  const std::vector<Key<double>> keys = {{1, 9, Ease::smooth()}, {2, 1, Ease::smooth()}, {4, 6, Ease::smooth()}};
  const Curve<double> curve = keyed_curve<double>(keys, {.ends = Ends::flat});
  CHECK(curve.rate(1) == 0);
  CHECK(std::abs(curve.rate(4, Side::in)) < 1e-14);
  CHECK(test::near(curve.rate(2), 0.5 * (-8.0 + 2.5), 1e-14));
}

TEST_CASE("one rotation span with given angular velocities agrees with scipy and meets them exactly") {
  for (const auto& file : test::vector_family("rotation_hermite")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const auto& input = c["input"];
      Key<Quat> a{0, normalized(quat(input["q0_xyzw"]))}, b{input["duration"], normalized(quat(input["q1_xyzw"]))};
      // The file's angular velocities are in the body's axes.
      a.out = Tangent<Quat>{Tangent<Quat>::Kind::given, a.value * vec(input["angular_velocity0"])};
      b.in = Tangent<Quat>{Tangent<Quat>::Kind::given, b.value * vec(input["angular_velocity1"])};
      const Curve<Quat> curve = keyed_curve<Quat>({a, b});
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const Sample<Quat> s = curve.sample(c["t"][k], k + 1 == c["t"].size() ? Side::in : Side::out);
        CHECK(test::near(s.value, quat(c["q_xyzw"][k]), tolerance));
        CHECK(test::near(Vec3(s.value.conjugate() * s.rate), vec(c["angular_rate"][k]), tolerance));
      }
      CHECK(test::near(curve.rate(0), a.out->rate, 1e-13));
      CHECK(test::near(curve.rate(b.time, Side::in), b.in->rate, 1e-12));
    }
  }
}

TEST_CASE("glTF cubic rotations agree with three.js") {
  std::size_t compared = 0;
  for (const auto& file : test::vector_family("gltf_animation"))
    for (const auto& c : file["cases"]) {
      if (c["input"]["interpolation"] != "CUBICSPLINE") continue;
      if (!c["value"].contains("rotation_xyzw")) continue;
      ++compared;
      CAPTURE(c["name"].get<std::string>());
      const std::vector<double> times = c["input"]["times"];
      const auto& flat = c["input"]["outputs"]["rotation"];
      std::vector<Vec4> parts[3];
      for (std::size_t i = 0; i < times.size(); ++i)
        for (std::size_t part = 0; part < 3; ++part) parts[part].push_back(quat(flat, 12 * i + 4 * part).coeffs());
      const Curve<Quat> curve = gltf_cubic_rotation(times, parts[0], parts[1], parts[2]);
      for (std::size_t k = 0; k < c["t"].size(); ++k)
        CHECK(test::near(curve.value(c["t"][k]), quat(c["value"]["rotation_xyzw"][k]), test::tolerance(file)));
      // Its angular velocity is that of its values.
      const double t = 0.3 * times[0] + 0.7 * times[1], h = 1e-4;
      const Quat here = curve.value(t);
      const auto turned = [&](double x) { return log_map(curve.value(x) * here.conjugate()); };
      const Vec3 stencil = (8 * (turned(t + h) - turned(t - h)) - (turned(t + 2 * h) - turned(t - 2 * h))) / (12 * h);
      CHECK(test::near(curve.rate(t), stencil, 1e-7));
    }
  CHECK(compared > 0);
}

TEST_CASE("pchip agrees with scipy") {
  for (const auto& file : test::vector_family("pchip")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const std::vector<double> x = c["input"]["x"], y = c["input"]["y"];
      std::vector<Key<double>> keys;
      for (std::size_t i = 0; i < x.size(); ++i) keys.push_back({x[i], y[i], Ease::monotone()});
      const Curve<double> curve = keyed_curve<double>(keys);
      const double size = test::largest(c["value"]);
      double shortest = x.back() - x.front();
      for (std::size_t i = 1; i < x.size(); ++i) shortest = std::min(shortest, x[i] - x[i - 1]);
      const double speed = std::max(test::largest(c["derivative"]), test::largest(c["slopes"]));
      // A straight line's second derivative is only the rounding of its slopes.
      const double bend = std::max(test::largest(c["second"]), speed / shortest);
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        CAPTURE(c["t"][k].get<double>());
        const Sample<double> s = curve.sample(c["t"][k], k + 1 == c["t"].size() ? Side::in : Side::out);
        CHECK(std::abs(s.value - c["value"][k].get<double>()) <= tolerance * size);
        CHECK(std::abs(s.rate - c["derivative"][k].get<double>()) <= tolerance * speed);
        CHECK(std::abs(s.acceleration - c["second"][k].get<double>()) <= tolerance * bend);
      }
      for (std::size_t i = 0; i < x.size(); ++i)
        CHECK(std::abs(curve.rate(x[i], i + 1 == x.size() ? Side::in : Side::out) - c["slopes"][i].get<double>()) <=
              tolerance * speed);
      const auto& part = c["integral"];
      CHECK(std::abs(integral(curve, part["a"], part["b"]) - part["value"].get<double>()) <=
            tolerance * size * (x.back() - x.front()));
    }
  }
}

TEST_CASE("Catmull-Rom, Kochanek-Bartels and natural splines agree with the splines module") {
  int checked = 0;
  for (const auto& file : test::vector_family("catmull_kb_natural")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      const auto& input = c["input"];
      CAPTURE(c["name"].get<std::string>());
      const std::string kind = input["kind"];
      const std::string end = input["end"].is_string() ? input["end"].get<std::string>() : "clamped";
      const std::vector<double> grid = input["grid"];
      // Ends with given slopes are no words of keys; splines.cpp checks them.
      if (end == "clamped") continue;
      const auto& points = input["points"];
      std::vector<Key<double>> keys;
      for (std::size_t d = 0; d < points[0].size(); ++d) {
        keys.clear();
        for (std::size_t i = 0; i < grid.size(); ++i) {
          const std::size_t p = i % points.size();
          Ease ease = kind == "natural" ? Ease::natural() : Ease::catmull_rom();
          if (kind == "kochanek_bartels") {
            ease = Ease::tcb(0, 0, 0);
            if (input.contains("tcb")) {
              const auto& tcb = input["tcb"];
              const std::size_t q = end == "closed" ? p : p == 0 ? 0 : p - 1;
              if (q < tcb.size()) ease = Ease::tcb(tcb[q][0], tcb[q][1], tcb[q][2]);
            }
          }
          keys.push_back({grid[i], points[p][d], ease});
        }
        const Curve<double> curve = keyed_curve<double>(keys, {.ends = end == "closed" ? Ends::wrap : Ends::secant});
        for (std::size_t k = 0; k < c["t"].size(); ++k) {
          const double t = c["t"][k];
          CAPTURE(t);
          // The end's derivative is that of the last span, any other key's that of the span that leaves it.
          const Sample<double> s = curve.sample(t, k + 1 == c["t"].size() ? Side::in : Side::out);
          CHECK(test::near(s.value, c["value"][k][d].get<double>(), tolerance));
          CHECK(test::near(s.rate, c["derivative"][k][d].get<double>(), tolerance));
        }
        ++checked;
      }
    }
  }
  CHECK(checked > 0);
}

TEST_CASE("weighted handles give the Bezier that scipy finds") {
  for (const auto& file : test::vector_family("time_bezier")) {
    const double tolerance = test::tolerance(file), steep = test::stated(file, "tolerance", "near a vertical tangent");
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const auto& given_keys = c["input"]["keys"];
      std::vector<Key<double>> keys;
      for (std::size_t i = 0; i < given_keys.size(); ++i) {
        const auto& g = given_keys[i];
        const double t = g["co"][0], v = g["co"][1];
        Key<double> key{t, v};
        if (i > 0) {
          const double share = t - g["handle_left"][0].get<double>();
          if (share > 0)
            key.in = given((v - g["handle_left"][1].get<double>()) / share, share / (t - keys.back().time));
        }
        if (i + 1 < given_keys.size()) {
          const double share = g["handle_right"][0].get<double>() - t;
          if (share > 0)
            key.out = given((g["handle_right"][1].get<double>() - v) / share,
                            share / (given_keys[i + 1]["co"][0].get<double>() - t));
        }
        keys.push_back(key);
      }
      // Handles of no length at both ends of a span make time and value advance alike: a straight line.
      for (std::size_t i = 0; i + 1 < keys.size(); ++i)
        if (!keys[i].out && !keys[i + 1].in) keys[i].ease = Ease::linear();
      Curve<double> curve(0);
      REQUIRE_NOTHROW(curve = keyed_curve<double>(keys));
      const double usual = test::largest(c["value"]) / (curve.end() - curve.start());
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        CAPTURE(c["t"][k].get<double>());
        const auto& rate = c["derivative"][k];
        const bool vertical = rate.is_null() || std::abs(rate.get<double>()) > 50 * usual;
        const Sample<double> s = curve.sample(c["t"][k], k + 1 == c["t"].size() ? Side::in : Side::out);
        CHECK(test::near(s.value, c["value"][k].get<double>(), vertical ? steep : tolerance));
        if (!vertical) CHECK(test::near(s.rate, rate.get<double>(), 1e-7));
      }
    }
  }
}

TEST_CASE("a museum of nasty curves stays finite and meets its keys to the bit") {
  const std::vector<std::vector<Key<double>>> museum = {
      {{3, 7}},
      {{0, 1}, {1e-9, 2}},
      {{0, 1}, {1e9, -1}, {1e9 + 1, 5}},
      {{-1e9, 1e150}, {0, -1e150}, {1e-9, 3}, {1, 3}},
      {{0, 0.1, Ease::hold()}, {0.1, 0.2, Ease::named("bezier(0,1,0,1)").value()}, {0.3, 0.7}},
      {{0, 0.1, Ease::smooth_clamped(), {}, given(1e12, 1)}, {0.3, 0.7, Ease::smooth_clamped(), given(-1e12, 1)}},
      {{0, 1, Ease::natural()}, {1, 1, Ease::natural()}, {2, 1, Ease::centripetal()}, {3, 1}},
  };
  for (const auto& keys : museum) {
    const Curve<double> curve = keyed_curve<double>(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      CHECK(curve.value(keys[i].time) == keys[i].value);
      if (i > 0 && keys[i - 1].ease.rule() != Ease::Rule::hold)
        CHECK(curve.value(keys[i].time, Side::in) == keys[i].value);
    }
    for (int k = -5; k <= 105; ++k) {
      const Sample<double> s = curve.sample(curve.start() + k * 0.01 * (curve.duration() + 1e-3));
      CHECK(std::isfinite(s.value));
      CHECK(std::isfinite(s.rate));
    }
  }
}

TEST_CASE("smooth-clamped never leaves the two values of a span") {
  test::Random random(5);
  for (int n = 0; n < 50; ++n) {
    std::vector<Key<double>> keys;
    for (int i = 0; i < 6; ++i) keys.push_back({i + random.between(0, 0.9), random.between(-5, 5)});
    const Curve<double> curve = keyed_curve<double>(keys);
    for (std::size_t i = 0; i + 1 < keys.size(); ++i)
      for (int k = 0; k <= 20; ++k) {
        const double v = curve.value(keys[i].time + k / 20.0 * (keys[i + 1].time - keys[i].time));
        CHECK(v >= std::min(keys[i].value, keys[i + 1].value) - 1e-12);
        CHECK(v <= std::max(keys[i].value, keys[i + 1].value) + 1e-12);
      }
  }
}

TEST_CASE("ratios pass the geometric mean half way") {
  const Curve<double> c = keyed_curve<double>({{0, 1, Ease::linear()}, {1, 4}}, {.logarithmic = true});
  CHECK(c.value(0.5) == doctest::Approx(2).epsilon(1e-15));
  CHECK(c.rate(0.5) == doctest::Approx(2 * std::log(4.0)).epsilon(1e-14));
  CHECK(c.value(1) == 4);
  CHECK_THROWS_WITH_AS(static_cast<void>(keyed_curve<double>({{0, 1}, {1, -2}}, {.logarithmic = true})),
                       doctest::Contains("key 1 (time 1 s, value -2)"), std::invalid_argument);
}

TEST_CASE("the long way around turns the other way by the rest of a turn") {
  const Curve<Quat> c =
      keyed_curve<Quat>({{0, exp_map({0, 0, 0}), Ease::linear()}, {1, exp_map({0, 0, 1})}}, {.long_way = true});
  CHECK(test::near(c.rate(0.5), Vec3(0, 0, 1 - 2 * std::acos(-1.0)), 1e-14));
  CHECK(test::near(c.value(1), exp_map({0, 0, 1}), 1e-15));
}

TEST_CASE("a curve is to the bit its own spans, however it keeps them") {
  test::Random random(11);
  for (int n = 0; n < 60; ++n) {
    CAPTURE(n);
    std::vector<Key<Vec3>> keys;
    double time = -3;
    for (int i = 0; i < 12; ++i, time += 0.01 + random.unit())
      keys.push_back({.time = time, .value = random.vector(4)});
    for (Key<Vec3>& key : keys)
      key.ease = n % 3 == 0 ? Ease::smooth() : n % 3 == 1 ? Ease::natural() : Ease::tcb(0.2, 0, 0.1);
    // With all of them the curve goes on smoothly at every key; these do not.
    if (n % 4 == 1) keys[5].ease = Ease::linear();
    if (n % 4 == 2) keys[5].ease = Key<Vec3>{}.ease;
    if (n % 4 == 2) keys[5].out = Tangent<Vec3>{Tangent<Vec3>::Kind::given, {1, 2, 3}, 1.0 / 3};
    if (n % 4 == 3) keys[5].value_in = Vec3(1, 2, 3);
    const Curve<Vec3> curve = keyed_curve<Vec3>(keys);
    const std::vector<Span<Vec3>> spans = curve.spans();
    const Curve<Vec3> of_spans{std::span<const Span<Vec3>>(spans)};
    for (int i = 0; i <= 400; ++i) {
      const double at =
          i < 12 ? keys[static_cast<std::size_t>(i)].time : curve.start() + curve.duration() * random.unit();
      for (const Side side : {Side::in, Side::out}) {
        const Sample<Vec3> one = curve.sample(at, side), two = of_spans.sample(at, side);
        REQUIRE(one.value == two.value);
        REQUIRE(one.rate == two.rate);
        REQUIRE(one.acceleration == two.acceleration);
        for (const int order : {1, 2, 3})
          REQUIRE(derivative_at(curve, order, at, side) == derivative_at(of_spans, order, at, side));
      }
    }
  }
}

TEST_CASE("keys that cannot be a curve are refused with index, time and value") {
  const auto refused = [](std::initializer_list<Key<double>> keys, const char* text) {
    CHECK_THROWS_WITH_AS(static_cast<void>(keyed_curve<double>(keys)), doctest::Contains(text), std::invalid_argument);
  };
  refused({}, "at least one key");
  refused({{0, 1}, {0, 2}}, "key 1 (time 0 s, value 2) must come after the key before it, at 0 s");
  refused({{0, 1}, {-1, 2}}, "key 1 (time -1 s");
  refused({{0, not_a_number}}, "key 0");
  refused({{0, -1e308, Ease::linear()}, {1, 1e308}},
          "key 1 (time 1 s, value 1e+308) is too far from the key before it, at -1e+308, for a number to hold the "
          "difference");
  CHECK_NOTHROW(static_cast<void>(keyed_curve<double>({{0, -1e308, Ease::hold()}, {1, 1e308}})));
  refused({{not_a_number, 1}}, "finite time");
  refused({{0, 1, Ease::linear(), {}, given(1)}, {1, 2}}, "one of them decides");
  refused({{0, 1, Ease::smooth_clamped(), {}, given(1, -0.5)}, {1, 2}}, "weight -0.5");
  refused({{0, 1, Ease::smooth_clamped(), {}, given(1, 0)}, {1, 2}}, "weight 0");
  CHECK_THROWS_WITH_AS(static_cast<void>(keyed_curve<Quat>({{0, Quat(0, 0, 0, 0)}})), doctest::Contains("key 0"),
                       std::invalid_argument);
}

TEST_CASE("every automatic tangent joins smoothly over a loop, per component") {
  for (const TangentKind kind : {TangentKind::automatic, TangentKind::plateau, TangentKind::auto_clamped,
                                 TangentKind::auto_chord, TangentKind::auto_mix, TangentKind::auto_ease}) {
    CAPTURE(static_cast<int>(kind));
    std::vector<Key<Vec2>> keys = {{0, {1, 0}}, {1, {2, -1}}, {2.5, {4, 1}}, {3, {0, 3}}, {4, {1, 0}}};
    for (auto& key : keys) key.in = key.out = Tangent<Vec2>{kind, Vec2::Zero()};
    const Curve<Vec2> curve =
        keyed_curve<Vec2>(keys, {.ends = Ends::wrap}).with_outside(Outside::repeat, Outside::repeat);
    CHECK(test::near(curve.rate(4, Side::in), curve.rate(4), 1e-13));
    CHECK(std::abs(curve.rate(4)[0]) > 0.1);
    // The second component turns there.
    if (kind != TangentKind::automatic) CHECK(curve.rate(1)[1] == 0);
  }
}

TEST_CASE("tangents are aligned, mirrored and straight as they say") {
  using K = TangentKind;
  const auto tangent = [](K kind, double rate = 0, double weight = 1.0 / 3) {
    return Tangent<double>{kind, rate, weight};
  };
  std::vector<Key<double>> keys = {{0, 0}, {1, 2}, {3, 3}, {4, 9}};
  keys[1].in = tangent(K::aligned, 0, 0.5);
  keys[1].out = tangent(K::given, 7);
  keys[2].in = tangent(K::vector);
  keys[2].out = tangent(K::mirrored);
  keys[3].in = tangent(K::flat);
  const Curve<double> c = keyed_curve<double>(keys);
  CHECK(c.rate(1, Side::in) == doctest::Approx(7));
  CHECK(c.rate(1) == doctest::Approx(7));
  CHECK(c.rate(3, Side::in) == doctest::Approx(0.5));
  CHECK(c.rate(3) == doctest::Approx(0.5));
  CHECK(c.rate(4, Side::in) == doctest::Approx(0));
  // Mirrored: as long as the third of two seconds, in a span of one second, and so the same as stated.
  std::vector<Key<double>> stated = keys;
  stated[2].out = tangent(K::given, 0.5, 2.0 / 3);
  const Curve<double> d = keyed_curve<double>(stated);
  for (const double t : {3.2, 3.5, 3.9}) CHECK(c.value(t) == doctest::Approx(d.value(t)).epsilon(1e-14));
  // Beside a side without a given slope, aligned means that side's slope.
  const Curve<double> beside_line =
      keyed_curve<double>({{0, 0, Ease::linear()}, {1, 2, Ease::smooth_clamped(), {}, tangent(K::aligned)}, {3, 3}});
  CHECK(beside_line.rate(1) == doctest::Approx(2));
  keys[1].out = tangent(K::mirrored);
  CHECK_THROWS_WITH_AS(
      (void)keyed_curve<double>(keys),
      doctest::Contains("key 1 (time 1 s, value 2) has two tangents that each take the slope of the other"),
      std::invalid_argument);
  Key<Quat> turned{0, exp_map({0, 0, 0})};
  turned.out = Tangent<Quat>{K::plateau, Vec3::Zero()};
  CHECK_THROWS_WITH_AS((void)keyed_curve<Quat>({turned, {1, exp_map({0, 0, 1})}}),
                       doctest::Contains("rotations do not take"), std::invalid_argument);
}

TEST_CASE("weights beyond the span are shortened only where time would run backwards") {
  const auto curve = [](double first, double second, Overlong rule) {
    Key<double> a{0, 0}, b{1, 1};
    a.out = given(2, first);
    b.in = given(0.5, second);
    return keyed_curve<double>({a, b}, {.overlong = rule});
  };
  const auto same = [](const Curve<double>& a, const Curve<double>& b) {
    for (const double t : {0.1, 0.4, 0.5, 0.8})
      if (std::abs(a.value(t) - b.value(t)) > 1e-12) return false;
    return true;
  };
  CHECK_FALSE(same(curve(1.2, 0.4, Overlong::keep_ratio), curve(1, 0.4, Overlong::keep_ratio)));
  CHECK(same(curve(1.2, 0.4, Overlong::contain), curve(1, 0.4, Overlong::keep_ratio)));
  CHECK(same(curve(3, 3, Overlong::keep_ratio), curve(1, 1, Overlong::keep_ratio)));
  CHECK(same(curve(3, 3, Overlong::keep_start), curve(4.0 / 3, 1.0 / 3, Overlong::keep_ratio)));
  // The slopes stay.
  CHECK(curve(3, 3, Overlong::keep_start).rate(0) == doctest::Approx(2));
  CHECK(curve(3, 3, Overlong::keep_start).rate(1, Side::in) == doctest::Approx(0.5));
}
