#include <tweenfall/physics/soft_body.h>
#include <tweenfall/physics/vehicle.h>

#include "curves/counted_allocations.h"
#include "support.h"

using namespace tweenfall;

namespace {

constexpr double dt = 1.0 / 120;

World world_on_a_floor() {
  World world({.sleep_after = std::numeric_limits<double>::infinity()});
  world.add({.shape = {Box{{100, 1, 100}}}, .fixed = true, .motion = {.pose = {.position = {0, -1, 0}}}});
  return world;
}

BodySettings box_at(const Vec3& place) {
  BodySettings body{.shape = {Box{{0.5, 0.5, 0.5}}}};
  body.motion.pose.position = place;
  return body;
}

/// How often memory is taken in some steps, after others to settle.
template <class Step>
std::size_t taken_by(const Step& step, int settling = 240, int counted = 120) {
  for (int i = 0; i < settling; ++i) step();
  const std::size_t before = test::allocations();
  for (int i = 0; i < counted; ++i) step();
  return test::allocations() - before;
}

SoftSettings hung_cloth(const Vec3& corner, double thickness, int cells) {
  SoftSettings cloth = tweenfall::cloth({.corner = corner, .columns = cells, .rows = cells});
  cloth.pins = {{.node = 0, .in_place = true}, {.node = static_cast<std::uint32_t>(cells), .in_place = true}};
  cloth.thickness = thickness;
  return cloth;
}

SoftSettings hung_rope(const Vec3& from) {
  SoftSettings line = rope({.from = from, .to = from - Vec3(0, 2, 0)});
  line.pins = {{.node = 0, .in_place = true}};
  return line;
}

}  // namespace

TEST_CASE("a settled step with sensors takes no memory") {
  World world = world_on_a_floor();
  for (int i = 0; i < 20; ++i) {
    world.add(box_at(Vec3(3 * i, 0.5, 0)));
    BodySettings sensor = box_at(Vec3(3 * i, 0.5, 0));
    sensor.sensor = true;
    sensor.fixed = true;
    world.add(sensor);
  }
  CHECK(taken_by([&] { world.step(dt); }) == 0);
  CHECK(world.sensor_overlaps().size() >= 20);
}

TEST_CASE("a settled step of ropes, cloths and volumes takes no memory, alone and beside each other") {
  const std::vector<SoftSettings> kinds{
      hung_cloth(Vec3(0, 3, 0), 0, 12),   hung_rope(Vec3(4, 3, 0)),
      hung_rope(Vec3(5, 3, 0)),           soft_box({.pose = {.position = {-3, 0.51, 0}}}),
      hung_cloth(Vec3(0, 3, 2), 0.04, 8), hung_cloth(Vec3(0.05, 3, 2), 0.04, 8)};
  for (std::size_t kind = 0; kind <= kinds.size(); ++kind) {
    CAPTURE(kind);
    World world = world_on_a_floor();
    const BodyId held = world.add(box_at(Vec3(4.5, 0.5, 0)));
    for (std::size_t i = 0; i < kinds.size(); ++i) {
      if (kind < kinds.size() && i != kind) continue;
      SoftSettings settings = kinds[i];
      // Two ropes hold one body.
      if (i == 1 || i == 2) settings.pins.push_back({.node = 20, .body = held, .in_place = true});
      add_soft(world, settings);
    }
    CHECK(taken_by([&] { world.step(dt); }, 40, 20) == 0);
  }
}

TEST_CASE("a settled step of a vehicle takes no memory, however stiff its struts") {
  for (const double stiffness : {30'000.0, 3e7}) {
    CAPTURE(stiffness);
    World world = world_on_a_floor();
    BodySettings body{.shape = {Box{Vec3(1.6, 0.1, 0.7)}}, .mass = 1000.0};
    body.motion.pose.position = Vec3(0, 0.6, 0);
    const BodyId chassis = world.add(body);
    VehicleSettings settings{.chassis = chassis, .wheels = {}};
    for (const double x : {1.3, -1.3})
      for (const double z : {-0.7, 0.7}) settings.wheels.push_back({.mount = Vec3(x, 0, z), .stiffness = stiffness});
    Vehicle vehicle(std::move(settings));
    CHECK(taken_by([&] {
            vehicle.act(world, dt);
            world.step(dt);
          }) == 0);
    CHECK(vehicle.reading(0).touches);
  }
}

TEST_CASE("a settled step takes no memory on two threads") {
  World world = world_on_a_floor();
  world.set_executor(std::make_shared<ThreadPool>(2));
  for (int column = 0; column < 40; ++column)
    for (int row = 0; row < 2 + column % 7; ++row) world.add(box_at(Vec3(3 * column, 0.5 + row, 0)));
  // Which thread does what is left to chance: once in a while one does more than ever before.
  std::size_t least = taken_by([&] { world.step(dt); });
  for (int i = 0; i < 20 && least > 0; ++i) least = std::min(least, taken_by([&] { world.step(dt); }, 0));
  CHECK(least == 0);
}

TEST_CASE("a settled step takes no memory whatever joints hold its bodies") {
  const JointKind kinds[] = {BallJoint{},
                             HingeJoint{},
                             SliderJoint{},
                             FixedJoint{},
                             DistanceJoint{},
                             WheelJoint{},
                             PulleyJoint{},
                             UniversalJoint{},
                             SwingTwistJoint{},
                             GearJoint{},
                             SpringJoint{.length = 1.5, .stiffness = 2000, .damping = 200}};
  World world = world_on_a_floor();
  double x = 0;
  for (const JointKind& kind : kinds) {
    x += 5;
    BodyId above;
    Pose pose;
    for (int link = 0; link < 3; ++link) {
      const BodyId body = world.add(box_at(Vec3(x, 8 - 1.5 * link, 0)));
      const Pose own = world.motion(body).pose;
      const JointFrames frames = joint_frames(pose, own, own.position + Vec3(0, 0.7, 0));
      world.add_joint({.a = above, .b = body, .frame_a = frames.a, .frame_b = frames.b, .kind = kind});
      above = body;
      pose = own;
    }
  }
  CHECK(taken_by([&] { world.step(dt); }, 1200) == 0);
}
