#include <thread>

#include "physics/scenarios.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

bool same_contact(const Contact& a, const Contact& b) {
  const auto same_point = [](const ContactPoint& one, const ContactPoint& other) {
    return one.position == other.position && one.penetration == other.penetration && one.feature == other.feature;
  };
  const auto count = static_cast<std::size_t>(a.manifold.count);
  return a.a == b.a && a.b == b.b && a.manifold.normal == b.manifold.normal && a.manifold.count == b.manifold.count &&
         std::equal(a.manifold.points.begin(), a.manifold.points.begin() + static_cast<std::ptrdiff_t>(count),
                    b.manifold.points.begin(), same_point) &&
         a.impulse == b.impulse && a.total_impulse == b.total_impulse && a.approach_speed == b.approach_speed &&
         a.began == b.began && a.part_a == b.part_a && a.part_b == b.part_b;
}

}  // namespace

TEST_CASE("a copy taken at any step goes on in the same bits as the original") {
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.name);
    World original = scenario.make();
    World relay = original;  // copied again before every step
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

TEST_CASE("contacts are told alike by a world, its copies and whom it was loaded into, whenever they are asked") {
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.name);
    World world = scenario.make();
    std::size_t seen = 0;
    for (int n = 0; n < scenario.steps; ++n) {
      scenario.step(world, n);
      if (n % 7 != 3) continue;
      CAPTURE(n);
      const World copy = world;  // before anyone asked
      World loaded;
      loaded.load(world.save());
      std::vector<Contact> told(world.contacts().begin(), world.contacts().end());
      seen += told.size();
      // By several threads at once: one of them assembles them.
      std::vector<std::size_t> counts(3);
      std::vector<std::thread> askers;
      for (std::size_t& count : counts) askers.emplace_back([&copy, &count] { count = copy.contacts().size(); });
      for (std::thread& asker : askers) asker.join();
      for (const std::size_t count : counts) CHECK(count == told.size());
      REQUIRE(std::ranges::equal(copy.contacts(), told, same_contact));
      REQUIRE(std::ranges::equal(loaded.contacts(), told, same_contact));
      // They are those of the last step, whatever was done since.
      for (const BodyId body : loaded.bodies()) {
        Motion motion = loaded.motion(body);
        motion.pose.position += Vec3(1, 2, 3);
        if (!loaded.is_fixed(body)) loaded.apply_force(body, Vec3(0, 5, 0), Vec3(0, 0, 0));
        loaded.set_motion(body, motion);
      }
      loaded.add({.shape = {Sphere{0.5}}});
      const World later = loaded;
      REQUIRE(std::ranges::equal(loaded.contacts(), told, same_contact));
      REQUIRE(std::ranges::equal(later.contacts(), told, same_contact));
      if (told.empty()) continue;
      // A removed body takes its own along.
      const BodyId leaves = told[told.size() / 2].b;
      loaded.remove(leaves);
      std::erase_if(told, [&](const Contact& contact) { return contact.a == leaves || contact.b == leaves; });
      REQUIRE(std::ranges::equal(loaded.contacts(), told, same_contact));
    }
    CHECK(seen > 3);
  }
}
