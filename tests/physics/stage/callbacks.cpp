// What callbacks change: found again by whoever goes back, loads, or gives the log of the inputs to another stage.

#include "physics/handoff/scenes.h"

#include <tweenfall/physics/stage/recording.h>

#include <algorithm>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Balls in a row, some keyed, that touch or nearly do, and one that is thrown at them; contacts free them, give them
/// back and drive them.
StageDescription random_row(Random& random) {
  StageDescription row;
  row.step = random.unit() < 0.5 ? 1.0 / 60 : 1.0 / 240;
  row.world.gravity = {0, 0, 0};
  const auto add = [&](double x, double speed) {
    row.nodes.push_back({.name = "ball" + std::to_string(row.nodes.size()),
                         .rest = {.position = {x, 0, 0}},
                         .body = BodyDescription{.shape = {Sphere{0.2}},
                                                 .mass = random.between(0.3, 2),
                                                 .restitution = random.unit() < 0.5 ? 1 : random.unit(),
                                                 .twist = {.linear = {speed, 0, 0}}}});
  };
  const int balls = 2 + static_cast<int>(random.unit() * 5);
  for (int i = 0; i < balls; ++i) {
    add(0.4 * i + (random.unit() < 0.5 ? 0 : random.between(0, 0.02)), 0);
    if (random.unit() < 0.5) row.nodes.back().body->drive = Drive::keyed();
  }
  add(0.4 * balls + random.between(0, 0.3), -random.between(1, 8));
  const Drive drives[] = {Drive::free(), Drive::free(), Drive::keyed(), Drive{.hz = 5}};
  const auto any_drive = [&] { return drives[random.bits() % std::size(drives)]; };
  for (int i = 0; i < 3; ++i) {
    Rule rule{.bodies = {i == 0 ? "ball*" : "ball" + std::to_string(i)}, .to = any_drive()};
    rule.when.triggers = {when::ContactHit{.impulse = random.unit() < 0.5 ? 0 : random.between(0, 2)}};
    rule.once = random.unit() < 0.5;
    if (random.unit() < 0.3) rule.then.push_back({random.between(0, 0.1), {.to = any_drive()}});
    row.rules.push_back(std::move(rule));
  }
  return row;
}

void change_something(Random& random, Stage& stage) {
  const NodeId node = random.bits() % stage.nodes().size();
  switch (random.bits() % 4) {
    case 0:
      return stage.release(node);
    case 1:
      return stage.recover(node);
    case 2:
      return stage.hand_over(node, {.to = {.hz = 4}});
    default:
      return stage.apply_impulse(node, random.vector(0.5), random.vector(1));
  }
}

}  // namespace

TEST_CASE("what callbacks change is found again: sought, loaded, and given from the log of the inputs, to the bit") {
  int told = 0, between_blows = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    CAPTURE(seed);
    Random random(seed);
    const StageDescription row = random_row(random);
    Stage stage(row);
    const auto answer = [&] {
      REQUIRE(++told < 100'000);
      if (random.unit() < 0.6) change_something(random, stage);
    };
    stage.on_contact([&](const StageEvent&) { answer(); });
    stage.on_handoff([&](const HandOff&) { answer(); });
    while (stage.time() < 0.3) stage.advance(random.between(0, 0.06));
    const double end = stage.time();
    const std::uint64_t hash = stage.state_hash();
    const std::size_t handoffs = stage.handoffs().size(), events = stage.events().size();
    const std::vector<TimedInput> inputs = stage.inputs();
    between_blows +=
        static_cast<int>(std::ranges::count_if(inputs, [](const TimedInput& i) { return i.after_blows > 0; }));
    stage.on_contact({});
    stage.on_handoff({});
    Stage loaded(row), given(row);
    loaded.load(stage.save());
    for (Stage* const each : {&stage, &loaded}) {
      each->seek(random.between(0, end));
      each->seek(end);
    }
    static_cast<void>(advance_with(given, inputs, end));
    for (const Stage* const each : {&stage, &loaded, &given}) {
      CHECK(each->state_hash() == hash);
      CHECK(each->handoffs().size() == handoffs);
      CHECK(each->events().size() == events);
    }
  }
  CHECK(told > 300);
  CHECK(between_blows > 0);
}
