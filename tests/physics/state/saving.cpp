#include <cstring>

#include "physics/saved_bytes.h"
#include "physics/scenarios.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

World loaded(std::span<const std::byte> saved) {
  World world;
  world.add({.motion = {.pose = {.position = Vec3(9, 9, 9)}}});  // nothing of it must be left
  world.step(0.01);
  world.load(saved);
  return world;
}

/// Some of everything that a world can hold.
World varied() {
  const std::vector<Scenario> all = scenarios();
  World world = all[0].make();
  for (int n = 0; n < 105; ++n) all[0].step(world, n);
  const std::vector<BodyId> bodies = world.bodies();
  world.add_force(Spring{.a = bodies[2], .b = bodies[3], .rest_length = 1, .stiffness = 20});
  world.add_force(Drag{.linear = 0.5});
  world.ignore(bodies[4], bodies[5]);
  world.set_groups(bodies[6], 2, 5);
  return world;
}

}  // namespace

TEST_CASE("a world that was saved at any step and loaded goes on in the same bits") {
  for (const Scenario& scenario : scenarios()) {
    CAPTURE(scenario.name);
    World original = scenario.make();
    World relay = original;  // saved and loaded before every step
    std::vector<World> branches;
    for (int n = 0; n < scenario.steps; ++n) {
      const std::vector<std::byte> saved = relay.save();
      REQUIRE(saved == original.save());
      if (n % 80 == 10) branches.push_back(loaded(saved));
      relay = loaded(saved);
      REQUIRE(relay.save() == saved);
      scenario.step(original, n);
      scenario.step(relay, n);
      for (World& branch : branches) scenario.step(branch, n);
      REQUIRE(relay.state_hash() == original.state_hash());
      for (const World& branch : branches) REQUIRE(branch.state_hash() == original.state_hash());
      REQUIRE(relay.contacts().size() == original.contacts().size());
    }
  }
}

TEST_CASE("handles, shapes and free places come back as they were saved") {
  World world = varied();
  const std::vector<BodyId> before = world.bodies();
  World again = loaded(world.save());
  CHECK(again.bodies() == before);
  for (const BodyId body : before) {
    CHECK(again.mass(body).inertia == world.mass(body).inertia);
    CHECK(again.mass(body).center == world.mass(body).center);
    CHECK(again.drive(body) == world.drive(body));
    CHECK(again.shape(body).solid.index() == world.shape(body).solid.index());
  }
  CHECK(!again.collides(before[4], before[5]));
  CHECK(again.time() == world.time());
  // What is added and removed next gets the same handles and numbers.
  CHECK(again.add({}) == world.add({}));
  CHECK(again.add_force(Drag{}) == world.add_force(Drag{}));
  world.remove_force(0);
  again.remove_force(0);
  for (int i = 0; i < 30; ++i) {
    world.step(0.01);
    again.step(0.01);
  }
  CHECK(again.state_hash() == world.state_hash());
}

TEST_CASE("a hull that was loaded is the hull that was saved, to the bit, also when rounding makes it hard") {
  Random random(21);
  for (int n = 0; n < 300; ++n) {
    std::vector<Vec3> points;
    const int kind = n % 4, count = 6 + n % 60;
    for (int i = 0; i < count; ++i) {
      Vec3 point = random.vector(1);
      if (kind == 1) point.normalize();
      if (kind == 2) point = Vec3(std::round(3 * point.x()), std::round(3 * point.y()), std::round(3 * point.z()));
      if (kind == 3) point[i % 3] = 1 + 1e-7 * point[i % 3];
      points.push_back(point);
    }
    std::optional<ConvexHull> made;
    try {
      made.emplace(points);
    } catch (const std::invalid_argument&) {
      continue;  // flat, or depends on rounding
    }
    const ConvexHull& hull = *made;
    World world;
    const BodyId first = world.add({.shape = {Hull{hull}}}), second = world.add({.shape = {Hull{hull}}});
    const World again = loaded(world.save());
    const ConvexHull& read = std::get<Hull>(again.shape(first).solid).convex;
    REQUIRE(read.vertices().data() == std::get<Hull>(again.shape(second).solid).convex.vertices().data());
    REQUIRE(std::ranges::equal(read.vertices(), hull.vertices()));
    REQUIRE(std::ranges::equal(read.faces(), hull.faces(), [](const auto& a, const auto& b) {
      return a.normal == b.normal && a.offset == b.offset && a.first == b.first && a.corners == b.corners;
    }));
    REQUIRE(std::ranges::equal(read.edges(), hull.edges(), [](const auto& a, const auto& b) {
      return a.from == b.from && a.to == b.to && a.left == b.left && a.right == b.right;
    }));
    for (std::size_t i = 0; i < hull.vertices().size(); ++i)
      REQUIRE(std::ranges::equal(read.neighbors(i), hull.neighbors(i)));
    REQUIRE(read.measures().inertia == hull.measures().inertia);
    REQUIRE(read.inner_radius() == hull.inner_radius());
    REQUIRE(read.outer_radius() == hull.outer_radius());
  }
}

TEST_CASE("vertices and faces that are no convex hull are refused") {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  using Faces = std::vector<std::vector<std::uint32_t>>;
  const Faces good{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  CHECK(ConvexHull(corners, good).edges().size() == 6);
  const std::vector<Faces> bad{{},
                               {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}},
                               {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}},
                               {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 4}},
                               {{0, 2, 1}, {0, 2, 1}, {0, 3, 2}, {1, 2, 3}},
                               {{0, 2}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}},
                               {{0, 2, 1, 0}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
  for (const Faces& faces : bad) {
    CAPTURE(faces.size());
    CHECK_THROWS_AS(ConvexHull(corners, faces), std::invalid_argument);
  }
  std::vector<Vec3> dented = corners;
  dented.push_back(Vec3(0.2, 0.2, 0.2));
  CHECK_THROWS_AS(ConvexHull(dented, Faces{{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 4}, {2, 3, 4}, {3, 1, 4}}),
                  std::invalid_argument);
}

TEST_CASE("a world with a field, or with a body that is not finite, says why it cannot be saved") {
  World world;
  const std::size_t field =
      world.add_force(Field([](double, const Vec3&, const Vec3&, double) { return Vec3(0, 0, 0); }));
  CHECK_THROWS_WITH_AS((void)world.save(),
                       "a world with a field cannot be saved, since a field is a function: remove it with "
                       "remove_force, and add it again after loading",
                       std::invalid_argument);
  world.remove_force(field);
  CHECK(!world.save().empty());
  const BodyId body = world.add({});
  Motion fast;
  fast.twist.linear = Vec3(9e29, 0, 0);
  world.set_motion(body, fast);
  CHECK_THROWS_AS(world.step(1e20), NotFinite);
  CHECK_THROWS_WITH_AS((void)world.save(), "a world whose body 0 is not finite cannot be saved", std::invalid_argument);
}

TEST_CASE("bytes that are no saved world are refused in words, and change nothing") {
  const std::vector<std::byte> good = varied().save();
  World world = varied();
  world.step(0.01);
  const std::uint64_t hash = world.state_hash();
  const auto refused = [&](std::vector<std::byte> bytes, const std::string& words) {
    CAPTURE(words);
    CHECK_THROWS_WITH_AS(world.load(bytes), words.c_str(), std::invalid_argument);
    CHECK(world.state_hash() == hash);
  };
  refused({}, "these 0 bytes are too few for a saved world");
  std::vector<std::byte> bytes = good;
  bytes[0] = std::byte{'T'};
  refused(bytes, "these bytes are no saved world: they do not begin with \"tweenfall world\"");
  bytes = good;
  put(bytes, 16, 8, 4);
  refused(bytes, "this saved world is of version 8; only version 12 can be read");
  bytes = good;
  bytes.pop_back();
  refused(bytes, "a saved world should have " + std::to_string(good.size() - header) +
                     " bytes after its header, but has " + std::to_string(good.size() - header - 1));
  bytes = good;
  bytes[good.size() / 2] ^= std::byte{1};
  refused(bytes, "a saved world was damaged: its checksum is not that of its contents");
  bytes = good;
  bytes.push_back(std::byte{0});
  seal(bytes);
  refused(bytes, "a saved world is wrong at byte " + std::to_string(good.size() - header) +
                     " of its contents: there is more data than a world");
  bytes.resize(good.size() - 5);
  seal(bytes);
  CHECK_THROWS_AS(world.load(bytes), std::invalid_argument);
  // Settings come first: gravity, integrator, iterations; then the bodies' count.
  bytes = good;
  put(bytes, header + 24, 9, 4);
  seal(bytes);
  refused(bytes, "a saved world has a bad setting: there is no such integrator");
  for (const std::uint64_t iterations : {0, 10'001}) {
    bytes = good;
    put(bytes, header + 28, iterations, 4);
    seal(bytes);
    refused(bytes,
            "a saved world has a bad setting: iterations must be 1 to 10000, but are " + std::to_string(iterations));
  }
  bytes = good;
  put(bytes, header + 60, 1ull << 60);
  seal(bytes);
  refused(bytes, "a saved world is wrong at byte 69 of its contents: it tells of more than there is room for");
  CHECK(world.state_hash() == hash);
  world.load(good);
  CHECK(world.save() == good);
}

TEST_CASE("saved bytes that were changed are refused, or are a world that steps, with a hash of its own") {
  const char* many = std::getenv("TWEENFALL_MUTATIONS");
  const int rounds = many ? std::atoi(many) : 3000;
  std::vector<std::vector<std::byte>> seeds{varied().save()};
  for (const Scenario& scenario : scenarios()) {
    World world = scenario.make();
    for (int n = 0; n < scenario.steps / 2; ++n) scenario.step(world, n);
    if (world.bodies().size() < 60) seeds.push_back(world.save());
  }
  Random random(99);
  int accepted = 0;
  for (int round = 0; round < rounds; ++round) {
    CAPTURE(round);
    const std::vector<std::byte>& seed = seeds[random.bits() % seeds.size()];
    std::vector<std::byte> bytes = seed;
    const int edits = 1 + static_cast<int>(random.bits() % 3);
    for (int i = 0; i < edits; ++i) {
      const std::size_t at = header + random.bits() % (bytes.size() - header - 8);
      const double numbers[] = {0, -1, 1e300, 1e-300, std::numeric_limits<double>::infinity(), std::nan(""), 1e29};
      switch (random.bits() % 6) {
        case 0:
          bytes[at] ^= static_cast<std::byte>(1u << random.bits() % 8);
          break;
        case 1:
          bytes[at] = static_cast<std::byte>(random.bits());
          break;
        case 2:
          put(bytes, at, random.bits(), 4);
          break;
        case 3:
          put(bytes, header + (at - header) / 8 * 8, std::bit_cast<std::uint64_t>(numbers[random.bits() % 7]));
          break;
        case 4:
          bytes.erase(bytes.begin() + static_cast<std::ptrdiff_t>(at));
          break;
        default:
          bytes[at] = std::byte{0xff};
          break;
      }
    }
    seal(bytes);
    World world;
    try {
      world.load(bytes);
    } catch (const std::invalid_argument&) {
      continue;
    }
    ++accepted;
    World original;
    original.load(seed);
    REQUIRE((world.state_hash() == original.state_hash()) == (world.save() == seed));
    try {
      for (int i = 0; i < 3; ++i) world.step(1.0 / 60);
      static_cast<void>(world.save());
    } catch (const NotFinite&) {
    }
  }
  MESSAGE(accepted << " of " << rounds << " were worlds");
  CHECK(accepted > rounds / 20);
}
