#include "expression/expression_kernels.h"

#include <cstring>
#include <span>

namespace tweenfall::expressions {

namespace {

using elementary::SinCos;
namespace series = elementary::series;

using List = std::array<double, most_lanes>;

TWEENFALL_INLINED Still read(const LanesView<Still>& from, std::size_t i) noexcept {
  return {from[0][i]};
}
TWEENFALL_INLINED Jet read(const LanesView<Jet>& from, std::size_t i) noexcept {
  return {from[0][i], from[1][i], from[2][i]};
}
TWEENFALL_INLINED void write(const Still& number, std::size_t i, Lanes<Still>& to) noexcept {
  to[0][i] = number.v;
}
TWEENFALL_INLINED void write(const Jet& number, std::size_t i, Lanes<Jet>& to) noexcept {
  to[0][i] = number.v;
  to[1][i] = number.d;
  to[2][i] = number.dd;
}

// What is written lies elsewhere than what is read, which only this tells the compilers.
#if defined(__clang__)
#define TWEENFALL_LOOP _Pragma("clang loop vectorize(assume_safety)")
#else
#define TWEENFALL_LOOP _Pragma("GCC ivdep")
#endif

template <class Kind, class Number>
TWEENFALL_INLINED void do_each(const LanesView<Number>* arguments, std::size_t count, double way,
                               Lanes<Number>& out) noexcept {
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) {
    Number of_one[Kind::count];
    for (int k = 0; k < Kind::count; ++k) of_one[k] = read(arguments[k], i);
    write(Kind::template of<Number>(of_one, way), i, out);
  }
}

// In several passes: each is short enough that a processor begins the next numbers while it waits for these.
TWEENFALL_INLINED void find_sin_cos(const double* x, std::size_t count, List& sin, List& cos) noexcept {
  List quadrants, highs, lows;
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) {
    quadrants[i] = series::quadrants_of(x[i]);
    const two_part::Sum r = series::less_quadrants(x[i], quadrants[i]);
    highs[i] = r.high;
    lows[i] = r.low;
  }
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) {
    const two_part::Sum along = series::sin_of({highs[i], lows[i]});
    sin[i] = along.high + along.low;
  }
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) {
    const two_part::Sum across = series::cos_of({highs[i], lows[i]});
    const SinCos wave = series::turned({sin[i], across.high + across.low}, quadrants[i]);
    sin[i] = wave.sin;
    cos[i] = wave.cos;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (std::abs(x[i]) <= series::largest_angle) continue;
    const SinCos wave = elementary::sin_cos(x[i]);
    sin[i] = wave.sin;
    cos[i] = wave.cos;
  }
}

TWEENFALL_INLINED void find_exp(const double* x, std::size_t count, List& out) noexcept {
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) out[i] = series::exp_of({x[i], 0});
  for (std::size_t i = 0; i < count; ++i)
    if (!(std::abs(x[i]) <= series::largest_exponent)) out[i] = elementary::exp(x[i]);
}

TWEENFALL_INLINED bool is_ordinary(double x) noexcept {
  return x >= series::smallest_normal && x <= series::largest_number;
}

TWEENFALL_INLINED void find_log(const double* x, std::size_t count, List& out) noexcept {
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) {
    const two_part::Sum l = series::log_of(x[i]);
    out[i] = l.high + l.low;
  }
  for (std::size_t i = 0; i < count; ++i)
    if (!is_ordinary(x[i])) out[i] = elementary::log(x[i]);
}

TWEENFALL_INLINED void find_product(const double* x, double n, std::size_t count, List& out) noexcept {
  List square;
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) {
    square[i] = x[i];
    out[i] = 1;
  }
  for (int left = static_cast<int>(std::abs(n)); left > 0; left /= 2) {
    if (left % 2 == 1) {
      TWEENFALL_LOOP
      for (std::size_t i = 0; i < count; ++i) out[i] *= square[i];
    }
    TWEENFALL_LOOP
    for (std::size_t i = 0; i < count; ++i) square[i] *= square[i];
  }
  if (n < 0) {
    TWEENFALL_LOOP
    for (std::size_t i = 0; i < count; ++i) out[i] = 1 / out[i];
  }
}

/// x^n for one n, as `power_value` has it.
TWEENFALL_INLINED void find_powers(const double* x, double n, std::size_t count, List& out) noexcept {
  if (is_product(n)) return find_product(x, n, count, out);
  List exponents{}, lows;
  const bool splits = std::abs(n) <= 0x1p900;
  if (splits) {
    TWEENFALL_LOOP
    for (std::size_t i = 0; i < count; ++i) {
      const two_part::Sum exponent = series::exponent_of_power(x[i], n);
      exponents[i] = exponent.high;
      lows[i] = exponent.low;
    }
    TWEENFALL_LOOP
    for (std::size_t i = 0; i < count; ++i) out[i] = series::exp_of({exponents[i], lows[i]});
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double size = std::abs(exponents[i]);
    const bool ordinary = splits && is_ordinary(x[i]) && size <= series::largest_exponent && size > 0x1p-50;
    if (!ordinary) out[i] = power_value(x[i], n);
  }
}

/// Whether what was found before is of the same values.
TWEENFALL_INLINED bool is_of(const Prepared& prepared, const double* x, std::size_t count) noexcept {
  return prepared.count == count && std::memcmp(prepared.argument.data(), x, count * sizeof(double)) == 0;
}
template <std::size_t Parts>
TWEENFALL_INLINED void keep_argument(const double* x, std::size_t count, Prepared& prepared) noexcept {
  // Nothing else is derived from numbers that stand still.
  if (Parts == 1) return;
  std::memcpy(prepared.argument.data(), x, count * sizeof(double));
  prepared.count = count;
}

template <class Kind, class Number>
TWEENFALL_INLINED void do_from_elementary(const LanesView<Number>* arguments, std::size_t count, Prepared& prepared,
                                          Lanes<Number>& out) noexcept {
  constexpr bool waves = std::is_same_v<Kind, kinds::Sine> || std::is_same_v<Kind, kinds::Cosine>;
  const double* x = arguments[0][0];
  List &first = prepared.found[0], &second = prepared.found[1];
  if (!is_of(prepared, x, count)) {
    if constexpr (waves)
      find_sin_cos(x, count, first, second);
    else if constexpr (std::is_same_v<Kind, kinds::Exponential>)
      find_exp(x, count, first);
    else
      find_log(x, count, first);
    keep_argument<parts_of<Number>>(x, count, prepared);
  }
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) {
    if constexpr (waves)
      write(Kind::from(read(arguments[0], i), SinCos{first[i], second[i]}), i, out);
    else
      write(Kind::from(read(arguments[0], i), first[i]), i, out);
  }
}

template <class Kind, class... Others>
constexpr bool is_one_of = (std::is_same_v<Kind, Others> || ...);

template <class Kind, class Number>
TWEENFALL_INLINED void do_all(const LanesView<Number>* arguments, std::size_t count, double way,
                              [[maybe_unused]] Prepared& prepared, Lanes<Number>& out) noexcept {
  if constexpr (is_one_of<Kind, kinds::Sine, kinds::Cosine, kinds::Exponential, kinds::Logarithm>) {
    do_from_elementary<Kind, Number>(arguments, count, prepared, out);
  } else if constexpr (std::is_same_v<Kind, kinds::Power>) {
    if constexpr (parts_of < Number >> 1)
      for (std::size_t i = 0; i < count; ++i) {
        const Number of_one[2] = {read(arguments[0], i), read(arguments[1], i)};
        write(Kind::of(of_one, way), i, out);
      }
  } else {
    do_each<Kind, Number>(arguments, count, way, out);
  }
}

template <class Number>
TWEENFALL_INLINED void raise_all(const LanesView<Number>& a, double n, std::size_t count, Prepared& prepared,
                                 Lanes<Number>& out) noexcept {
  List &values = prepared.found[0], &below = prepared.found[1], &second_below = prepared.found[2];
  if (!(is_of(prepared, a[0], count) && prepared.exponent == n)) {
    find_powers(a[0], n, count, values);
    if constexpr (parts_of < Number >> 1) {
      below.fill(0);
      second_below.fill(0);
      if (n != 0) find_powers(a[0], n - 1, count, below);
      if (n != 0 && n != 1) find_powers(a[0], n - 2, count, second_below);
    }
    keep_argument<parts_of<Number>>(a[0], count, prepared);
    prepared.exponent = n;
  }
  TWEENFALL_LOOP
  for (std::size_t i = 0; i < count; ++i) {
    if constexpr (parts_of < Number >> 1)
      write(raised(read(a, i), n, values[i], below[i], second_below[i]), i, out);
    else
      write(Number{values[i]}, i, out);
  }
}

// The same source for each instruction set. None of them fuses a multiplication and an addition here, so the bits are
// the same.
#define TWEENFALL_VERSION(name, target)                                                                            \
  template <class Kind, class Number>                                                                              \
  target void do_all_##name(const LanesView<Number>* arguments, std::size_t count, double way, Prepared& prepared, \
                            Lanes<Number>& out) {                                                                  \
    do_all<Kind, Number>(arguments, count, way, prepared, out);                                                    \
  }                                                                                                                \
  template <class Number>                                                                                          \
  target void raise_##name(const LanesView<Number>& a, double n, std::size_t count, Prepared& prepared,            \
                           Lanes<Number>& out) {                                                                   \
    raise_all<Number>(a, n, count, prepared, out);                                                                 \
  }                                                                                                                \
  template <class Number, class... Kinds>                                                                          \
  constexpr KernelsOf<Number> table_##name(kinds::List<Kinds...>) {                                                \
    return {{&do_all_##name<Kinds, Number>...}, &raise_##name<Number>};                                            \
  }                                                                                                                \
  constexpr ExpressionKernels name = {table_##name<Still>(kinds::All{}), table_##name<Jet>(kinds::All{})};

TWEENFALL_VERSION(plain, )
#if defined(__x86_64__) || defined(__i386__)
TWEENFALL_VERSION(avx2, [[gnu::target("avx2")]])
#endif
#undef TWEENFALL_VERSION

}  // namespace

std::span<const ExpressionKernels* const> expression_kernels() noexcept {
#if defined(__x86_64__) || defined(__i386__)
  static constexpr std::array all = {&plain, &avx2};
  return std::span(all).first(__builtin_cpu_supports("avx2") ? 2 : 1);
#else
  static constexpr std::array all = {&plain};
  return all;
#endif
}

}  // namespace tweenfall::expressions
