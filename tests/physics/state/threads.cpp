#include <tweenfall/physics/executor.h>
#include <tweenfall/physics/strategies.h>

#include <algorithm>
#include <atomic>
#include <thread>

#include "physics/scenarios.h"
#include "threads/workers.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

/// Does all parts in reverse order, and claims that there are many threads.
class Backward : public Executor {
 public:
  void for_each(std::size_t count, const Work& work) override {
    ++calls;
    for (std::size_t i = count; i-- > 0;) work(i);
  }
  [[nodiscard]] std::size_t threads() const noexcept override { return 5; }
  int calls = 0;
};

World with_threads(World world, std::size_t threads) {
  world.set_executor(std::make_shared<ThreadPool>(threads));
  return world;
}

}  // namespace

TEST_CASE("any number of threads, and parts done in any order, end every step in the same bits") {
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.name);
    World alone = scenario.make();
    const auto backward = std::make_shared<Backward>();
    std::vector<World> others;
    for (const std::size_t threads : {1, 2, 3, 8}) others.push_back(with_threads(alone, threads));
    others.push_back(alone);
    others.back().set_executor(backward);
    for (int n = 0; n < scenario.steps; ++n) {
      CAPTURE(n);
      scenario.step(alone, n);
      // Eight threads on few processors take long: they see only the beginning, two of them see everything.
      if (n == 60) others.erase(others.begin() + 2, others.begin() + 4);
      for (World& other : others) {
        scenario.step(other, n);
        REQUIRE(other.state_hash() == alone.state_hash());
      }
    }
    CHECK(others.back().save() == alone.save());
  }
}

TEST_CASE("times of impact beside many pendulums are found to the same bits by any number of threads") {
  WorldSettings settings;
  settings.collision = Detection::time_of_impact;
  World alone(settings);
  alone.add({.shape = {Box{{100, 1, 100}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
  for (int i = 0; i < 40; ++i) {
    BodySettings ball{.shape = {Sphere{0.2}}, .restitution = 0.8};
    ball.motion.pose.position = Vec3(i, 1 + 0.05 * i, 0);
    alone.add(ball);
    ball.motion.pose.position.z() = 5;
    JointSettings joint{.b = alone.add(ball)};
    joint.frame_a.position = Vec3(i + 0.5, 1 + 0.05 * i, 5);
    joint.frame_b.position = Vec3(0.5, 0, 0);
    alone.add_joint(joint);
  }
  World shared = with_threads(alone, 2);
  for (int n = 0; n < 90; ++n) {
    CAPTURE(n);
    alone.step(1.0 / 60);
    shared.step(1.0 / 60);
    REQUIRE(shared.state_hash() == alone.state_hash());
  }
}

TEST_CASE("large worlds are shared out, small ones are not") {
  const auto calls = [](int bodies) {
    World world;
    const auto executor = std::make_shared<Backward>();
    world.set_executor(executor);
    for (int i = 0; i < bodies; ++i)
      world.add({.motion = {.pose = {.position = Vec3(0.9 * (i % 40), 0, 0.9 * (i / 40))}}});
    world.step(0.01);
    int shared = executor->calls;
    const World copy = world;  // shares the executor
    World again = copy;
    again.step(0.01);
    CHECK((executor->calls > shared) == (shared > 0));
    return shared;
  };
  CHECK(calls(10) == 0);
  CHECK(calls(1600) > 3);
}

TEST_CASE("threads of the settings step the world, and are refused beyond 0 to 256") {
  World two({.threads = 2}), none({.threads = 0});
  for (World* world : {&two, &none})
    for (int i = 0; i < 500; ++i)
      world->add({.motion = {.pose = {.position = Vec3(0.9 * (i % 10), 0.9 * (i / 100), 0.9 * (i / 10 % 10))}}});
  for (int n = 0; n < 20; ++n) {
    two.step(0.01);
    none.step(0.01);
  }
  CHECK(two.state_hash() == none.state_hash());
  CHECK(two.save() == none.save());
  CHECK_THROWS_WITH_AS(World({.threads = -1}), "threads must be 0 to 256, but are -1", std::invalid_argument);
  CHECK_THROWS_AS(World({.threads = 257}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(ThreadPool(0), "a pool has 1 to 256 threads, not 0", std::invalid_argument);
}

TEST_CASE("a pool does every part once, whoever asks and however often") {
  ThreadPool pool(4);
  std::atomic<int> wrong{0};
  const auto ask = [&] {
    for (int round = 0; round < 2000; ++round) {
      const std::size_t count = static_cast<std::size_t>(round % 37);
      std::vector<std::atomic<int>> done(count);
      const auto part = [&](std::size_t i) { done[i].fetch_add(1 + (round == 100 && i == 0)); };
      pool.for_each(count, Work(part));
      for (std::size_t i = 0; i < count; ++i)
        if (done[i] != 1 + (round == 100 && i == 0)) ++wrong;
    }
  };
  std::vector<std::thread> askers;
  for (int i = 0; i < 3; ++i) askers.emplace_back(ask);
  for (std::thread& asker : askers) asker.join();
  CHECK(wrong == 0);
  for (int i = 0; i < 50; ++i) ThreadPool unused(1 + static_cast<std::size_t>(i) % 9);
}

TEST_CASE("a pool does more parts than one job can have, and those of jobs of ever other sizes") {
  ThreadPool pool(3);
  std::vector<char> done((std::size_t{1} << 21) + 5, 0);
  const auto count_up = [&](std::size_t i) { ++done[i]; };
  pool.for_each(done.size(), Work(count_up));
  CHECK(std::all_of(done.begin(), done.end(), [](char times) { return times == 1; }));
  std::vector<int> sums(100, 0);
  const auto add = [&](std::size_t i) { ++sums[i]; };
  for (std::size_t size = 0; size <= sums.size(); ++size)
    for (const std::size_t count : {size, sums.size() - size, std::size_t{2}}) pool.for_each(count, Work(add));
  // Of 101 jobs of 0 to 100 parts, the i-th part is in those that have more than i.
  for (std::size_t i = 0; i < sums.size(); ++i) REQUIRE(sums[i] == 2 * (100 - static_cast<int>(i)) + (i < 2 ? 101 : 0));
}

TEST_CASE("of the parts that throw the first is heard, and all others are done") {
  ThreadPool pool(3);
  const threads::Workers workers(&pool);
  for (int round = 0; round < 200; ++round) {
    std::atomic<int> done{0};
    const auto part = [&](std::size_t i) {
      ++done;
      if (i % 7 == 3) throw std::runtime_error(std::to_string(i));
    };
    CHECK_THROWS_WITH_AS(workers.parts(40, part), "3", std::runtime_error);
    CHECK(done == 40);
  }
}

TEST_CASE(
    "what stops being finite is told with the same words by any number of threads, and fields run on the caller's") {
  std::string words;
  for (const std::size_t threads : {1, 2, 8}) {
    World world = with_threads(World({.gravity = Vec3(0, 0, 0)}), threads);
    for (int i = 0; i < 600; ++i) {
      BodySettings body;
      body.motion.pose.position = Vec3(3.0 * i, 0, 0);
      if (i % 100 == 57) body.motion.twist.linear = Vec3(0, 9e29, 0);
      world.add(body);
    }
    const std::thread::id here = std::this_thread::get_id();
    bool elsewhere = false;
    world.add_force(Field([&](double, const Vec3& place, const Vec3&, double time) -> Vec3 {
      elsewhere = elsewhere || std::this_thread::get_id() != here;
      if (time > 0.5 && place.x() > 30) throw std::runtime_error("at " + std::to_string(place.x()));
      return Vec3(0, 0, 0);
    }));
    const World start = world;
    try {
      world.step(1e9);
      FAIL("must throw");
    } catch (const NotFinite& fault) {
      if (words.empty()) words = fault.what();
      CHECK(words == fault.what());
      CHECK(fault.body.index == 57);
    } catch (const std::runtime_error& error) {
      CHECK(std::string(error.what()) == "at 33.000000");
    }
    CHECK(!elsewhere);
  }
}
