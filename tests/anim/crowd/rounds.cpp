// Crowds in loops with offset: how far they are from the exact path in later rounds, and what they say of it.

#include <tweenfall/anim/crowd.h>

#include <stdexcept>

#include "figures.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// The largest part of its bound that a compiled clip is away from the exact path at random times of rounds, most of
/// them far from the first.
double part_of_bound(const std::shared_ptr<const Hierarchy>& nodes, const Clip& clip, const CrowdClip& compiled,
                     double arm, double speed, std::uint64_t seed) {
  const Animation exact(nodes, {clip}, {{.clip = 0, .at = 0.7, .speed = speed}});
  Random random(seed);
  std::vector<Motion> wanted(nodes->size());
  std::vector<CrowdGroup> pose(compiled.groups());
  double largest = 0;
  for (int i = 0; i < 400; ++i) {
    const double round = std::floor(std::pow(10, random.between(0, 4)) - 1);
    const double phase = (round + (random.unit() < 0.1 ? 0 : random.unit())) * clip.duration;
    const double time = 0.7 + (speed == 0 ? phase : phase / std::abs(speed));
    const Side side = random.unit() < 0.3 ? Side::in : Side::out;
    exact.sample(time, wanted, side);
    const ClipClock clock = compiled.clock(0.7, speed, time, side);
    compiled.sample(clock, pose);
    largest = std::max(largest, distance(*nodes, wanted, pose, arm) / compiled.error(clock.cycle));
  }
  return largest;
}

/// A root that turns and comes back, with an arm that gets a meter longer in each round.
struct Stretching {
  std::shared_ptr<const Hierarchy> nodes = std::make_shared<Hierarchy>(Hierarchy({{"root"}, {"arm", 0}}));
  Clip clip{.name = "stretching", .duration = 1, .loop = {.mode = LoopMode::repeat_offset}};

  Stretching() {
    std::vector<Key<Quat>> turns;
    for (int i = 0; i <= 8; ++i)
      turns.push_back({.time = i / 8.0, .value = exp_map(Vec3(0, 0, std::sin(i * pi / 4))), .ease = Ease::smooth()});
    clip.tracks.push_back({"root", "rotation", keyed_curve<Quat>(turns)});
    clip.tracks.push_back(
        {"arm", "position", keyed_curve<Vec3>({{.time = 0, .value = {0, 0, 0}}, {.time = 1, .value = {1, 0, 0}}})});
  }
};

}  // namespace

TEST_CASE("in whatever round of a loop, a crowd is no further from the exact path than it says") {
  double largest = 0, most_below_root = 0;
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    INFO("seed ", seed);
    Random random(seed);
    const auto nodes = random_figure(seed + 600, 1 + seed % 13);
    Clip clip = random_clip(seed + 700, *nodes, random.between(0.3, 2));
    clip.loop.mode = seed % 6 == 0 ? LoopMode::pingpong : seed % 6 == 1 ? LoopMode::repeat : LoopMode::repeat_offset;
    if (seed % 5 == 0) clip.loop.count = random.between(1, 20000);
    // What comes back to where it was turned does not turn on.
    if (seed % 4 == 0)
      for (Track& track : clip.tracks)
        if (std::holds_alternative<Curve<Quat>>(track.curve)) {
          const Quat rest = random.rotation();
          track.curve = keyed_curve<Quat>({{.time = 0, .value = rest, .ease = random_ease(random)},
                                           {.time = 0.4 * clip.duration, .value = random.rotation()},
                                           {.time = clip.duration, .value = rest}});
        }
    const CrowdSettings settings{.tolerance = std::pow(10, -random.between(1.5, 4)),
                                 .arm = random.between(0, 0.5),
                                 .rounds = seed % 3 == 0 ? 8 : 1};
    const CrowdClip compiled = compile(clip, *nodes, settings);
    CHECK(compiled.error() <= settings.tolerance);
    CHECK(compiled.error(settings.rounds - 1) <= settings.tolerance);
    CHECK(compiled.error(1 - settings.rounds) <= settings.tolerance);
    const double speed = seed % 7 == 0 ? 0 : seed % 3 == 1 ? random.between(-3, -0.2) : random.between(0.2, 3);
    const double part = part_of_bound(nodes, clip, compiled, settings.arm, speed, seed);
    CHECK(part <= 1);
    largest = std::max(largest, part);
    if (seed % 6 > 1) most_below_root = std::max(most_below_root, compiled.error(10000) / compiled.error());
  }
  CHECK(largest > 0.9);           // the bounds are not idle ones
  CHECK(most_below_root > 1000);  // and told of figures that grow
}

TEST_CASE("what a crowd says of its error holds between the times at which it was measured") {
  // Of thousands of random clips those for which the largest error lay between them the most.
  struct Rare {
    std::uint64_t seed;
    std::size_t joints;
    double duration, tolerance, arm;
  };
  for (const Rare& rare : {Rare{22, 12, 0.55319, 0.019918, 0.20367}, Rare{1025, 20, 0.87, 0.0024535, 0},
                           Rare{1067, 3, 2.8212584, 2.7116e-4, 1.5066}}) {
    INFO("seed ", rare.seed);
    const auto nodes = random_figure(rare.seed + 1000000, rare.joints);
    const Animation exact(nodes, {random_clip(rare.seed + 2000000, *nodes, rare.duration)}, {{.clip = 0}});
    const CrowdClip compiled = compile(exact.clips()[0], *nodes, {.tolerance = rare.tolerance, .arm = rare.arm});
    double farthest = 0;
    constexpr int times = 4000;
    for (int i = 0; i < times; ++i)
      farthest = std::max(farthest, distance(exact, compiled, rare.duration * (i + 0.5) / times, rare.arm));
    CHECK(farthest <= compiled.error());
    CHECK(farthest > 0.9 * compiled.error());
    CHECK(compiled.error() <= rare.tolerance);
  }
}

TEST_CASE("a figure that walks away is off by what floats round, and no more") {
  const auto nodes = random_figure(3, 6);
  Clip clip = random_clip(41, *nodes, 1);
  std::erase_if(clip.tracks, [](const Track& track) { return track.node == "joint0" || track.property != "scale"; });
  clip.tracks.push_back(
      {"joint0", "position", keyed_curve<Vec3>({{.time = 0, .value = {0, 1, 0}}, {.time = 1, .value = {0, 1, 1.5}}})});
  clip.loop.mode = LoopMode::repeat_offset;
  const CrowdClip compiled = compile(clip, *nodes);
  // 24 bits: half of a unit in the last place is at most 2^-24 of a number.
  const double rounding = 0x1p-24;
  CHECK(compiled.error(1) <= compiled.error() + 1e-6);
  CHECK(compiled.error(10000) - compiled.error(1) == doctest::Approx(9999 * 1.5 * rounding).epsilon(0.05));
  CHECK(part_of_bound(nodes, clip, compiled, 0.1, 1, 5) <= 1);
}

TEST_CASE("where errors grow with the rounds, a clip is compiled for as many of them as are asked for") {
  const Stretching made;
  const CrowdClip one = compile(made.clip, *made.nodes, {.tolerance = 1e-3});
  CHECK(one.error(0) <= 1e-3);
  CHECK(one.error(100) > 0.01);
  CHECK(one.error(-100) == one.error(100));
  CHECK(one.error(201) - one.error(200) == doctest::Approx(one.error(2) - one.error(1)));
  const CrowdClip many = compile(made.clip, *made.nodes, {.tolerance = 1e-3, .rounds = 101});
  CHECK(many.error(100) <= 1e-3);
  CHECK(many.error(-100) <= 1e-3);
  CHECK(many.error(300) > 1e-3);
  CHECK(part_of_bound(made.nodes, made.clip, many, 0.1, 1, 6) <= 1);
  CHECK(part_of_bound(made.nodes, made.clip, many, 0.1, -1, 7) <= 1);
  CHECK(CrowdClip::from_bytes(many.to_bytes()).error(70) == many.error(70));
  CHECK_THROWS_WITH_AS((void)compile(made.clip, *made.nodes, {.tolerance = 1e-3, .rounds = 100000}),
                       doctest::Contains("m for 100000 rounds in float; the nearest is 0.0"), std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)compile(made.clip, *made.nodes, {.rounds = 0}),
                       doctest::Contains("for 1 to 100 million rounds; it is told 0"), std::invalid_argument);
}

TEST_CASE("a play that only repeats a clip with offset takes its crowd nowhere") {
  const Stretching made;
  const CrowdClip compiled = compile(made.clip, *made.nodes);
  const Play play{.clip = 0, .loop = Loop{.mode = LoopMode::repeat}};
  const Animation exact(made.nodes, {made.clip}, {play});
  std::vector<Motion> wanted(2);
  std::vector<CrowdGroup> pose(compiled.groups());
  for (const double time : {0.3, 1.3, 7.9}) {
    exact.sample(time, wanted);
    compiled.sample(clock_at(play, made.clip, time), pose);
    CHECK(distance(*made.nodes, wanted, pose, 0.1) <= 1e-4);
  }
}
