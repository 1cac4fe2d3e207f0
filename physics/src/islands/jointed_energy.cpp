#include "islands/jointed_energy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "islands/handed_back.h"
#include "joints/kinds/kinds.h"

namespace tweenfall::islands {

using state::Body;

namespace {

/// Blows that joints hand on between bodies of like masses leave hardly more energy than they had.
constexpr double much_lighter = 10;

/// Whether a body that moves has `much_lighter` times the mass of another.
bool has_unlike(const IslandContents& island, const std::vector<Body>& bodies) {
  double least = std::numeric_limits<double>::infinity(), greatest = 0;
  for (const joints::JointLink* link : island.joints)
    for (const std::uint32_t index : {link->a, link->b}) {
      if (index == joints::JointLink::world || bodies[index].immovable()) continue;
      least = std::min(least, bodies[index].mass().mass);
      greatest = std::max(greatest, bodies[index].mass().mass);
    }
  return greatest > much_lighter * least;
}

/// The bodies of an island that its solver moved, in order, each once.
class Held {
 public:
  Held(const IslandContents& island, const std::vector<Body>& bodies, const std::vector<char>& moved)
      : bodies_(bodies), moved_(moved) {
    for (const contacts::ContactConstraint* contact : island.contacts) {
      const std::span<const contacts::PointConstraint> points = contact->points;
      const bool pushed =
          std::ranges::any_of(points.first(static_cast<std::size_t>(contact->count)),
                              [](const contacts::PointConstraint& point) { return point.total_normal > 0; });
      end(contact->a, pushed);
      end(contact->b, pushed);
    }
    for (const joints::JointLink* link : island.joints) {
      if (link->a == joints::JointLink::world)
        held = true;
      else
        end(link->a, true);
      end(link->b, true);
      passive = passive && !joints::gives_energy(link->joint->settings.kind);
    }
    std::sort(free.begin(), free.end());
    free.erase(std::unique(free.begin(), free.end()), free.end());
  }

  bool passive = true;  ///< nothing that moves by its own will gives energy
  bool held = false;    ///< by something immovable
  std::vector<std::uint32_t> free;

 private:
  void end(std::uint32_t index, bool holds) {
    const Body& body = bodies_[index];
    passive = passive && !body.conveys && !(body.immovable() && body.displaces());
    if (body.immovable())
      held = held || holds;
    else if (moved_[index] != 0)
      free.push_back(index);
  }

  const std::vector<Body>& bodies_;
  const std::vector<char>& moved_;
};

double energy_of(const Body& body, const Quat& rotation, const Twist& twist) {
  return 0.5 * body.mass().mass * twist.linear.squaredNorm() +
         0.5 * twist.angular.dot(body.world_inertia(rotation) * twist.angular);
}

}  // namespace

void bound_jointed(const IslandContents& island, std::vector<Body>& bodies, const std::vector<forces::Load>& loads,
                   const std::vector<char>& moved, double dt, const std::function<FreeStart(std::uint32_t)>& start_of) {
  if (island.joints.empty() || !island.springs.empty() || !has_unlike(island, bodies)) return;
  const Held held(island, bodies, moved);
  if (!held.held || !held.passive) return;
  double before = 0, work = 0, most = 0, after = 0;
  for (const std::uint32_t index : held.free) {
    const Body& body = bodies[index];
    const forces::Load& load = loads[index];
    if (body.drive.owner() == Owner::driven || load.torque != Vec3::Zero()) return;
    const FreeStart start = start_of(index);
    // What corrections of overlaps and of joints move a body takes no speed from it.
    const Vec3 way = 0.5 * dt * (start.twist.linear + body.twist.linear);
    const double fallen = 0.5 * body.mass().mass * (load.acceleration + load.end_acceleration).dot(way);
    before += energy_of(body, start.rotation, start.twist);
    work += fallen;
    most += std::abs(fallen);
    after += energy_of(body, body.motion.pose.rotation, body.twist);
  }
  const double allowed = std::max(0.0, before + work + passable_gain * (before + most));
  if (after <= allowed) return;
  const double share = std::sqrt(allowed / after);
  HandedBack handed_back(island, bodies);
  for (const std::uint32_t index : held.free) {
    Body& body = bodies[index];
    handed_back.note(index, (share - 1) * body.mass().mass * body.twist.linear);
    body.twist.linear *= share;
    body.twist.angular *= share;
    body.follow_center(body.motion.pose.rotation);
  }
  handed_back.hand_back();
}

}  // namespace tweenfall::islands
