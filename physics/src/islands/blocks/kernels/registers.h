#pragma once

/// Lanes while they are worked on, in as many registers as they fill. Each operation rounds as it does for one double,
/// so that the bits are the same however many numbers the processor handles at once.

#include <cstddef>

#include "islands/blocks/contact_block.h"

namespace tweenfall::blocks {

/// An inlined function takes the instruction set of its caller.
#define TWEENFALL_LANES [[gnu::always_inline]] inline

// How vectors are passed to functions that are not inlined does not matter here: all are inlined.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wpsabi"

/// How many of the kernel versions this processor can run, in the order plain, AVX2, AVX-512.
[[nodiscard]] inline std::size_t possible_versions() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  if (!__builtin_cpu_supports("avx2")) return 1;
  return __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") ? 3 : 2;
#else
  return 1;
#endif
}

/// The part of lanes, and of masks, that one register holds.
using Two = double __attribute__((vector_size(16)));
using Four = double __attribute__((vector_size(32)));
using Eight = double __attribute__((vector_size(64)));
using TwoMasks = std::int64_t __attribute__((vector_size(16)));
using FourMasks = std::int64_t __attribute__((vector_size(32)));
using EightMasks = std::int64_t __attribute__((vector_size(64)));

/// Two halves of lanes.
template <class Half>
struct Halves {
  Half low, high;

#define TWEENFALL_BOTH(operation)                                                                   \
  TWEENFALL_LANES friend auto operator operation(const Halves& a, const Halves& b) {                \
    return Halves<decltype(a.low operation b.low)>{a.low operation b.low, a.high operation b.high}; \
  }
  TWEENFALL_BOTH(+)
  TWEENFALL_BOTH(-)
  TWEENFALL_BOTH(*)
  TWEENFALL_BOTH(/)
  TWEENFALL_BOTH(&)
  TWEENFALL_BOTH(|)
  TWEENFALL_BOTH(>)
  TWEENFALL_BOTH(<)
  TWEENFALL_BOTH(>=)
#undef TWEENFALL_BOTH
  TWEENFALL_LANES friend Halves operator-(const Halves& a) {
    return {-a.low, -a.high};
  }
  TWEENFALL_LANES friend Halves operator~(const Halves& a) {
    return {~a.low, ~a.high};
  }
};

/// Only the lanes from `first` on, as many as fit into a `Part`.
template <class Part, int first>
struct LanesFrom {
  Part of;

#define TWEENFALL_PART(operation)                                                          \
  TWEENFALL_LANES friend auto operator operation(const LanesFrom& a, const LanesFrom& b) { \
    return LanesFrom<decltype(a.of operation b.of), first>{a.of operation b.of};           \
  }
  TWEENFALL_PART(+)
  TWEENFALL_PART(-)
  TWEENFALL_PART(*)
  TWEENFALL_PART(/)
  TWEENFALL_PART(&)
  TWEENFALL_PART(|)
  TWEENFALL_PART(>)
  TWEENFALL_PART(<)
  TWEENFALL_PART(>=)
#undef TWEENFALL_PART
  TWEENFALL_LANES friend LanesFrom operator-(const LanesFrom& a) {
    return {-a.of};
  }
  TWEENFALL_LANES friend LanesFrom operator~(const LanesFrom& a) {
    return {~a.of};
  }
};

/// Where one is above another, below it, or at least as large.
template <class Register>
TWEENFALL_LANES auto above(const Register& a, const Register& b) {
  return a > b;
}
template <class Register>
TWEENFALL_LANES auto below(const Register& a, const Register& b) {
  return a < b;
}
template <class Register>
TWEENFALL_LANES auto at_least(const Register& a, const Register& b) {
  return a >= b;
}
#if (defined(__x86_64__) || defined(__i386__)) && !defined(__clang__)
// g++ combines several comparisons of eight numbers one by one, unless each of them has to be in a register.
TWEENFALL_LANES EightMasks in_register(EightMasks which) {
  asm("" : "+v"(which));
  return which;
}
TWEENFALL_LANES EightMasks above(const Eight& a, const Eight& b) {
  return in_register(a > b);
}
TWEENFALL_LANES EightMasks below(const Eight& a, const Eight& b) {
  return in_register(a < b);
}
TWEENFALL_LANES EightMasks at_least(const Eight& a, const Eight& b) {
  return in_register(a >= b);
}
#endif

template <class Masks, class Register>
TWEENFALL_LANES Register choose(const Masks& which, const Register& yes, const Register& no) {
  return which ? yes : no;
}
template <class Masks, class Half>
TWEENFALL_LANES Halves<Half> choose(const Halves<Masks>& which, const Halves<Half>& yes, const Halves<Half>& no) {
  return {choose(which.low, yes.low, no.low), choose(which.high, yes.high, no.high)};
}

template <class Masks, class Part, int first>
TWEENFALL_LANES LanesFrom<Part, first> choose(const LanesFrom<Masks, first>& which, const LanesFrom<Part, first>& yes,
                                              const LanesFrom<Part, first>& no) {
  return {choose(which.of, yes.of, no.of)};
}

/// The greater of two, and the lesser; the second if neither is.
template <class Register>
TWEENFALL_LANES Register greater_of(const Register& a, const Register& b) {
  return choose(a > b, a, b);
}
template <class Register>
TWEENFALL_LANES Register lesser_of(const Register& a, const Register& b) {
  return choose(a < b, a, b);
}
TWEENFALL_LANES Eight greater_of(const Eight& a, const Eight& b) {
  return a > b ? a : b;
}
TWEENFALL_LANES Eight lesser_of(const Eight& a, const Eight& b) {
  return a < b ? a : b;
}

TWEENFALL_LANES bool any_of(const TwoMasks& which) {
  return (which[0] | which[1]) != 0;
}
TWEENFALL_LANES bool any_of(const FourMasks& which) {
  return ((which[0] | which[1]) | (which[2] | which[3])) != 0;
}
TWEENFALL_LANES bool any_of(const EightMasks& which) {
  const FourMasks halves =
      __builtin_shufflevector(which, which, 0, 1, 2, 3) | __builtin_shufflevector(which, which, 4, 5, 6, 7);
  return any_of(
      TwoMasks(__builtin_shufflevector(halves, halves, 0, 1) | __builtin_shufflevector(halves, halves, 2, 3)));
}
template <class Half>
TWEENFALL_LANES bool any_of(const Halves<Half>& which) {
  return any_of(which.low | which.high);
}

template <class Part, int first>
TWEENFALL_LANES bool any_of(const LanesFrom<Part, first>& which) {
  return any_of(which.of);
}

TWEENFALL_LANES void fill(double value, Two& to) {
  to = Two{value, value};
}
TWEENFALL_LANES void fill(double value, Four& to) {
  to = Four{value, value, value, value};
}
TWEENFALL_LANES void fill(double value, Eight& to) {
  to = Eight{value, value, value, value, value, value, value, value};
}
template <class Half>
TWEENFALL_LANES void fill(double value, Halves<Half>& to) {
  fill(value, to.low);
  fill(value, to.high);
}

template <class Part, int first>
TWEENFALL_LANES void fill(double value, LanesFrom<Part, first>& to) {
  fill(value, to.of);
}

template <class Register, class Item>
TWEENFALL_LANES void load(const Item* from, Register& to) {
  Register numbers;
  __builtin_memcpy(&numbers, from, sizeof numbers);
  to = numbers;
}
template <class Half, class Item>
TWEENFALL_LANES void load(const Item* from, Halves<Half>& to) {
  load(from, to.low);
  load(from + sizeof(Half) / sizeof(Item), to.high);
}
template <class Part, int first, class Item>
TWEENFALL_LANES void load(const Item* from, LanesFrom<Part, first>& to) {
  load(from + first, to.of);
}
template <class Register, class Item>
TWEENFALL_LANES void store(const Register& from, Item* to) {
  __builtin_memcpy(to, &from, sizeof from);
}
template <class Half, class Item>
TWEENFALL_LANES void store(const Halves<Half>& from, Item* to) {
  store(from.low, to);
  store(from.high, to + sizeof(Half) / sizeof(Item));
}

template <class Part, int first, class Item>
TWEENFALL_LANES void store(const LanesFrom<Part, first>& from, Item* to) {
  store(from.of, to + first);
}

TWEENFALL_LANES Two root_of(const Two& a) {
  return Two{__builtin_sqrt(a[0]), __builtin_sqrt(a[1])};
}
TWEENFALL_LANES Four root_of(const Four& a) {
  return Four{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]), __builtin_sqrt(a[3])};
}
TWEENFALL_LANES Eight root_of(const Eight& a) {
  return Eight{__builtin_sqrt(a[0]), __builtin_sqrt(a[1]), __builtin_sqrt(a[2]), __builtin_sqrt(a[3]),
               __builtin_sqrt(a[4]), __builtin_sqrt(a[5]), __builtin_sqrt(a[6]), __builtin_sqrt(a[7])};
}
template <class Half>
TWEENFALL_LANES Halves<Half> root_of(const Halves<Half>& a) {
  return {root_of(a.low), root_of(a.high)};
}

template <class Part, int first>
TWEENFALL_LANES LanesFrom<Part, first> root_of(const LanesFrom<Part, first>& a) {
  return {root_of(a.of)};
}

/// A choice of lanes.
template <class Masks>
struct Choice {
  Masks of;

  [[nodiscard]] TWEENFALL_LANES static Choice in(const Mask& from) {
    Choice choice;
    load(from.lanes, choice.of);
    return choice;
  }
  TWEENFALL_LANES void put(Mask& to) const { store(of, to.lanes); }
  [[nodiscard]] TWEENFALL_LANES bool any() const { return any_of(of); }

  TWEENFALL_LANES friend Choice operator&(const Choice& a, const Choice& b) { return {a.of & b.of}; }
  TWEENFALL_LANES friend Choice operator|(const Choice& a, const Choice& b) { return {a.of | b.of}; }
  TWEENFALL_LANES friend Choice operator~(const Choice& a) { return {~a.of}; }
};

/// A number in each lane.
template <class Register>
struct Wide {
  using Which = Choice<decltype(above(Register{}, Register{}))>;
  Register of;

  Wide() = default;
  TWEENFALL_LANES explicit Wide(const Register& numbers) : of(numbers) {}
  TWEENFALL_LANES Wide(const Lanes& from) { load(from.lanes, of); }  // NOLINT: as if it were one
  TWEENFALL_LANES explicit Wide(double value) { fill(value, of); }
  TWEENFALL_LANES void put(Lanes& to) const { store(of, to.lanes); }

  TWEENFALL_LANES friend Wide operator+(const Wide& a, const Wide& b) { return Wide(a.of + b.of); }
  TWEENFALL_LANES friend Wide operator-(const Wide& a, const Wide& b) { return Wide(a.of - b.of); }
  TWEENFALL_LANES friend Wide operator*(const Wide& a, const Wide& b) { return Wide(a.of * b.of); }
  TWEENFALL_LANES friend Wide operator/(const Wide& a, const Wide& b) { return Wide(a.of / b.of); }
  TWEENFALL_LANES friend Wide operator-(const Wide& a) { return Wide(-a.of); }
  TWEENFALL_LANES friend Which operator>(const Wide& a, const Wide& b) { return {above(a.of, b.of)}; }
  TWEENFALL_LANES friend Which operator<(const Wide& a, const Wide& b) { return {below(a.of, b.of)}; }
  TWEENFALL_LANES friend Which operator>=(const Wide& a, const Wide& b) { return {at_least(a.of, b.of)}; }
  TWEENFALL_LANES friend Wide select(const Which& which, const Wide& yes, const Wide& no) {
    return Wide(choose(which.of, yes.of, no.of));
  }
  TWEENFALL_LANES friend Wide greater(const Wide& a, const Wide& b) { return Wide(greater_of(a.of, b.of)); }
  TWEENFALL_LANES friend Wide lesser(const Wide& a, const Wide& b) { return Wide(lesser_of(a.of, b.of)); }
  TWEENFALL_LANES friend Wide root(const Wide& a) { return Wide(root_of(a.of)); }
};

/// Vectors.
template <class Register>
struct Wide3 {
  using Number = Wide<Register>;
  Number x, y, z;

  Wide3() = default;
  TWEENFALL_LANES Wide3(const Number& x_lanes, const Number& y_lanes, const Number& z_lanes)
      : x(x_lanes), y(y_lanes), z(z_lanes) {}
  TWEENFALL_LANES Wide3(const Lanes3& from) : x(from.x), y(from.y), z(from.z) {}  // NOLINT: as if it were one
  TWEENFALL_LANES void put(Lanes3& to) const {
    x.put(to.x);
    y.put(to.y);
    z.put(to.z);
  }

  TWEENFALL_LANES friend Wide3 operator+(const Wide3& a, const Wide3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  TWEENFALL_LANES friend Wide3 operator-(const Wide3& a, const Wide3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  TWEENFALL_LANES friend Wide3 operator*(const Number& s, const Wide3& a) { return {s * a.x, s * a.y, s * a.z}; }
  TWEENFALL_LANES friend Wide3 cross(const Wide3& a, const Wide3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  TWEENFALL_LANES friend Number dot(const Wide3& a, const Wide3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  TWEENFALL_LANES friend Wide3 operator*(const LanesSymmetric& m, const Wide3& a) {
    return {m.xx * a.x + m.xy * a.y + m.xz * a.z, m.xy * a.x + m.yy * a.y + m.yz * a.z,
            m.xz * a.x + m.yz * a.y + m.zz * a.z};
  }
};

template <class Register>
TWEENFALL_LANES Wide3<Register> operator*(const Wide<Register>& s, const Lanes3& a) {
  return s * Wide3<Register>(a);
}

template <class Register>
TWEENFALL_LANES Register row(const double* from) {
  Register numbers;
  __builtin_memcpy(&numbers, from, sizeof numbers);
  return numbers;
}

/// Vectors from rows of x, y, z and one more number.
TWEENFALL_LANES void gather(const double* const* rows, Two& x, Two& y, Two& z, Two& last) {
  const Two a = row<Two>(rows[0]), b = row<Two>(rows[1]);
  const Two c = row<Two>(rows[0] + 2), d = row<Two>(rows[1] + 2);
  x = __builtin_shufflevector(a, b, 0, 2);
  y = __builtin_shufflevector(a, b, 1, 3);
  z = __builtin_shufflevector(c, d, 0, 2);
  last = __builtin_shufflevector(c, d, 1, 3);
}
TWEENFALL_LANES void gather(const double* const* rows, Four& x, Four& y, Four& z, Four& last) {
  const Four a = row<Four>(rows[0]), b = row<Four>(rows[1]), c = row<Four>(rows[2]), d = row<Four>(rows[3]);
  const Four even_ab = __builtin_shufflevector(a, b, 0, 4, 2, 6), odd_ab = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Four even_cd = __builtin_shufflevector(c, d, 0, 4, 2, 6), odd_cd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  x = __builtin_shufflevector(even_ab, even_cd, 0, 1, 4, 5);
  y = __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 4, 5);
  z = __builtin_shufflevector(even_ab, even_cd, 2, 3, 6, 7);
  last = __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 6, 7);
}
TWEENFALL_LANES void gather(const double* const* rows, Eight& x, Eight& y, Eight& z, Eight& last) {
  // Each half holds one of two rows, so that no number has to pass between halves more than once.
  const auto joined = [&](int low, int high) -> Eight {
    return __builtin_shufflevector(row<Four>(rows[low]), row<Four>(rows[high]), 0, 1, 2, 3, 4, 5, 6, 7);
  };
  const Eight a = joined(0, 4), b = joined(1, 5), c = joined(2, 6), d = joined(3, 7);
  const Eight even_ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight odd_ab = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight even_cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight odd_cd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  x = __builtin_shufflevector(even_ab, even_cd, 0, 1, 8, 9, 4, 5, 12, 13);
  y = __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 8, 9, 4, 5, 12, 13);
  z = __builtin_shufflevector(even_ab, even_cd, 2, 3, 10, 11, 6, 7, 14, 15);
  last = __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 10, 11, 6, 7, 14, 15);
}
template <class Half>
TWEENFALL_LANES void gather(const double* const* rows, Halves<Half>& x, Halves<Half>& y, Halves<Half>& z,
                            Halves<Half>& last) {
  gather(rows, x.low, y.low, z.low, last.low);
  gather(rows + sizeof(Half) / sizeof(double), x.high, y.high, z.high, last.high);
}

template <class Part, int first>
TWEENFALL_LANES void gather(const double* const* rows, LanesFrom<Part, first>& x, LanesFrom<Part, first>& y,
                            LanesFrom<Part, first>& z, LanesFrom<Part, first>& last) {
  gather(rows + first, x.of, y.of, z.of, last.of);
}

/// Back to rows of x, y, z and `last`.
TWEENFALL_LANES void scatter(const Two& x, const Two& y, const Two& z, const Two& last, double* const* rows) {
  store(Two(__builtin_shufflevector(x, y, 0, 2)), rows[0]);
  store(Two(__builtin_shufflevector(z, last, 0, 2)), rows[0] + 2);
  store(Two(__builtin_shufflevector(x, y, 1, 3)), rows[1]);
  store(Two(__builtin_shufflevector(z, last, 1, 3)), rows[1] + 2);
}
TWEENFALL_LANES void scatter(const Four& x, const Four& y, const Four& z, const Four& last, double* const* rows) {
  const Four low_xy = __builtin_shufflevector(x, y, 0, 4, 2, 6), high_xy = __builtin_shufflevector(x, y, 1, 5, 3, 7);
  const Four low_z = __builtin_shufflevector(z, last, 0, 4, 2, 6),
             high_z = __builtin_shufflevector(z, last, 1, 5, 3, 7);
  store(Four(__builtin_shufflevector(low_xy, low_z, 0, 1, 4, 5)), rows[0]);
  store(Four(__builtin_shufflevector(high_xy, high_z, 0, 1, 4, 5)), rows[1]);
  store(Four(__builtin_shufflevector(low_xy, low_z, 2, 3, 6, 7)), rows[2]);
  store(Four(__builtin_shufflevector(high_xy, high_z, 2, 3, 6, 7)), rows[3]);
}
TWEENFALL_LANES void scatter(const Eight& x, const Eight& y, const Eight& z, const Eight& last, double* const* rows) {
  const Eight low_xy = __builtin_shufflevector(x, y, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight high_xy = __builtin_shufflevector(x, y, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight low_z = __builtin_shufflevector(z, last, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight high_z = __builtin_shufflevector(z, last, 1, 9, 3, 11, 5, 13, 7, 15);
  const auto put = [&](const Eight& both, int low, int high) {
    store(Four(__builtin_shufflevector(both, both, 0, 1, 2, 3)), rows[low]);
    store(Four(__builtin_shufflevector(both, both, 4, 5, 6, 7)), rows[high]);
  };
  put(__builtin_shufflevector(low_xy, low_z, 0, 1, 8, 9, 4, 5, 12, 13), 0, 4);
  put(__builtin_shufflevector(high_xy, high_z, 0, 1, 8, 9, 4, 5, 12, 13), 1, 5);
  put(__builtin_shufflevector(low_xy, low_z, 2, 3, 10, 11, 6, 7, 14, 15), 2, 6);
  put(__builtin_shufflevector(high_xy, high_z, 2, 3, 10, 11, 6, 7, 14, 15), 3, 7);
}
template <class Half>
TWEENFALL_LANES void scatter(const Halves<Half>& x, const Halves<Half>& y, const Halves<Half>& z,
                             const Halves<Half>& last, double* const* rows) {
  scatter(x.low, y.low, z.low, last.low, rows);
  scatter(x.high, y.high, z.high, last.high, rows + sizeof(Half) / sizeof(double));
}

template <class Part, int first>
TWEENFALL_LANES void scatter(const LanesFrom<Part, first>& x, const LanesFrom<Part, first>& y,
                             const LanesFrom<Part, first>& z, const LanesFrom<Part, first>& last, double* const* rows) {
  scatter(x.of, y.of, z.of, last.of, rows + first);
}

#pragma GCC diagnostic pop

}  // namespace tweenfall::blocks
