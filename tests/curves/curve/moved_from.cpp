// What is left of values that were moved from: they are as they were.

#include "support.h"

#include <tweenfall/curves/arc_length.h>
#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/keys.h>

#include <utility>

using namespace tweenfall;

TEST_CASE("a curve that was moved from, built or assigned, is what it was") {
  Curve<double> curve = keyed_curve<double>({{0, 1, Ease::smooth()}, {1, 3}, {2, 2}});
  const double before = curve.value(0.7);
  Curve<double> taken = std::move(curve);
  CHECK(curve.value(0.7) == before);
  CHECK(curve.end() == 2);
  taken = std::move(curve);
  CHECK(curve.sample(0.7).value == before);
  CHECK(taken.value(0.7) == before);
  Curve<Quat> turn{Quat::Identity()};
  const Curve<Quat> taken_turn = std::move(turn);
  CHECK(turn.value(1).w() == taken_turn.value(1).w());
  CHECK(std::is_nothrow_move_constructible_v<Curve<double>>);
  CHECK(std::is_nothrow_move_assignable_v<Curve<Color>>);
}

TEST_CASE("an expression and a measured path that were moved from are what they were") {
  Expression expression("2*t+1");
  const Expression taken = std::move(expression);
  CHECK(expression.sample(3).value == 7);
  CHECK(taken.sample(3).value == 7);
  MeasuredPath<Vec2> path(keyed_curve<Vec2>({{0, {0, 0}}, {1, {3, 4}}}));
  const MeasuredPath<Vec2> taken_path = std::move(path);
  CHECK(path.length() == doctest::Approx(5));
  CHECK(taken_path.length() == path.length());
}

TEST_CASE("an ease that was moved from still makes curves") {
  for (const char* word : {"quad-in-out", "smooth", "spring(0.3s,0.5)", "hold"}) {
    Ease ease = Ease::named(word).value();
    const Ease taken = std::move(ease);
    CHECK(ease == taken);
    CHECK(ease.name() == word);
    CHECK_NOTHROW((void)keyed_curve<double>({{0, 1, ease}, {1, 2}}));
  }
}
