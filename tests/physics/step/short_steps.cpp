#include "physics/scene.h"

using namespace tweenfall;

namespace {

struct Tower {
  World world;
  std::vector<BodyId> boxes;
  std::array<Vec3, 10> places;
  explicit Tower(double lean = 0, double restitution = 0) : world({.sleep_after = 1e300}) {
    world.add({.shape = {Plane{}}, .restitution = restitution, .fixed = true});
    for (int i = 0; i < 10; ++i) {
      BodySettings box;
      box.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
      box.restitution = restitution;
      box.motion.pose.position = Vec3(lean * i, 0.5 + i, 0);
      boxes.push_back(world.add(box));
    }
  }
  /// Settled under its own weight.
  Tower& settle(int steps) {
    for (int i = 0; i < steps; ++i) world.step(1.0 / 240);
    for (std::size_t i = 0; i < boxes.size(); ++i) places[i] = world.motion(boxes[i]).pose.position;
    return *this;
  }
  double strayed() const {
    double most = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i)
      most = std::max(most, (world.motion(boxes[i]).pose.position - places[i]).norm());
    return most;
  }
  double fastest() const {
    double most = 0;
    for (const BodyId box : boxes) most = std::max(most, world.twist(box).linear.norm());
    return most;
  }
};

}  // namespace

TEST_CASE("a stack of ten stands within 0.1 mm whatever short steps come between the long ones") {
  const double ulp = std::nextafter(3.7, 4.0) - 3.7;
  for (const double restitution : {0.0, 0.5})
    for (const double lean : {0.0, 0.02}) {
      CAPTURE(lean);
      CAPTURE(restitution);
      Tower tower(lean, restitution);
      tower.settle(120);
      test::Random random(7);
      const double lengths[] = {1.0 / 240, 1e-12, 1e-9, 1e-6, 1e-4, ulp};
      double fastest = 0;
      for (int i = 0; i < 240; ++i) {
        const auto pick = static_cast<std::size_t>(random.between(0, 5.999));
        tower.world.step(i % 2 == 0 ? 1.0 / 240 : lengths[pick]);
        fastest = std::max(fastest, tower.fastest());
      }
      CHECK(tower.strayed() < 1e-4);
      CHECK(fastest < 0.01);
    }
}

TEST_CASE("short steps alone, one length after another, leave a stack where it stood") {
  const Tower standing = Tower().settle(240);
  for (const double length : {1e-12, 1e-9, 1e-6, 1e-4, 4e-16})
    for (const int run : {1, 7, 40}) {
      CAPTURE(length);
      CAPTURE(run);
      Tower fresh;
      for (int i = 0; i < run; ++i) fresh.world.step(length);
      CHECK(fresh.fastest() < 1e-2);
      Tower tower = standing;
      for (int round = 0; round < 3; ++round) {
        for (int i = 0; i < 8; ++i) tower.world.step(1.0 / 240);
        for (int i = 0; i < run; ++i) tower.world.step(length);
      }
      // Milliseconds in steps of 0.1 ms press the contacts slightly differently.
      CHECK(tower.strayed() < (run * length > 1e-3 ? 2e-4 : 1e-4));
      CHECK(tower.fastest() < 0.01);
    }
}

TEST_CASE("a pause of a short step does not change where a ball on a keyed lift is carried") {
  for (const double pause : {0.0, 1e-12, 4e-16, 1e-9}) {
    World world({.sleep_after = 1e300});
    BodySettings lift;
    lift.shape.solid = Box{Vec3(1, 0.1, 1)};
    lift.drive = Drive::keyed();
    lift.motion.pose.position = Vec3(80, -0.1, 0);
    lift.motion.twist.linear = Vec3(0, 1, 0);
    const BodyId floor = world.add(lift);
    BodySettings box;
    box.shape.solid = Box{Vec3(0.2, 0.2, 0.2)};
    box.motion.pose.position = Vec3(80, 0.2, 0);
    box.motion.twist.linear = Vec3(0, 1, 0);
    const BodyId body = world.add(box);
    double time = 0;
    const auto step = [&](double dt) {
      time += dt;
      Motion target = lift.motion;
      target.pose.position.y() += time;
      world.set_target(floor, target);
      world.step(dt);
    };
    for (int i = 0; i < 240; ++i) {
      step(1.0 / 240);
      if (pause > 0) step(pause);
      CHECK(std::abs(world.twist(body).linear.y() - 1) < 1e-3);
    }
    CHECK(std::abs(world.motion(body).pose.position.y() - 0.2 - time) < 1e-4);
  }
}
