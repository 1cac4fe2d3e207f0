#pragma once

// The compiled form of a clip.
//
// A channel is one kind of value (translation, rotation, scale) of the eight joints of a group. Its values at the knots
// of a timeline, and for cubic channels its rates there, are rows; between two knots the channel is a Hermite cubic of
// these, or a line. A row is the sum of a base, a uniform cubic B-spline over the numbers of the knots with a
// coefficient for every `stride` of them, and of the remainder, an integer. Where a base would not save space there is
// none.
// Channels of the same form make up a run, and are stored together, knot after
// knot.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/crowd_pose.h>

#include "clip/life.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <new>
#include <vector>

namespace tweenfall::crowd {

inline constexpr std::size_t lane_count = CrowdGroup::size;

/// Bound on the inverse of a difference of nearly equal times, so that products with it stay finite in float.
inline constexpr double steepest = 1e30;

/// Begins where a line of the processor's cache does: reading eight numbers that lie in two lines takes twice as long.
template <class Number>
struct LineAllocator {
  using value_type = Number;
  static constexpr std::align_val_t line{64};

  LineAllocator() = default;
  template <class Other>
  LineAllocator(const LineAllocator<Other>&) noexcept {}
  [[nodiscard]] Number* allocate(std::size_t count) {
    return static_cast<Number*>(::operator new(count * sizeof(Number), line));
  }
  void deallocate(Number* numbers, std::size_t) noexcept { ::operator delete(numbers, line); }
  bool operator==(const LineAllocator&) const = default;
};
template <class Number>
using LineVector = std::vector<Number, LineAllocator<Number>>;

enum class Kind : std::uint8_t { translation, rotation, scale };

[[nodiscard]] constexpr std::size_t components(Kind kind) {
  return kind == Kind::rotation ? 4 : 3;
}

/// How the three or four components of a value are packed into the words of a lane.
enum class Packing : std::uint8_t {
  none,
  narrow,  ///< one word: 10 bits for each of three, 8 for each of four
  wide,    ///< two words: 16 bits each
  exact,   ///< a float each
};

/// The position of a component in its word. Reading leaves it there, and treats only the topmost as signed: steps and
/// offsets are made for that.
struct Field {
  std::size_t word;
  int at, bits;

  [[nodiscard]] constexpr bool at_top() const { return at + bits == 32; }
  /// Added to a number so that it is not negative.
  [[nodiscard]] constexpr int bias() const { return at_top() ? 0 : 1 << (bits - 1); }
  /// The factor by which a number is multiplied when it is read.
  [[nodiscard]] constexpr double factor() const { return at_top() ? 1.0 : static_cast<double>(1U << at); }
};

[[nodiscard]] constexpr Field field_of(Packing packing, std::size_t component_count, std::size_t component) {
  if (packing == Packing::wide) return {component / 2, component % 2 == 0 ? 0 : 16, 16};
  if (component_count == 4) return {0, static_cast<int>(8 * component), 8};
  return {0, component == 2 ? 22 : static_cast<int>(10 * component), 10};
}

[[nodiscard]] constexpr std::size_t words_of(Packing packing, std::size_t component_count) {
  switch (packing) {
    case Packing::narrow:
      return 1;
    case Packing::wide:
      return 2;
    case Packing::exact:
      return component_count;
    case Packing::none:
      break;
  }
  return 0;
}

/// The largest whole number that a packing holds; the least is its negative.
[[nodiscard]] constexpr int limit_of(Packing packing, std::size_t component_count) {
  return packing == Packing::wide ? 32767 : component_count == 3 ? 511 : 127;
}

struct Timeline {
  std::vector<double> knots;  ///< s; two or more, not decreasing; equal ones are a jump or a kink

  // Made from the knots: for each of many equal stretches of time, the first knot not before its start.
  std::vector<std::uint32_t> cells;
  double cells_per_second = 0;

  void index();

  struct Place {
    std::size_t knot;  ///< the segment's first
    double u;          ///< position in the segment, 0 to 1
    double length;     ///< of the segment, s; 0 for a jump
  };
  [[nodiscard]] Place at(double time, bool arriving) const noexcept;
};

struct Channel {
  std::uint32_t group = 0;
  Kind kind = Kind::translation;
  std::uint32_t numbers = 0;  ///< where its offsets and steps begin
};

/// How channels are stored.
struct Form {
  static constexpr std::uint32_t no_timeline = 0xffffffff;

  std::uint32_t timeline = no_timeline;  ///< none: the channels are constant, equal to their offsets
  bool cubic = false;
  Packing base = Packing::none, fine = Packing::none;
  std::uint32_t stride = 0;  ///< knots for each coefficient of the base; a power of 2, or 0 without one

  auto operator<=>(const Form&) const = default;

  [[nodiscard]] bool is_constant() const { return base == Packing::none && fine == Packing::none; }

  [[nodiscard]] std::size_t slots(std::size_t component_count) const {
    return cubic ? 2 * component_count : component_count;
  }
  /// Lines of eight floats for each slot: offset, step of the base, step of the fine part.
  [[nodiscard]] std::size_t numbers_per_slot() const {
    if (fine == Packing::exact) return 0;
    return 1 + (base != Packing::none ? 1 : 0) + (fine != Packing::none ? 1 : 0);
  }
  /// Lines of eight words of one channel in a row of the base, or of the fine part.
  [[nodiscard]] std::size_t lines(Packing packing, std::size_t component_count) const {
    return (cubic ? 2 : 1) * words_of(packing, component_count);
  }
  [[nodiscard]] std::size_t base_rows(std::size_t knots) const {
    return base == Packing::none ? 0 : (knots - 2) / stride + 4;
  }
};

struct Run {
  Form form;
  std::uint32_t first = 0, count = 0;          ///< channels
  std::size_t base_row = 0, fine_row = 0;      ///< words in a row
  std::size_t base_begin = 0, fine_begin = 0;  ///< where the rows begin among the words
  std::uint32_t stride_bits = 0;               ///< the stride is 2 to the power of this
  std::size_t taps_begin = 0;  ///< where the weights of the base's coefficients begin, four for each knot of a stride
};

/// A joint that a loop with offset moves further in each round.
struct Climb {
  std::uint32_t joint = 0;
  double gain[3] = {0, 0, 0};  ///< m per round
  double turn[3] = {0, 0, 0};  ///< rotation vector, per round
};

/// How far roundings to float take a place, relative to its distance, and how far axes of length 1.
inline constexpr double place_rounding = 0x1p-24, axes_rounding = 3 * place_rounding;

/// How far points of the figure are from the exact path at most, m.
struct RoundErrors {
  double first = 0;              ///< in the first round
  double later = 0, growth = 0;  ///< in the k-th before or after it: `later` + k `growth`

  [[nodiscard]] double in(int round) const { return round == 0 ? first : later + std::abs(1.0 * round) * growth; }
  void include(const RoundErrors& other) {
    first = std::max(first, other.first);
    later = std::max(later, other.later);
    growth = std::max(growth, other.growth);
  }
};

struct CompiledClip {
  std::uint32_t joints = 0;
  double duration = 0;  ///< s
  Loop loop;
  RoundErrors errors;
  std::vector<Timeline> timelines;
  std::vector<Run> runs;
  std::vector<Channel> channels;  ///< each kind of each group once
  LineVector<float> numbers;
  LineVector<std::int32_t> words;
  std::vector<Climb> climbs;
  // Made by `lay_out`:
  std::vector<float> taps;
  clips::Rounds forwards, backwards;  ///< of plays whose speed is positive or negative
};

/// Sets where the rows of each run lie, from its form and channels, the weights of its base, and the rounds of plays.
/// @returns the total number of words
std::uint64_t lay_out(CompiledClip& clip);

/// Moves the joints that climb to where they are after `cycle` rounds. @param rates  null for none
void climb(const CompiledClip& clip, int cycle, CrowdGroup* pose, CrowdRates* rates) noexcept;

/// The four coefficients' weights of a uniform cubic B-spline at x, 0 to 1, between the second and the third.
void spline_weights(double x, double* weights) noexcept;

}  // namespace tweenfall::crowd
