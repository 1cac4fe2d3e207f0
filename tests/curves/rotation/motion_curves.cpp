#include "support.h"

#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/motion_curves.h>
#include <tweenfall/curves/rotation.h>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

const std::vector<double> even{0, 0.5, 1, 1.5, 2}, uneven{-0.25, 0.1, 0.11, 1.9};

Curve<Vec3> vectors(Random& random, const std::vector<double>& times, const Ease& ease) {
  std::vector<Key<Vec3>> keys;
  for (const double time : times) keys.push_back({.time = time, .value = random.vector(2), .ease = ease});
  return keyed_curve<Vec3>(keys).with_outside(Outside::hold, Outside::repeat);
}

Curve<Quat> rotations(Random& random, const std::vector<double>& times, const Ease& ease) {
  std::vector<Key<Quat>> keys;
  for (const double time : times) keys.push_back({.time = time, .value = random.rotation(), .ease = ease});
  return keyed_curve<Quat>(keys).with_outside(Outside::hold, Outside::repeat);
}

bool same(const Vec3& a, const Vec3& b) {
  return a == b;
}

}  // namespace

TEST_CASE("curves that are sampled together give the bits that each gives by itself") {
  Random random(7);
  std::vector<Curve<Vec3>> positions, scales;
  std::vector<Curve<Quat>> turns;
  for (const std::vector<double>& times : {even, uneven})
    for (const Ease& ease : {Ease::linear(), Ease::smooth(), Ease::hold(), Ease::bezier(0.4, 0, 0.2, 1)}) {
      positions.push_back(vectors(random, times, ease));
      turns.push_back(rotations(random, times, ease));
      scales.push_back(vectors(random, even, Ease::smooth()));
    }
  positions.push_back(Curve<Vec3>(Vec3(1, 2, 3)));
  turns.push_back(axis_curve({0, 0, 1}, oscillator({.amplitude = 0.5, .hz = 2})));
  scales.push_back(vectors(random, {1.0}, Ease::linear()));

  MotionCurves together;
  for (std::size_t i = 0; i < positions.size(); ++i)
    together.add(positions.size() - 1 - i,
                 {&positions[i], i % 3 == 1 ? nullptr : &turns[i], i % 4 == 2 ? nullptr : &scales[i]});
  REQUIRE(together.size() == positions.size());

  std::vector<double> times{-1, -0.25, 0, 0.1, 0.11, 0.3, 0.5, 1, 1.25, 1.5, 1.9, 2, 3.3};
  for (int i = 0; i < 200; ++i) times.push_back(random.between(-0.5, 2.5));
  const double rate = -0.7;
  for (const Side side : {Side::in, Side::out})
    for (const double time : times) {
      CAPTURE(time);
      std::vector<Motion> motions(positions.size());
      together.sample(time, side, rate, motions);
      for (std::size_t i = 0; i < positions.size(); ++i) {
        const Motion& motion = motions[positions.size() - 1 - i];
        Motion alone, one;
        const auto position = positions[i].sample(time, side);
        alone.pose.position = position.value;
        alone.twist.linear = position.rate * rate;
        if (i % 3 != 1) {
          const auto rotation = turns[i].sample(time, side);
          alone.pose.rotation = rotation.value;
          alone.twist.angular = rotation.rate * rate;
        }
        if (i % 4 != 2) {
          const auto scale = scales[i].sample(time, side);
          alone.pose.scale = scale.value;
          alone.scale_rate = scale.rate * rate;
        }
        together.sample_one(i, time, side, rate, one);
        for (const Motion* other : {&motion, static_cast<const Motion*>(&one)}) {
          REQUIRE(same(other->pose.position, alone.pose.position));
          REQUIRE(same(other->twist.linear, alone.twist.linear));
          REQUIRE(other->pose.rotation.coeffs() == alone.pose.rotation.coeffs());
          REQUIRE(same(other->twist.angular, alone.twist.angular));
          REQUIRE(same(other->pose.scale, alone.pose.scale));
          REQUIRE(same(other->scale_rate, alone.scale_rate));
        }
      }
    }
}

TEST_CASE("spans that share their knots, and those that do not join, give back what they were made of") {
  Random random(11);
  const Curve<Vec3> first = vectors(random, even, Ease::linear()), second = vectors(random, even, Ease::hold());
  CHECK(first.knots().data() == second.knots().data());
  const Curve<Vec3> third = vectors(random, uneven, Ease::linear());
  CHECK(third.knots().data() != first.knots().data());
  CHECK(second.value(0.5, Side::in) != second.value(0.5));

  std::vector<RotationSpan> spans = rotations(random, even, Ease::smooth()).spans();
  for (RotationSpan& span : spans) span.spin = {0, 0, 0};
  const auto check = [](const std::vector<RotationSpan>& given) {
    const std::vector<RotationSpan> back = Curve<Quat>(std::span<const RotationSpan>(given)).spans();
    REQUIRE(back.size() == given.size());
    for (std::size_t i = 0; i < back.size(); ++i) {
      for (std::size_t k = 0; k <= static_cast<std::size_t>(given[i].degree); ++k)
        CHECK(back[i].coefficients[k] == given[i].coefficients[k]);
      CHECK(back[i].from.coeffs() == given[i].from.coeffs());
      CHECK(back[i].end.coeffs() == given[i].end.coeffs());
      CHECK(back[i].spin == given[i].spin);
    }
  };
  check(spans);
  spans[1].end = random.rotation();  // a jump
  check(spans);
  spans[2].coefficients[0] = Vec4(0.1, 0.2, 0.3, 0);  // that does not start at `from`
  check(spans);
  spans[2].degree = 1;
  check(spans);
  spans[0].spin = {0, 3, 0};
  check(spans);
}
