#pragma once

// When something that grows over time is reached, to the bit.

#include <bit>
#include <cstdint>

namespace tweenfall::graphs {

/// The first time up to `time`, which is after `before`, at which something is reached that is not yet at `before` and
/// is at `time`. Halves along the binary digits of the time itself, not of the stretch: where rounding makes it
/// undecided over a few neighboring times, still the same one is found, whatever the stretch that is searched.
/// @param before, time  s; 0 or later
template <class Reached>
[[nodiscard]] double first_reached(double before, double time, const Reached& reached) noexcept {
  auto low = std::bit_cast<std::uint64_t>(before), high = std::bit_cast<std::uint64_t>(time);
  while (high - low > 1) {
    // Of the times in between, the one with the fewest digits.
    const std::uint64_t last = high - 1;
    const std::uint64_t middle = last & ~(std::bit_floor(low ^ last) - 1);
    (reached(std::bit_cast<double>(middle)) ? high : low) = middle;
  }
  return std::bit_cast<double>(high);
}

/// The same, where it is likely to be near a guess: looked for in its neighborhood first.
template <class Reached>
[[nodiscard]] double first_reached(double before, double time, double guess, const Reached& reached) noexcept {
  const auto low = std::bit_cast<std::uint64_t>(before), high = std::bit_cast<std::uint64_t>(time);
  const auto near = std::bit_cast<std::uint64_t>(guess >= before && guess <= time ? guess : before);
  for (std::uint64_t reach = 16; reach < std::uint64_t{1} << 40; reach *= 16) {
    const std::uint64_t below = near - low > reach ? near - reach : low;
    const std::uint64_t above = high - near > reach ? near + reach : high;
    const double from = std::bit_cast<double>(below), to = std::bit_cast<double>(above);
    if ((below == low || !reached(from)) && (above == high || reached(to))) return first_reached(from, to, reached);
  }
  return first_reached(before, time, reached);
}

}  // namespace tweenfall::graphs
