#include <tweenfall/curves/elementary.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/quaternion_cubic.h>

#include <stdexcept>

#include "curves/stated.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Ease tcb_of(const nlohmann::json& numbers) {
  return Ease::tcb(numbers[0], numbers[1], numbers[2]);
}

// A curve of the family rotation_curves through keys with the ease that its kind is called here.
Curve<Quat> splines_curve(const nlohmann::json& input) {
  const std::string kind = input["kind"];
  const std::vector<double> grid = input["grid"];
  std::vector<Quat> rotations;
  for (const auto& q : input["q_xyzw"]) rotations.push_back(quat(q));
  if (kind == "de_casteljau") return bezier_rotation(grid, rotations);
  const bool closed = input["closed"];
  std::vector<Key<Quat>> keys;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    Ease ease = Ease::linear();
    if (kind == "catmull_rom") ease = Ease::catmull_rom();
    if (kind == "squad") ease = Ease::squad();
    if (kind == "barry_goldman") ease = Ease::barry_goldman();
    if (kind == "kochanek_bartels") {
      // Open curves state the numbers of inner keys only; those of the ends have no effect.
      const auto& numbers = input["tcb"];
      ease = Ease::tcb(0, 0, 0);
      if (closed)
        ease = tcb_of(numbers[i % numbers.size()]);
      else if (i > 0 && i + 1 < grid.size())
        ease = tcb_of(numbers[i - 1]);
    }
    keys.push_back({grid[i], rotations[i % rotations.size()], ease});
  }
  return keyed_curve<Quat>(keys, {.ends = closed ? Ends::wrap : Ends::secant});
}

// The module's open ends are not what it documents: of the three control rotations from which "natural" is made, its
// code hands the key itself for the third (splines 0.3.3, quaternion.py, KochanekBartels.__init__: control_points[1]),
// whereas its page "end-conditions-natural" has the half way to the third control, as ours is and as the angle's own
// spline needs it. So the end span is made here with the module's control and, else, our own.
Curve<Quat> splines_end(const Curve<Quat>& curve, bool first) {
  const auto knots = curve.knots();
  const double end = first ? knots.front() : knots.back(), inner = first ? knots[1] : knots[knots.size() - 2];
  const Quat a = curve.value(end), d = curve.value(inner);
  const Vec3 rate = curve.rate(inner, first ? Side::in : Side::out);
  const Quat b = slerp(a, d, 0.5), c = exp_map((end - inner) / 3 * rate) * d;
  const std::vector<double> times = {std::min(end, inner), std::max(end, inner)};
  return bezier_rotation(times, first ? std::vector<Quat>{a, b, c, d} : std::vector<Quat>{d, c, b, a});
}

// What the module gives as angular velocity (splines 0.3.3, quaternion.py, DeCasteljau.evaluate): the turn between the
// last two rotations of the algorithm, times the degree. That is the derivative where all turns commute and at the ends
// of a span, but not between: there the two move too. Ours is the derivative, as another test holds against
// differences.
Vec3 splines_rate(const Curve<Quat>& curve, double t, Side side) {
  const auto knots = curve.knots();
  std::size_t i = 0;
  while (i + 2 < knots.size() && (side == Side::out ? knots[i + 1] <= t : knots[i + 1] < t)) ++i;
  const double start = knots[i], h = knots[i + 1] - start;
  if (t == start || t == knots[i + 1]) return curve.rate(t, side);
  const Quat a = curve.value(start), d = curve.value(knots[i + 1], Side::in);
  std::vector<Quat> row = {a, exp_map(h / 3 * curve.rate(start)) * a,
                           exp_map(-h / 3 * curve.rate(knots[i + 1], Side::in)) * d, d};
  while (row.size() > 2) {
    for (std::size_t k = 0; k + 1 < row.size(); ++k) row[k] = slerp(row[k], row[k + 1], (t - start) / h);
    row.pop_back();
  }
  return 3 / h * log_map(row[1] * row[0].conjugate());
}

// Central differences, for tests alone.
Vec3 velocity_near(const Curve<Quat>& curve, double t, double h) {
  const Quat here = curve.value(t);
  const auto turned = [&](double x) { return log_map(curve.value(x) * here.conjugate()); };
  return (8 * (turned(t + h) - turned(t - h)) - (turned(t + 2 * h) - turned(t - 2 * h))) / (12 * h);
}
Vec3 acceleration_near(const Curve<Quat>& curve, double t, double h) {
  return (8 * (curve.rate(t + h) - curve.rate(t - h)) - (curve.rate(t + 2 * h) - curve.rate(t - 2 * h))) / (12 * h);
}

const char* const eases[] = {"linear",        "nlerp",          "squad",       "catmull-rom", "tcb(0.3,-0.4,0.5)",
                             "barry-goldman", "natural",        "hold",        "smooth",      "monotone",
                             "centripetal",   "smooth-clamped", "cubic-in-out"};

Ease named(const char* word) {
  return Ease::named(word).value();
}

std::vector<Key<Quat>> random_keys(test::Random& random, std::size_t count) {
  std::vector<Key<Quat>> keys;
  double time = random.between(-2, 2);
  for (std::size_t i = 0; i < count; ++i) {
    keys.push_back({time, random.rotation()});
    time += random.between(0.3, 1.5);
  }
  return keys;
}

}  // namespace

TEST_CASE("squad, De Casteljau, Catmull-Rom, Kochanek-Bartels, Barry-Goldman and slerp agree with the splines module") {
  for (const auto& file : test::vector_family("rotation_curves")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const Curve<Quat> curve = splines_curve(c["input"]);
      const std::string kind = c["input"]["kind"];
      const bool open = (kind == "catmull_rom" || kind == "kochanek_bartels") && !c["input"]["closed"];
      const auto knots = curve.knots();
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const double t = std::min(c["t"][k].get<double>(), curve.end());
        CAPTURE(t);
        const Quat expected = quat(c["q_xyzw"][k]);
        const bool first = t<knots[1], last = t> knots[knots.size() - 2];
        const Curve<Quat> shown = open && (first || last) ? splines_end(curve, first) : curve;
        CHECK(test::near(shown.value(t), expected, tolerance));
        if (!c.contains("angular_velocity_world")) continue;
        const Vec3 rate = vec(c["angular_velocity_world"][k]);
        const Side inward = t < shown.end() ? Side::out : Side::in;
        // At a key where the slope jumps, the module gives that of the span that it finds: either is right.
        CHECK((test::near(splines_rate(shown, t, inward), rate, tolerance) ||
               test::near(splines_rate(shown, t, Side::in), rate, tolerance)));
      }
    }
  }
}

TEST_CASE("the rotation spline with continuous acceleration agrees with scipy") {
  for (const auto& file : test::vector_family("rotation_spline_c2")) {
    const double turn = test::tolerance(file), rate = test::stated(file, "tolerance", "rates"),
                 acceleration = test::stated(file, "tolerance", "accelerations");
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      const std::vector<double> times = c["input"]["times"];
      std::vector<Quat> rotations;
      for (const auto& q : c["input"]["q_xyzw"]) rotations.push_back(quat(q));
      const Curve<Quat> curve = clamped_rotation(times, rotations);
      // scipy stops after ten rounds of a slower iteration, with up to 1e-5 left of the jump in acceleration that is to
      // vanish. Rates that are off by e at both ends of a span of h seconds move the rotation by e h / 8, its
      // quaternion by half of that, so values come as near as their file's rates let them.
      double longest = 0;
      for (std::size_t i = 0; i + 1 < times.size(); ++i) {
        longest = std::max(longest, times[i + 1] - times[i]);
        if (i == 0) continue;
        const Sample<Quat> in = curve.sample(times[i], Side::in), out = curve.sample(times[i]);
        CHECK(test::near(in.acceleration, out.acceleration, 1e-11));
      }
      const double size = std::max(1.0, test::largest(c["angular_rate"]));
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const double t = c["t"][k];
        CAPTURE(t);
        const Sample<Quat> s = curve.sample(t, t < curve.end() ? Side::out : Side::in);
        const Quat back = s.value.conjugate();
        CHECK(test::near(s.value, quat(c["q_xyzw"][k]), std::max(turn, rate * size * longest / 16)));
        CHECK(test::near(Vec3(back * s.rate), vec(c["angular_rate"][k]), rate));
        CHECK(test::near(Vec3(back * s.acceleration), vec(c["angular_acceleration"][k]), acceleration));
      }
    }
  }
}

TEST_CASE("the weighted mean agrees with scipy and knows neither order nor signs") {
  for (const auto& file : test::vector_family("rotation_mean")) {
    const double tolerance = test::tolerance(file);
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      std::vector<Quat> rotations;
      for (const auto& q : c["input"]["q_xyzw"]) rotations.push_back(normalized(quat(q)));
      std::vector<double> weights = c["input"]["weights"];
      const Quat expected = quat(c["q_xyzw"]);
      CHECK(test::near(weighted_mean(rotations, weights), expected, tolerance));
      std::reverse(rotations.begin(), rotations.end());
      std::reverse(weights.begin(), weights.end());
      rotations[0].coeffs() *= -1;
      CHECK(test::near(weighted_mean(rotations, weights), expected, tolerance));
    }
  }
  const Quat one(1, 0, 0, 0);
  const auto refused = [](std::vector<Quat> rotations, std::vector<double> weights, const char* text) {
    CHECK_THROWS_WITH_AS((void)weighted_mean(rotations, weights), doctest::Contains(text), std::invalid_argument);
  };
  refused({}, {}, "at least one");
  refused({one}, {1, 2}, "2 weights and 1 rotations");
  refused({one, one}, {1, -1}, "rotation 1");
  refused({one, one}, {0, 0}, "not zero");
  refused({one, Quat(2, 0, 0, 0)}, {1, 1}, "unit length");
}

TEST_CASE("CSS rotate: turns about one axis are kept, others go the short way") {
  struct Turned {
    Vec3 axis;
    double angle;
  };
  const auto parsed = [](const std::string& text) {
    if (text == "none") return Turned{{0, 0, 1}, 0};
    std::vector<double> numbers;
    const char* at = text.c_str();
    while (numbers.size() < 4) {
      char* end = nullptr;
      const double number = std::strtod(at, &end);
      if (end == at) break;
      numbers.push_back(number);
      at = end;
    }
    Vec3 axis(0, 0, 1);
    if (numbers.size() == 4)
      axis = {numbers[0], numbers[1], numbers[2]};
    else if (*at == ' ' && at[1] != 'z')
      axis = at[1] == 'x' ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    else if (text[0] == 'x' || text[0] == 'y')
      axis = text[0] == 'x' ? Vec3(1, 0, 0) : Vec3(0, 1, 0);
    if (numbers.empty()) numbers.push_back(std::strtod(text.c_str() + 2, nullptr));
    return Turned{axis.normalized(), numbers.back() * pi / 180};
  };
  for (const auto& file : test::vector_family("css_rotate")) {
    const double tolerance = test::stated(file, "tolerance", "digits:");
    for (const auto& c : file["cases"]) {
      CAPTURE(c["name"].get<std::string>());
      Turned from = parsed(c["input"]["from"]), to = parsed(c["input"]["to"]);
      if (from.angle == 0) from.axis = to.axis;
      if (to.angle == 0) to.axis = from.axis;
      const bool one_axis = (from.axis - to.axis).norm() < 1e-9;
      const Curve<Quat> curve =
          one_axis ? axis_curve(from.axis, keyed_curve<double>({{0, from.angle, Ease::linear()}, {1, to.angle}}))
                   : keyed_curve<Quat>(
                         {{0, exp_map(from.angle * from.axis), Ease::linear()}, {1, exp_map(to.angle * to.axis)}});
      // The same turns as a key's own: the whole turns that the angle makes beyond the short way.
      const double angle = to.angle - from.angle;
      const double shorter = angle - 2 * pi * std::round(angle / (2 * pi));
      Key<Quat> first{0, exp_map(from.angle * from.axis), Ease::linear()};
      first.turn = {Turn::Way::along, static_cast<int>(std::floor(std::abs(angle) / (2 * pi))),
                    angle < 0 ? Vec3(-from.axis) : from.axis};
      CAPTURE(shorter);
      const Curve<Quat> turning = keyed_curve<Quat>({first, {1, exp_map(to.angle * to.axis)}});
      for (std::size_t k = 0; k < c["t"].size(); ++k) {
        const Turned expected = parsed(c["computed"][k]);
        const Quat rotation = exp_map(expected.angle * expected.axis);
        CHECK(test::near(curve.value(c["t"][k]), rotation, tolerance));
        if (one_axis) CHECK(test::near(turning.value(c["t"][k]), rotation, tolerance));
      }
      if (one_axis) CHECK(test::near(turning.rate(0.5), Vec3(angle * from.axis), 1e-9));
    }
  }
}

TEST_CASE("angular velocity and acceleration are the derivatives of every kind of span, kinds mixed key by key") {
  test::Random random(11);
  for (int round = 0; round < 60; ++round) {
    std::vector<Key<Quat>> keys = random_keys(random, 6);
    for (auto& key : keys) {
      key.ease = named(eases[random.bits() % std::size(eases)]);
      key.turn.whole_turns = static_cast<int>(random.bits() % 5) - 2;
      if (random.bits() % 3 == 0) key.turn.way = Turn::Way::longer;
    }
    const Ends ends[] = {Ends::secant, Ends::flat, Ends::wrap};
    const Curve<Quat> curve = keyed_curve<Quat>(keys, {.ends = ends[round % 3]});
    for (std::size_t i = 0; i + 1 < keys.size(); ++i) {
      CAPTURE(keys[i].ease.name());
      const double span = keys[i + 1].time - keys[i].time;
      for (const double u : {0.13, 0.52, 0.87}) {
        const double t = keys[i].time + u * span, h = 2e-4 * span;
        const Sample<Quat> s = curve.sample(t);
        CHECK(std::abs(s.value.norm() - 1) < 1e-14);
        CHECK(test::near(s.rate, velocity_near(curve, t, h), 1e-7));
        CHECK(test::near(s.acceleration, acceleration_near(curve, t, h), 1e-6));
      }
    }
  }
}

TEST_CASE("every kind passes its keys, and those that promise it join them with one angular velocity") {
  test::Random random(12);
  for (const char* word : eases) {
    CAPTURE(std::string(word));
    const std::string name = word;
    const bool kinked =
        name == "linear" || name == "nlerp" || name == "hold" || name.substr(0, 3) == "tcb" || name == "centripetal";
    for (int round = 0; round < 8; ++round) {
      std::vector<Key<Quat>> keys = random_keys(random, 6);
      for (auto& key : keys) {
        key.ease = named(word);
        key.turn.whole_turns = static_cast<int>(random.bits() % 3) - 1;
      }
      const Curve<Quat> curve = keyed_curve<Quat>(keys);
      for (std::size_t i = 0; i < keys.size(); ++i) {
        const double t = keys[i].time;
        CHECK(test::near(curve.value(t), keys[i].value, 1e-15));
        const double eps = 1e-9;
        if (name != "hold") CHECK(test::near(curve.value(t - eps), keys[i].value, 1e-6));
        if (i == 0 || i + 1 == keys.size() || kinked) continue;
        CHECK(test::near(curve.rate(t, Side::in), curve.rate(t, Side::out), 1e-11));
      }
    }
  }
}

TEST_CASE("natural rotations join with one angular acceleration, have none at the ends, and know whole turns") {
  test::Random random(13);
  for (int round = 0; round < 40; ++round) {
    std::vector<Key<Quat>> keys = random_keys(random, 3 + random.bits() % 6);
    for (auto& key : keys) {
      key.ease = Ease::natural();
      if (round % 2 == 1) key.turn.whole_turns = static_cast<int>(random.bits() % 3) - 1;
    }
    const bool around = round % 4 >= 2;
    if (around) keys.back().value = keys.front().value;
    const Curve<Quat> curve = keyed_curve<Quat>(keys, {.ends = around ? Ends::wrap : Ends::secant});
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const double t = keys[i].time;
      Sample<Quat> in = curve.sample(t, Side::in), out = curve.sample(t);
      if (i == 0 || i + 1 == keys.size()) {
        if (!around) {
          CHECK(test::near((i == 0 ? out : in).acceleration, Vec3(0, 0, 0), 1e-8));
          continue;
        }
        out = curve.sample(keys.front().time);
        in = curve.sample(keys.back().time, Side::in);
      }
      CHECK(test::near(in.rate, out.rate, 1e-9));
      CHECK(test::near(in.acceleration, out.acceleration, 1e-7));
    }
  }
}

TEST_CASE("about one axis, natural, catmull-rom, squad and barry-goldman are the angle's own spline") {
  const Vec3 axis = Vec3(1, -2, 0.5).normalized();
  const double times[] = {0, 0.7, 1.1, 2.4, 3}, angles[] = {0.2, 1.9, 1.1, -0.6, 0.4};
  for (const char* word : {"natural", "catmull-rom", "squad", "barry-goldman", "tcb(0.2,0.1,-0.3)", "linear"})
    for (const Ends ends : {Ends::secant, Ends::flat}) {
      CAPTURE(std::string(word));
      std::vector<Key<double>> numbers;
      std::vector<Key<Quat>> keys;
      for (std::size_t i = 0; i < 5; ++i) {
        numbers.push_back({times[i], angles[i], named(word)});
        keys.push_back({times[i], exp_map(angles[i] * axis), named(word)});
      }
      const Curve<double> angle = keyed_curve<double>(numbers, {.ends = ends});
      const Curve<Quat> turning = keyed_curve<Quat>(keys, {.ends = ends});
      for (int k = 0; k <= 30; ++k) {
        const double t = 0.1 * k;
        const Sample<double> expected = angle.sample(t);
        const Sample<Quat> s = turning.sample(t);
        CHECK(test::near(s.value, exp_map(expected.value * axis), 1e-13));
        CHECK(test::near(s.rate, Vec3(expected.rate * axis), 1e-11));
        if (k < 30) CHECK(test::near(s.acceleration, Vec3(expected.acceleration * axis), 1e-10));
      }
    }
}

TEST_CASE("nlerp is the chord scaled to unit length") {
  test::Random random(14);
  for (int n = 0; n < 20; ++n) {
    const Quat a = random.rotation(), b = random.rotation();
    const Curve<Quat> curve = keyed_curve<Quat>({{0, a, Ease::nlerp()}, {2, b}});
    for (const double u : {0.1, 0.5, 0.8}) {
      const Vec4 chord = (1 - u) * a.coeffs() + (a.dot(b) < 0 ? -u : u) * b.coeffs();
      CHECK(test::near(curve.value(2 * u), Quat(Vec4(chord.normalized())), 1e-15));
    }
  }
}

TEST_CASE("each key says the way around and the whole turns") {
  const Vec3 z(0, 0, 1);
  const auto mean_rate = [&](double angle, const Turn& turn) {
    Key<Quat> first{0, exp_map(0.3 * z), Ease::linear()};
    first.turn = turn;
    const Curve<Quat> curve = keyed_curve<Quat>({first, {1, exp_map((0.3 + angle) * z)}});
    CHECK(test::near(curve.value(1, Side::in), exp_map((0.3 + angle) * z), 1e-14));
    CHECK(curve.rate(0.4).head<2>().norm() < 1e-14);
    return curve.rate(0.4).z();
  };
  using Way = Turn::Way;
  CHECK(test::near(mean_rate(1, {}), 1, 1e-14));
  CHECK(test::near(mean_rate(1, {Way::longer}), 1 - 2 * pi, 1e-14));
  CHECK(test::near(mean_rate(1, {Way::shorter, 2}), 1 + 4 * pi, 1e-14));
  CHECK(test::near(mean_rate(1, {Way::longer, 1}), 1 - 4 * pi, 1e-14));
  CHECK(test::near(mean_rate(-1, {Way::along, 0, z}), 2 * pi - 1, 1e-14));
  CHECK(test::near(mean_rate(1, {Way::along, 0, -z}), 1 - 2 * pi, 1e-14));
  CHECK(test::near(mean_rate(1, {Way::along, 3, z}), 1 + 6 * pi, 1e-14));
  CHECK(test::near(mean_rate(0, {Way::shorter, -2, z}), -4 * pi, 1e-14));
  CHECK(test::near(std::abs(mean_rate(pi, {})), pi, 1e-14));
  CHECK(test::near(mean_rate(pi, {Way::along, 0, z}), pi, 1e-14));
  CHECK(test::near(mean_rate(pi, {Way::along, 0, -z}), -pi, 1e-14));

  Key<Quat> key{0, Quat(1, 0, 0, 0)};
  key.turn = {Way::shorter, 1};
  CHECK_THROWS_WITH_AS((void)keyed_curve<Quat>({key, {1, Quat(-1, 0, 0, 0)}}), doctest::Contains("needs an axis"),
                       std::invalid_argument);
  key.turn = {Way::along};
  CHECK_THROWS_WITH_AS((void)keyed_curve<Quat>({key, {1, Quat(0, 1, 0, 0)}}), doctest::Contains("must not be zero"),
                       std::invalid_argument);
}

TEST_CASE("given end angular velocities are met exactly, whatever the way, the turns and the weights") {
  test::Random random(15);
  for (int n = 0; n < 60; ++n) {
    Key<Quat> a{0.5, random.rotation()}, b{0.5 + random.between(0.2, 3), random.rotation()};
    const double w0 = n % 3 == 0 ? random.between(0.05, 1) : 1.0 / 3, w1 = n % 3 == 1 ? random.between(0.05, 1) : w0;
    a.out = Tangent<Quat>{Tangent<Quat>::Kind::given, random.vector(n % 5 == 0 ? 1000 : 5), w0};
    b.in = Tangent<Quat>{Tangent<Quat>::Kind::given, random.vector(5), w1};
    a.turn.whole_turns = n % 4 - 1;
    if (n % 7 == 0) a.turn.way = Turn::Way::longer;
    const Curve<Quat> curve = keyed_curve<Quat>({a, b});
    CHECK(test::near(curve.rate(a.time), a.out->rate, 1e-13));
    CHECK(test::near(curve.rate(b.time, Side::in), b.in->rate, 1e-11));
    const double t = a.time + 0.37 * curve.duration(), h = 1e-5 * curve.duration();
    CHECK(test::near(curve.rate(t), velocity_near(curve, t, h), 1e-6));
  }
}

TEST_CASE("a museum of nasty turns stays finite, of unit length and on its keys") {
  const Quat one(1, 0, 0, 0), minus(-1, 0, 0, 0), half(0, 1, 0, 0), other_half(0, 0, 1, 0);
  const Quat nearly_half(1e-12, 1, 0, 0), past_half(-1e-12, 1, 0, 0), close = exp_map({1e-9, 0, 0});
  const std::vector<std::vector<Quat>> museum = {
      {one, one, one},
      {one, minus, one, minus},
      {one, half, one, half},
      {one, half, other_half, minus},
      {one, close, one, half},
      {one, nearly_half, one},
      {nearly_half, past_half, one},
      {half, other_half},
      {Quat(1e150, 0, 1e150, 0), Quat(0, 1e-150, 0, 1e-150), one},
  };
  for (const char* word : eases)
    for (const auto& rotations : museum)
      for (const double step : {1e-9, 1.0, 1e9}) {
        CAPTURE(std::string(word));
        std::vector<Key<Quat>> keys;
        for (std::size_t i = 0; i < rotations.size(); ++i)
          keys.push_back({static_cast<double>(i) * step, rotations[i], named(word)});
        const Curve<Quat> curve = keyed_curve<Quat>(keys);
        for (const auto& key : keys) CHECK(test::near(curve.value(key.time), normalized(key.value), 1e-15));
        for (int k = -1; k <= 41; ++k) {
          const Sample<Quat> s = curve.sample(curve.start() + k * curve.duration() / 40);
          CHECK(std::abs(s.value.norm() - 1) < 1e-13);
          CHECK(s.rate.allFinite());
          CHECK(s.acceleration.allFinite());
        }
      }
}

TEST_CASE("the sign of a key's quaternion changes nothing") {
  test::Random random(16);
  for (const char* word : eases) {
    std::vector<Key<Quat>> keys = random_keys(random, 5);
    for (auto& key : keys) key.ease = named(word);
    const Curve<Quat> curve = keyed_curve<Quat>(keys);
    keys[1].value.coeffs() *= -1;
    keys[3].value.coeffs() *= -1;
    const Curve<Quat> other = keyed_curve<Quat>(keys);
    for (int k = 0; k <= 40; ++k) {
      const double t = curve.start() + k * curve.duration() / 40;
      CHECK(test::near(curve.value(t), other.value(t), 1e-14));
      CHECK(test::near(curve.rate(t), other.rate(t), 1e-11));
    }
  }
}

TEST_CASE("on numbers nlerp is linear, and squad and barry-goldman are catmull-rom") {
  const auto with = [](const char* word) {
    return keyed_curve<double>({{0, 1, named(word)}, {1, 3, named(word)}, {1.5, -1, named(word)}, {3, 2, named(word)}});
  };
  for (const auto& [word, same] :
       {std::pair{"nlerp", "linear"}, {"squad", "catmull-rom"}, {"barry-goldman", "catmull-rom"}})
    for (int k = 0; k <= 30; ++k) CHECK(with(word).sample(0.1 * k).value == with(same).sample(0.1 * k).value);
}

TEST_CASE("control rotations and times that do not fit are refused by name") {
  const Quat one(1, 0, 0, 0);
  const std::vector<double> times = {0, 1};
  const std::vector<Quat> three(3, one);
  CHECK_THROWS_WITH_AS((void)bezier_rotation(times, three), doctest::Contains("take 4 control rotations; there are 3"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bezier_rotation(times, std::vector<Quat>{one, one, Quat(0, 0, 0, 0), one}),
                       doctest::Contains("control 2"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)bezier_rotation(std::vector<double>{1, 1}, std::vector<Quat>(4, one)),
                       doctest::Contains("key 1 (time 1 s)"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)clamped_rotation(times, three), doctest::Contains("3 rotations and 2 times"),
                       std::invalid_argument);
}
