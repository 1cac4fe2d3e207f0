#include <algorithm>
#include <cmath>

#include "collision/surfaces/surface.h"
#include "islands/small/part_of_step.h"
#include "state/world_data.h"
#include "step/solver.h"

/// Small islands in which something turns so fast, or is about to, that contacts found once per step say nothing
/// about its end: they go through the step in pieces, and every piece finds its contacts again.

namespace tweenfall {

namespace small {
namespace {

using contacts::ContactConstraint;
using state::Body;

/// Greatest number of contacts of an island that is cut into pieces.
constexpr std::size_t most_contacts = 32;
/// A step in which something may turn by more than `much` is cut into pieces in which it turns by at most `little`,
/// rad.
constexpr double much = 1.5;
constexpr double little = 0.15;
constexpr int most_pieces = 600;
/// Number of pieces for a body that no pieces can follow, as it turns by more than `beyond_following` in a step, rad:
/// it stays bounded, in bounded time.
constexpr int pieces_of_unfollowed = 60;
constexpr double beyond_following = 1e5;
constexpr int least_sub_steps = 8;

bool round(const Body& body) {
  return std::holds_alternative<Sphere>(body.shape().solid);
}

/// By how much the bodies of a contact may turn in a step, relative to each other and by the blow that they give each
/// other, rad.
double turn_of(const ContactConstraint& contact, const std::vector<Body>& bodies, double dt) {
  const Body &a = bodies[contact.a], &b = bodies[contact.b];
  if (round(a) && round(b)) return 0;
  double size = std::numeric_limits<double>::infinity(), turn = 0;
  for (const Body* body : {&a, &b}) {
    if (body->immovable() || round(*body)) continue;
    size = std::min(size, body->radius());
    turn += body->twist.angular.norm();
  }
  if (std::isinf(size)) return 0;
  const Vec3& normal = contact.manifold.normal;
  const double closing = std::max(0.0, normal.dot(a.twist.linear - b.twist.linear));
  return (turn + closing / size) * dt;
}

}  // namespace
}  // namespace small

int World::Implementation::pieces_of(const islands::IslandContents& island, double dt) const {
  if (island.contacts.size() > small::most_contacts || !island.springs.empty() || !island.joints.empty()) return 1;
  double turn = 0;
  for (const contacts::ContactConstraint* contact : island.contacts) {
    turn = std::max(turn, small::turn_of(*contact, bodies, dt));
    for (const std::uint32_t index : {contact->a, contact->b})
      if (bodies[index].displaces() || bodies[index].drive.owner() == Owner::driven ||
          surfaces::surface_of(bodies[index].shape().solid))
        return 1;
  }
  if (!(turn > small::much)) return 1;
  if (!(turn < small::beyond_following)) return small::pieces_of_unfollowed;
  return static_cast<int>(std::min<double>(std::ceil(turn / small::little), small::most_pieces));
}

void World::Implementation::solve_in_pieces(const islands::IslandContents& island, int pieces, double dt,
                                            step::Solver& solver) {
  const double h = dt / pieces;
  const int sub_steps = std::max(1, (small::least_sub_steps + pieces - 1) / pieces);
  small::PartsOfStep parts(island, bodies);
  for (int piece = 0; piece < pieces; ++piece) {
    const std::span<contacts::ContactConstraint* const> near = find_again(island, parts, h);
    begin_part(parts);
    if (!near.empty()) solver.solve(bodies, loads, near, {}, settings, h, moved, sub_steps);
    end_part(parts, near, h);
  }
  parts.finish(dt);
  for (const std::uint32_t index : parts.movable()) moved[index] = 1;
}

}  // namespace tweenfall
