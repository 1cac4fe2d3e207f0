#include <algorithm>

#include "islands/blocks/block_solver.h"

/// A foot that comes down stops the whole figure above it. A contact that reckons with the foot's own mass would need a
/// dozen passes for that, each followed by one over the joints.

namespace tweenfall::blocks {

namespace {

/// With more points of contact on a figure than this, none is given more weight: they could only share it.
constexpr std::uint32_t most_borne = 6;
/// Greatest factor. What carries more is a column: as soon as it buckles, it carries far less.
constexpr double most_weight = 8;

}  // namespace

/// Gives contacts of jointed bodies the mass of what joints carry along, so that one pass nearly stops it. Several
/// points on a figure share that mass: together they never push harder than it takes, whatever each knows of the
/// others.
void BlockSolver::weigh_jointed() {
  joints_.find_figures_of_bodies(bodies_.size());
  borne_.assign(joints_.figure_count(), 0);
  const auto figure_of = [this](std::uint32_t place) {
    return bodies_[place].movable ? joints_.figure_of(place) : joints::IslandJoints::none;
  };
  const auto each_lane = [this](const auto& see) {
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const ContactBlocks::Origin& origin = contacts_.origin(i);
      for (int lane = 0; lane < lane_count; ++lane)
        if (origin[static_cast<std::size_t>(lane)]) see(i, lane, *origin[static_cast<std::size_t>(lane)]);
    }
  };
  const std::size_t block_count = contacts_.blocks.size();
  const auto ends_of = [&](std::size_t i, int lane) -> std::array<std::uint32_t, 2> {
    if (i < block_count) return {contacts_.blocks[i].a[lane], contacts_.blocks[i].b[lane]};
    const BallBlock& ball = contacts_.balls[i - block_count];
    return {ball.a[lane], ball.b[lane]};
  };
  each_lane([&](std::size_t i, int lane, const contacts::ContactConstraint& contact) {
    for (const std::uint32_t end : ends_of(i, lane))
      if (const std::uint32_t figure = figure_of(end); figure != joints::IslandJoints::none)
        borne_[figure] += static_cast<std::uint32_t>(contact.count);
  });
  // Calls see(place, turn) for both ends of a contact: the mean of its points' arms x normal.
  const auto each_turn = [&](const contacts::ContactConstraint& contact, const std::array<std::uint32_t, 2>& ends,
                             const auto& see) {
    Vec3 arm_a = Vec3::Zero(), arm_b = Vec3::Zero();
    for (std::size_t k = 0; k < static_cast<std::size_t>(contact.count); ++k) {
      arm_a += contact.points[k].start_arm_a / contact.count;
      arm_b += contact.points[k].start_arm_b / contact.count;
    }
    see(ends[0], arm_a.cross(contact.manifold.normal));
    see(ends[1], arm_b.cross(contact.manifold.normal));
  };
  const auto carries = [&](std::uint32_t place) {
    const std::uint32_t figure = figure_of(place);
    return figure != joints::IslandJoints::none && borne_[figure] <= most_borne;
  };
  pushes_.clear();
  each_lane([&](std::size_t i, int lane, const contacts::ContactConstraint& contact) {
    each_turn(contact, ends_of(i, lane), [&](std::uint32_t place, const Vec3& turn) {
      if (carries(place)) pushes_.push_back({place, contact.manifold.normal, turn, 0});
    });
  });
  if (pushes_.empty()) return;
  joints_.respond(pushes_);
  std::size_t next = 0;
  each_lane([&](std::size_t i, int lane, const contacts::ContactConstraint& contact) {
    double alone = 0, carrying = 0;
    each_turn(contact, ends_of(i, lane), [&](std::uint32_t place, const Vec3& turn) {
      const IslandBody& body = bodies_[place];
      const double own = body.inverse_mass + turn.dot(body.inverse_inertia * turn);
      alone += own;
      if (!carries(place)) {
        carrying += own;
        return;
      }
      const double shared = borne_[joints_.figure_of(place)] * pushes_[next++].inverse;
      carrying += std::clamp(shared, 0.0, own);
    });
    if (!(carrying < alone)) return;
    const double weight = std::min(most_weight, alone / carrying);
    if (i >= block_count) {
      contacts_.balls[i - block_count].mass[lane] *= weight;
      return;
    }
    ContactBlock& block = contacts_.blocks[i];
    block.weight[lane] = weight;
    for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(contact.count); ++k)
      contacts_.points[block.point + k].mass[lane] *= weight;
  });
}

}  // namespace tweenfall::blocks
