#pragma once

// Eight floats side by side. Each operation rounds as for a single float, so that the bits do not depend on the width
// of the processor's vectors.

#include "crowd/compiled_clip.h"

#include <cstddef>
#include <cstdint>

namespace tweenfall::crowd {

using Lanes = float __attribute__((vector_size(32), aligned(32)));
using Words = std::int32_t __attribute__((vector_size(32), aligned(32)));

/// How many versions of a kernel this processor can run, in the order plain, AVX2, AVX-512: the last has more
/// registers, which here stay as wide.
[[nodiscard]] inline std::size_t possible_versions() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  if (!__builtin_cpu_supports("avx2")) return 1;
  return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") ? 3 : 2;
#else
  return 1;
#endif
}
#define TWEENFALL_CROWD_AVX512 [[gnu::target("avx512f,avx512vl,avx512dq")]]

/// Inlined functions use the instruction set of the function that they are inlined into.
#define TWEENFALL_CROWD_LANES [[gnu::always_inline]] inline

// How vectors are passed to functions does not matter here: all are inlined.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

TWEENFALL_CROWD_LANES Lanes all(float value) {
  return Lanes{value, value, value, value, value, value, value, value};
}
TWEENFALL_CROWD_LANES Lanes load(const float* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
/// As `all`, for a number in memory: one instruction instead of seven.
TWEENFALL_CROWD_LANES Lanes splat(float value) {
  float lanes[lane_count];
  for (float& lane : lanes) lane = value;
  return load(lanes);
}
TWEENFALL_CROWD_LANES void store(float* to, const Lanes& lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}
TWEENFALL_CROWD_LANES Words load_words(const std::int32_t* from) {
  Words words;
  __builtin_memcpy(&words, from, sizeof words);
  return words;
}
/// The integers of `bits` bits from bit `at` of each word, left in place: multiplied by 2 to the power of `at`, and
/// unsigned except at the top of the word.
template <int at, int bits>
TWEENFALL_CROWD_LANES Lanes field(const Words& words) {
  if constexpr (at + bits == 32) return __builtin_convertvector(words >> at, Lanes);
  constexpr std::int32_t mask = static_cast<std::int32_t>(((std::uint32_t{1} << bits) - 1) << at);
  return __builtin_convertvector(words & Words{mask, mask, mask, mask, mask, mask, mask, mask}, Lanes);
}
TWEENFALL_CROWD_LANES Lanes select(const Words& which, const Lanes& yes, const Lanes& no) {
  return reinterpret_cast<Lanes>((which & reinterpret_cast<Words>(yes)) | (~which & reinterpret_cast<Words>(no)));
}
/// Square roots and reciprocals are those of IEEE 754: the faster, approximate instructions differ between processors.
TWEENFALL_CROWD_LANES Lanes root(const Lanes& value) {
  Lanes result;
  for (std::size_t i = 0; i < lane_count; ++i) result[i] = __builtin_sqrtf(value[i]);
  return result;
}

#pragma GCC diagnostic pop

}  // namespace tweenfall::crowd
