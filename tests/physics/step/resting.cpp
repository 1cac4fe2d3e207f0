#include "physics/scene.h"

using namespace tweenfall;
using test::near;

namespace {

BodySettings unit_box(double height) {
  BodySettings box;
  box.shape.solid = Box{Vec3(0.5, 0.5, 0.5)};
  box.mass = 1;
  box.motion.pose.position = Vec3(0, height, 0);
  return box;
}

}  // namespace

TEST_CASE("a stack of ten boxes stands for ten seconds within a centimeter, then sleeps") {
  for (const double rate : {60.0, 240.0}) {
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    std::vector<BodyId> boxes;
    for (int i = 0; i < 10; ++i) boxes.push_back(world.add(unit_box(0.5 + i)));
    for (int i = 0; i < static_cast<int>(10 * rate); ++i) world.step(1 / rate);
    for (int i = 0; i < 10; ++i)
      CHECK((world.motion(boxes[static_cast<std::size_t>(i)]).pose.position - Vec3(0, 0.5 + i, 0)).norm() < 0.01);
    CHECK(world.asleep(boxes.front()));
    CHECK(world.asleep(boxes.back()));
    CHECK(world.still_for(boxes.back()) > 5);
    // What happens to one is felt by all.
    world.apply_impulse(boxes[5], Vec3(1, 0, 0), world.motion(boxes[5]).pose.position);
    world.step(1 / rate);
    CHECK(!world.asleep(boxes.front()));
    CHECK(!world.asleep(boxes.back()));
  }
}

TEST_CASE("a pyramid of boxes stands, and its top stays where it was") {
  for (const std::string name : {"pyramid_small", "pyramid20"}) {
    if (name == "pyramid20" && !std::filesystem::is_directory(test::scenes_folder())) {
      MESSAGE("SKIPPED: scene " << name << ", no folder " << test::scenes_folder().string());
      continue;
    }
    for (test::Scene& scene : test::scenes(name)) {
      CAPTURE(scene.file["name"].get<std::string>());
      const Vec3 start = scene.world.motion(scene.bodies.back()).pose.position;
      for (int i = 0; i < scene.steps; ++i) scene.step();
      CHECK((scene.world.motion(scene.bodies.back()).pose.position - start).norm() < 0.02);
    }
  }
}

TEST_CASE("a box on a slope slides with g (sin a - mu cos a) below the friction angle's tangent, and stays above it") {
  bool slid = false, stayed = false;
  for (test::Scene& scene : test::scenes("slope_mu")) {
    CAPTURE(scene.file["name"].get<std::string>());
    const BodyId box = scene.bodies.back();
    const double friction = scene.file["bodies"].back()["friction"];
    const double gravity = test::vector_from(scene.file["gravity"]).norm();
    const Vec3 normal = scene.world.motion(scene.bodies.front()).pose.rotation * Vec3(0, 1, 0);
    const double cosine = normal.y(), sine = std::sqrt(1 - cosine * cosine);
    if (friction < sine / cosine) {
      for (int i = 0; i < scene.steps; ++i) scene.step();
      const double expected = gravity * (sine - friction * cosine) * scene.steps * scene.dt;
      CHECK(std::abs(scene.world.twist(box).linear.norm() - expected) < 1e-4);
      slid = true;
    } else {
      // It may settle into its contact first.
      for (int i = 0; i < 31; ++i) scene.step();
      const Vec3 settled = scene.world.motion(box).pose.position;
      for (int i = 0; i < scene.steps; ++i) scene.step();
      CHECK((scene.world.motion(box).pose.position - settled).norm() < 1e-6);
      stayed = true;
    }
  }
  CHECK(slid);
  CHECK(stayed);
}

TEST_CASE("a ball rolls down a slope with 5/7 g sin a") {
  WorldSettings settings;
  const double sine = 0.5, cosine = std::sqrt(0.75);
  settings.gravity = 9.81 * Vec3(sine, -cosine, 0);
  World world(settings);
  world.add({.shape = {Plane{}}, .friction = 1, .fixed = true});
  BodySettings ball;
  ball.shape.solid = Sphere{0.5};
  ball.friction = 1;
  ball.motion.pose.position = Vec3(0, 0.5, 0);
  const BodyId body = world.add(ball);
  for (int i = 0; i < 480; ++i) world.step(1.0 / 240);
  const double speed = 5.0 / 7 * 9.81 * sine * 2;
  CHECK(near(world.twist(body).linear.x(), speed, 1e-4));
  CHECK(near(world.twist(body).angular.z(), -speed / 0.5, 1e-4));
}

TEST_CASE("rolling friction stops a ball that would roll forever") {
  for (const double resistance : {0.0, 0.02}) {
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    BodySettings ball;
    ball.shape.solid = Sphere{0.5};
    ball.rolling_friction = resistance;
    ball.motion.pose.position = Vec3(0, 0.5, 0);
    ball.motion.twist = {Vec3(1, 0, 0), Vec3(0, 0, -2)};
    const BodyId body = world.add(ball);
    // Rolling: (7/5) m a = -m g b / r, so it stops after v / (5 g b / (7 r)) = 3.57 s, v^2 / 2a = 1.784 m away.
    for (int i = 0; i < 240 * 5; ++i) world.step(1.0 / 240);
    if (resistance == 0) CHECK(near(world.motion(body).pose.position.x(), 5.0, 1e-3));
    if (resistance > 0) CHECK(near(world.motion(body).pose.position.x(), 7 * 0.5 / (10 * 9.81 * 0.02), 0.01));
  }
}

TEST_CASE("overlap is taken apart slowly and gives no speed") {
  for (const double depth : {0.005, 0.05, 0.2}) {
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    const BodyId body = world.add(unit_box(0.5 - depth));
    double before = 0.5 - depth, fastest = 0, highest = 0, most = 0;
    for (int i = 0; i < 480; ++i) {
      world.step(1.0 / 240);
      const double height = world.motion(body).pose.position.y();
      fastest = std::max(fastest, (height - before) * 240);
      highest = std::max(highest, height);
      most = std::max(most, world.kinetic_energy());
      before = height;
    }
    CHECK(fastest <= 0.5 + 1e-9);
    CHECK(highest <= 0.501);
    CHECK(highest > 0.499);
    CHECK(most < 1e-6);
  }
}

TEST_CASE("crates that are pushed out of the floor, and of each other, go straight up") {
  for (const double rate : {240.0, 60.0})
    for (const double depth : {0.5, 0.2, 0.05})
      for (const int count : {1, 2}) {
        World world;
        world.add({.shape = {Plane{}}, .fixed = true});
        std::vector<BodyId> crates;
        for (int i = 0; i < count; ++i) crates.push_back(world.add(unit_box(0.5 - depth + (1 - depth) * i)));
        CAPTURE(rate);
        CAPTURE(depth);
        CAPTURE(count);
        for (int i = 0; i < static_cast<int>(4 * rate); ++i) world.step(1 / rate);
        for (int i = 0; i < count; ++i) {
          const Pose pose = world.motion(crates[static_cast<std::size_t>(i)]).pose;
          CHECK((pose.position - Vec3(0, 0.5 + i, 0)).norm() < 5e-4);
          CHECK(2 * pose.rotation.vec().norm() < 5e-4);
        }
      }
}

TEST_CASE("a plate that bears many lies on a plate that bears many, whoever came first") {
  for (const bool plates_first : {true, false})
    for (const int rows : {7, 12}) {
      CAPTURE(plates_first);
      CAPTURE(rows);
      World world;
      world.add({.shape = {Plane{}}, .fixed = true});
      BodyId top;
      const auto add_plates = [&] {
        world.add({.shape = {Box{Vec3(2.2, 0.1, 1.1)}}, .mass = 50, .motion = {{.position = Vec3(1, 0.1, 0)}}});
        top = world.add({.shape = {Box{Vec3(1, 0.1, 1)}}, .mass = 50, .motion = {{.position = Vec3(0, 0.3, 0)}}});
      };
      if (plates_first) add_plates();
      for (int i = 0; i < rows; ++i)
        for (int k = 0; k < rows; ++k)
          for (const Vec3& on : {Vec3(-0.9, 0.45, -0.9), Vec3(1.2, 0.25, -0.9)})
            world.add({.shape = {Sphere{0.05}},
                       .mass = 0.1,
                       .motion = {{.position = on + 1.8 / (rows - 1) * Vec3(i, 0, k)}}});
      if (!plates_first) add_plates();
      for (int i = 0; i < 30; ++i) world.step(1.0 / 60);
      CHECK((world.motion(top).pose.position - Vec3(0, 0.3, 0)).norm() < 5e-3);
    }
}

TEST_CASE("of many at one point each touches no more others than push it away") {
  constexpr int count = 1000;
  constexpr std::size_t each = 16;
  const std::vector<Shape> shapes{{Sphere{0.1}}, {Box{Vec3(0.1, 0.1, 0.1)}}, {Capsule{0.08, 0.07}}};
  World world({.gravity = Vec3::Zero()});
  for (int i = 0; i < count; ++i) world.add({.shape = shapes[static_cast<std::size_t>(i) % shapes.size()]});
  for (int i = 0; i < 3; ++i) {
    world.step(1.0 / 60);
    CHECK(world.contacts().size() > count);
    CHECK(world.contacts().size() <= each * count);
  }
}

TEST_CASE("a column that begins in itself is taken apart gently: nothing is thrown, tilted or lifted too far") {
  constexpr double size = 1, push = 0.5;
  for (const double dt : {1.0 / 60, 1.0 / 240})
    for (const int count : {10, 20})
      for (const double depth : {0.02, 0.05, 0.1}) {
        CAPTURE(dt);
        CAPTURE(count);
        CAPTURE(depth);
        World world;
        world.add({.shape = {Plane{}}, .fixed = true});
        std::vector<BodyId> boxes;
        for (int i = 0; i < count; ++i)
          boxes.push_back(
              world.add({.shape = {Box{Vec3(size / 2, size / 2, size / 2)}},
                         .mass = 1.0,
                         .motion = {.pose = {.position = Vec3(0, (size - depth) * (i + 1) - size / 2, 0)}}}));
        const double rest = size * (count - 0.5);
        double fastest = 0, quickest = 0, highest = -HUGE_VAL, astray = 0;
        for (int i = 0; i < 6 / dt; ++i) {
          const double before = world.motion(boxes.back()).pose.position.y();
          world.step(dt);
          const double top = world.motion(boxes.back()).pose.position.y();
          highest = std::max(highest, top - rest);
          quickest = std::max(quickest, (top - before) / dt);
          for (const BodyId& box : boxes) {
            const Vec3 place = world.motion(box).pose.position;
            fastest = std::max(fastest, world.twist(box).linear.norm());
            astray = std::max(astray, std::hypot(place.x(), place.z()));
          }
        }
        MESSAGE(count << " boxes, " << 1e3 * depth << " mm in each other, steps of 1/" << 1 / dt << " s: at most "
                      << fastest << " m/s, shifted at " << quickest << ", " << 1e3 * highest << " mm too high, "
                      << 1e3 * astray << " mm astray");
        CHECK(fastest < 0.2);
        CHECK(quickest < push + 0.1);
        CHECK(highest < 5e-4);
        CHECK(astray < 0.05);
        CHECK(std::abs(world.motion(boxes.back()).pose.position.y() - rest) < 5e-3);
        CHECK(world.kinetic_energy() < 1e-2);  // the tallest still sways a little
      }
}

TEST_CASE("a row that begins in itself where nothing holds it parts about its center, and goes on so after loading") {
  World world({.gravity = Vec3(0, 0, 0)});
  std::vector<BodyId> boxes;
  for (int i = 0; i < 15; ++i)
    boxes.push_back(world.add({.shape = {Box{Vec3(0.5, 0.5, 0.5)}},
                               .mass = 1.0 + i % 3,
                               .motion = {.pose = {.position = Vec3(0.9 * i, 0, 0)}}}));
  const auto center = [&boxes](const World& of) {
    Vec3 sum = Vec3::Zero();
    double mass = 0;
    for (const BodyId& box : boxes) {
      sum += of.mass(box).mass * of.motion(box).pose.position;
      mass += of.mass(box).mass;
    }
    return Vec3(sum / mass);
  };
  const Vec3 start = center(world);
  World loaded;
  for (int i = 0; i < 600; ++i) {
    world.step(1.0 / 60);
    if (i == 20) loaded.load(world.save());
    if (i > 20) loaded.step(1.0 / 60);
  }
  CHECK(loaded.state_hash() == world.state_hash());
  CHECK((center(world) - start).norm() < 1e-9);
  CHECK(world.kinetic_energy() < 1e-6);
  for (std::size_t i = 1; i < boxes.size(); ++i)
    CHECK(world.motion(boxes[i]).pose.position.x() - world.motion(boxes[i - 1]).pose.position.x() > 1 - 1e-3);
}
