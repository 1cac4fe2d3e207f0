#include "compiling/measuring.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "crowd/sample_kernels.h"

namespace tweenfall::crowd {

namespace {

/// Of a piece of a channel, so much goes unmeasured at most.
constexpr double unmeasured_part = 0.28867513459481287;

/// When errors have to be measured next.
class Measured {
 public:
  explicit Measured(std::span<const std::vector<double>* const> channels)
      : channels_(channels), next_(channels.size(), 0) {}

  /// @param time  when they were measured; only grows
  [[nodiscard]] double next_after(double time) {
    double next = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < channels_.size(); ++i) {
      const std::vector<double>& knots = *channels_[i];
      while (next_[i] < knots.size() && knots[next_[i]] <= time) ++next_[i];
      // What is left of a piece may be short enough; then those behind it count.
      double since = time;
      for (std::size_t k = std::max<std::size_t>(next_[i], 1); k < knots.size() && since < next; ++k) {
        const double due = since + unmeasured_part * (knots[k] - knots[k - 1]);
        if (due < knots[k]) {
          next = std::min(next, due);
          break;
        }
        since = knots[k];
      }
    }
    return next;
  }

 private:
  std::span<const std::vector<double>* const> channels_;
  std::vector<std::size_t> next_;  // of each channel: its first knot behind the time
};

}  // namespace

std::vector<Instant> telling_instants(std::span<const std::vector<double>* const> channels, std::vector<double> bends,
                                      double duration) {
  // Where a channel jumps, it has two knots.
  for (const std::vector<double>* knots : channels)
    for (std::size_t i = 1; i < knots->size(); ++i)
      if ((*knots)[i] == (*knots)[i - 1]) bends.push_back((*knots)[i]);
  bends.insert(bends.end(), {0.0, duration});
  std::ranges::sort(bends);
  bends.erase(std::unique(bends.begin(), bends.end()), bends.end());
  Measured measured(channels);
  std::vector<Instant> instants;
  for (std::size_t i = 0; i < bends.size(); ++i) {
    if (i > 0) instants.push_back({bends[i], Side::in});
    instants.push_back({bends[i], Side::out});
    if (i + 1 == bends.size()) break;
    const double most = unmeasured_part * (bends[i + 1] - bends[i]);
    for (double time = bends[i];;) {
      time = std::max(std::min(measured.next_after(time), time + most), std::nextafter(time, duration));
      if (!(time < bends[i + 1])) break;
      instants.push_back({time, Side::out});
    }
  }
  return instants;
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

/// So many instants are measured at first while forms are sought.
constexpr std::size_t first_some = 4096;
/// So many of those at which a clip was too far off are added to them.
constexpr std::size_t most_added = 256;
/// So many poses of joints of the exact path are kept, for they are needed again and again.
constexpr std::size_t most_frames = 1'000'000;
/// All are measured in so many rounds, each of which goes through the clip: what is too far off is found early.
constexpr std::size_t spread = 16;

}  // namespace

Measuring::Measuring(const ExactPose& exact, double arm, std::vector<Instant> instants)
    : exact_(exact), arm_(arm), instants_(std::move(instants)) {
  const std::size_t count = std::min(first_some, instants_.size());
  frames_.reserve(std::min(count * exact.nodes().size(), most_frames));
  for (std::size_t i = 0; i < count; ++i) add(instants_[i * instants_.size() / count]);
}

void Measuring::add(const Instant& instant) {
  const std::size_t nodes = exact_.nodes().size();
  if (frames_.size() == some_.size() * nodes && frames_.size() + nodes <= most_frames) {
    std::vector<Motion> local(nodes);
    exact_.sample(instant.time, instant.side, local);
    frames_.resize(frames_.size() + nodes);
    exact_.nodes().world_frames(local, std::span(frames_).last(nodes));
  }
  some_.push_back(instant);
}

void Measuring::at_some(const CompiledClip& clip, LargestError& known, std::size_t& measured) const {
  Comparison comparison(exact_, clip, arm_);
  const std::size_t nodes = exact_.nodes().size();
  for (; measured < some_.size(); ++measured) {
    const Instant& instant = some_[measured];
    std::span<const WorldFrame> frames;
    if ((measured + 1) * nodes <= frames_.size()) frames = std::span(frames_).subspan(measured * nodes, nodes);
    const double distance = comparison.distance(instant.time, instant.side, frames, known.distance);
    if (distance > known.distance) known = {distance, instant.time};
  }
}

LargestError Measuring::at_all(const CompiledClip& clip, const LargestError& known, double allowed) {
  if (instants_.size() <= first_some) return known;
  Comparison comparison(exact_, clip, arm_);
  LargestError largest;
  std::vector<std::pair<double, Instant>> beyond;
  for (std::size_t round = 0; round < spread && beyond.empty(); ++round)
    for (std::size_t i = round; i < instants_.size(); i += spread) {
      const Instant& instant = instants_[i];
      const double distance = comparison.distance(instant.time, instant.side, {}, largest.distance);
      if (distance > largest.distance) largest = {distance, instant.time};
      if (distance > allowed) beyond.emplace_back(distance, instant);
    }
  std::ranges::stable_sort(beyond, std::greater{}, [](const auto& one) { return one.first; });
  beyond.resize(std::min(beyond.size(), most_added));
  for (const auto& [distance, instant] : beyond) add(instant);
  return largest;
}

}  // namespace tweenfall::crowd
