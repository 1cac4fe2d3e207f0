#include "physics/scenarios.h"

using namespace tweenfall;
using namespace tweenfall::test;

TEST_CASE("a copy taken at any step goes on in the same bits as the original") {
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.name);
    World original = scenario.make();
    World relay = original;  // copied anew before every step
    std::vector<World> branches;
    for (int n = 0; n < scenario.steps; ++n) {
      if (n % 40 == 20) branches.push_back(original);
      scenario.step(original, n);
      World next = relay;
      scenario.step(next, n);
      relay = std::move(next);
      for (World& branch : branches) scenario.step(branch, n);
      REQUIRE(relay.state_hash() == original.state_hash());
      for (const World& branch : branches) REQUIRE(branch.state_hash() == original.state_hash());
    }
  }
}

TEST_CASE("assigning an older state of a world takes it back, as often as one likes") {
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.name);
    World world = scenario.make();
    const int kept_at = scenario.steps / 2, end = kept_at + 20;
    for (int n = 0; n < kept_at; ++n) scenario.step(world, n);
    const World kept = world;
    for (int n = kept_at; n < end; ++n) scenario.step(world, n);
    const std::uint64_t once = world.state_hash();
    for (int again = 0; again < 3; ++again) {
      world = kept;
      CHECK(world.state_hash() == kept.state_hash());
      for (int n = kept_at; n < end; ++n) scenario.step(world, n);
      CHECK(world.state_hash() == once);
    }
  }
}

TEST_CASE("a step that a field stops leaves a world that goes on as if it had not been tried") {
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.name);
    World world = scenario.make(), other = world;
    for (int n = 0; n < scenario.steps; ++n) {
      if (n % 10 == 5) {
        World tried = world;
        const std::size_t field = tried.add_force(
            Field([](double, const Vec3&, const Vec3&, double) -> Vec3 { throw std::runtime_error("no"); }));
        try {
          tried.step(1.0 / 60);
        } catch (const std::runtime_error&) {
        }
        tried.remove_force(field);
        World untried = world;
        untried.remove_force(
            untried.add_force(Field([](double, const Vec3&, const Vec3&, double) { return Vec3(0, 0, 0); })));
        CHECK(tried.state_hash() == untried.state_hash());
      }
      scenario.step(world, n);
    }
  }
}
