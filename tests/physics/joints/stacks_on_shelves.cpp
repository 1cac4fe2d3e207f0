#include <vector>

#include "joint_scene.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::jointed;

namespace {

constexpr double shelf_mass = 20, box_mass = 10;

/// A shelf that a weld holds at the origin, and boxes stacked near its other end.
struct StackOnShelf {
  World world;
  BodyId shelf;
  JointId weld;
  std::vector<BodyId> boxes;

  StackOnShelf(const WorldSettings& settings, int count) : world(settings) {
    shelf = add_box(world, {1, 0, 0}, {1, 0.05, 0.3}, shelf_mass);
    weld = join(world, {}, shelf, {0, 0, 0}, FixedJoint{});
    for (int i = 0; i < count; ++i)
      boxes.push_back(add_box(world, {1.7, 0.25 + 0.4 * i, 0}, {0.2, 0.2, 0.2}, box_mass));
  }
  /// By the law of the lever, N m.
  [[nodiscard]] double torque() const {
    double sum = shelf_mass * g * world.motion(shelf).pose.position.x();
    for (const BodyId& box : boxes) sum += box_mass * g * world.motion(box).pose.position.x();
    return sum;
  }
};

}  // namespace

TEST_CASE("a stack on a welded shelf comes to rest, and the weld bears its weight by the law of the lever") {
  for (const double rate : {60.0, 240.0})
    for (const int count : {2, 4, 6, 10}) {
      CAPTURE(rate);
      CAPTURE(count);
      StackOnShelf scene(awake, count);
      for (int i = 0; i < 6 * rate; ++i) scene.world.step(1 / rate);
      double fastest = 0, off = 0;
      for (int i = 0; i < rate; ++i) {
        scene.world.step(1 / rate);
        for (const BodyId& box : scene.boxes) fastest = std::max(fastest, scene.world.twist(box).linear.norm());
        const JointReading reading = scene.world.reading(scene.weld);
        const double weight = (shelf_mass + count * box_mass) * g;
        off = std::max(
            {off, std::abs(reading.force.y() / weight - 1), std::abs(reading.torque.z() / scene.torque() - 1)});
      }
      CHECK(fastest < 1e-3);
      CHECK(off < 1e-3);
      CHECK(std::abs(scene.world.motion(scene.boxes.back()).pose.position.x() - 1.7) < 0.02);
    }
}

TEST_CASE("a stack on a welded shelf falls asleep") {
  for (const int count : {4, 6}) {
    CAPTURE(count);
    StackOnShelf scene({}, count);
    for (int i = 0; i < 180; ++i) scene.world.step(1.0 / 60);
    CHECK(scene.world.asleep(scene.boxes.back()));
  }
}
