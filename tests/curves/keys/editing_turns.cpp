#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/quaternion_cubic.h>

#include "support.h"

using namespace tweenfall;

namespace {

struct Turning {
  std::string name;
  Curve<Quat> curve;
};

std::vector<double> times() {
  return {0.5, 1, 2.25, 3};
}
std::vector<Quat> rotations() {
  return {exp_map(Vec3(0.2, -0.1, 0.4)), exp_map(Vec3(0.9, 1.1, -0.3)), exp_map(Vec3(-0.7, 1.4, 0.8)),
          exp_map(Vec3(-1, 0.2, 1.3))};
}

// Every kind of key, each with the short way and with whole turns, and the curves that are not made from keys.
std::vector<Turning> all_turnings() {
  std::vector<Turning> result;
  std::vector<std::string> words = Ease::names();
  words.insert(words.end(), {"tcb(0.3,-0.2,0.5)", "bezier(0.7,0,0.2,1)", "steps(3,jump-end)"});
  for (const std::string& word : words) {
    const std::optional<Ease> ease = Ease::named(word);
    if (!ease || word == "periodic") continue;  // periodic keys end as they begin
    for (const int turns : {0, 1}) {
      std::vector<Key<Quat>> keys;
      for (std::size_t i = 0; i < 4; ++i) {
        keys.push_back({times()[i], rotations()[i], *ease});
        keys.back().turn.whole_turns = i == 1 ? turns : 0;
      }
      result.push_back({word + (turns != 0 ? " with a whole turn" : ""), keyed_curve<Quat>(keys)});
    }
  }
  for (const double weight : {1.0 / 3, 0.6})
    for (const int turns : {0, -1}) {
      std::vector<Key<Quat>> keys;
      for (std::size_t i = 0; i < 4; ++i) {
        const Tangent<Quat> tangent{TangentKind::given, Vec3(1, -0.5, 0.3), weight};
        keys.push_back({times()[i], rotations()[i], Ease::smooth_clamped(), tangent, tangent});
        keys.back().turn.whole_turns = turns;
      }
      result.push_back({"stated velocities", keyed_curve<Quat>(keys)});
    }
  std::vector<Quat> controls;
  for (int i = 0; i < 10; ++i) controls.push_back(exp_map(Vec3(0.3 * i, 0.9 - 0.1 * i * i, 0.2 * i)));
  result.push_back({"Bezier", bezier_rotation(times(), controls)});
  result.push_back({"clamped", clamped_rotation(times(), rotations(), Vec3(1, 0, 0), Vec3(0, 2, 0))});
  std::vector<Vec4> values, tangents;
  for (const Quat& q : rotations()) {
    values.push_back(q.coeffs());
    tangents.emplace_back(0.3, -0.2, 0.5, 0.1);
  }
  result.push_back({"glTF", gltf_cubic_rotation(times(), tangents, values, tangents)});
  return result;
}

void check_same(const Sample<Quat>& a, const Sample<Quat>& b, const Vec3& rate, const Vec3& acceleration) {
  CHECK(test::near(a.value, b.value, 1e-12));
  CHECK(test::near(a.rate, rate, 1e-9 * (1 + rate.norm())));
  CHECK(test::near(a.acceleration, acceleration, 1e-8 * (1 + acceleration.norm())));
}

void check_same(const Curve<Quat>& a, const Curve<Quat>& b, double from, double to) {
  for (int i = 0; i < 90; ++i) {
    const double t = from + (to - from) * (i + 0.37) / 90;
    CAPTURE(t);
    const Sample<Quat> s = b.sample(t);
    check_same(a.sample(t), s, s.rate, s.acceleration);
  }
}

}  // namespace

TEST_CASE("turns of every kind are cut, joined, played backwards and written out as loops") {
  const OutsideRule<Quat> forever{Outside::repeat_offset}, twice{Outside::pingpong, {}, 1.5},
      on{Outside::linear, Vec3(0.3, 2, -1)}, thrice{Outside::repeat_offset, {}, 3};
  for (const Turning& each : all_turnings()) {
    CAPTURE(each.name);
    for (const auto& [before, after] : {std::pair{forever, twice}, std::pair{on, thrice}}) {
      const Curve<Quat> curve = each.curve.with_outside(before, after);
      const double from = curve.start() - 3.3 * curve.duration(), to = curve.end() + 3.8 * curve.duration();
      check_same(trimmed(curve, from, to), curve, from, to);
      const auto parts = split(curve, 1.7);
      check_same(joined(parts.first, parts.second), curve, curve.start(), curve.end());
      check_same(with_knot(curve, 2.6), curve, from, to);
      const Curve<Quat> back = reversed(curve);
      for (int i = 0; i < 90; ++i) {
        const double t = from + (to - from) * (i + 0.37) / 90;
        CAPTURE(t);
        const Sample<Quat> s = curve.sample(t, Side::in);
        check_same(back.sample(curve.start() + curve.end() - t), s, -s.rate, s.acceleration);
      }
      check_same(reversed(back), curve, from, to);
    }
  }
}

TEST_CASE("keys are not taken from turns that they would not repeat") {
  for (const char* word : {"squad", "barry-goldman", "nlerp", "smooth"}) {
    CAPTURE(word);
    const std::vector<Key<Quat>> keys = {
        {0, rotations()[0], *Ease::named(word)}, {1, rotations()[1], *Ease::named(word)}, {2, rotations()[2]}};
    CHECK_THROWS_AS((void)keys_of(keyed_curve<Quat>(std::span<const Key<Quat>>(keys))), std::invalid_argument);
  }
  RotationSpan spinning{};
  for (Vec4& c : spinning.coefficients) c.setZero();
  spinning.spin = {0, 1, 0};
  CHECK_THROWS_WITH_AS((void)keys_of(Curve<Quat>(std::span<const RotationSpan>(&spinning, 1))),
                       doctest::Contains("turns on the way"), std::invalid_argument);
}
