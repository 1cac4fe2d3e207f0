#include "stage/rules/meetings.h"

#include <tweenfall/curves/rotation.h>
#include <tweenfall/physics/contact.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace tweenfall::staging {

namespace {

/// Shapes nearer than this have met, m.
constexpr double hair = 1e-7;
constexpr int most_advances = 64;

/// The path of one body through the piece.
struct Course {
  const StagedBody* body = nullptr;
  std::size_t index = 0;
  const Shape* shape = nullptr;
  Motion start;
  Vec3 center{0, 0, 0};
  Vec3 acceleration{0, 0, 0};
  bool follows = false;  ///< it follows its path, exactly
  bool movable = false;
  double speed = 0;   ///< upper bound of the speed of its points, m/s
  Bounds reach = {};  ///< everything that it may touch

  [[nodiscard]] Pose at(double from, double time) const {
    const double since = time - from;
    if (follows) return rigid(body->path.at(time, Side::in)).pose;
    if (since == 0) return start.pose;
    Pose pose = moved_on(start, center, since).pose;
    pose.position += acceleration * (0.5 * since * since);
    return pose;
  }
};

/// Greatest distance of a point of the shape from its node, m.
double radius_of(const Shape& shape) {
  const Bounds box = bounds(shape, {});
  const Vec3 corner = box.low.cwiseAbs().cwiseMax(box.high.cwiseAbs());
  return corner.allFinite() ? corner.norm() : 0;
}

/// The pairs that press on each other, sorted like the world's contacts, and whether a body is in one of them.
struct Pressing {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  std::vector<char> bodies;

  explicit Pressing(const StageState& state) : bodies(state.node_of.size(), 0) {
    for (const Contact& contact : state.world.contacts()) {
      if (!(contact.impulse > 0)) continue;
      pairs.emplace_back(std::min(contact.a.index, contact.b.index), std::max(contact.a.index, contact.b.index));
      bodies[contact.a.index] = bodies[contact.b.index] = 1;
    }
    std::ranges::sort(pairs);
  }
  [[nodiscard]] bool contains(BodyId a, BodyId b) const {
    return std::ranges::binary_search(pairs, std::pair(std::min(a.index, b.index), std::max(a.index, b.index)));
  }
};

Course course_of(const StageState& state, std::size_t index, double end, const Pressing& pressing) {
  const StagedBody& body = state.bodies[index];
  Course course{.body = &body, .index = index, .shape = &state.world.shape(body.id)};
  course.start = state.world.motion(body.id);
  course.center = state.world.mass(body.id).center;
  const double dt = end - state.time, radius = radius_of(*course.shape);
  const Bounds here = bounds(*course.shape, course.start.pose);
  course.reach = here;
  if (state.world.is_fixed(body.id)) return course;
  const Owner owner = state.world.owner(body.id);
  course.movable = owner != Owner::keyed;
  if (owner == Owner::keyed) {
    course.follows = true;
    // A curve does not give its greatest speed: it is sampled at several places, with room to spare.
    constexpr int places = 4;
    for (int i = 0; i <= places; ++i) {
      const Motion motion = body.path.at(state.time + dt * i / places, i == places ? Side::in : Side::out);
      course.speed = std::max(course.speed, motion.twist.linear.norm() + motion.twist.angular.norm() * radius);
    }
    course.speed *= 1.25;
  } else if (!state.world.asleep(body.id)) {
    // A body that rests or rolls on something does not fall.
    if (owner == Owner::free && !pressing.bodies[body.id.index]) course.acceleration = state.gravity;
    course.speed = state.world.twist(body.id).linear.norm() + course.acceleration.norm() * dt +
                   course.start.twist.angular.norm() * radius;
  }
  const Vec3 room = Vec3::Constant(course.speed * dt + hair);
  course.reach = {here.low - room, here.high + room};
  return course;
}

bool overlap(const Bounds& a, const Bounds& b) {
  return (a.low.array() <= b.high.array()).all() && (b.low.array() <= a.high.array()).all();
}

/// The time just before two separated shapes first touch; by conservative advancement (Mirtich, Impulse-based
/// Dynamic Simulation of Rigid Body Systems, 1996, chapter 2).
std::optional<double> first_touch(const Course& a, const Course& b, double from, double end) {
  double time = from;
  const double closing = a.speed + b.speed;
  if (!(closing > 0)) return std::nullopt;
  for (int i = 0; i < most_advances; ++i) {
    const Manifold manifold = collide(*a.shape, a.at(from, time), *b.shape, b.at(from, time), infinity);
    double gap = infinity;
    for (int k = 0; k < manifold.count; ++k)
      gap = std::min(gap, -manifold.points[static_cast<std::size_t>(k)].penetration);
    if (i == 0 && !(gap > 0)) return std::nullopt;
    if (gap <= hair) return time;
    time += (gap - 0.5 * hair) / closing;
    if (!(time < end)) return std::nullopt;
  }
  return time;
}

}  // namespace

std::vector<Meeting> meetings(const StageState& state, double end, const std::vector<char>& watched) {
  const Pressing pressing(state);
  std::vector<Course> courses;
  for (std::size_t i = 0; i < state.bodies.size(); ++i)
    if (state.bodies[i].present) courses.push_back(course_of(state, i, end, pressing));
  std::ranges::stable_sort(courses, {}, [](const Course& course) { return course.reach.low.x(); });
  std::vector<Meeting> found;
  for (std::size_t i = 0; i < courses.size(); ++i) {
    const Course& a = courses[i];
    for (std::size_t k = i + 1; k < courses.size() && courses[k].reach.low.x() <= a.reach.high.x(); ++k) {
      const Course& b = courses[k];
      if ((!watched[a.index] && !watched[b.index]) || !overlap(a.reach, b.reach)) continue;
      if (pressing.contains(a.body->id, b.body->id) || !state.world.collides(a.body->id, b.body->id)) continue;
      const std::optional<double> time = first_touch(a, b, state.time, end);
      if (!time) continue;
      if (watched[a.index]) found.push_back({*time, a.index, b.body->id});
      if (watched[b.index]) found.push_back({*time, b.index, a.body->id});
    }
  }
  std::ranges::sort(found, [](const Meeting& a, const Meeting& b) {
    return a.time != b.time ? a.time < b.time : a.body != b.body ? a.body < b.body : a.other.index < b.other.index;
  });
  return found;
}

}  // namespace tweenfall::staging
