#include "crowd/skin_kernels.h"

#include "crowd/lanes.h"

#include <array>

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::crowd {

namespace {

using Four = float __attribute__((vector_size(16), aligned(16)));

TWEENFALL_CROWD_LANES Four four(const float* from) {
  Four numbers;
  __builtin_memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

/// Four numbers in both halves: written like this it is one instruction.
TWEENFALL_CROWD_LANES Lanes twice(const float* from) {
  float lanes[lane_count];
  __builtin_memcpy(lanes, from, sizeof(Four));
  __builtin_memcpy(lanes + 4, from, sizeof(Four));
  return load(lanes);
}

/// The matrix of a vertex: its first two rows, and the third.
struct Blended {
  Lanes upper;
  Four lower;
};

/// Adds the matrices of joints times their weights, each of which is in both halves of a row.
TWEENFALL_CROWD_LANES void add_joints(const CrowdMesh::Influence4& of, const CrowdMatrix* palette, bool first,
                                      Blended& matrix) {
  const char* const begin = reinterpret_cast<const char*>(palette);
  const Lanes both = twice(of.weight);
  const Lanes weight[4] = {__builtin_shufflevector(both, both, 0, 0, 0, 0, 4, 4, 4, 4),
                           __builtin_shufflevector(both, both, 1, 1, 1, 1, 5, 5, 5, 5),
                           __builtin_shufflevector(both, both, 2, 2, 2, 2, 6, 6, 6, 6),
                           __builtin_shufflevector(both, both, 3, 3, 3, 3, 7, 7, 7, 7)};
  for (int i = 0; i < 4; ++i) {
    const float* const joint = reinterpret_cast<const float*>(begin + of.offset[i]);
    const Lanes upper = load(joint) * weight[i];
    const Four lower = four(joint + 8) * __builtin_shufflevector(weight[i], weight[i], 0, 1, 2, 3);
    matrix.upper = first && i == 0 ? upper : matrix.upper + upper;
    matrix.lower = first && i == 0 ? lower : matrix.lower + lower;
  }
}

/// Transposes four pairs of a vertex and the one four further, with four numbers each, to each number of all eight.
TWEENFALL_CROWD_LANES void columns(const Lanes (&pairs)[4], Lanes* out) {
  const Lanes low01 = __builtin_shufflevector(pairs[0], pairs[1], 0, 8, 1, 9, 4, 12, 5, 13),
              high01 = __builtin_shufflevector(pairs[0], pairs[1], 2, 10, 3, 11, 6, 14, 7, 15),
              low23 = __builtin_shufflevector(pairs[2], pairs[3], 0, 8, 1, 9, 4, 12, 5, 13),
              high23 = __builtin_shufflevector(pairs[2], pairs[3], 2, 10, 3, 11, 6, 14, 7, 15);
  out[0] = __builtin_shufflevector(low01, low23, 0, 1, 8, 9, 4, 5, 12, 13);
  out[1] = __builtin_shufflevector(low01, low23, 2, 3, 10, 11, 6, 7, 14, 15);
  out[2] = __builtin_shufflevector(high01, high23, 0, 1, 8, 9, 4, 5, 12, 13);
  out[3] = __builtin_shufflevector(high01, high23, 2, 3, 10, 11, 6, 7, 14, 15);
}

TWEENFALL_CROWD_LANES void all_columns(const Blended (&of)[lane_count], Lanes (&m)[3][4]) {
  Lanes first[4], second[4], third[4];
  for (int i = 0; i < 4; ++i) {
    first[i] = __builtin_shufflevector(of[i].upper, of[i + 4].upper, 0, 1, 2, 3, 8, 9, 10, 11);
    second[i] = __builtin_shufflevector(of[i].upper, of[i + 4].upper, 4, 5, 6, 7, 12, 13, 14, 15);
    third[i] = __builtin_shufflevector(of[i].lower, of[i + 4].lower, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  columns(first, m[0]);
  columns(second, m[1]);
  columns(third, m[2]);
}

/// Writes eight points. Each write's fourth number is overwritten by the next point, so the last one is written
/// separately.
TWEENFALL_CROWD_LANES void put_points(const Lanes& x, const Lanes& y, const Lanes& z, CrowdPoint* out) {
  const Lanes xy_low = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13),
              xy_high = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15),
              z_low = __builtin_shufflevector(z, z, 0, 8, 1, 9, 4, 12, 5, 13),
              z_high = __builtin_shufflevector(z, z, 2, 10, 3, 11, 6, 14, 7, 15);
  const Lanes pairs[4] = {__builtin_shufflevector(xy_low, z_low, 0, 1, 8, 9, 4, 5, 12, 13),
                          __builtin_shufflevector(xy_low, z_low, 2, 3, 10, 11, 6, 7, 14, 15),
                          __builtin_shufflevector(xy_high, z_high, 0, 1, 8, 9, 4, 5, 12, 13),
                          __builtin_shufflevector(xy_high, z_high, 2, 3, 10, 11, 6, 7, 14, 15)};
  float* const to = &out->x;
  for (int i = 0; i < 4; ++i) {
    const Four point = __builtin_shufflevector(pairs[i], pairs[i], 0, 1, 2, 3);
    __builtin_memcpy(to + 3 * i, &point, sizeof point);
  }
  for (int i = 0; i < 4; ++i) {
    const Four point = __builtin_shufflevector(pairs[i], pairs[i], 4, 5, 6, 7);
    __builtin_memcpy(to + 3 * (i + 4), &point, i < 3 ? sizeof point : 3 * sizeof(float));
  }
}

/// Normals of a block in progress: their lengths, which take long, are computed now and used one block later.
struct Normals {
  Lanes turned[3], shrink;
};

/// Transforms by the cofactors of a matrix: the cross products of its rows.
TWEENFALL_CROWD_LANES void turn_normals(const Lanes (&m)[3][4], const Lanes* n, Normals& out) {
  Lanes* const turned = out.turned;
  for (int r = 0; r < 3; ++r) {
    const Lanes *const a = m[(r + 1) % 3], *const b = m[(r + 2) % 3];
    turned[r] =
        (n[0] * (a[1] * b[2] - a[2] * b[1]) + n[1] * (a[2] * b[0] - a[0] * b[2])) + n[2] * (a[0] * b[1] - a[1] * b[0]);
  }
  const Lanes squared = (turned[0] * turned[0] + turned[1] * turned[1]) + turned[2] * turned[2];
  const Words there = squared > all(1e-36F);
  out.shrink = select(there, all(1) / root(squared), all(0));
}
TWEENFALL_CROWD_LANES void put_normals(const Normals& of, CrowdPoint* out) {
  put_points(of.turned[0] * of.shrink, of.turned[1] * of.shrink, of.turned[2] * of.shrink, out);
}

/// @param before where the normals in progress belong; null for none
template <bool many, bool with_normals>
TWEENFALL_CROWD_LANES void skin_block(const SkinWork& work, std::size_t block, CrowdPoint* positions,
                                      CrowdPoint* before, Normals& normals) {
  Blended matrices[lane_count];
  const std::size_t first = block * lane_count;
  for (std::size_t i = 0; i < lane_count; ++i) {
    add_joints(work.influences[first + i], work.palette, true, matrices[i]);
    if constexpr (many)
      for (std::uint32_t k = work.more[first + i]; k < work.more[first + i + 1]; ++k)
        add_joints(work.more_influences[k], work.palette, false, matrices[i]);
  }
  if constexpr (with_normals)
    if (before) put_normals(normals, before);
  Lanes m[3][4];
  all_columns(matrices, m);
  Lanes numbers[6];
  for (int i = 0; i < 6; ++i) numbers[i] = load(work.blocks[block].numbers[i]);
  if constexpr (with_normals) turn_normals(m, numbers + 3, normals);
  Lanes moved[3];
  for (int r = 0; r < 3; ++r)
    moved[r] = (m[r][0] * numbers[0] + m[r][1] * numbers[1]) + (m[r][2] * numbers[2] + m[r][3]);
  put_points(moved[0], moved[1], moved[2], positions);
}

template <bool many, bool with_normals>
TWEENFALL_CROWD_LANES void skin_blocks(const SkinWork& work) {
  const std::size_t whole = work.vertices / lane_count, rest = work.vertices % lane_count;
  Normals on_their_way{};
  CrowdPoint* before = nullptr;
  for (std::size_t block = 0; block < whole; ++block) {
    skin_block<many, with_normals>(work, block, work.positions + block * lane_count, before, on_their_way);
    if constexpr (with_normals) before = work.normals + block * lane_count;
  }
  if (rest == 0) {
    if constexpr (with_normals)
      if (before) put_normals(on_their_way, before);
    return;
  }
  CrowdPoint positions[lane_count], normals[lane_count];
  skin_block<many, with_normals>(work, whole, positions, before, on_their_way);
  if constexpr (with_normals) put_normals(on_their_way, normals);
  for (std::size_t i = 0; i < rest; ++i) {
    work.positions[whole * lane_count + i] = positions[i];
    if constexpr (with_normals) work.normals[whole * lane_count + i] = normals[i];
  }
}

TWEENFALL_CROWD_LANES void skin_all(const SkinWork& work) {
  if (work.more)
    work.normals ? skin_blocks<true, true>(work) : skin_blocks<true, false>(work);
  else
    work.normals ? skin_blocks<false, true>(work) : skin_blocks<false, false>(work);
}

// The same source for each instruction set. The compiler fuses no multiplication with an addition, so the bits are the
// same.
#define TWEENFALL_CROWD_VERSIONS(name, target)    \
  target void skin_##name(const SkinWork& work) { \
    skin_all(work);                               \
  }                                               \
  constexpr SkinKernels name##_kernels = {skin_##name};

TWEENFALL_CROWD_VERSIONS(plain, )
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_CROWD_VERSIONS(avx2, [[gnu::target("avx2")]])
TWEENFALL_CROWD_VERSIONS(avx512, TWEENFALL_CROWD_AVX512)
#endif
#undef TWEENFALL_CROWD_VERSIONS

}  // namespace

std::span<const SkinKernels* const> possible_skin_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr std::array all = {&plain_kernels, &avx2_kernels, &avx512_kernels};
#else
  static constexpr std::array all = {&plain_kernels};
#endif
  return std::span(all).first(possible_versions());
}

const SkinKernels& fastest_skin_kernels() {
  static const SkinKernels& fastest = *possible_skin_kernels().back();
  return fastest;
}

}  // namespace tweenfall::crowd
