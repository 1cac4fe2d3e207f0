#include "compiling/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "crowd/sample_kernels.h"

namespace tweenfall::crowd {

namespace {

constexpr int looks = 48;
constexpr double least_reach = 1e-6;  // m; anything nearer to its joint cannot be seen

double longest_column(const Mat3& linear) {
  return std::max({linear.col(0).norm(), linear.col(1).norm(), linear.col(2).norm()});
}

void look_at(const ExactPose& exact, double arm, std::span<const WorldFrame> world, Reach& reach) {
  const Hierarchy& nodes = exact.nodes();
  for (std::size_t node = 0; node < nodes.size(); ++node) {
    const double tip = arm * longest_column(world[node].linear);
    // All joints above it reach that far.
    for (std::size_t above = node; above != no_node; above = nodes[above].parent) {
      Reach::OfJoint& of = reach.joints[above];
      of.farthest = std::max(of.farthest, (world[node].origin - world[above].origin).norm() + tip);
    }
    if (nodes[node].parent != no_node)
      reach.joints[node].stretch =
          std::max(reach.joints[node].stretch, longest_column(world[nodes[node].parent].linear));
  }
}

}  // namespace

Reach reach_of(const ExactPose& exact, double arm) {
  const std::size_t count = exact.nodes().size();
  Reach reach{std::vector<Reach::OfJoint>(count)};
  std::vector<Motion> local(count);
  std::vector<WorldFrame> world(count);
  std::vector<double> least_scale(count, std::numeric_limits<double>::infinity());
  for (int i = 0; i <= looks; ++i) {
    exact.sample(exact.duration() * i / looks, Side::out, local);
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
  for (std::size_t node = 0; node < count; ++node) {
    Reach::OfJoint& of = reach.joints[node];
    of.farthest = std::max(of.farthest, least_reach);
    of.farthest_unscaled = of.farthest / std::clamp(least_scale[node], 1e-2, 1e6);
  }
  return reach;
}

double largest_error(const ExactPose& exact, const CompiledClip& clip, double arm, std::span<const double> times) {
  const Hierarchy& nodes = exact.nodes();
  std::vector<Motion> wanted(nodes.size()), found(nodes.size());
  std::vector<WorldFrame> wanted_world(nodes.size()), found_world(nodes.size());
  std::vector<CrowdGroup> pose(crowd_groups(nodes.size()));
  double largest = 0;
  for (const double time : times)
    for (const Side side : {Side::in, Side::out}) {
      if (time <= 0 && side == Side::in) continue;  // the time before its start does not belong to the clip
      exact.sample(time, side, wanted);
      nodes.world_frames(wanted, wanted_world);
      sample_with(fastest_sample_kernels(), clip, time, side == Side::in, 1, pose.data(), nullptr);
      for (std::size_t node = 0; node < nodes.size(); ++node) {
        const CrowdGroup& group = pose[node / CrowdGroup::size];
        const std::size_t lane = node % CrowdGroup::size;
        Pose& local = found[node].pose;
        for (int c = 0; c < 3; ++c) {
          local.position[c] = group.translation[c][lane];
          local.scale[c] = group.scale[c][lane];
        }
        for (int c = 0; c < 4; ++c) local.rotation.coeffs()[c] = group.rotation[c][lane];
      }
      nodes.world_frames(found, found_world);
      for (std::size_t node = 0; node < nodes.size(); ++node)
        for (int axis = 0; axis < 3; ++axis) {
          const Vec3 tip = arm * Vec3::Unit(axis);
          const double error = (wanted_world[node].point(tip) - found_world[node].point(tip)).norm();
          // NaN counts as an infinite error.
          largest = error <= largest ? largest : std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
        }
    }
  return largest;
}

}  // namespace tweenfall::crowd
