#include "islands/sprung_energy.h"

#include <tweenfall/curves/rotation.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "islands/handed_back.h"
#include "islands/moved_bodies.h"

namespace tweenfall::islands {

namespace {

using state::Body;

/// Parts of their way that are tried: each half of the one before, and in the end none.
constexpr int most_halvings = 24;
/// Share of the inertia that keeps the equations solvable if no turn about some axis moves anything.
constexpr double firming = 1e-9;
/// Springs that swing by less than the square root of this in a step, and bodies that turn by less than `followed_turn`
/// in it, rad, are followed: what their energy sways by is no gain.
constexpr double followed_swing = 1, followed_turn = 0.5;
/// The gain of a step that is but rounding, relative.
constexpr double gain_of_rounding = 1e-9;

/// Where a spring is fastened.
struct End {
  std::uint32_t body;  ///< or the world
  Vec3 local;          ///< from the center of mass, node axes; in the world
};

/// Calls see(a, b, length at rest, stiffness) for each spring.
template <class See>
void each_spring(const IslandContents& island, const std::vector<Body>& bodies, const See& see) {
  for (const step::SpringRow* spring : island.springs)
    see(End{spring->a, spring->local_a}, End{spring->b, spring->local_b}, spring->rest_length, spring->stiffness);
  for (const joints::JointLink* link : island.joints) {
    const JointSettings& joint = link->joint->settings;
    const auto* spring = std::get_if<SpringJoint>(&joint.kind);
    if (!spring) continue;
    const auto end_of = [&](std::uint32_t body, const Pose& frame) -> End {
      return {body,
              body == joints::JointLink::world ? frame.position : Vec3(frame.position - bodies[body].mass().center)};
    };
    see(end_of(link->a, joint.frame_a), end_of(link->b, joint.frame_b), spring->length, spring->stiffness);
  }
}

/// Whether a step follows all springs, and what they turn.
bool follows(const IslandContents& island, const std::vector<Body>& bodies, double dt) {
  const auto moving = [&](const End& end) {
    return end.body != joints::JointLink::world && !bodies[end.body].immovable();
  };
  const auto place_of = [&](const End& end) -> Vec3 {
    if (end.body == joints::JointLink::world) return end.local;
    return bodies[end.body].center + bodies[end.body].motion.pose.rotation * end.local;
  };
  bool all = true;
  each_spring(island, bodies, [&](const End& a, const End& b, double length, double stiffness) {
    const double distance = (place_of(b) - place_of(a)).norm(), tension = stiffness * std::abs(distance - length);
    double swing = 0;
    for (const End* end : {&a, &b}) {
      if (!moving(*end)) continue;
      const Body& body = bodies[end->body];
      const double lever = end->local.norm(), turns = lever * body.inverse_inertia().norm();
      all = all && body.twist.angular.norm() * dt <= followed_turn;
      swing += (stiffness + (distance > 0 ? tension / distance : 0)) / body.mass().mass +
               (stiffness * lever + tension) * turns;
    }
    all = all && swing * dt * dt <= followed_swing;
  });
  return all;
}

/// The bodies on springs through a step.
class Sprung {
 public:
  Sprung(const IslandContents& island, const std::vector<Body>& bodies, const std::vector<std::uint32_t>& all,
         const std::function<FreeStart(std::uint32_t)>& start_of)
      : island_(island), bodies_(bodies), all_(all) {
    starts_.reserve(all.size());
    ends_.reserve(all.size());
    double mass = 0;
    for (const std::uint32_t index : all) {
      const Body& body = bodies[index];
      starts_.push_back(start_of(index));
      ends_.push_back({body.center, body.motion.pose.rotation, body.twist});
      mass += body.mass().mass;
      start_center_ += body.mass().mass * starts_.back().center;
      center_ += body.mass().mass * body.center;
      start_velocity_ += body.mass().mass * starts_.back().twist.linear;
      velocity_ += body.mass().mass * body.twist.linear;
    }
    for (Vec3* sum : {&start_center_, &center_, &start_velocity_, &velocity_}) *sum /= mass;
  }

  [[nodiscard]] const std::vector<FreeStart>& starts() const { return starts_; }
  [[nodiscard]] const std::vector<FreeStart>& ends() const { return ends_; }
  /// Of their common center of mass, at the end of the step, m/s.
  [[nodiscard]] const Vec3& velocity() const { return velocity_; }

  /// Where they are after a part of their way, as seen from their center of mass unless something holds them; with the
  /// velocities of its end.
  [[nodiscard]] std::vector<FreeStart> after(double part, bool held) const {
    std::vector<FreeStart> places = ends_;
    if (part == 1) return places;
    const Vec3 moved = held ? Vec3(0, 0, 0) : Vec3(center_ - start_center_);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const FreeStart& start = starts_[i];
      const Vec3 turn = log_map(ends_[i].rotation * start.rotation.conjugate());
      places[i].center = start.center + moved + part * (ends_[i].center - start.center - moved);
      places[i].rotation = (exp_map(Vec3(part * turn)) * start.rotation).normalized();
    }
    return places;
  }

  /// Kinetic, J; of what nothing holds without that of the common center.
  [[nodiscard]] double kinetic(const std::vector<FreeStart>& places, const Vec3& without) const {
    double sum = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Body& body = bodies_[all_[i]];
      sum += 0.5 * body.mass().mass * (places[i].twist.linear - without).squaredNorm() +
             0.5 * places[i].twist.angular.dot(body.world_inertia(places[i].rotation) * places[i].twist.angular);
    }
    return sum;
  }

  /// Of the springs, J.
  [[nodiscard]] double stored(const std::vector<FreeStart>& places) const {
    double sum = 0;
    each_spring(island_, bodies_, [&](const End& a, const End& b, double length, double stiffness) {
      const double stretch = (point_of(b, places) - point_of(a, places)).norm() - length;
      sum += 0.5 * stiffness * stretch * stretch;
    });
    return sum;
  }

  /// About their common center of mass.
  [[nodiscard]] Vec3 angular_momentum(const std::vector<FreeStart>& places, const Vec3& center,
                                      const Vec3& velocity) const {
    Vec3 sum(0, 0, 0);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Body& body = bodies_[all_[i]];
      sum += body.mass().mass * (places[i].center - center).cross(places[i].twist.linear - velocity) +
             body.world_inertia(places[i].rotation) * places[i].twist.angular;
    }
    return sum;
  }
  [[nodiscard]] Vec3 start_momentum() const { return angular_momentum(starts_, start_center_, start_velocity_); }
  [[nodiscard]] double start_energy(bool held) const {
    return kinetic(starts_, held ? Vec3(0, 0, 0) : start_velocity_) + stored(starts_);
  }
  [[nodiscard]] const Vec3& center() const { return center_; }

  [[nodiscard]] Mat3 inertia(const std::vector<FreeStart>& places) const {
    Mat3 sum = Mat3::Zero();
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Body& body = bodies_[all_[i]];
      const Vec3 arm = places[i].center - center_;
      sum += body.mass().mass * (arm.squaredNorm() * Mat3::Identity() - arm * arm.transpose()) +
             body.world_inertia(places[i].rotation);
    }
    return sum + firming * sum.trace() * Mat3::Identity();
  }

 private:
  [[nodiscard]] Vec3 point_of(const End& end, const std::vector<FreeStart>& places) const {
    if (end.body == joints::JointLink::world) return end.local;
    const auto found = std::lower_bound(all_.begin(), all_.end(), end.body);
    if (found != all_.end() && *found == end.body) {
      const FreeStart& place = places[static_cast<std::size_t>(found - all_.begin())];
      return place.center + place.rotation * end.local;
    }
    const Body& body = bodies_[end.body];
    return body.center + body.motion.pose.rotation * end.local;
  }

  const IslandContents& island_;
  const std::vector<Body>& bodies_;
  const std::vector<std::uint32_t>& all_;
  std::vector<FreeStart> starts_, ends_;
  Vec3 start_center_{0, 0, 0}, center_{0, 0, 0}, start_velocity_{0, 0, 0}, velocity_{0, 0, 0};
};

/// Energies that something leaves at a place: of what cannot slow down, and of what can.
struct Left {
  double least = 0, more = 0;
};

}  // namespace

void bound_sprung(const IslandContents& island, std::vector<Body>& bodies, const std::vector<forces::Load>& loads,
                  const std::vector<char>& moved, double dt, const std::function<FreeStart(std::uint32_t)>& start_of) {
  if ((island.springs.empty() && island.joints.empty()) || follows(island, bodies, dt)) return;
  const MovedBodies those(island, bodies, moved);
  if (!those.passive || those.all.empty()) return;
  const Sprung sprung(island, bodies, those.all, start_of);
  // What nothing holds and every load moves alike has no work done on it, as seen from its center.
  bool held = those.held;
  const forces::Load& first = loads[those.all.front()];
  for (const std::uint32_t index : those.all) {
    const forces::Load& load = loads[index];
    if (bodies[index].drive.owner() == Owner::driven) return;
    held = held || load.acceleration != first.acceleration || load.end_acceleration != first.end_acceleration ||
           load.torque != Vec3::Zero() || load.drag > 0 || load.angular_drag > 0 || load.angular_damping > 0;
  }
  double work = 0, most = 0;
  for (std::size_t i = 0; held && i < those.all.size(); ++i) {
    const forces::Load& load = loads[those.all[i]];
    const FreeStart &start = sprung.starts()[i], &end = sprung.ends()[i];
    const Vec3 force = 0.5 * bodies[those.all[i]].mass().mass * (load.acceleration + load.end_acceleration);
    const double its =
        force.dot(end.center - start.center) + load.torque.dot(log_map(end.rotation * start.rotation.conjugate()));
    work += its;
    most += std::abs(its);
  }
  const double before = sprung.start_energy(held);
  const double allowed = std::max(0.0, before + work + gain_of_rounding * (before + most));
  const Vec3 velocity = held ? Vec3(0, 0, 0) : sprung.velocity();
  if (sprung.kinetic(sprung.ends(), velocity) + sprung.stored(sprung.ends()) <= allowed) return;

  const Vec3 momentum = held ? Vec3(0, 0, 0) : sprung.start_momentum();
  std::vector<FreeStart> places;
  Mat3 inverse = Mat3::Zero();
  Vec3 astray(0, 0, 0);
  Left left;
  double part = 1;
  for (int halving = 0;; ++halving, part = halving < most_halvings ? 0.5 * part : 0) {
    places = sprung.after(part, held);
    if (!held) inverse = sprung.inertia(places).inverse();
    astray = held ? Vec3(0, 0, 0) : sprung.angular_momentum(places, sprung.center(), velocity);
    left.least = sprung.stored(places) + 0.5 * momentum.dot(inverse * momentum);
    left.more = sprung.kinetic(places, velocity) - 0.5 * astray.dot(inverse * astray);
    if (left.least <= allowed || part == 0) break;
  }
  const double room = std::max(0.0, allowed - left.least);
  const double share = left.more <= room ? 1 : std::sqrt(room / left.more);
  const Vec3 turn = inverse * (momentum - share * astray);
  HandedBack handed_back(island, bodies);
  for (std::size_t i = 0; i < places.size(); ++i) {
    Body& body = bodies[those.all[i]];
    const Twist before_it = body.twist;
    body.center = places[i].center;
    body.twist.linear =
        velocity + share * (before_it.linear - velocity) + turn.cross(Vec3(places[i].center - sprung.center()));
    body.twist.angular = share * before_it.angular + turn;
    handed_back.note(those.all[i], body.mass().mass * (body.twist.linear - before_it.linear));
    body.follow_center(places[i].rotation);
  }
  handed_back.hand_back();
}

}  // namespace tweenfall::islands
