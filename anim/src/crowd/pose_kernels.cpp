#include "crowd/pose_kernels.h"

#include "crowd/lanes.h"

#include <array>

#pragma GCC diagnostic ignored "-Wpsabi"

namespace tweenfall::crowd {

namespace {

/// The rows of a group: translation, rotation, scale.
constexpr std::size_t row_count = 10, first_turn = 3, first_scale = 7;

TWEENFALL_CROWD_LANES float* row(CrowdGroup& group, std::size_t i) {
  return reinterpret_cast<float*>(&group) + i * lane_count;
}
TWEENFALL_CROWD_LANES const float* row(const CrowdGroup& group, std::size_t i) {
  return reinterpret_cast<const float*>(&group) + i * lane_count;
}
TWEENFALL_CROWD_LANES Lanes dot(const Lanes* a, const Lanes* b) {
  return (a[0] * b[0] + a[1] * b[1]) + (a[2] * b[2] + a[3] * b[3]);
}
/// a, or -a where the other is negative.
TWEENFALL_CROWD_LANES Lanes with_sign(const Lanes& a, const Lanes& of) {
  const Words sign = reinterpret_cast<Words>(of) & (Words{} + static_cast<std::int32_t>(0x80000000U));
  return reinterpret_cast<Lanes>(reinterpret_cast<Words>(a) ^ sign);
}
/// Scales to length 1; where the length is 0, takes `otherwise`.
TWEENFALL_CROWD_LANES void normalize(Lanes* q, const Lanes* otherwise) {
  const Lanes squared = dot(q, q);
  const Lanes shrink = all(1) / root(squared);
  const Words there = squared > all(1e-30F);
  for (std::size_t c = 0; c < 4; ++c) q[c] = select(there, q[c] * shrink, otherwise[c]);
}
/// The product a b of quaternions x, y, z, w.
TWEENFALL_CROWD_LANES void multiply(const Lanes* a, const Lanes* b, Lanes* out) {
  out[0] = (a[3] * b[0] + a[0] * b[3]) + (a[1] * b[2] - a[2] * b[1]);
  out[1] = (a[3] * b[1] + a[1] * b[3]) + (a[2] * b[0] - a[0] * b[2]);
  out[2] = (a[3] * b[2] + a[2] * b[3]) + (a[0] * b[1] - a[1] * b[0]);
  out[3] = (a[3] * b[3] - a[0] * b[0]) - (a[1] * b[1] + a[2] * b[2]);
}

/// Up to this many layers, the kernel has their number as a constant.
constexpr std::size_t most_known = 4;

/// @tparam known number of layers, all with a weight; 0: any number, some of which may have none
template <std::size_t known>
TWEENFALL_CROWD_LANES void blend_groups(const CrowdLayer* layers, std::size_t layer_count, float portion,
                                        std::size_t groups, CrowdGroup* out) {
  const std::size_t count = known > 0 ? known : layer_count;
  const CrowdGroup* poses[most_known];
  Lanes shares[most_known];
  for (std::size_t layer = 0; layer < known; ++layer) {
    poses[layer] = layers[layer].pose.data();
    shares[layer] = splat(layers[layer].weight * portion);
  }
  const auto pose_of = [&](std::size_t layer) { return known > 0 ? poses[layer] : layers[layer].pose.data(); };
  const auto share_of = [&](std::size_t layer) {
    return known > 0 ? shares[layer] : splat(layers[layer].weight * portion);
  };
  const auto counts = [&](std::size_t layer) { return known > 0 || layers[layer].weight > least_weight; };
  for (std::size_t g = 0; g < groups; ++g) {
    // Rotations separately: together with the rest there would be more numbers than registers.
    Lanes first[4], turned[4];
    for (std::size_t c = 0; c < 4; ++c) {
      first[c] = load(row(pose_of(0)[g], first_turn + c));
      turned[c] = share_of(0) * first[c];
    }
    for (std::size_t layer = 1; layer < count; ++layer) {
      if (!counts(layer)) continue;
      Lanes turn[4];
      for (std::size_t c = 0; c < 4; ++c) turn[c] = load(row(pose_of(layer)[g], first_turn + c));
      const Lanes share = with_sign(share_of(layer), dot(first, turn));
      for (std::size_t c = 0; c < 4; ++c) turned[c] = turned[c] + share * turn[c];
    }
    normalize(turned, first);
    Lanes moved[6];
    const auto straight = [](std::size_t i) { return i < 3 ? i : first_scale + i - 3; };
    for (std::size_t i = 0; i < 6; ++i) moved[i] = share_of(0) * load(row(pose_of(0)[g], straight(i)));
    for (std::size_t layer = 1; layer < count; ++layer) {
      if (!counts(layer)) continue;
      for (std::size_t i = 0; i < 6; ++i)
        moved[i] = moved[i] + share_of(layer) * load(row(pose_of(layer)[g], straight(i)));
    }
    // The output may be an input, so it is written after everything is read.
    for (std::size_t c = 0; c < 4; ++c) store(row(out[g], first_turn + c), turned[c]);
    for (std::size_t i = 0; i < 6; ++i) store(row(out[g], straight(i)), moved[i]);
  }
}

TWEENFALL_CROWD_LANES void blend_all(const CrowdLayer* layers, std::size_t layer_count, float portion,
                                     std::size_t groups, CrowdGroup* out) {
  bool all_count = true;
  for (std::size_t layer = 0; layer < layer_count; ++layer)
    all_count = all_count && layers[layer].weight > least_weight;
  if (all_count && layer_count == 2) return blend_groups<2>(layers, layer_count, portion, groups, out);
  if (all_count && layer_count == 3) return blend_groups<3>(layers, layer_count, portion, groups, out);
  if (all_count && layer_count == 4) return blend_groups<4>(layers, layer_count, portion, groups, out);
  blend_groups<0>(layers, layer_count, portion, groups, out);
}

TWEENFALL_CROWD_LANES void blend_masked_groups(const CrowdLayer* layers, std::size_t layer_count, std::size_t groups,
                                               CrowdGroup* out) {
  const Lanes zero = all(0);
  for (std::size_t g = 0; g < groups; ++g) {
    // Where only one layer has a weight, its numbers are taken as they are.
    Lanes sum[row_count], alone[row_count], first[4], total = zero;
    Words has_one = total > zero, has_more = has_one;
    for (std::size_t i = 0; i < row_count; ++i) {
      alone[i] = load(row(layers[0].pose[g], i));
      sum[i] = zero;
    }
    for (std::size_t c = 0; c < 4; ++c) first[c] = alone[first_turn + c];
    for (std::size_t layer = 0; layer < layer_count; ++layer) {
      const CrowdGroup& pose = layers[layer].pose[g];
      Lanes share = splat(layers[layer].weight);
      if (!layers[layer].mask.empty()) share = share * load(layers[layer].mask.data() + g * lane_count);
      const Words counts = share > all(least_weight);
      share = select(counts, share, zero);
      has_more = has_more | (has_one & counts);
      Lanes part[row_count];
      for (std::size_t i = 0; i < row_count; ++i) part[i] = load(row(pose, i));
      const Lanes turn_share = with_sign(share, dot(first, part + first_turn));
      for (std::size_t i = 0; i < row_count; ++i) {
        const bool turns = i >= first_turn && i < first_scale;
        sum[i] = sum[i] + (turns ? turn_share : share) * part[i];
        alone[i] = select(counts & ~has_one, part[i], alone[i]);
      }
      has_one = has_one | counts;
      total = total + share;
    }
    const Lanes portion = all(1) / select(has_one, total, all(1));
    for (std::size_t i = 0; i < row_count; ++i) sum[i] = sum[i] * portion;
    normalize(sum + first_turn, first);
    for (std::size_t i = 0; i < row_count; ++i) store(row(out[g], i), select(has_more, sum[i], alone[i]));
  }
}

TWEENFALL_CROWD_LANES void difference_groups(const CrowdGroup* reference, const CrowdGroup* pose, std::size_t groups,
                                             CrowdGroup* out) {
  const Lanes zero = all(0), one = all(1);
  for (std::size_t g = 0; g < groups; ++g) {
    Lanes back[4], turn[4], moved[4], ways[3], ratios[3];
    for (std::size_t c = 0; c < 4; ++c) {
      back[c] = load(row(reference[g], first_turn + c));
      if (c < 3) back[c] = zero - back[c];
      turn[c] = load(row(pose[g], first_turn + c));
    }
    multiply(back, turn, moved);
    for (std::size_t c = 0; c < 3; ++c) {
      ways[c] = load(row(pose[g], c)) - load(row(reference[g], c));
      const Lanes from = load(row(reference[g], first_scale + c));
      const Words none = from == zero;
      ratios[c] = select(none, one, load(row(pose[g], first_scale + c)) / select(none, one, from));
    }
    for (std::size_t c = 0; c < 3; ++c) {
      store(row(out[g], c), ways[c]);
      store(row(out[g], first_scale + c), ratios[c]);
    }
    for (std::size_t c = 0; c < 4; ++c) store(row(out[g], first_turn + c), moved[c]);
  }
}

TWEENFALL_CROWD_LANES void add_groups(const CrowdGroup* base, const CrowdGroup* difference, float of_all,
                                      const float* mask, std::size_t groups, CrowdGroup* out) {
  const Lanes zero = all(0), one = all(1), weight = splat(of_all);
  for (std::size_t g = 0; g < groups; ++g) {
    const Lanes share = mask ? weight * load(mask + g * lane_count) : weight;
    Lanes turn[4], from[4], result[4];
    for (std::size_t c = 0; c < 4; ++c) {
      turn[c] = load(row(difference[g], first_turn + c));
      from[c] = load(row(base[g], first_turn + c));
    }
    // Mixed with the identity, the short way.
    const Lanes turn_share = with_sign(share, turn[3]);
    for (std::size_t c = 0; c < 3; ++c) turn[c] = turn_share * turn[c];
    turn[3] = (one - share) + turn_share * turn[3];
    multiply(from, turn, result);
    normalize(result, from);
    const Words none = share == zero;
    for (std::size_t c = 0; c < 4; ++c) store(row(out[g], first_turn + c), select(none, from[c], result[c]));
    for (std::size_t c = 0; c < 3; ++c) {
      store(row(out[g], c), load(row(base[g], c)) + share * load(row(difference[g], c)));
      const Lanes ratio = load(row(difference[g], first_scale + c));
      store(row(out[g], first_scale + c), load(row(base[g], first_scale + c)) * (one + share * (ratio - one)));
    }
  }
}

using Quad = float __attribute__((vector_size(16), aligned(16)));

/// Transposes four rows to eight times four numbers, and writes them to one row of eight matrices, or of as many as
/// there are.
TWEENFALL_CROWD_LANES void put_rows(const Lanes& x, const Lanes& y, const Lanes& z, const Lanes& w, std::size_t there,
                                    CrowdMatrix* out, std::size_t row_number) {
  const Lanes xy_low = __builtin_shufflevector(x, y, 0, 8, 1, 9, 4, 12, 5, 13),
              xy_high = __builtin_shufflevector(x, y, 2, 10, 3, 11, 6, 14, 7, 15),
              zw_low = __builtin_shufflevector(z, w, 0, 8, 1, 9, 4, 12, 5, 13),
              zw_high = __builtin_shufflevector(z, w, 2, 10, 3, 11, 6, 14, 7, 15);
  // Each of these is for a joint and the one four further.
  const Lanes pairs[4] = {__builtin_shufflevector(xy_low, zw_low, 0, 1, 8, 9, 4, 5, 12, 13),
                          __builtin_shufflevector(xy_low, zw_low, 2, 3, 10, 11, 6, 7, 14, 15),
                          __builtin_shufflevector(xy_high, zw_high, 0, 1, 8, 9, 4, 5, 12, 13),
                          __builtin_shufflevector(xy_high, zw_high, 2, 3, 10, 11, 6, 7, 14, 15)};
  for (std::size_t i = 0; i < 4; ++i) {
    const Quad low = __builtin_shufflevector(pairs[i], pairs[i], 0, 1, 2, 3),
               high = __builtin_shufflevector(pairs[i], pairs[i], 4, 5, 6, 7);
    if (i < there) __builtin_memcpy(out[i].row[row_number], &low, sizeof low);
    if (i + 4 < there) __builtin_memcpy(out[i + 4].row[row_number], &high, sizeof high);
  }
}

TWEENFALL_CROWD_LANES void place_group(const CrowdGroup& group, std::size_t there, CrowdMatrix* out) {
  const Lanes one = all(1);
  const Lanes x = load(group.rotation[0]), y = load(group.rotation[1]), z = load(group.rotation[2]),
              w = load(group.rotation[3]);
  const Lanes x2 = x + x, y2 = y + y, z2 = z + z;
  const Lanes xx = x * x2, yy = y * y2, zz = z * z2, xy = x * y2, xz = x * z2, yz = y * z2, wx = w * x2, wy = w * y2,
              wz = w * z2;
  const Lanes sx = load(group.scale[0]), sy = load(group.scale[1]), sz = load(group.scale[2]);
  put_rows((one - (yy + zz)) * sx, (xy - wz) * sy, (xz + wy) * sz, load(group.translation[0]), there, out, 0);
  put_rows((xy + wz) * sx, (one - (xx + zz)) * sy, (yz - wx) * sz, load(group.translation[1]), there, out, 1);
  put_rows((xz - wy) * sx, (yz + wx) * sy, (one - (xx + yy)) * sz, load(group.translation[2]), there, out, 2);
}

TWEENFALL_CROWD_LANES void place_all(const CrowdGroup* pose, std::size_t joints, CrowdMatrix* out) {
  std::size_t g = 0;
  for (; (g + 1) * lane_count <= joints; ++g) place_group(pose[g], lane_count, out + g * lane_count);
  if (g * lane_count < joints) place_group(pose[g], joints - g * lane_count, out + g * lane_count);
}

TWEENFALL_CROWD_LANES Quad quad_of(const float* from) {
  Quad quad;
  __builtin_memcpy(&quad, from, sizeof quad);
  return quad;
}
TWEENFALL_CROWD_LANES Quad each(float value) {
  return Quad{value, value, value, value};
}
/// 0, 0, 0 and the last number.
TWEENFALL_CROWD_LANES Quad last_of(const Quad& quad) {
  using Bits = std::int32_t __attribute__((vector_size(16), aligned(16)));
  return reinterpret_cast<Quad>(reinterpret_cast<Bits>(quad) & Bits{0, 0, 0, -1});
}

TWEENFALL_CROWD_LANES void compose_all(const std::uint32_t* order, const std::uint32_t* parents, std::size_t joints,
                                       const CrowdMatrix& root, CrowdMatrix* out) {
  for (std::size_t i = 0; i < joints; ++i) {
    const std::uint32_t joint = order[i], parent = parents[joint];
    const CrowdMatrix& above = parent < joints ? out[parent] : root;
    const Quad a = quad_of(out[joint].row[0]), b = quad_of(out[joint].row[1]), c = quad_of(out[joint].row[2]);
    Quad rows[3];
    for (int k = 0; k < 3; ++k) {
      const float* const from = above.row[k];
      rows[k] = (a * each(from[0]) + b * each(from[1])) + (c * each(from[2]) + last_of(quad_of(from)));
    }
    for (int k = 0; k < 3; ++k) __builtin_memcpy(out[joint].row[k], &rows[k], sizeof rows[k]);
  }
}

// The same source for each instruction set. The compiler fuses no multiplication with an addition, so the bits are the
// same.
#define TWEENFALL_CROWD_VERSIONS(name, target)                                                                   \
  target void blend_##name(const CrowdLayer* layers, std::size_t layer_count, float portion, std::size_t groups, \
                           CrowdGroup* out) {                                                                    \
    blend_all(layers, layer_count, portion, groups, out);                                                        \
  }                                                                                                              \
  target void blend_masked_##name(const CrowdLayer* layers, std::size_t layer_count, std::size_t groups,         \
                                  CrowdGroup* out) {                                                             \
    blend_masked_groups(layers, layer_count, groups, out);                                                       \
  }                                                                                                              \
  target void difference_##name(const CrowdGroup* reference, const CrowdGroup* pose, std::size_t groups,         \
                                CrowdGroup* out) {                                                               \
    difference_groups(reference, pose, groups, out);                                                             \
  }                                                                                                              \
  target void add_##name(const CrowdGroup* base, const CrowdGroup* more, float weight, const float* mask,        \
                         std::size_t groups, CrowdGroup* out) {                                                  \
    add_groups(base, more, weight, mask, groups, out);                                                           \
  }                                                                                                              \
  target void place_##name(const CrowdGroup* pose, std::size_t joints, CrowdMatrix* out) {                       \
    place_all(pose, joints, out);                                                                                \
  }                                                                                                              \
  target void compose_##name(const std::uint32_t* order, const std::uint32_t* parents, std::size_t joints,       \
                             const CrowdMatrix& root, CrowdMatrix* out) {                                        \
    compose_all(order, parents, joints, root, out);                                                              \
  }                                                                                                              \
  constexpr PoseKernels name##_kernels = {blend_##name, blend_masked_##name, difference_##name,                  \
                                          add_##name,   place_##name,        compose_##name};

TWEENFALL_CROWD_VERSIONS(plain, )
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_CROWD_VERSIONS(avx2, [[gnu::target("avx2")]])
TWEENFALL_CROWD_VERSIONS(avx512, TWEENFALL_CROWD_AVX512)
#endif
#undef TWEENFALL_CROWD_VERSIONS

}  // namespace

std::span<const PoseKernels* const> possible_pose_kernels() {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr std::array all = {&plain_kernels, &avx2_kernels, &avx512_kernels};
#else
  static constexpr std::array all = {&plain_kernels};
#endif
  return std::span(all).first(possible_versions());
}

const PoseKernels& fastest_pose_kernels() {
  static const PoseKernels& fastest = *possible_pose_kernels().back();
  return fastest;
}

}  // namespace tweenfall::crowd
