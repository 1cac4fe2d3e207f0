#include "pairs/broad_phase.h"

#include "collision/impact_time.h"

#include <map>

#include "support.h"

using namespace tweenfall;

namespace {

constexpr double margin = 2e-3;
constexpr double frame_time = 1.0 / 60;

/// Bodies that move at random, and their pairs, found by the broad phase and by brute force.
struct Crowd {
  test::Random random;
  std::vector<state::Body> bodies;
  std::vector<forces::Load> loads;
  std::vector<std::uint32_t> told;  ///< of those that do not move by themselves: to be looked at
  pairs::BroadPhase broad_phase;
  state::IgnoredPairs ignored;

  explicit Crowd(std::uint64_t seed) : random(seed) {}

  std::uint32_t any() { return static_cast<std::uint32_t>(random.bits() % bodies.size()); }

  void put(std::uint32_t index, const Solid& solid, const Vec3& at) {
    if (index >= bodies.size()) {
      bodies.resize(index + 1);
      loads.resize(index + 1);
    }
    state::Body body;
    state::Makeup makeup;
    makeup.shape.solid = solid;
    body.alive = true;
    makeup.radius = std::holds_alternative<Plane>(solid)
                        ? std::numeric_limits<double>::infinity()
                        : 0.5 * (bounds(makeup.shape, {}).high - bounds(makeup.shape, {}).low).norm();
    if (const auto* sphere = std::get_if<Sphere>(&solid)) makeup.radius = makeup.roundness = sphere->radius;
    body.makeup = std::make_shared<const state::Makeup>(makeup);
    body.motion.pose.position = at;
    body.motion.pose.rotation = random.rotation();
    body.follow_motion();
    body.fixed = std::holds_alternative<Plane>(solid) || random.unit() < 0.2;
    if (!body.fixed && random.unit() < 0.2) body.drive = Drive::keyed();
    bodies[index] = body;
    loads[index] = {};
    told.push_back(index);
  }

  void put_any(std::uint32_t index, double room) {
    const double size = std::pow(10, random.between(-2, 0.3));
    const double kind = random.unit();
    Solid solid = Sphere{size};
    if (kind < 0.3) solid = Box{Vec3(random.between(0.1, 1), random.between(0.1, 1), random.between(0.1, 1)) * size};
    if (kind < 0.1) solid = Capsule{0.3 * size, size};
    if (kind < 0.04) solid = Box{Vec3(1e3, 0.1, 1e3)};
    if (kind < 0.02) solid = Plane{random.rotation() * Vec3(0, 1, 0), random.between(-room, room)};
    put(index, solid, random.vector(room));
  }

  void step() {
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
      state::Body& body = bodies[i];
      if (body.placed || body.has_target) told.push_back(i);
      body.placed = false;
      if (body.has_target) body.motion.pose = body.target().pose;
      body.has_target = false;
      if (!body.immovable() && !body.asleep) {
        body.motion.pose.position += body.twist.linear * frame_time;
        body.motion.pose.rotation = random.rotation();
      }
      body.follow_motion();
    }
  }

  void disturb(double room) {
    for (int i = 0; i < 6; ++i) {
      const std::uint32_t index = any();
      state::Body& body = bodies[index];
      const double what = random.unit();
      if (what < 0.1 && body.alive) {
        const std::uint32_t other = any();
        if (other != index && bodies[other].alive && ignored.ask(index, other, random.unit() < 0.7))
          broad_phase.look_again(index);
      } else if (what < 0.15) {
        const std::uint64_t groups = random.bits() % 8;
        body.set_filter({groups, random.unit() < 0.2 ? 0 : random.bits() % 16 | 1});
        told.push_back(index);
        broad_phase.look_again(index);
      } else if (what < 0.25 && body.alive) {
        broad_phase.remove(index);
        ignored.remove(index);
        body.alive = false;
      } else if (what < 0.4) {
        if (body.alive) broad_phase.remove(index);
        ignored.remove(index);
        put_any(index, room);
      } else if (what < 0.5) {
        put_any(static_cast<std::uint32_t>(bodies.size()), room);
      } else if (what < 0.6) {
        body.motion.pose.position = random.vector(room);
        body.placed = true;
        body.follow_motion();
        told.push_back(index);
      } else if (what < 0.8 && !body.fixed) {
        body.drive = body.drive.owner() == Owner::keyed ? Drive::free() : Drive::keyed();
        body.placed = true;
        body.has_target = false;
        told.push_back(index);
      } else if (!body.immovable()) {
        body.asleep = random.unit() < 0.5;
        body.twist = {};
        if (!body.asleep) body.twist = {random.vector(20), random.vector(40)};
        loads[index].acceleration = random.vector(100);
      }
    }
    for (std::uint32_t i = 0; i < bodies.size(); ++i) {
      state::Body& body = bodies[i];
      if (body.fixed || !body.immovable() || random.unit() < 0.5) continue;
      body.has_target = true;
      body.target() = body.motion;
      if (random.unit() < 0.8) body.target().pose.position += random.vector(0.5);
      if (random.unit() < 0.5) body.target().pose.rotation = random.rotation();
      told.push_back(i);
    }
  }

  std::vector<pairs::Pair> found() {
    std::vector<std::uint32_t> changed;
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
      if (bodies[i].alive && (!bodies[i].immovable() || std::count(told.begin(), told.end(), i) > 0))
        changed.push_back(i);
    told.clear();
    return broad_phase.find(bodies, changed, loads, {bodies, ignored}, margin, frame_time);
  }

  [[nodiscard]] bool near(const state::Body& a, const forces::Load& load_a, const state::Body& b,
                          const forces::Load& load_b) const {
    if (std::holds_alternative<Plane>(b.shape().solid)) return near(b, load_b, a, load_a);
    const Bounds box = pairs::swept_bounds(b, load_b, 0.5 * margin, frame_time);
    const auto* plane = std::get_if<Plane>(&a.shape().solid);
    if (!plane) {
      const Bounds other = pairs::swept_bounds(a, load_a, 0.5 * margin, frame_time);
      return (other.low.array() <= box.high.array()).all() && (box.low.array() <= other.high.array()).all();
    }
    if (a.displaces()) return true;
    for (int corner = 0; corner < 8; ++corner) {
      const Vec3 at(corner & 1 ? box.low.x() : box.high.x(), corner & 2 ? box.low.y() : box.high.y(),
                    corner & 4 ? box.low.z() : box.high.z());
      const Vec3 local = a.motion.pose.rotation.conjugate() * (at - a.motion.pose.position);
      if (plane->normal.dot(local) - plane->offset <= 0.5 * margin) return true;
    }
    return false;
  }

  [[nodiscard]] std::vector<pairs::Pair> counted_out() const {
    std::vector<pairs::Pair> all, result;
    std::map<std::uint32_t, std::uint32_t> neighbors, counts;
    const auto both_move = [this](const pairs::Pair& pair) {
      return !bodies[pair.first].immovable() && !bodies[pair.second].immovable();
    };
    for (std::uint32_t i = 0; i < bodies.size(); ++i)
      for (std::uint32_t k = i + 1; k < bodies.size(); ++k) {
        const state::Body &a = bodies[i], &b = bodies[k];
        if (!a.alive || !b.alive || (a.immovable() && b.immovable()) || (!a.stirs() && !b.stirs())) continue;
        if (!near(a, loads[i], b, loads[k])) continue;
        if ((a.groups() & b.collides_with()) == 0 || (b.groups() & a.collides_with()) == 0 || ignored.contains(k, i))
          continue;
        all.emplace_back(i, k);
        if (!both_move(all.back())) continue;
        ++neighbors[i];
        ++neighbors[k];
      }
    constexpr std::uint32_t most = pairs::BroadPhase::most_pairs;
    for (const pairs::Pair& pair : all) {
      const auto [i, k] = pair;
      if (both_move(pair) && neighbors[i] >= most && neighbors[k] >= most) {
        if (counts[i] >= most && counts[k] >= most) continue;
        ++counts[i];
        ++counts[k];
      }
      result.push_back(pair);
    }
    return result;
  }
};

}  // namespace

TEST_CASE(
    "pairs are those that counting all out gives, whatever is added, removed, moved, turned, led, put to sleep or told "
    "whom to meet") {
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Crowd crowd(seed);
    const double room = seed % 3 == 0 ? 3 : seed % 3 == 1 ? 10 : 1e4;
    for (std::uint32_t i = 0; i < 20 + 10 * seed; ++i) crowd.put_any(i, room);
    std::size_t most = 0;
    for (int step = 0; step < 150; ++step) {
      crowd.disturb(room);
      const std::vector<pairs::Pair> expected = crowd.counted_out();
      CAPTURE(seed);
      CAPTURE(step);
      REQUIRE(crowd.found() == expected);
      most = std::max(most, expected.size());
      crowd.step();
    }
    CHECK(most > 5);
  }
}

TEST_CASE("hundreds at one point, beside them, gone and back again, have the pairs that counting out gives") {
  Crowd crowd(3);
  for (std::uint32_t i = 0; i < 700; ++i) crowd.put(i, Sphere{0.5}, Vec3::Zero());
  for (int step = 0; step < 12; ++step) {
    CAPTURE(step);
    const std::vector<pairs::Pair> expected = crowd.counted_out();
    REQUIRE(crowd.found() == expected);
    CHECK(expected.size() <= 700 * (pairs::BroadPhase::most_pairs + 300));
    for (state::Body& body : crowd.bodies) {
      body.twist.linear = crowd.random.vector(step < 6 ? 1 : 20);
      if (step == 7) body.motion.pose.position *= 100;
      if (step == 9) body.motion.pose.position = crowd.random.vector(0.1);
    }
    crowd.step();
    for (std::uint32_t i = 0; i < crowd.bodies.size(); ++i) crowd.told.push_back(i);
  }
}

TEST_CASE("ten thousand at one point have no more pairs than their number allows, at once") {
  Crowd crowd(4);
  for (std::uint32_t i = 0; i < 10000; ++i) {
    crowd.put(i, Sphere{0.5}, Vec3::Zero());
    crowd.bodies[i].fixed = false;
    crowd.bodies[i].drive = Drive::free();
  }
  std::vector<std::uint32_t> changed(10000);
  for (std::uint32_t i = 0; i < 10000; ++i) changed[i] = i;
  for (int step = 0; step < 5; ++step)
    CHECK(crowd.broad_phase.find(crowd.bodies, changed, crowd.loads, {crowd.bodies, crowd.ignored}, margin, frame_time)
              .size() <= 10000u * pairs::BroadPhase::most_pairs);
}

TEST_CASE("boxes without end and numbers that are none neither hang nor lose a pair") {
  Crowd crowd(5);
  const double end = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < 300; ++i) {
    crowd.put(i, Sphere{0.5}, Vec3(2.0 * i, 0, 0));
    crowd.bodies[i].fixed = false;
    crowd.bodies[i].drive = Drive::free();
  }
  crowd.bodies[7].twist.linear = Vec3(end, 0, 0);
  crowd.bodies[8].motion.pose.position = Vec3(1e30, -1e30, 1e30);
  crowd.loads[9].acceleration = Vec3(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  const std::vector<pairs::Pair> found = crowd.found();
  for (std::uint32_t i = 10; i < 300; ++i) CHECK(std::count(found.begin(), found.end(), pairs::Pair(7, i)) == 1);
  for (std::uint32_t i = 10; i < 300; ++i) CHECK(std::count(found.begin(), found.end(), pairs::Pair(9, i)) == 1);
}

TEST_CASE("nothing leaves its swept bounds within the step, cubes that spin and keyed bodies that turn included") {
  Crowd crowd(6);
  const Solid solids[] = {Sphere{0.5}, Box{Vec3(0.5, 0.5, 0.5)}, Box{Vec3(0.1, 0.6, 0.3)}, Capsule{0.2, 0.6}};
  for (int i = 0; i < 2000; ++i) {
    crowd.put(0, solids[i % 4], crowd.random.vector(3));
    state::Body& body = crowd.bodies[0];
    body.fixed = false;
    state::Makeup makeup = *body.makeup;
    makeup.spherical = i % 4 < 2;
    body.makeup = std::make_shared<const state::Makeup>(makeup);
    body.twist = {crowd.random.vector(30), crowd.random.vector(60)};
    crowd.loads[0].acceleration = crowd.random.vector(100);
    if (body.immovable()) {
      body.has_target = true;
      body.target().pose.position = body.motion.pose.position + crowd.random.vector(1);
      body.target().pose.rotation = crowd.random.rotation();
    }
    const Bounds swept = pairs::swept_bounds(body, crowd.loads[0], 1e-9, frame_time);
    const collision::Course course = collision::course_of(body, crowd.loads[0], frame_time);
    for (int k = 0; k <= 20; ++k) {
      const Bounds at = bounds(body.shape(), course.at(k * frame_time / 20).node(body));
      CAPTURE(i);
      CAPTURE(k);
      CHECK(pairs::contains(swept, at));
    }
  }
}
