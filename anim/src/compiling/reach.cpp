#include "compiling/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tweenfall::crowd {

namespace {

constexpr int looks = 48;
constexpr double least_reach = 1e-9;   // m; anything nearer to its joint cannot be seen
constexpr double least_factor = 1e-9;  // of lengths; what is made smaller cannot be seen, either

double longest_column(const Mat3& linear) {
  return std::max({linear.col(0).norm(), linear.col(1).norm(), linear.col(2).norm()});
}

void look_at(const ExactPose& exact, double arm, std::span<const WorldFrame> world, Reach& reach) {
  const Hierarchy& nodes = exact.nodes();
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const double tip = arm * longest_column(world[node].linear);
    reach.extent = std::max(reach.extent, world[node].origin.cwiseAbs().maxCoeff());
    // All joints above it reach that far.
    for (std::size_t above = node; above != no_node; above = nodes[above].parent) {
      Reach::OfJoint& of = reach.joints[above];
      of.farthest = std::max(of.farthest, (world[node].origin - world[above].origin).norm() + tip);
    }
    const std::size_t parent = nodes[node].parent;
    const double stretch = parent == no_node ? 1 : longest_column(world[parent].linear);
    reach.joints[node].stretch = std::max({reach.joints[node].stretch, stretch, least_factor});
  }
}

}  // namespace

Reach reach_of(const ExactPose& exact, double arm, int last_round) {
  const std::size_t count = exact.nodes().size();
  Reach reach{std::vector<Reach::OfJoint>(count)};
  std::vector<Motion> local(count);
  std::vector<WorldFrame> world(count);
  std::vector<double> least_scale(count, std::numeric_limits<double>::infinity());
  for (int i = 0; i < (last_round > 0 ? 2 : 1) * (looks + 1); ++i) {
    exact.sample(exact.duration() * (i % (looks + 1)) / looks, Side::out, local, i <= looks ? 0 : last_round);
    exact.nodes().world_frames(local, world);
    look_at(exact, arm, world, reach);
    for (std::size_t node = 0; node < count; ++node) {
      const Pose& pose = local[node].pose;
      double* const largest = reach.joints[node].largest;
      least_scale[node] = std::min(least_scale[node], pose.scale.cwiseAbs().minCoeff());
      largest[0] = std::max(largest[0], pose.position.cwiseAbs().maxCoeff());
      largest[2] = std::max(largest[2], pose.scale.cwiseAbs().maxCoeff());
    }
  }
  std::vector<double> rounding(count);  // squared
  for (std::size_t node = 0; node < count; ++node) {
    Reach::OfJoint& of = reach.joints[node];
    of.farthest = std::max(of.farthest, least_reach);
    of.farthest_unscaled = of.farthest / std::max({least_scale[node], 1e-2 * of.largest[2], least_factor});
    // Those of many joints hardly ever add up.
    const double place = place_rounding * of.stretch * of.largest[0], turn = axes_rounding * of.farthest;
    rounding[node] = place * place + turn * turn;
    const std::size_t parent = exact.nodes()[node].parent;
    if (parent != no_node) rounding[node] += rounding[parent];
    reach.rounding = std::max(reach.rounding, std::sqrt(rounding[node]));
  }
  return reach;
}

}  // namespace tweenfall::crowd
