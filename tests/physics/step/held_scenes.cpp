#include <algorithm>
#include <cstdlib>

#include "physics/scene.h"

using namespace tweenfall;

// The scenes folder's scenes, held to the figures that its own pages name. Those that take minutes are measured when
// TWEENFALL_ALL_SCENES is set.

namespace {

/// Calls `test` with the scene of this name; if there is no such folder, it is said loudly.
template <class Test>
void with_scene(const std::string& name, const Test& test) {
  if (!std::filesystem::is_directory(test::scenes_folder())) {
    MESSAGE("SKIPPED: scene " << name << ", no folder " << test::scenes_folder().string());
    return;
  }
  for (test::Scene& scene : test::scenes(name)) test(scene);
}

bool all_scenes() {
  const bool all = std::getenv("TWEENFALL_ALL_SCENES") != nullptr;
  if (!all) MESSAGE("SKIPPED: takes longer than others; TWEENFALL_ALL_SCENES=1 runs it, as .ci/nightly does");
  return all;
}

/// Depth of each pair that was in contact, where its bodies are now.
std::vector<double> overlaps(const World& world) {
  std::vector<double> depths;
  depths.reserve(world.contacts().size());
  for (const Contact& contact : world.contacts()) {
    const Manifold now = collide(world.shape(contact.a), world.motion(contact.a).pose, world.shape(contact.b),
                                 world.motion(contact.b).pose);
    double depth = 0;
    for (int i = 0; i < now.count; ++i) depth = std::max(depth, now.points[static_cast<std::size_t>(i)].penetration);
    depths.push_back(depth);
  }
  return depths;
}

double energy_of(const test::Scene& scene) {
  double energy = scene.world.kinetic_energy();
  for (std::size_t i = 1; i < scene.bodies.size(); ++i)
    energy += scene.world.mass(scene.bodies[i]).mass * 9.81 * scene.world.motion(scene.bodies[i]).pose.position.y();
  return energy;
}

}  // namespace

TEST_CASE("a pushed plate under 25 balls and they speed up as the closed form says, in any direction") {
  for (const std::string name : {"sb_rolling_y", "sb_rolling_xy"})
    with_scene(name, [&](test::Scene& scene) {
      CAPTURE(name);
      const Vec3 along = scene.push.normalized();
      // With f = 0.4 (10 + 25) g below, a rolling ball gets 2/7 of the plate's acceleration.
      const double plate = (150 - 0.4 * 35 * 9.81) / (10 + 25 * 2.0 / 7), ball = plate * 2 / 7;
      double sum = 0;
      for (int i = 0; i < scene.steps; ++i) {
        scene.step();
        const double time = scene.world.time();
        double off = (scene.world.twist(scene.bodies[1]).linear - plate * time * along).squaredNorm();
        for (std::size_t k = 2; k < scene.bodies.size(); ++k)
          off += (scene.world.twist(scene.bodies[k]).linear - ball * time * along).squaredNorm() / 25;
        sum += off;
      }
      MESSAGE(name << ": mean squared error " << sum / scene.steps);
      CHECK(sum / scene.steps < 1e-6);
    });
}

TEST_CASE("balls that fall from 5 m and bounce without loss keep their energy") {
  if (!all_scenes()) return;
  with_scene("sb_bouncing", [](test::Scene& scene) {
    double sum = 0;
    for (int i = 0; i < scene.steps; ++i) {
      scene.step();
      const double off = energy_of(scene) - 24034.5;
      sum += off * off;
    }
    MESSAGE("sb_bouncing: mean (E - E0)^2 " << sum / scene.steps);
    CHECK(sum / scene.steps < 0.02);
  });
}

TEST_CASE("a block of 216 balls falls apart with hardly any overlap") {
  if (!all_scenes()) return;
  with_scene("sb_666", [](test::Scene& scene) {
    double sum = 0;
    for (int i = 0; i < scene.steps; ++i) {
      scene.step();
      for (const double depth : overlaps(scene.world)) sum += depth * depth;
    }
    MESSAGE("sb_666: mean squared overlap " << sum / scene.steps);
    CHECK(sum / scene.steps < 1e-6);
  });
}

TEST_CASE("a block of 216 balls that bounce without loss keeps its energy") {
  if (!all_scenes()) return;
  with_scene("sb_elastic666", [](test::Scene& scene) {
    const double before = energy_of(scene);
    double sum = 0;
    for (int i = 0; i < scene.steps; ++i) {
      scene.step();
      sum += std::pow(energy_of(scene) - before, 2);
    }
    MESSAGE("sb_elastic666: mean (E - E0)^2 " << sum / scene.steps);
    CHECK(sum / scene.steps < 10);
  });
}

TEST_CASE("a hundred ragdolls fall on each other, and their joints hardly open") {
  with_scene("ragdolls100", [](test::Scene& scene) {
    double sum = 0, most = 0;
    int readings = 0;
    for (int i = 0; i < scene.steps; ++i) {
      scene.step();
      for (const JointId joint : scene.world.joints()) {
        const double gap = scene.world.reading(joint).gap;
        sum += gap;
        most = std::max(most, gap);
        ++readings;
      }
    }
    MESSAGE("ragdolls100: joint gap " << 1000 * sum / readings << " mm in the mean, " << 1000 * most << " at most");
    CHECK(sum / readings < 0.35e-3);
    CHECK(most < 4e-3);
  });
}

TEST_CASE("a hundred ragdolls fall alike with one thread and with two, whoever is solved beside whom") {
  with_scene("ragdolls100", [](test::Scene& scene) {
    World shared = scene.world;
    shared.set_executor(std::make_shared<ThreadPool>(2));
    bool alike = true;
    for (int i = 0; i < 110 && alike; ++i) {
      scene.world.step(1.0 / 60);
      shared.step(1.0 / 60);
      for (const BodyId body : scene.bodies)
        alike = alike && scene.world.twist(body).linear == shared.twist(body).linear &&
                scene.world.twist(body).angular == shared.twist(body).angular;
      CAPTURE(i);
      CHECK(alike);
    }
  });
}

TEST_CASE("five thousand balls fall into a box and overlap by 24 mm at most") {
  with_scene("spheres5000", [](test::Scene& scene) {
    double most = 0;
    for (int i = 0; i < scene.steps; ++i) {
      scene.step();
      for (const double depth : overlaps(scene.world)) most = std::max(most, depth);
    }
    MESSAGE("spheres5000: overlap " << 1000 * most << " mm at most");
    CHECK(most < 24e-3);
  });
}

TEST_CASE("a pyramid of 50 rows stands for a minute") {
  with_scene("pyramid50", [](test::Scene& scene) {
    const Vec3 start = scene.world.motion(scene.bodies.back()).pose.position;
    const auto off = [&] { return (scene.world.motion(scene.bodies.back()).pose.position - start).norm(); };
    for (int i = 0; i < 1200; ++i) scene.step();
    MESSAGE("pyramid50: top off by " << 1000 * off() << " mm at 20 s");
    CHECK(off() < 0.1);
    if (!all_scenes()) return;
    for (int i = 1200; i < 3600; ++i) scene.step();
    MESSAGE("pyramid50: top off by " << 1000 * off() << " mm at 60 s");
    CHECK(off() < 0.355);
  });
}
