#include "compiling/measuring.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>

#include "compiling/later_rounds.h"
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

/// So many instants are measured at first while forms are sought.
constexpr std::size_t first_some = 4096;
/// So many of those at which a clip was too far off are added to them.
constexpr std::size_t most_added = 256;
/// So many poses of joints of the exact path are kept, for they are needed again and again.
constexpr std::size_t most_poses = 1'000'000;
/// All are measured in so many rounds, each of which goes through the clip: what is too far off is found early.
constexpr std::size_t spread = 16;
/// Next to errors that are so large a part of the largest there may be still larger ones.
constexpr double large_part = 0.7;
/// There, errors are measured at all knots, and so many times between two instants; elsewhere at a few.
constexpr int many_times = 5, few_times = 2;
/// What lies between two measured times is larger by at most this factor, but for roundings.
constexpr double between = 1.03;

RoundErrors scaled(const RoundErrors& errors, double factor) {
  return {factor * errors.first, factor * errors.later, factor * errors.growth};
}

bool is_within(const RoundErrors& errors, const RoundErrors& bounds) {
  return errors.first <= bounds.first && errors.later <= bounds.later && errors.growth <= bounds.growth;
}

}  // namespace

/// Compares the poses of a compiled clip with the exact path.
class Measuring::Comparison {
 public:
  /// @param all_rounds  whether errors of later rounds are told
  Comparison(const Measuring& measuring, const CompiledClip& clip, bool all_rounds)
      : exact_(measuring.exact_),
        clip_(clip),
        arm_(measuring.arm_),
        rounding_(measuring.rounding_),
        wanted_(exact_.nodes().size()),
        found_(exact_.nodes().size()),
        wanted_frames_(exact_.nodes().size()),
        found_frames_(exact_.nodes().size()),
        pose_(crowd_groups(exact_.nodes().size())) {
    if (all_rounds && !clip.climbs.empty()) later_.emplace(exact_.nodes(), clip.climbs, arm_);
  }

  /// The largest errors of any point.
  /// @param poses   those of the joints on the exact path; empty: they are found
  /// @param enough  errors within these need not be told exactly
  [[nodiscard]] RoundErrors errors(const Instant& at, std::span<const Pose> poses, const RoundErrors& enough) {
    place(at);
    if (poses.empty())
      exact_.sample(at.time, at.side, wanted_);
    else
      for (std::size_t node = 0; node < wanted_.size(); ++node) wanted_[node].pose = poses[node];
    const RoundErrors as_told = compared();
    if (at.side == Side::out || is_within(as_told, enough)) return as_told;
    // Formulas jump from one number to the next: then what arrives is what was there just before.
    exact_.sample(std::nextafter(at.time, 0.0), Side::out, wanted_);
    const RoundErrors before = compared();
    return before.first < as_told.first ? before : as_told;
  }

 private:
  void place(const Instant& at) {
    sample_with(fastest_sample_kernels(), clip_, at.time, at.side == Side::in, 1, pose_.data(), nullptr);
    for (std::size_t node = 0; node < found_.size(); ++node) {
      const CrowdGroup& group = pose_[node / CrowdGroup::size];
      const std::size_t lane = node % CrowdGroup::size;
      Pose& local = found_[node].pose;
      for (int c = 0; c < 3; ++c) {
        local.position[c] = group.translation[c][lane];
        local.scale[c] = group.scale[c][lane];
      }
      for (int c = 0; c < 4; ++c) local.rotation.coeffs()[c] = group.rotation[c][lane];
    }
    exact_.nodes().world_frames(found_, found_frames_);
  }

  [[nodiscard]] RoundErrors compared() {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    exact_.nodes().world_frames(wanted_, wanted_frames_);
    RoundErrors errors;
    if (later_) errors = later_->errors(wanted_, found_);
    for (std::size_t node = 0; node < wanted_.size(); ++node)
      for (int axis = 0; axis < 3; ++axis)
        for (const double arm : {-arm_, arm_}) {
          const Vec3 tip = arm * Vec3::Unit(axis);
          const double error = (wanted_frames_[node].point(tip) - found_frames_[node].point(tip)).norm();
          if (std::isnan(error)) return {infinite, infinite, infinite};
          errors.first = std::max(errors.first, error);
        }
    if (!std::isfinite(errors.later + errors.growth)) return {infinite, infinite, infinite};
    errors = scaled(errors, between);
    errors.first += rounding_;
    return errors;
  }

  const ExactPose& exact_;
  const CompiledClip& clip_;
  double arm_, rounding_;
  std::optional<LaterRounds> later_;
  std::vector<Motion> wanted_, found_;
  std::vector<WorldFrame> wanted_frames_, found_frames_;
  std::vector<CrowdGroup> pose_;
};

/// A clip measured at any time.
class Measuring::Whole {
 public:
  Whole(const Measuring& measuring, const CompiledClip& clip, double allowed)
      : measuring_(measuring),
        instants_(measuring.instants_),
        clip_(clip),
        allowed_(allowed),
        comparison_(measuring, clip, true),
        of_instants_(instants_.size()) {}

  /// @return whether the errors are allowed
  [[nodiscard]] bool measure() {
    for (std::size_t round = 0; round < spread; ++round) {
      for (std::size_t i = round; i < instants_.size(); i += spread) of_instants_[i] = measured(instants_[i]);
      if (largest_.distance > allowed_) return false;
    }
    const RoundErrors large = scaled(largest_.errors, large_part);
    for (std::size_t i = 0; i + 1 < instants_.size(); ++i) {
      const bool are_small = is_within(of_instants_[i], large) && is_within(of_instants_[i + 1], large);
      const double from = instants_[i].time, to = instants_[i + 1].time;
      measure_between(from, to, are_small ? few_times : many_times);
      if (!are_small) measure_knots(from, to);
    }
    return largest_.distance <= allowed_;
  }

  [[nodiscard]] const LargestError& largest() const { return largest_; }
  /// The instants whose errors were too large, the largest first; some of them.
  [[nodiscard]] std::vector<Instant> worst() {
    std::ranges::stable_sort(beyond_, std::greater{}, [](const auto& one) { return one.first; });
    std::vector<Instant> all(telling_, telling_ + 3);
    for (const auto& [distance, instant] : std::span(beyond_).first(std::min(beyond_.size(), most_added)))
      all.push_back(instant);
    return all;
  }

 private:
  void measure_between(double from, double to, int times) {
    for (int k = 1; k <= times; ++k) {
      const double time = from + (to - from) * k / (times + 1);
      if (time > from && time < to) (void)measured({time, Side::out});
    }
  }

  void measure_knots(double from, double to) {
    for (const Timeline& timeline : clip_.timelines) {
      const auto first = std::ranges::upper_bound(timeline.knots, from);
      for (auto knot = first; knot != timeline.knots.end() && *knot < to; ++knot) (void)measured({*knot, Side::out});
    }
  }

  RoundErrors measured(const Instant& at) {
    const RoundErrors errors = comparison_.errors(at, {}, scaled(largest_.errors, large_part));
    const RoundErrors& before = largest_.errors;
    if (errors.first >= before.first) telling_[0] = at;
    if (errors.later >= before.later) telling_[1] = at;
    if (errors.growth >= before.growth) telling_[2] = at;
    measuring_.include(largest_, errors, at.time);
    LargestError alone;
    measuring_.include(alone, errors, at.time);
    if (alone.distance > allowed_) beyond_.emplace_back(alone.distance, at);
    return errors;
  }

  const Measuring& measuring_;
  const std::vector<Instant>& instants_;
  const CompiledClip& clip_;
  double allowed_;
  Comparison comparison_;
  LargestError largest_;
  Instant telling_[3] = {};  // of the largest of each of the errors
  std::vector<RoundErrors> of_instants_;
  std::vector<std::pair<double, Instant>> beyond_;
};

Measuring::Measuring(const ExactPose& exact, double arm, double rounding, int last_round, std::vector<Instant> instants)
    : exact_(exact), arm_(arm), rounding_(rounding), last_round_(last_round), instants_(std::move(instants)) {
  const std::size_t count = std::min(first_some, instants_.size());
  poses_.reserve(std::min(count * exact.nodes().size(), most_poses));
  for (std::size_t i = 0; i < count; ++i) add(instants_[i * instants_.size() / count]);
}

void Measuring::add(const Instant& instant) {
  const std::size_t nodes = exact_.nodes().size();
  if (poses_.size() == some_.size() * nodes && poses_.size() + nodes <= most_poses) {
    std::vector<Motion> local(nodes);
    exact_.sample(instant.time, instant.side, local);
    for (const Motion& motion : local) poses_.push_back(motion.pose);
  }
  some_.push_back(instant);
}

void Measuring::include(LargestError& largest, const RoundErrors& errors, double time) const {
  largest.errors.include(errors);
  const double distance = std::max(largest.errors.first, last_round_ > 0 ? largest.errors.in(last_round_) : 0.0);
  if (distance > largest.distance) {
    largest.distance = distance;
    largest.time = time;
  }
}

void Measuring::at_some(const CompiledClip& clip, LargestError& known, std::size_t& measured) const {
  Comparison comparison(*this, clip, last_round_ > 0);
  const std::size_t nodes = exact_.nodes().size();
  for (; measured < some_.size(); ++measured) {
    std::span<const Pose> poses;
    if ((measured + 1) * nodes <= poses_.size()) poses = std::span(poses_).subspan(measured * nodes, nodes);
    const Instant& instant = some_[measured];
    include(known, comparison.errors(instant, poses, known.errors), instant.time);
  }
}

LargestError Measuring::at_all(const CompiledClip& clip, double allowed) {
  Whole whole(*this, clip, allowed);
  if (!whole.measure())
    for (const Instant& instant : whole.worst()) add(instant);
  return whole.largest();
}

}  // namespace tweenfall::crowd
