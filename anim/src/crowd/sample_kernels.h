#pragma once

// The inner loops of sampling, one version for each instruction set.

#include <tweenfall/anim/play.h>

#include "crowd/compiled_clip.h"

#include <span>

namespace tweenfall::crowd {

/// The factors of the rows around a time.
struct RowWeights {
  float base[4];
  float fine[2];
  float sum;  ///< of the weights of the two knots; used only for tangents
};

/// A run at a time.
struct RunPlace {
  const Run* run;
  const std::int32_t* base;             ///< the first of four rows
  const std::int32_t* fine;             ///< the first of two
  RowWeights value, tangent;            ///< those for tangents are not set where there are none
  RowWeights value_rate, tangent_rate;  ///< not set where no rates are requested
};

struct SampleKernels {
  void (*pose)(const CompiledClip& clip, std::span<const RunPlace> places, CrowdGroup* pose);
  void (*pose_and_rates)(const CompiledClip& clip, std::span<const RunPlace> places, CrowdGroup* pose,
                         CrowdRates* rates);
};

/// For all instruction sets that this processor has, the plainest first. All give the same bits.
[[nodiscard]] std::span<const SampleKernels* const> possible_sample_kernels();
/// The last of them.
[[nodiscard]] const SampleKernels& fastest_sample_kernels();

/// Samples all of a clip by given kernels. @param rates  null for none
void sample_with(const SampleKernels& kernels, const CompiledClip& clip, double time, bool arriving, double rate,
                 CrowdGroup* pose, CrowdRates* rates) noexcept;

/// The same for many figures at their clocks. @param poses  figure after figure
void sample_many_with(const SampleKernels& kernels, const CompiledClip& clip, std::span<const ClipClock> clocks,
                      CrowdGroup* poses) noexcept;

}  // namespace tweenfall::crowd
