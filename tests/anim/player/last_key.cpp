#include "support.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/crowd.h>
#include <tweenfall/curves/keys.h>

#include <memory>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Held at x = 1, 2 and, from the clip's very end on, 3.
Clip held(const Loop& loop = {}) {
  Clip clip{.name = "held", .duration = 2, .loop = loop};
  clip.tracks.push_back({"lamp", "position",
                         keyed_curve<Vec3>({{.time = 0, .value = Vec3(1, 0, 0), .ease = Ease::hold()},
                                            {.time = 1, .value = Vec3(2, 0, 0), .ease = Ease::hold()},
                                            {.time = 2, .value = Vec3(3, 0, 0)}})});
  return clip;
}

double x_of(const Clip& clip, const Play& play, double time, Side side = Side::out) {
  const auto nodes = std::make_shared<const Hierarchy>(Hierarchy({Node{.name = "lamp"}}));
  const Animation animation(nodes, {clip}, {play});
  const Motion motion = animation.sample_node(0, time, side);
  CHECK(motion.twist.linear == Vec3(0, 0, 0));
  return motion.pose.position.x();
}

}  // namespace

TEST_CASE("a play that is over rests on the last key, also where that is held only from the clip's end on") {
  CHECK(x_of(held(), {}, 1.999) == 2);
  CHECK(x_of(held(), {}, 2, Side::in) == 2);
  CHECK(x_of(held(), {}, 2) == 3);
  CHECK(x_of(held(), {}, 77) == 3);
  const Clip twice = held({LoopMode::repeat, 2});
  CHECK(x_of(twice, {}, 2) == 1);
  CHECK(x_of(twice, {}, 4, Side::in) == 2);
  CHECK(x_of(twice, {}, 4) == 3);
  // There and back, it ends where it began, and a part of it before its last key.
  CHECK(x_of(held({LoopMode::pingpong, 2}), {}, 9) == 1);
  CHECK(x_of(held({LoopMode::repeat, 1.25}), {}, 9) == 1);
  CHECK(x_of(held(), Play{.to = 1.0}, 9) == 1);
  CHECK(x_of(held(), Play{.reverse = true}, 9) == 1);
}

TEST_CASE("steps that jump at their end come to it, as CSS has it") {
  Clip clip{.name = "steps", .duration = 2};
  clip.tracks.push_back(
      {"lamp", "position.x",
       keyed_curve<double>(
           {{.time = 0, .value = 0, .ease = Ease::named("steps(4, jump-end)").value()}, {.time = 2, .value = 4}})});
  CHECK(x_of(clip, {}, 1.9) == 3);
  CHECK(x_of(clip, {}, 2.5) == 4);
}

TEST_CASE("what begins anew where a clip ends is not shown at its start again") {
  Clip clip{.name = "saw", .duration = 2};
  Curve<double> saw = keyed_curve<double>({{.time = 0, .value = 0, .ease = Ease::linear()}, {.time = 1, .value = 5}});
  clip.tracks.push_back({"lamp", "position.x", saw.with_outside(Outside::hold, Outside::repeat)});
  CHECK(x_of(clip, {}, 9) == 5);
}

TEST_CASE("a crowd rests on the last key as the clip itself does") {
  const auto nodes = std::make_shared<const Hierarchy>(Hierarchy({Node{.name = "lamp"}}));
  const CrowdClip clip = compile(held(), *nodes);
  std::vector<CrowdGroup> pose(clip.groups());
  for (const auto& [time, x] : {std::pair(1.9, 2.0), {2.0, 3.0}, {50.0, 3.0}}) {
    clip.sample(clip.clock(0, 1, time), pose);
    CHECK(static_cast<double>(pose[0].translation[0][0]) == doctest::Approx(x));
  }
}

TEST_CASE("a crowd does not show what begins anew where its clip ends") {
  const auto nodes = std::make_shared<const Hierarchy>(Hierarchy({Node{.name = "lamp"}}));
  Clip source{.name = "saw", .duration = 2};
  const Curve<Vec3> saw = keyed_curve<Vec3>(
      {{.time = 0, .value = Vec3(0, 0, 0), .ease = Ease::linear()}, {.time = 1, .value = Vec3(5, 0, 0)}});
  source.tracks.push_back({"lamp", "position", saw.with_outside(Outside::hold, Outside::repeat)});
  const CrowdClip clip = compile(source, *nodes);
  std::vector<CrowdGroup> pose(clip.groups());
  clip.sample(clip.clock(0, 1, 50), pose);
  CHECK(static_cast<double>(pose[0].translation[0][0]) == doctest::Approx(5));
}
