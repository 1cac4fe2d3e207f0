#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include "crowd/sample_kernels.h"

namespace tweenfall::crowd {

namespace {

/// The weights of the values and of the tangents at a segment's two knots.
struct SegmentWeights {
  double value[2], tangent[2];
};

SegmentWeights segment_weights(bool cubic, const Timeline::Place& place) {
  const double u = place.u, left = 1 - u;
  if (!cubic) return {{left, u}, {0, 0}};
  const double end = u * u * (3 - 2 * u);
  return {{1 - end, end}, {u * left * left * place.length, -u * u * left * place.length}};
}

SegmentWeights segment_rates(bool cubic, const Timeline::Place& place) {
  if (!(place.length > 0)) return {};
  const double u = place.u, per_second = std::min(1 / place.length, steepest);
  if (!cubic) return {{-per_second, per_second}, {0, 0}};
  const double end = 6 * u * (1 - u) * per_second;
  return {{-end, end}, {(1 - u) * (1 - 3 * u), u * (3 * u - 2)}};
}

/// Of the rows around the knots whose weights are given.
/// @param taps weights of the base's coefficients at the first knot, followed by those at the second; null for no base
void set_weights(RowWeights& weights, const double* of_knots, const float* taps) {
  const float first = static_cast<float>(of_knots[0]), second = static_cast<float>(of_knots[1]);
  if (taps) {
    using Four = float __attribute__((vector_size(16)));
    Four at_first, at_second;
    std::memcpy(&at_first, taps, sizeof at_first);
    std::memcpy(&at_second, taps + 4, sizeof at_second);
    const Four base = first * at_first + second * at_second;
    std::memcpy(weights.base, &base, sizeof base);
  }
  weights.fine[0] = first;
  weights.fine[1] = second;
  // For tangents, whose weights do not sum to 1.
  weights.sum = static_cast<float>(of_knots[0] + of_knots[1]);
}

void set_place(RunPlace& at, const CompiledClip& clip, const Run& run, const Timeline::Place& place, bool with_rates) {
  const Form& form = run.form;
  const float* taps = nullptr;
  if (form.base != Packing::none) {
    const std::uint32_t knot = static_cast<std::uint32_t>(place.knot), row = knot >> run.stride_bits;
    taps = clip.taps.data() + run.taps_begin + std::size_t{4} * (knot & (form.stride - 1));
    at.base = clip.words.data() + run.base_begin + row * run.base_row;
  }
  at.fine = clip.words.data() + run.fine_begin + place.knot * run.fine_row;
  const SegmentWeights weights = segment_weights(form.cubic, place);
  set_weights(at.value, weights.value, taps);
  if (form.cubic) set_weights(at.tangent, weights.tangent, taps);
  if (!with_rates) return;
  const SegmentWeights moving = segment_rates(form.cubic, place);
  set_weights(at.value_rate, moving.value, taps);
  if (form.cubic) set_weights(at.tangent_rate, moving.tangent, taps);
}

/// Several runs are located first, so that their words are loaded from memory in parallel.
constexpr std::size_t at_once = 8;

/// Finds the rows of a clip's runs at a time.
class Locator {
 public:
  Locator() = default;
  Locator(const CompiledClip& clip, double time, bool arriving)
      : clip_(&clip), time_(std::isnan(time) ? 0 : time), arriving_(arriving) {}  // NaN counts as 0

  /// Finds the place on a timeline, for all runs that follow it.
  void look_at(std::uint32_t timeline) {
    timeline_ = timeline;
    place_ = clip_->timelines[timeline].at(time_, arriving_);
  }

  /// Locates the runs from `first` on, as many as are located at once. @param places  `at_once` of them
  std::span<const RunPlace> locate(std::size_t first, bool with_rates, RunPlace* places) {
    const std::size_t count = std::min(at_once, clip_->runs.size() - first);
    for (std::size_t i = 0; i < count; ++i) {
      const Run& run = clip_->runs[first + i];
      places[i].run = &run;
      places[i].base = places[i].fine = nullptr;
      if (run.form.timeline == Form::no_timeline) continue;
      if (run.form.timeline != timeline_) look_at(run.form.timeline);
      set_place(places[i], *clip_, run, place_, with_rates);
    }
    return {places, count};
  }

 private:
  const CompiledClip* clip_ = nullptr;
  double time_ = 0;
  bool arriving_ = false;
  std::uint32_t timeline_ = Form::no_timeline;
  Timeline::Place place_{};
};

void scale_rates(CrowdRates* rates, std::size_t groups, float factor) {
  for (std::size_t g = 0; g < groups; ++g) {
    CrowdRates& group = rates[g];
    for (auto* part : {group.linear, group.angular, group.scale})
      for (std::size_t c = 0; c < 3; ++c)
        for (std::size_t lane = 0; lane < CrowdGroup::size; ++lane) part[c][lane] *= factor;
  }
}

}  // namespace

void sample_with(const SampleKernels& kernels, const CompiledClip& clip, double time, bool arriving, double rate,
                 CrowdGroup* pose, CrowdRates* rates) noexcept {
  RunPlace places[at_once];
  Locator locator(clip, time, arriving);
  for (std::size_t first = 0; first < clip.runs.size(); first += at_once) {
    const std::span<const RunPlace> found = locator.locate(first, rates != nullptr, places);
    if (rates)
      kernels.pose_and_rates(clip, found, pose, rates);
    else
      kernels.pose(clip, found, pose);
  }
  if (rates && rate != 1) scale_rates(rates, crowd_groups(clip.joints), static_cast<float>(rate));
}

void sample_many_with(const SampleKernels& kernels, const CompiledClip& clip, std::span<const ClipClock> clocks,
                      CrowdGroup* poses) noexcept {
  // Each step from a time to a place in the timeline waits for the one before: those of several figures wait together.
  constexpr std::size_t figures = 8;
  const std::size_t groups = crowd_groups(clip.joints);
  const std::uint32_t timeline = clip.runs.empty() ? Form::no_timeline : clip.runs.front().form.timeline;
  RunPlace places[at_once];
  for (std::size_t begin = 0; begin < clocks.size(); begin += figures) {
    const std::span<const ClipClock> some = clocks.subspan(begin, std::min(figures, clocks.size() - begin));
    Locator locators[figures];
    for (std::size_t i = 0; i < some.size(); ++i) {
      locators[i] = Locator(clip, some[i].time, some[i].side == Side::in);
      if (timeline != Form::no_timeline) locators[i].look_at(timeline);
    }
    for (std::size_t i = 0; i < some.size(); ++i)
      for (std::size_t first = 0; first < clip.runs.size(); first += at_once)
        kernels.pose(clip, locators[i].locate(first, false, places), poses + (begin + i) * groups);
  }
}

void climb(const CompiledClip& clip, int cycle, CrowdGroup* pose, CrowdRates* rates) noexcept {
  for (const Climb& joint : clip.climbs) {
    CrowdGroup& group = pose[joint.joint / CrowdGroup::size];
    const std::size_t lane = joint.joint % CrowdGroup::size;
    for (std::size_t c = 0; c < 3; ++c)
      group.translation[c][lane] = static_cast<float>(group.translation[c][lane] + cycle * joint.gain[c]);
    const Vec3 turn(joint.turn[0], joint.turn[1], joint.turn[2]);
    if (turn == Vec3(0, 0, 0)) continue;
    const Quat turned = exp_map(cycle * turn);
    const Quat q = turned * Quat(group.rotation[3][lane], group.rotation[0][lane], group.rotation[1][lane],
                                 group.rotation[2][lane]);
    for (int c = 0; c < 4; ++c) group.rotation[c][lane] = static_cast<float>(q.coeffs()[c]);
    if (!rates) continue;
    auto& angular = rates[joint.joint / CrowdGroup::size].angular;
    const Vec3 moved = turned * Vec3(angular[0][lane], angular[1][lane], angular[2][lane]);
    for (int c = 0; c < 3; ++c) angular[c][lane] = static_cast<float>(moved[c]);
  }
}

std::uint64_t lay_out(CompiledClip& clip) {
  std::uint64_t words = 0;
  clip.taps.clear();
  for (Run& run : clip.runs) {
    run.base_row = run.fine_row = 0;
    run.stride_bits = run.form.stride > 0 ? static_cast<std::uint32_t>(std::bit_width(run.form.stride) - 1) : 0;
    for (std::uint32_t i = run.first; i < run.first + run.count; ++i) {
      const std::size_t count = components(clip.channels[i].kind);
      run.base_row += CrowdGroup::size * run.form.lines(run.form.base, count);
      run.fine_row += CrowdGroup::size * run.form.lines(run.form.fine, count);
    }
    const std::size_t knots =
        run.form.timeline == Form::no_timeline ? 0 : clip.timelines[run.form.timeline].knots.size();
    run.base_begin = static_cast<std::size_t>(words);
    words += std::uint64_t{run.base_row} * run.form.base_rows(knots);
    run.fine_begin = static_cast<std::size_t>(words);
    words += std::uint64_t{run.fine_row} * knots;
    run.taps_begin = clip.taps.size();
    for (std::uint32_t i = 0; run.form.base != Packing::none && i <= run.form.stride; ++i) {
      double weights[4];
      spline_weights(static_cast<double>(i) / run.form.stride, weights);
      for (const double weight : weights) clip.taps.push_back(static_cast<float>(weight));
    }
  }
  const bool lands = std::ranges::any_of(clip.timelines, [](const Timeline& timeline) {
    return timeline.knots.back() == timeline.knots[timeline.knots.size() - 2];
  });
  clip.forwards = clips::rounds_of(clip.duration, clip.loop, false, lands);
  clip.backwards = clips::rounds_of(clip.duration, clip.loop, true, lands);
  return words;
}

}  // namespace tweenfall::crowd
