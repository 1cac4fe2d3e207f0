#pragma once

/// Many scalar curves, sampled together at one time: what a crowd, a particle system or a graph editor asks for.
///
/// A batch keeps the curves' cubics laid out closely, and remembers the one that each curve was last in, so that
/// playing forwards costs a few instructions per curve. The numbers are those of `Curve::sample`, to the bit.

#include <tweenfall/curves/curve.h>

#include <cstdint>
#include <span>
#include <vector>

namespace tweenfall {

class CurveBatch {
 public:
  /// Fast are curves of spans up to cubic without easing shapes or weighted handles that hold outside their knots;
  /// all others are asked one by one.
  explicit CurveBatch(std::span<const Curve<double>> curves);

  [[nodiscard]] std::size_t size() const noexcept { return tracks_.size(); }

  /// The curves' values (U) and rates (U/s) at any finite `time`, in the order in which they were given.
  /// Not to be called by two threads at once: what is remembered changes.
  /// @param values, rates  `size()` numbers each; `rates` may be left empty
  /// @throws std::invalid_argument for another size.
  void sample(double time, std::span<double> values, std::span<double> rates = {});

 private:
  // One stretch of a curve with its cubic, a line of the processor's cache; constant before the first knot, which is
  // from minus infinity on, and from the last one to infinity.
  struct alignas(64) Stretch {
    double start, end, inverse;  // inverse of the duration
    double c0, c1, c2, c3;
  };
  // Where a curve's stretches are, and what tells roughly which of them holds a time.
  struct Track {
    std::uint32_t first, last;  // of stretches_
    double start, end, spans_per_second;
  };
  // A curve that is asked by itself.
  struct Apart {
    std::size_t index;
    Curve<double> curve;
  };

  [[nodiscard]] std::uint32_t guess(const Track& track, double time) const noexcept;
  [[nodiscard]] std::uint32_t search(const Track& track, double time) const noexcept;
  void seek(std::size_t count, double time) noexcept;
  void remember(std::size_t track) noexcept;

  std::vector<Stretch> stretches_;
  std::vector<Track> tracks_;
  std::vector<Apart> apart_;
  double time_ = 0, stride_ = 0;  // last asked for; up to which step the next stretch is the likely one

  // The stretch that each curve was last in: which, until when, and its numbers.
  std::vector<std::uint32_t> place_, stale_;
  std::vector<double> start_, end_, inverse_, c0_, c1_, c2_, c3_;
};

}  // namespace tweenfall
