#include "crowd/sample_kernels.h"

#include "crowd/lanes.h"

#include <array>

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::crowd {

namespace {

template <std::size_t count, Packing packing>
TWEENFALL_CROWD_LANES void unpack(const std::int32_t* row, Lanes (&out)[count]) {
  if constexpr (packing == Packing::exact) {
    for (std::size_t c = 0; c < count; ++c) out[c] = reinterpret_cast<Lanes>(load_words(row + c * lane_count));
  } else if constexpr (packing == Packing::wide) {
    const Words low = load_words(row), high = load_words(row + lane_count);
    out[0] = field<0, 16>(low);
    out[1] = field<16, 16>(low);
    out[2] = field<0, 16>(high);
    if constexpr (count == 4) out[3] = field<16, 16>(high);
  } else if constexpr (count == 3) {
    const Words row_words = load_words(row);
    out[0] = field<0, 10>(row_words);
    out[1] = field<10, 10>(row_words);
    out[2] = field<22, 10>(row_words);
  } else {
    const Words row_words = load_words(row);
    out[0] = field<0, 8>(row_words);
    out[1] = field<8, 8>(row_words);
    out[2] = field<16, 8>(row_words);
    out[3] = field<24, 8>(row_words);
  }
}

/// The sum of `rows` rows, each times its weight; and for rates times its rate weight.
template <std::size_t count, Packing packing, int rows, bool rates>
TWEENFALL_CROWD_LANES void weighted_rows(const std::int32_t* first, std::size_t row_words, const Lanes* weights,
                                         const Lanes* rate_weights, Lanes (&value)[count], Lanes (&rate)[count]) {
  for (int row = 0; row < rows; ++row) {
    Lanes part[count];
    unpack<count, packing>(first + static_cast<std::size_t>(row) * row_words, part);
    for (std::size_t c = 0; c < count; ++c) {
      value[c] = row == 0 ? part[c] * weights[row] : value[c] + part[c] * weights[row];
      if constexpr (rates) rate[c] = row == 0 ? part[c] * rate_weights[row] : rate[c] + part[c] * rate_weights[row];
    }
  }
}

/// Row weights, each repeated for every lane. They are widened here and not where they are set, because reading them is
/// only fast if they were written at the same width.
struct LaneWeights {
  Lanes base[4], fine[2], sum;
};

template <Packing base, Packing fine>
TWEENFALL_CROWD_LANES void spread(const RowWeights& weights, LaneWeights& lanes) {
  if constexpr (base != Packing::none)
    for (std::size_t i = 0; i < 4; ++i) lanes.base[i] = splat(weights.base[i]);
  if constexpr (fine != Packing::none)
    for (std::size_t i = 0; i < 2; ++i) lanes.fine[i] = splat(weights.fine[i]);
  lanes.sum = splat(weights.sum);
}

struct LanePlace {
  LaneWeights value, tangent, value_rate, tangent_rate;
};

/// The current position of the kernel: among the words of the base and fine rows, and among the numbers.
struct Cursor {
  const std::int32_t* base;
  const std::int32_t* fine;
  const float* numbers;
};

/// Adds the values, or the tangents, of a channel; the cursor moves on.
template <std::size_t count, Packing base, Packing fine, bool rates, bool tangents>
TWEENFALL_CROWD_LANES void slots(Cursor& at, const Run& run, const LaneWeights& weights,
                                 const LaneWeights& rate_weights, Lanes (&value)[count], Lanes (&rate)[count]) {
  constexpr bool based = base != Packing::none, has_fine = fine != Packing::none, exact = fine == Packing::exact;
  Lanes smooth[count], smooth_rate[count], rest[count], rest_rate[count];
  if constexpr (based)
    weighted_rows<count, base, 4, rates>(at.base, run.base_row, weights.base, rate_weights.base, smooth, smooth_rate);
  if constexpr (has_fine)
    weighted_rows<count, fine, 2, rates>(at.fine, run.fine_row, weights.fine, rate_weights.fine, rest, rest_rate);
  for (std::size_t c = 0; c < count; ++c) {
    if constexpr (exact) {
      value[c] = rest[c];
      if constexpr (rates) rate[c] = rest_rate[c];
    } else {
      const Lanes offset = load(at.numbers);
      // The weights of the values sum to 1; those of the tangents do not.
      value[c] = tangents ? offset * weights.sum : offset;
      if constexpr (rates) rate[c] = tangents ? offset * rate_weights.sum : all(0);
      if constexpr (based) {
        const Lanes step = load(at.numbers + lane_count);
        value[c] = value[c] + step * smooth[c];
        if constexpr (rates) rate[c] = rate[c] + step * smooth_rate[c];
      }
      if constexpr (has_fine) {
        const Lanes step = load(at.numbers + (based ? 2 : 1) * lane_count);
        value[c] = value[c] + step * rest[c];
        if constexpr (rates) rate[c] = rate[c] + step * rest_rate[c];
      }
      at.numbers += (1 + (based ? 1 : 0) + (has_fine ? 1 : 0)) * lane_count;
    }
  }
  at.base += words_of(base, count) * lane_count;
  at.fine += words_of(fine, count) * lane_count;
}

template <bool rates>
TWEENFALL_CROWD_LANES void put(Lanes (&value)[3], Lanes (&rate)[3], float (*to)[lane_count],
                               float (*rate_to)[lane_count]) {
  // Not in a loop: g++ 12 would copy the results of a loop of three through memory, in halves.
  store(to[0], value[0]);
  store(to[1], value[1]);
  store(to[2], value[2]);
  if constexpr (rates) {
    store(rate_to[0], rate[0]);
    store(rate_to[1], rate[1]);
    store(rate_to[2], rate[2]);
  }
}

/// Rotations are normalized; p'/|p| without its part along p is half of w p/|p|.
template <bool rates>
TWEENFALL_CROWD_LANES void put(Lanes (&p)[4], Lanes (&rate)[4], float (*to)[lane_count], float (*rate_to)[lane_count]) {
  const Lanes squared = (p[0] * p[0] + p[1] * p[1]) + (p[2] * p[2] + p[3] * p[3]);
  // No compiled clip has a quaternion this close to zero; forged bytes may.
  const Words there = squared > all(1e-4F);
  const Lanes shrink = select(there, all(1) / root(squared), all(0));
  for (std::size_t c = 0; c < 3; ++c) store(to[c], p[c] * shrink);
  store(to[3], select(there, p[3] * shrink, all(1)));
  if constexpr (rates) {
    const Lanes twice = select(there, all(2) / squared, all(0));
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t a = (c + 1) % 3, b = (c + 2) % 3;
      store(rate_to[c], twice * ((p[3] * rate[c] - rate[3] * p[c]) - (rate[a] * p[b] - rate[b] * p[a])));
    }
  }
}

template <std::size_t count, Packing base, Packing fine, bool cubic, bool rates>
TWEENFALL_CROWD_LANES void one_channel(Cursor& at, const Run& run, const LanePlace& place, float (*to)[lane_count],
                                       float (*rate_to)[lane_count]) {
  Lanes value[count], rate[count];
  slots<count, base, fine, rates, false>(at, run, place.value, place.value_rate, value, rate);
  if constexpr (cubic) {
    Lanes more[count], more_rate[count];
    slots<count, base, fine, rates, true>(at, run, place.tangent, place.tangent_rate, more, more_rate);
    for (std::size_t c = 0; c < count; ++c) {
      value[c] = value[c] + more[c];
      if constexpr (rates) rate[c] = rate[c] + more_rate[c];
    }
  }
  put<rates>(value, rate, to, rate_to);
}

template <Packing base, Packing fine, bool cubic, bool rates>
TWEENFALL_CROWD_LANES void each_channel(const CompiledClip& clip, const Run& run, const RunPlace& place,
                                        CrowdGroup* pose, CrowdRates* moving) {
  Cursor at{place.base, place.fine, nullptr};
  LanePlace lanes;
  spread<base, fine>(place.value, lanes.value);
  if constexpr (cubic) spread<base, fine>(place.tangent, lanes.tangent);
  if constexpr (rates) {
    spread<base, fine>(place.value_rate, lanes.value_rate);
    if constexpr (cubic) spread<base, fine>(place.tangent_rate, lanes.tangent_rate);
  }
  const Channel* const end = clip.channels.data() + run.first + run.count;
  for (const Channel* channel = end - run.count; channel != end; ++channel) {
    at.numbers = clip.numbers.data() + channel->numbers;
    CrowdGroup& group = pose[channel->group];
    CrowdRates* const moves = rates ? moving + channel->group : nullptr;
    if (channel->kind == Kind::rotation)
      one_channel<4, base, fine, cubic, rates>(at, run, lanes, group.rotation, rates ? moves->angular : nullptr);
    else if (channel->kind == Kind::translation)
      one_channel<3, base, fine, cubic, rates>(at, run, lanes, group.translation, rates ? moves->linear : nullptr);
    else
      one_channel<3, base, fine, cubic, rates>(at, run, lanes, group.scale, rates ? moves->scale : nullptr);
  }
}

template <Packing base, Packing fine, bool rates>
TWEENFALL_CROWD_LANES void each_channel(const CompiledClip& clip, const Run& run, const RunPlace& place,
                                        CrowdGroup* pose, CrowdRates* moving) {
  if (run.form.cubic)
    each_channel<base, fine, true, rates>(clip, run, place, pose, moving);
  else
    each_channel<base, fine, false, rates>(clip, run, place, pose, moving);
}

template <bool rates>
TWEENFALL_CROWD_LANES void whole_run(const CompiledClip& clip, const Run& run, const RunPlace& place, CrowdGroup* pose,
                                     CrowdRates* moving) {
  constexpr Packing none = Packing::none, narrow = Packing::narrow, wide = Packing::wide;
  const Packing base = run.form.base, fine = run.form.fine;
  if (base == narrow && fine == narrow)
    each_channel<narrow, narrow, rates>(clip, run, place, pose, moving);
  else if (base == narrow)
    each_channel<narrow, none, rates>(clip, run, place, pose, moving);
  else if (base == wide && fine == narrow)
    each_channel<wide, narrow, rates>(clip, run, place, pose, moving);
  else if (base == wide)
    each_channel<wide, none, rates>(clip, run, place, pose, moving);
  else if (fine == narrow)
    each_channel<none, narrow, rates>(clip, run, place, pose, moving);
  else if (fine == wide)
    each_channel<none, wide, rates>(clip, run, place, pose, moving);
  else if (fine == Packing::exact)
    each_channel<none, Packing::exact, rates>(clip, run, place, pose, moving);
  else
    each_channel<none, none, false, rates>(clip, run, place, pose, moving);
}

template <bool rates>
TWEENFALL_CROWD_LANES void all_runs(const CompiledClip& clip, std::span<const RunPlace> places, CrowdGroup* pose,
                                    CrowdRates* moving) {
  for (const RunPlace& place : places) whole_run<rates>(clip, *place.run, place, pose, moving);
}

// The same source for each instruction set. The compiler fuses no multiplication with an addition, so the bits are the
// same.
#define TWEENFALL_CROWD_VERSIONS(name, target)                                                                    \
  target void pose_##name(const CompiledClip& clip, std::span<const RunPlace> places, CrowdGroup* pose) {         \
    all_runs<false>(clip, places, pose, nullptr);                                                                 \
  }                                                                                                               \
  target void pose_and_rates_##name(const CompiledClip& clip, std::span<const RunPlace> places, CrowdGroup* pose, \
                                    CrowdRates* rates) {                                                          \
    all_runs<true>(clip, places, pose, rates);                                                                    \
  }                                                                                                               \
  constexpr SampleKernels name##_kernels = {pose_##name, pose_and_rates_##name};

TWEENFALL_CROWD_VERSIONS(plain, )
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_CROWD_VERSIONS(avx2, [[gnu::target("avx2")]])
TWEENFALL_CROWD_VERSIONS(avx512, TWEENFALL_CROWD_AVX512)
#endif
#undef TWEENFALL_CROWD_VERSIONS

}  // namespace

std::span<const SampleKernels* const> possible_sample_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr std::array all = {&plain_kernels, &avx2_kernels, &avx512_kernels};
#else
  static constexpr std::array all = {&plain_kernels};
#endif
  return std::span(all).first(possible_versions());
}

const SampleKernels& fastest_sample_kernels() {
  static const SampleKernels& fastest = *possible_sample_kernels().back();
  return fastest;
}

}  // namespace tweenfall::crowd
