// Crowds of clips that are steep: eases that leave a key straight up, keys very close to each other, formulas that
// jump.

#include <tweenfall/anim/crowd.h>
#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/functions.h>

#include <numbers>
#include <stdexcept>

#include "figures.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

Clip of_keys(const std::vector<Key<Vec3>>& places, const std::vector<Key<Quat>>& turns) {
  Clip clip{.name = "steep", .duration = 1};
  if (!places.empty()) clip.tracks.push_back({"joint0", "position", keyed_curve<Vec3>(places)});
  if (!turns.empty()) clip.tracks.push_back({"joint0", "rotation", keyed_curve<Quat>(turns)});
  return clip;
}

/// How far the compiled clip is from the exact path, at times that crowd together at both ends of [0, 1].
double farthest_from(const Clip& clip, const Hierarchy& nodes, const CrowdClip& compiled) {
  const Animation exact(std::make_shared<const Hierarchy>(nodes), {clip}, {{.clip = 0}});
  double farthest = 0;
  for (double exponent = 0; exponent < 16; exponent += 0.01) {
    const double near_end = std::pow(10, -exponent);
    for (const double time : {near_end, 1 - near_end}) farthest = std::max(farthest, distance(exact, compiled, time));
  }
  return farthest;
}

}  // namespace

TEST_CASE("eases that leave a key straight up are kept within a tenth of a millimeter, in place and in rotation") {
  const auto nodes = random_figure(5, 3);
  for (const char* word : {"circ-out", "circ-in", "circ-in-out", "bezier(0,1,0,1)", "bezier(0,0.5,1,0.5)"}) {
    CAPTURE(word);
    const Ease ease = Ease::named(word).value();
    const Clip moves = of_keys({{.time = 0, .value = {0, 0, 0}, .ease = ease}, {.time = 1, .value = {3, 0, 0}}}, {});
    const Clip turns = of_keys(
        {}, {{.time = 0, .value = Quat(1, 0, 0, 0), .ease = ease}, {.time = 1, .value = exp_map(Vec3(0, 0, 2.5))}});
    for (const Clip& clip : {moves, turns}) {
      const CrowdClip compiled = compile(clip, *nodes);
      CHECK(compiled.error() <= 1e-4);
      CHECK(farthest_from(clip, *nodes, compiled) <= 1e-4);
      CHECK(compiled.byte_count() < 60000);
    }
  }
}

TEST_CASE("keys close to each other are compiled within their tolerance, or refused for being too fast") {
  const auto nodes = random_figure(5, 3);
  const auto clip_with = [](double gap, const char* word) {
    Random random(4);
    std::vector<Key<Quat>> turns;
    for (int i = 0; i < 10; ++i)
      for (int k = 0; k < 2; ++k)
        turns.push_back({.time = 0.1 * i + gap * k,
                         .value = exp_map(Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1))),
                         .ease = Ease::named(word).value()});
    return of_keys({}, turns);
  };
  for (const char* word : {"smooth", "natural"}) {
    const Clip close = clip_with(1e-3, word);
    const CrowdClip compiled = compile(close, *nodes);
    CHECK(farthest_from(close, *nodes, compiled) <= 1e-4);
    // So close that the slopes turn it around hundreds of times between two keys.
    CHECK_THROWS_WITH_AS((void)compile(clip_with(1e-6, word), *nodes),
                         doctest::Contains("the rotation of \"joint0\" changes so fast that 20"),
                         std::invalid_argument);
  }
  // Where slopes are bounded by the values, keys may be as close as they like.
  for (const double gap : {1e-3, 1e-4, 1e-6}) {
    const Clip close = clip_with(gap, "smooth-clamped");
    CHECK(farthest_from(close, *nodes, compile(close, *nodes)) <= 1e-4);
  }
}

namespace {

Clip of_formula(const char* text, double duration) {
  Clip clip{.name = "steep", .duration = duration};
  const Curve<double> x = expression_curve(Expression(text)), rest(0.0);
  clip.tracks.push_back({"joint0", "position", parametric(x, rest, rest)});
  return clip;
}

}  // namespace

TEST_CASE("formulas that jump are kept within their tolerance on both sides of each jump, with few knots") {
  const auto nodes = random_figure(5, 3);
  struct Jumping {
    const char* formula;
    double first_jump, duration;
    std::size_t bytes;
  };
  // Times of which some are numbers (0.25), some lie between two (1 / 3, asin(1 / 7)), and pulses of 2 ms.
  for (const Jumping& each :
       {Jumping{"floor(4*t)", 0.25, 3, 9000}, Jumping{"floor(3*t)", 1.0 / 3, 60, 200'000},
        Jumping{"floor(7*sin(t))", std::asin(1.0 / 7), 60, 200'000},
        Jumping{"sign(sin(20*t))", std::numbers::pi / 20, 3, 9000}, Jumping{"mod(t,0.37)", 0.37, 60, 200'000},
        Jumping{"t - floor(100*t)", 0.01, 1, 40'000}, Jumping{"floor(t*50)-floor(t*50-0.1)", 0.002, 3, 100'000}}) {
    CAPTURE(each.formula);
    const Clip clip = of_formula(each.formula, each.duration);
    const CrowdClip compiled = compile(clip, *nodes);
    CHECK(compiled.error() <= 1e-4);
    CHECK(compiled.byte_count() < each.bytes);
    const Animation exact(nodes, {clip}, {{.clip = 0}});
    double farthest = 0;
    for (double exponent = 1; exponent < 15; exponent += 0.1)
      for (const double way : {-1.0, 1.0})
        farthest = std::max(farthest, distance(exact, compiled, each.first_jump + way * std::pow(10, -exponent)));
    for (int i = 1; i < 5000; ++i)
      farthest = std::max(farthest, distance(exact, compiled, each.duration * i / 5000.0 + 1e-7));
    CHECK(farthest <= 1e-4);
  }
}

TEST_CASE("what changes too fast for a crowd is refused with the joint, the time and the cause") {
  const auto nodes = random_figure(5, 3);
  CHECK_THROWS_WITH_AS((void)compile(of_formula("tan(t)", 3), *nodes),
                       doctest::Contains("clip \"steep\" cannot be compiled for a crowd: from 1.57"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)compile(of_formula("1/(t-0.777)", 60), *nodes), doctest::Contains("near 0.77"),
                       std::invalid_argument);
  // Jumps of a meter so far away that floats are too coarse.
  CHECK_THROWS_WITH_AS((void)compile(of_formula("floor(30*t)", 60), *nodes),
                       doctest::Contains("m in float; the nearest"), std::invalid_argument);
}

TEST_CASE("tracks of one number are compiled with their keys") {
  const auto nodes = random_figure(5, 3);
  for (const char* property : {"position.y", "rotation.z", "scale.x"}) {
    CAPTURE(property);
    Clip clip{.name = "bump", .duration = 10};
    clip.tracks.push_back({"joint0", property,
                           keyed_curve<double>({{.time = 0, .value = 1},
                                                {.time = 5, .value = 1},
                                                {.time = 5.05, .value = 1.5},
                                                {.time = 5.1, .value = 1},
                                                {.time = 10, .value = 1}})});
    const CrowdClip compiled = compile(clip, *nodes);
    const Animation exact(nodes, {clip}, {{.clip = 0}});
    for (const double time : {4.9, 5.01, 5.05, 5.08, 7.0}) CHECK(distance(exact, compiled, time) <= 1e-4);
  }
}
