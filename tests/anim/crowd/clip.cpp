#include <tweenfall/anim/crowd.h>

#include <stdexcept>

#include "crowd/compiled_clip.h"
#include "crowd/sample_kernels.h"
#include "curves/counted_allocations.h"
#include "figures.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

// The whole clip as bytes, including unused lanes.
bool same_groups(std::span<const CrowdGroup> a, std::span<const CrowdGroup> b) {
  return std::ranges::equal(std::as_bytes(a), std::as_bytes(b));
}

}  // namespace

TEST_CASE("a compiled clip of any curves is nowhere further from the exact path than its tolerance") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    const std::size_t joints = seed == 1 ? 1 : seed == 2 ? 20 : 7 + seed;
    const auto nodes = random_figure(seed, joints);
    const Animation exact(nodes, {random_clip(seed + 100, *nodes, 2)}, {{.clip = 0}});
    const CrowdSettings settings{.tolerance = seed % 2 ? 1e-4 : 1e-3};
    const CrowdClip clip = compile(exact.clips()[0], *nodes, settings);
    CHECK(clip.error() <= settings.tolerance);
    Random random(seed);
    double farthest = 0;
    for (int i = 0; i < 400; ++i) farthest = std::max(farthest, distance(exact, clip, random.between(0, 2)));
    // At the knots themselves, and one ulp beside them.
    for (const Track& track : exact.clips()[0].tracks) {
      const auto* curve = std::get_if<Curve<Vec3>>(&track.curve);
      for (const double knot : curve ? curve->knots() : std::span<const double>())
        if (knot < 2)
          for (const double time : {std::nextafter(knot, -1.0), knot, std::nextafter(knot, 3.0)})
            if (time >= 0) farthest = std::max(farthest, distance(exact, clip, time));
    }
    INFO("seed ", seed);
    CHECK(farthest <= settings.tolerance);
    CHECK(farthest > 0.1 * clip.error());  // the bound is not an idle one
  }
}

TEST_CASE("steps stay steps: on either side of a jump stands what the curve has there") {
  const auto nodes = random_figure(3, 2);
  const std::vector<Key<Vec3>> keys{{.time = 0, .value = {0, 0, 0}, .ease = Ease::hold()},
                                    {.time = 0.3, .value = {5, 0, 0}, .ease = Ease::hold()},
                                    {.time = 0.30001, .value = {-5, 0, 0}, .ease = Ease::linear()},
                                    {.time = 1, .value = {2, 1, 0}}};
  Clip clip{.name = "steps", .duration = 1};
  clip.tracks.push_back({"joint1", "position", keyed_curve<Vec3>(keys)});
  const CrowdClip compiled = compile(clip, *nodes);
  std::vector<CrowdGroup> pose(compiled.groups());
  const auto x_at = [&](double time, Side side) {
    compiled.sample(ClipClock{.time = time, .side = side}, pose);
    return static_cast<double>(pose[0].translation[0][1]);
  };
  CHECK(x_at(0.3, Side::in) == doctest::Approx(0));
  CHECK(x_at(0.3, Side::out) == doctest::Approx(5));
  CHECK(x_at(std::nextafter(0.3, 0.0), Side::out) == doctest::Approx(0));
  CHECK(x_at(0.30001, Side::in) == doctest::Approx(5));
  CHECK(x_at(0.30001, Side::out) == doctest::Approx(-5));
  CHECK(x_at(1, Side::out) == doctest::Approx(2));
  CHECK(x_at(7, Side::out) == doctest::Approx(2));
  CHECK(x_at(-7, Side::out) == doctest::Approx(0));
}

TEST_CASE("a jump at the very end of a clip is kept, and what is said of the time before it is none of its own") {
  const auto nodes = random_figure(3, 2);
  Clip clip{.name = "steps", .duration = 1};
  std::vector<Key<Vec3>> places;
  std::vector<Key<Quat>> turns;
  for (int i = 0; i <= 4; ++i) {
    places.push_back({.time = 0.25 * i, .value = Vec3(i * i, 0, 0), .ease = Ease::hold()});
    turns.push_back({.time = 0.25 * i, .value = exp_map(Vec3(0, 0.7 * i, 0)), .ease = Ease::hold()});
  }
  clip.tracks.push_back({"joint1", "position", keyed_curve<Vec3>(places).with_outside(Outside::repeat, Outside::hold)});
  clip.tracks.push_back({"joint0", "rotation", keyed_curve<Quat>(turns)});
  const CrowdClip compiled = CrowdClip::from_bytes(compile(clip, *nodes).to_bytes());
  std::vector<CrowdGroup> pose(compiled.groups());
  const auto seen = [&](double time, Side side) {
    compiled.sample(ClipClock{.time = time, .side = side}, pose);
    const double turn = 2 * std::atan2(pose[0].rotation[1][0], pose[0].rotation[3][0]);
    return std::pair(static_cast<double>(pose[0].translation[0][1]), turn);
  };
  const auto is = [](const std::pair<double, double>& shown, double step) {
    return std::abs(shown.first - step * step) < 1e-4 && std::abs(shown.second - 0.7 * step) < 1e-3;
  };
  CHECK(is(seen(0, Side::out), 0));
  CHECK(is(seen(0.99, Side::out), 3));
  CHECK(is(seen(1, Side::in), 3));
  CHECK(is(seen(1, Side::out), 4));
  CHECK(is(seen(7, Side::in), 4));
  CHECK(is(seen(7, Side::out), 4));
}

TEST_CASE("the wide kernels give the bits of the plain ones, values and rates") {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const auto nodes = random_figure(seed, 13);
    const Clip source = random_clip(seed + 50, *nodes, 1.5);
    for (const double tolerance : {1e-2, 1e-3}) {
      const CrowdClip clip = compile(source, *nodes, {.tolerance = tolerance});
      const crowd::CompiledClip& compiled = clip.compiled();
      std::vector<CrowdGroup> wide(clip.groups()), plain(clip.groups()), alone(clip.groups());
      std::vector<CrowdRates> wide_rates(clip.groups()), plain_rates(clip.groups());
      Random random(seed);
      for (int i = 0; i < 100; ++i) {
        const double time = random.between(-0.1, 1.6);
        const bool arriving = random.unit() < 0.5;
        const auto all = crowd::possible_sample_kernels();
        crowd::sample_with(*all.front(), compiled, time, arriving, 1, plain.data(), plain_rates.data());
        for (const crowd::SampleKernels* kernels : all) {
          crowd::sample_with(*kernels, compiled, time, arriving, 1, wide.data(), wide_rates.data());
          crowd::sample_with(*kernels, compiled, time, arriving, 1, alone.data(), nullptr);
          CHECK(same_groups(wide, plain));
          CHECK(same_groups(wide, alone));
          CHECK(std::ranges::equal(std::as_bytes(std::span(wide_rates)), std::as_bytes(std::span(plain_rates))));
        }
      }
    }
  }
}

TEST_CASE("many figures at once stand as each does alone") {
  const auto nodes = random_figure(4, 13);
  Clip source = random_clip(54, *nodes, 1.5);
  source.loop = {.mode = LoopMode::repeat_offset};
  const CrowdClip clip = compile(source, *nodes);
  Random random(8);
  for (const std::size_t count : {0U, 1U, 3U, 4U, 5U, 23U}) {
    std::vector<ClipClock> clocks;
    for (std::size_t i = 0; i < count; ++i)
      clocks.push_back(clip.clock(0, 1, random.between(-0.2, 7), random.unit() < 0.5 ? Side::in : Side::out));
    std::vector<CrowdGroup> poses(count * clip.groups()), alone(clip.groups());
    clip.sample(clocks, poses);
    for (std::size_t i = 0; i < count; ++i) {
      clip.sample(clocks[i], alone);
      CHECK(same_groups(std::span(poses).subspan(i * clip.groups(), clip.groups()), alone));
    }
  }
}

TEST_CASE("rates are the derivatives of what the sampler returns") {
  const auto nodes = random_figure(5, 12);
  const Clip source = random_clip(77, *nodes, 2);
  const CrowdClip clip = compile(source, *nodes);
  std::vector<CrowdGroup> pose(clip.groups()), before(clip.groups()), after(clip.groups());
  std::vector<CrowdRates> rates(clip.groups());
  Random random(9);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const double time = random.between(0.01, 1.99), speed = random.between(-3, 3);
    // Kinks and jumps have no derivative: only where no knot is near.
    const double h = 2e-4;
    bool plain = true;
    for (const auto& timeline : clip.compiled().timelines)
      for (const double knot : timeline.knots) plain = plain && std::abs(knot - time) > 2 * h;
    if (!plain) continue;
    clip.sample(ClipClock{.time = time, .rate = speed}, pose, rates);
    clip.sample(time - h, before);
    clip.sample(time + h, after);
    for (std::size_t joint = 0; joint < 12; ++joint) {
      const Pose a = pose_of(before, joint), b = pose_of(after, joint), here = pose_of(pose, joint);
      const std::size_t group = joint / 8, lane = joint % 8;
      const Vec3 linear = speed * (b.position - a.position) / (2 * h), scaling = speed * (b.scale - a.scale) / (2 * h);
      Quat change = b.rotation * a.rotation.conjugate();
      const Vec3 turning = speed * log_map(change.normalized()) / (2 * h);
      for (int c = 0; c < 3; ++c) {
        // A float's rounding divided by 2 h, plus the third derivative of a piece.
        const double room = 3 * std::abs(speed) * (6e-8 * (1 + here.position.norm()) / h + 1e-2);
        CHECK(std::abs(rates[group].linear[c][lane] - linear[c]) <= room);
        CHECK(std::abs(rates[group].scale[c][lane] - scaling[c]) <= room);
        CHECK(std::abs(rates[group].angular[c][lane] - turning[c]) <= room * (1 + turning.squaredNorm() * 1e-4));
      }
      ++compared;
    }
  }
  CHECK(compared > 200);
}

TEST_CASE("one clock takes all of a clip through its loops, and a climb goes on from where it was") {
  const auto nodes = random_figure(8, 9);
  for (const LoopMode mode : {LoopMode::once, LoopMode::repeat, LoopMode::pingpong, LoopMode::repeat_offset}) {
    Clip source = random_clip(31, *nodes, 1);
    source.loop = {.mode = mode, .count = mode == LoopMode::once ? 0.0 : 3.5};
    const Animation exact(nodes, {source}, {{.clip = 0, .at = 0.25, .speed = 1.5}});
    const CrowdClip clip = compile(source, *nodes);
    Random random(4);
    for (int i = 0; i < 200; ++i) {
      const double time = random.between(0.25, 5);
      CHECK(distance(exact, clip, time) <= clip.error(clip.clock(0.25, 1.5, time).cycle));
    }
  }
}

TEST_CASE("clips without tracks, joints or length compile, and rest") {
  const auto nodes = random_figure(2, 11);
  const CrowdClip still = compile(Clip{.name = "still", .duration = 1}, *nodes);
  std::vector<CrowdGroup> pose(still.groups());
  still.sample(0.4, pose);
  for (std::size_t i = 0; i < nodes->size(); ++i) {
    CHECK(near(pose_of(pose, i).position, (*nodes)[i].rest.position, 1e-7));
    CHECK(near(pose_of(pose, i).rotation, (*nodes)[i].rest.rotation, 2e-7));
    CHECK(pose_of(pose, i).scale == Vec3(1, 1, 1));
  }
  std::vector<CrowdGroup> first(still.groups());
  still.sample(0, first);
  still.sample(NAN, pose);  // NaN counts as the start
  CHECK(std::memcmp(pose.data(), first.data(), first.size() * sizeof(CrowdGroup)) == 0);

  const CrowdClip nobody = compile(Clip{.name = "nobody", .duration = 1}, Hierarchy{});
  CHECK(nobody.groups() == 0);
  nobody.sample(0.5, std::span<CrowdGroup>());

  Clip instant{.name = "instant", .duration = 0};
  instant.tracks.push_back({"joint0", "position", keyed_curve<Vec3>({{.time = 0, .value = {1, 2, 3}}})});
  const CrowdClip pinned = compile(instant, *nodes);
  pinned.sample(0.0, pose);
  CHECK(near(pose_of(pose, 0).position, Vec3(1, 2, 3), 1e-4));
}

TEST_CASE("what cannot be compiled is refused in words") {
  const auto nodes = random_figure(2, 3);
  Clip stray{.name = "stray", .duration = 1};
  stray.tracks.push_back({"nobody", "position", Curve<Vec3>(Vec3(0, 0, 0))});
  CHECK_THROWS_WITH_AS((void)compile(stray, *nodes), doctest::Contains("there is no node \"nobody\""),
                       std::invalid_argument);
  const Clip endless{.name = "endless", .duration = std::numeric_limits<double>::infinity()};
  CHECK_THROWS_WITH_AS((void)compile(endless, *nodes), doctest::Contains("has no end"), std::invalid_argument);
  const Clip still{.name = "still", .duration = 1};
  CHECK_THROWS_WITH_AS((void)compile(still, *nodes, {.tolerance = 0}), doctest::Contains("tolerance"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)compile(still, *nodes, {.arm = -1}), doctest::Contains("arm"), std::invalid_argument);
  // A tenth of a millimeter at the other end of a country is below the precision of a float.
  Clip far{.name = "far", .duration = 1};
  far.tracks.push_back({"joint0", "position",
                        keyed_curve<Vec3>({{.time = 0, .value = {1e6, 0, 0}}, {.time = 1, .value = {2e6, 0.3, 0}}})});
  CHECK_THROWS_WITH_AS((void)compile(far, *nodes), doctest::Contains("in float; the nearest is"),
                       std::invalid_argument);
}

TEST_CASE("sampling a crowd asks for no memory") {
  const auto nodes = random_figure(6, 20);
  const CrowdClip clip = compile(random_clip(12, *nodes, 1), *nodes, {.tolerance = 1e-3});
  std::vector<CrowdGroup> pose(clip.groups());
  std::vector<CrowdRates> rates(clip.groups());
  const std::size_t before = allocations();
  for (int i = 0; i < 100; ++i) clip.sample(clip.clock(0, 1, 0.013 * i), pose, rates);
  CHECK(allocations() == before);
}
