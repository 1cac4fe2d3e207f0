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
    reach.extent = std::max(reach.extent, world[node].origin.cwiseAbs().maxCoeff());
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

namespace {

/// Compares the poses of a compiled clip with the exact path.
class Comparison {
 public:
  Comparison(const ExactPose& exact, const CompiledClip& clip, double arm)
      : exact_(exact),
        clip_(clip),
        arm_(arm),
        motions_(exact.nodes().size()),
        wanted_(exact.nodes().size()),
        found_(exact.nodes().size()),
        pose_(crowd_groups(exact.nodes().size())) {}

  /// The largest distance of a point, m.
  /// @param frames  where the joints are on the exact path; empty: this is found
  /// @param enough  what is nearer than this need not be told exactly, m
  [[nodiscard]] double distance(double time, Side side, std::span<const WorldFrame> frames, double enough) {
    place(time, side);
    const double as_told = frames.empty() ? distance_from(time, side) : distance_from(frames);
    if (side == Side::out || as_told < enough) return as_told;
    // Formulas jump from one number to the next: then what arrives is what was there just before.
    return std::min(as_told, distance_from(std::nextafter(time, 0.0), Side::out));
  }

 private:
  void place(double time, Side side) {
    const Hierarchy& nodes = exact_.nodes();
    sample_with(fastest_sample_kernels(), clip_, time, side == Side::in, 1, pose_.data(), nullptr);
    for (std::size_t node = 0; node < nodes.size(); ++node) {
      const CrowdGroup& group = pose_[node / CrowdGroup::size];
      const std::size_t lane = node % CrowdGroup::size;
      Pose& local = motions_[node].pose;
      for (int c = 0; c < 3; ++c) {
        local.position[c] = group.translation[c][lane];
        local.scale[c] = group.scale[c][lane];
      }
      for (int c = 0; c < 4; ++c) local.rotation.coeffs()[c] = group.rotation[c][lane];
    }
    nodes.world_frames(motions_, found_);
  }

  [[nodiscard]] double distance_from(double time, Side side) {
    exact_.sample(time, side, motions_);
    exact_.nodes().world_frames(motions_, wanted_);
    return distance_from(wanted_);
  }

  [[nodiscard]] double distance_from(std::span<const WorldFrame> wanted) const {
    double largest = 0;
    for (std::size_t node = 0; node < wanted.size(); ++node)
      for (int axis = 0; axis < 3; ++axis) {
        const Vec3 tip = arm_ * Vec3::Unit(axis);
        const double error = (wanted[node].point(tip) - found_[node].point(tip)).norm();
        if (std::isnan(error)) return std::numeric_limits<double>::infinity();
        largest = std::max(largest, error);
      }
    return largest;
  }

  const ExactPose& exact_;
  const CompiledClip& clip_;
  double arm_;
  std::vector<Motion> motions_;
  std::vector<WorldFrame> wanted_, found_;
  std::vector<CrowdGroup> pose_;
};

}  // namespace

std::vector<WorldFrame> exact_frames(const ExactPose& exact, std::span<const Instant> instants) {
  const std::size_t count = exact.nodes().size();
  std::vector<Motion> local(count);
  std::vector<WorldFrame> frames(instants.size() * count);
  for (std::size_t i = 0; i < instants.size(); ++i) {
    exact.sample(instants[i].time, instants[i].side, local);
    exact.nodes().world_frames(local, std::span(frames).subspan(i * count, count));
  }
  return frames;
}

LargestError largest_error(const ExactPose& exact, const CompiledClip& clip, double arm,
                           std::span<const Instant> instants, std::span<const WorldFrame> frames) {
  Comparison comparison(exact, clip, arm);
  LargestError largest;
  const std::size_t count = frames.empty() ? 0 : exact.nodes().size();
  for (std::size_t i = 0; i < instants.size(); ++i) {
    const double distance =
        comparison.distance(instants[i].time, instants[i].side, frames.subspan(i * count, count), largest.distance);
    if (distance > largest.distance) largest = {distance, instants[i].time};
  }
  return largest;
}

}  // namespace tweenfall::crowd
