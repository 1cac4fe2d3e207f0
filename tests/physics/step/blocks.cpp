#include <tweenfall/physics/world.h>

#include <cstring>

#include "contacts/contact_constraint.h"
#include "islands/blocks/coloring.h"
#include "islands/blocks/contact_block.h"
#include "islands/blocks/island_body.h"
#include "support.h"

using namespace tweenfall;

TEST_CASE("no two contacts of one color share a movable body, whatever touches what") {
  test::Random random(3);
  for (int round = 0; round < 50; ++round) {
    const std::uint32_t bodies = 2 + static_cast<std::uint32_t>(random.between(0, 60));
    std::vector<char> movable(bodies);
    for (char& moves : movable) moves = random.between(0, 1) < 0.8;
    blocks::Coloring coloring;
    coloring.reset(bodies);
    std::vector<std::vector<char>> seen;
    for (int i = 0; i < 4000; ++i) {
      const auto a = static_cast<std::uint32_t>(random.between(0, bodies - 1e-9));
      const auto b = static_cast<std::uint32_t>(random.between(0, bodies - 1e-9));
      if (a == b || !(movable[a] || movable[b])) continue;
      const std::uint32_t color = coloring.color(a, movable[a] != 0, b, movable[b] != 0);
      REQUIRE(color < coloring.end());
      if (seen.size() <= color) seen.resize(color + 1, std::vector<char>(bodies));
      for (const std::uint32_t body : {a, b}) {
        if (!movable[body]) continue;
        REQUIRE(!seen[color][body]);
        seen[color][body] = 1;
      }
    }
  }
}

TEST_CASE("contacts among many at one place share colors: few more of them than one body has contacts") {
  blocks::Coloring coloring;
  for (const bool again : {false, true}) {
    CAPTURE(again);
    coloring.reset(400);
    std::uint32_t contacts = 0;
    for (std::uint32_t a = 0; a < 400; ++a)
      for (std::uint32_t b = a + 1; b < std::min(400u, a + 100); ++b, ++contacts)
        static_cast<void>(coloring.color(a, true, b, true));
    // A body has up to 198 contacts, and colors taken in order are at most twice as many minus one.
    CHECK(coloring.end() >= 198);
    CHECK(coloring.end() - blocks::Coloring::half <= 2 * 198 - 1);
    CHECK(contacts > 30'000);
  }
  coloring.reset(400);
  CHECK(coloring.color(0, true, 1, true) == 0);
  CHECK(coloring.end() == blocks::Coloring::late);
}

TEST_CASE("rows are solved to the same bits with every instruction set") {
  using namespace blocks;
  struct Work {
    std::vector<ContactBlock> blocks;
    std::vector<BallBlock> balls;
    std::vector<PointRow> points;
    std::vector<FrictionRow> frictions;
    std::vector<DriftRow> drifts;
    std::vector<InertiaRow> inertias;
    std::vector<MeetingRow> meetings;
    std::vector<BodyLanes> velocities, displacements;
    std::vector<BodyLag> lags;
    std::vector<ContactOrigin> origins;
    std::vector<IslandBody> bodies;
    [[nodiscard]] Rows rows() {
      return {.blocks = blocks.data(),
              .pairs = blocks.size() / 2,
              .count = blocks.size(),
              .balls = balls.data(),
              .ball_pairs = balls.size() / 2,
              .ball_count = balls.size(),
              .points = points.data(),
              .frictions = frictions.data(),
              .drifts = drifts.data(),
              .inertias = inertias.data(),
              .origins = origins.data(),
              .bodies = bodies.data(),
              .meetings = meetings.data(),
              .ball_meetings = meetings.data(),
              .velocities = velocities.data(),
              .displacements = displacements.data(),
              .lags = lags.data()};
    }
  };
  test::Random random(8);
  const auto fill = [&random](auto& list, std::size_t count) {
    list.resize(count);
    // Of the magnitudes that occur, with both signs.
    for (auto& item : list) {
      double numbers[sizeof item / sizeof(double)];
      for (double& number : numbers) number = random.between(-1, 1);
      std::memcpy(&item, numbers, sizeof item);
    }
  };
  Work first;
  constexpr int count = 40;
  fill(first.points, 4 * count);
  fill(first.frictions, 4 * count);
  fill(first.drifts, 4 * count);
  fill(first.inertias, count);
  fill(first.meetings, count);
  fill(first.velocities, 8 * count);
  fill(first.displacements, 8 * count);
  fill(first.lags, 8 * count);
  const auto make_positive = [](Lanes& lanes) {
    for (int lane = 0; lane < lane_count; ++lane) lanes[lane] = std::abs(lanes[lane]);
  };
  for (BodyLanes& body : first.velocities) body.linear[3] = body.angular[3] = 0;
  for (PointRow& row : first.points) {
    make_positive(row.mass);
    make_positive(row.impulse);
  }
  for (MeetingRow& row : first.meetings) row.heeded = all(1);
  fill(first.blocks, count);
  fill(first.balls, count);
  const auto place = [&make_positive](auto& block, int i) {
    for (int lane = 0; lane < lane_count; ++lane) {
      block.a[lane] = static_cast<std::uint32_t>((8 * i + 2 * lane) % (8 * count));
      block.b[lane] = static_cast<std::uint32_t>((8 * i + 2 * lane + 9) % (8 * count));
      block.to_a[lane] = block.a[lane];
      block.to_b[lane] = block.b[lane];
      block.hard[lane] = lane % 2 == 0 ? -1 : 0;
    }
    make_positive(block.coefficient);
  };
  for (int i = 0; i < count; ++i) {
    ContactBlock& block = first.blocks[static_cast<std::size_t>(i)];
    place(block, i);
    for (int lane = 0; lane < lane_count; ++lane) {
      block.round_a[lane] = lane % 3 == 0 ? -1 : 0;
      block.round_b[lane] = lane % 3 == 1 ? -1 : 0;
    }
    block.drifts = i % 5 < 2;
    block.springs = i % 7 < 4;
    block.points = static_cast<std::int8_t>(1 + i % 4);
    block.frictions = i % 3 == 0 ? std::int8_t{0} : i % 3 == 1 ? std::int8_t{1} : block.points;
    block.point = block.friction = static_cast<std::uint32_t>(4 * i);
    block.inertia = static_cast<std::uint32_t>(i);
    block.even = i % 5 < 3;
    BallBlock& ball = first.balls[static_cast<std::size_t>(i)];
    place(ball, i);
    make_positive(ball.mass);
    make_positive(ball.impulse);
  }
  // What rows are prepared from.
  std::vector<contacts::ContactConstraint> contacts(lane_count * count);
  const auto some_vector = [&random] {
    return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
  };
  first.origins.resize(count);
  for (int i = 0; i < count; ++i)
    for (int lane = 0; lane < lane_count; ++lane) {
      contacts::ContactConstraint& contact = contacts[static_cast<std::size_t>(lane_count * i + lane)];
      contact.count = 1 + (i + lane) % first.blocks[static_cast<std::size_t>(i)].points;
      contact.eased = random.between(0, 1);
      for (contacts::PointConstraint& point : contact.points) {
        point.start_arm_a = some_vector();
        point.start_arm_b = some_vector();
        point.start_gap = random.between(-1, 1);
        point.skin_a = random.between(0, 1);
        point.skin_b = random.between(0, 1);
      }
      if (i % 4 != 3 || lane % 3 != 0)
        first.origins[static_cast<std::size_t>(i)][static_cast<std::size_t>(lane)] = &contact;
    }
  first.bodies.resize(lane_count * count);
  for (std::size_t i = 0; i < first.bodies.size(); ++i) {
    IslandBody& body = first.bodies[i];
    const Mat3 some = Mat3::NullaryExpr([&random] { return random.between(-1, 1); });
    body.inverse_inertia = some * some.transpose();
    body.stale = i % 5 == 0;
    for (double& number : body.turn.rotation) number = random.between(-1, 1);
    for (double& number : body.turn.angle) number = random.between(-1, 1);
  }
  const Work before = first;
  std::vector<std::uint32_t> found_first(lane_count * 2 * count);
  const auto run = [](Work& work, const Kernels& kernels, std::vector<std::uint32_t>& found) {
    kernels.prepare(work.rows());
    kernels.prepare_again(work.rows(), false);
    kernels.warm_start(work.rows());
    kernels.prepare_again(work.rows(), true);
    const std::size_t meetings = kernels.find_meetings(work.rows(), work.displacements.data(), 0.01, found.data());
    found.resize(meetings);
    for (const int passes : {1, 3, 1})
      kernels.solve(work.rows(), {all(0.7), all(0.2), all(0.9), all(0.1), all(240), all(1e-3), passes, true,
                                  passes != 3, passes == 3});
    kernels.hold(work.rows());
  };
  run(first, *possible_kernels().front(), found_first);
  CHECK(!found_first.empty());
  const auto same = [](const auto& a, const auto& b) {
    return std::memcmp(a.data(), b.data(), a.size() * sizeof a[0]) == 0;
  };
  for (const Kernels* kernels : possible_kernels()) {
    Work second = before;
    std::vector<std::uint32_t> found_second(lane_count * 2 * count);
    run(second, *kernels, found_second);
    CHECK(found_first == found_second);
    CHECK(same(first.velocities, second.velocities));
    CHECK(same(first.points, second.points));
    CHECK(same(first.frictions, second.frictions));
    CHECK(same(first.inertias, second.inertias));
    CHECK(same(first.balls, second.balls));
    CHECK(same(first.lags, second.lags));
  }
  CHECK(!same(first.velocities, before.velocities));
  CHECK(!same(first.points, before.points));
  CHECK(!same(first.balls, before.balls));
  CHECK(!same(first.lags, before.lags));
  if (possible_kernels().size() == 1) MESSAGE("SKIPPED: this processor has one instruction set only");
}

TEST_CASE("rows are prepared as rigid bodies turn: masses at the points, and friction along both tangents") {
  using namespace blocks;
  test::Random random(12);
  const auto some_vector = [&random] {
    return Vec3(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
  };
  // One lane of eight is filled, by a contact of two of three points.
  std::vector<contacts::ContactConstraint> contacts(1);
  contacts[0].count = 2;
  for (contacts::PointConstraint& point : contacts[0].points) {
    point.start_arm_a = some_vector();
    point.start_arm_b = some_vector();
    point.start_gap = random.between(-1, 1);
    point.skin_b = 0.1;
  }
  std::vector<IslandBody> bodies(3);
  const Mat3 some = Mat3::NullaryExpr([&random] { return random.between(-1, 1); });
  bodies[1].inverse_inertia = some * some.transpose();
  bodies[2].inverse_inertia = some.transpose() * some;
  const Vec3 angle(0.1, -0.2, 0.15);
  const Quat turn = exp_map(angle);
  std::copy_n(turn.coeffs().data(), 4, bodies[2].turn.rotation);
  std::copy_n(angle.data(), 3, bodies[2].turn.angle);
  ContactBlock block{};
  block.points = block.frictions = 3;
  block.even = false;
  constexpr int lane = 5;
  block.a[lane] = 1;
  block.b[lane] = 2;
  block.inverse_mass_a[lane] = 2;
  block.inverse_mass_b[lane] = 0.5;
  const Quat frame = exp_map(some_vector());
  const Vec3 normal = frame * Vec3(1, 0, 0), tangent1 = frame * Vec3(0, 1, 0), tangent2 = frame * Vec3(0, 0, 1);
  const auto put = [](Lanes3& lanes, const Vec3& value) {
    lanes.x[lane] = value.x();
    lanes.y[lane] = value.y();
    lanes.z[lane] = value.z();
  };
  put(block.normal, normal);
  put(block.tangent1, tangent1);
  put(block.tangent2, tangent2);
  ContactOrigin origin{};
  origin[lane] = contacts.data();
  std::vector<PointRow> points(3);
  std::vector<FrictionRow> frictions(3);
  std::vector<BodyLanes> velocities(3);
  InertiaRow inertia{};
  const Rows rows{.blocks = &block,
                  .pairs = 1,
                  .count = 1,
                  .points = points.data(),
                  .frictions = frictions.data(),
                  .inertias = &inertia,
                  .origins = &origin,
                  .bodies = bodies.data(),
                  .velocities = velocities.data()};
  for (const bool turned : {false, true}) {
    CAPTURE(turned);
    if (turned) {
      bodies[2].stale = true;
      fastest_kernels().prepare_again(rows, false);
    } else {
      fastest_kernels().prepare(rows);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const contacts::PointConstraint& point = contacts[0].points[i];
      const Vec3 arm_a = point.start_arm_a;
      const Vec3 skin = -point.skin_b * normal;
      const Vec3 arm_b = turned ? Vec3(turn * (point.start_arm_b - skin) + skin) : point.start_arm_b;
      const auto effect = [&](const Vec3& along, const Vec3& by) {
        const Vec3 spin_a = bodies[1].inverse_inertia * arm_a.cross(by);
        const Vec3 spin_b = bodies[2].inverse_inertia * arm_b.cross(by);
        return 2.5 * along.dot(by) + along.dot(spin_a.cross(arm_a)) + along.dot(spin_b.cross(arm_b));
      };
      CHECK(points[i].mass[lane] * effect(normal, normal) == doctest::Approx(1).epsilon(1e-12));
      const FrictionRow& row = frictions[i];
      // Times the effect of both tangents on each other, this is one.
      const double e11 = effect(tangent1, tangent1), e12 = effect(tangent1, tangent2), e22 = effect(tangent2, tangent2);
      CHECK(row.inverse11[lane] * e11 + row.inverse12[lane] * e12 == doctest::Approx(1).epsilon(1e-11));
      CHECK(std::abs(row.inverse11[lane] * e12 + row.inverse12[lane] * e22) < 1e-11);
      CHECK(row.inverse12[lane] * e12 + row.inverse22[lane] * e22 == doctest::Approx(1).epsilon(1e-11));
      // The gap that the rows see, where the body is, is that of the turned arm.
      if (!turned) continue;
      const Vec3 across(points[i].turn_b.x[lane], points[i].turn_b.y[lane], points[i].turn_b.z[lane]);
      CHECK(points[i].base[lane] + across.dot(angle) ==
            doctest::Approx(point.start_gap + normal.dot(arm_b - point.start_arm_b)).epsilon(1e-12));
    }
    for (int other = 0; other < lane_count; ++other) {
      if (other != lane) CHECK(points[0].mass[other] == 0);
      CHECK(points[2].mass[other] == 0);
      CHECK(frictions[2].firm[other] == 0);
    }
  }
}

TEST_CASE("a cloud of bodies that meets in its middle keeps its momentum, and gains no energy") {
  test::Random random(4);
  for (const double restitution : {0.0, 0.1, 0.25, 0.3, 1.0}) {
    CAPTURE(restitution);
    World world({.gravity = {0, 0, 0}});
    std::vector<BodyId> bodies;
    const Solid solids[] = {Sphere{0.3}, Box{Vec3(0.3, 0.2, 0.25)}, Capsule{0.15, 0.2}};
    for (int i = 0; i < 125; ++i) {
      BodySettings body;
      body.shape.solid = solids[i % 3];
      body.restitution = restitution;
      body.mass = 1 + i % 4;
      body.motion.pose.position = Vec3(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2) * 0.65;
      body.motion.pose.rotation = random.rotation();
      body.motion.twist.linear = -4 * body.motion.pose.position + random.vector(0.2);
      body.motion.twist.angular = random.vector(2);
      bodies.push_back(world.add(body));
    }
    const auto momentum = [&] {
      Vec3 sum = Vec3::Zero();
      for (const BodyId body : bodies) sum += world.mass(body).mass * world.twist(body).linear;
      return sum;
    };
    const Vec3 before = momentum();
    const double start = world.kinetic_energy();
    double energy = start;
    std::size_t most = 0;
    for (int step = 0; step < 240; ++step) {
      world.step(1.0 / 120);
      most = std::max(most, world.contacts().size());
      CAPTURE(step);
      // Removing overlap leaves traces of speed.
      CHECK(world.kinetic_energy() <= energy + 1e-8 * start);
      energy = world.kinetic_energy();
    }
    CHECK(most > 75);
    CHECK((momentum() - before).norm() < 1e-11);
  }
}

TEST_CASE("what falls dully on a heavy plate comes back with its share of the speed, however many fall") {
  for (const int rows : {2, 5, 15}) {
    CAPTURE(rows);
    World world;
    world.add({.shape = {Plane{}}, .fixed = true});
    BodySettings plate;
    plate.shape.solid = Box{Vec3(10, 0.5, 10)};
    plate.mass = 1e6;
    plate.motion.pose.position = Vec3(0, 0.5, 0);
    plate.restitution = 0.2;
    const BodyId ground = world.add(plate);
    std::vector<BodyId> bodies;
    for (int i = 0; i < rows * rows; ++i) {
      BodySettings body;
      if (i % 2 == 0)
        body.shape.solid = Sphere{0.25};
      else
        body.shape.solid = Box{Vec3(0.25, 0.25, 0.25)};
      body.mass = 1.0;
      body.restitution = 0.2;
      body.motion.pose.position = Vec3(i % rows - rows / 2, 1.25 + 0.05, i / rows - rows / 2);
      body.motion.twist.linear = Vec3(0, -10, 0);
      bodies.push_back(world.add(body));
    }
    const double step = 1.0 / 60;
    world.step(step);
    // A fall of 0.05 m, and a rise for the rest of the step.
    const double closing = std::sqrt(100 + 2 * 9.81 * 0.05), met = (closing - 10) / 9.81;
    const double back = 0.2 * closing - 9.81 * (step - met);
    for (const BodyId body : bodies) CHECK(std::abs(world.twist(body).linear.y() - back) < 0.03);
    CHECK(world.twist(ground).linear.norm() < 1e-3);
  }
}
