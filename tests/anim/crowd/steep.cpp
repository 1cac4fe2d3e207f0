// Crowds of clips that are steep: eases that leave a key straight up, and keys very close to each other.

#include <tweenfall/anim/crowd.h>

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
    CHECK_THROWS_WITH_AS(
        (void)compile(clip_with(1e-6, word), *nodes),
        doctest::Contains("clip \"steep\" cannot be compiled for a crowd: the rotations of the joints from "
                          "\"joint0\" on change so fast that 20"),
        std::invalid_argument);
  }
  // Where slopes are bounded by the values, keys may be as close as they like.
  for (const double gap : {1e-3, 1e-4, 1e-6}) {
    const Clip close = clip_with(gap, "smooth-clamped");
    CHECK(farthest_from(close, *nodes, compile(close, *nodes)) <= 1e-4);
  }
}
