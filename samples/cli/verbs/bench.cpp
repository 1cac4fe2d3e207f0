// tweenfall bench: how fast sampling and stepping are on this machine.

#include "report/table.h"
#include "report/terminal.h"
#include "verbs/verbs.h"

#include <tweenfall/anim/animation.h>
#include <tweenfall/curves/keys.h>
#include <tweenfall/curves/number_text.h>
#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/world.h>

#include <chrono>

namespace tweenfall::cli {

namespace {

/// Seconds per call: the best of several stretches of a tenth of a second.
template <class Call>
double seconds_of(Call&& call) {
  using Clock = std::chrono::steady_clock;
  double best = 1e300;
  for (int stretch = 0; stretch < 3; ++stretch) {
    const auto start = Clock::now();
    std::size_t calls = 0;
    double passed = 0;
    while (passed < 0.1) {
      call();
      ++calls;
      passed = std::chrono::duration<double>(Clock::now() - start).count();
    }
    best = std::min(best, passed / static_cast<double>(calls));
  }
  return best;
}

/// A chain of nodes, each moved and turned by eight keys.
Animation chain(std::size_t length) {
  auto nodes = std::make_shared<Hierarchy>();
  Clip clip{.name = "chain", .duration = 7, .loop = {.mode = LoopMode::repeat}};
  for (std::size_t i = 0; i < length; ++i) {
    const std::string name = "node" + std::to_string(i);
    nodes->add({name, i == 0 ? no_node : i - 1});
    std::vector<Key<Vec3>> places;
    std::vector<Key<Quat>> turns;
    for (int key = 0; key < 8; ++key) {
      places.push_back({static_cast<double>(key), Vec3(0.1 * key, 1, 0.05 * key * key)});
      turns.push_back({static_cast<double>(key), exp_map(Vec3(0.1 * key, 0.2, 0))});
    }
    clip.tracks.push_back({name, "position", keyed_curve<Vec3>(places)});
    clip.tracks.push_back({name, "rotation", keyed_curve<Quat>(turns)});
  }
  return {std::move(nodes), {std::move(clip)}, {Play{}}};
}

World floor_with_stacks(int stacks, int height) {
  World world({.sleep_after = std::numeric_limits<double>::infinity()});
  world.add({.shape = {Plane{}}, .fixed = true});
  for (int stack = 0; stack < stacks; ++stack)
    for (int level = 0; level < height; ++level) {
      BodySettings box{.shape = {Box{}}};
      box.motion.pose.position = Vec3(3.0 * stack, 0.5 + level, 0);
      world.add(box);
    }
  return world;
}

Run declare_bench(Arguments&) {
  return [] {
    const Progress progress("timing");
    Table table("on this machine, one thread", {"what", ">time", ">per second"});
    const auto row = [&](const std::string& what, double seconds, double things, const std::string& unit) {
      const double each = seconds / things;
      table.row({what,
                 each < 1e-6   ? brief_text(each * 1e9) + " ns"
                 : each < 1e-3 ? brief_text(each * 1e6) + " us"
                               : brief_text(each * 1e3) + " ms",
                 brief_text(1 / each) + " " + unit});
    };

    std::vector<Key<Vec3>> keys(64);
    for (int i = 0; i < 64; ++i)
      keys[static_cast<std::size_t>(i)] = {static_cast<double>(i), Vec3(i % 7, i % 5, i % 3)};
    const Curve<Vec3> curve = keyed_curve<Vec3>(keys);
    double time = 0, sum = 0;
    const double sampling = seconds_of([&] {
      for (int i = 0; i < 1000; ++i) {
        time = time > 60 ? 0 : time + 0.0137;
        sum += curve.sample(time).rate.x();
      }
    });
    row("a vector curve of 64 keys, value and rate", sampling, 1000, "samples");

    const Animation animation = chain(100);
    std::vector<Motion> local(100);
    std::vector<WorldFrame> worlds(100);
    const double posing = seconds_of([&] {
      time = time > 60 ? 0 : time + 0.0137;
      animation.sample(time, local);
      animation.nodes().world_frames(local, worlds);
      sum += worlds.back().velocity.x();
    });
    row("100 nodes in a chain, world frames", posing, 1, "poses");

    World one = floor_with_stacks(1, 10);
    row("a stack of 10 boxes, one step", seconds_of([&] { one.step(1.0 / 240); }), 1, "steps");
    World many = floor_with_stacks(20, 10);
    row("20 stacks of 10 boxes, one step", seconds_of([&] { many.step(1.0 / 240); }), 1, "steps");

    // The result must be used, or the compiler leaves the computation out.
    if (sum != sum) table.note("the samples are not numbers");
    print(table.text(styled_output()));
    return 0;
  };
}

}  // namespace

const Verb bench_verb{"bench", "time sampling and stepping on this machine", "tweenfall bench", declare_bench};

}  // namespace tweenfall::cli
