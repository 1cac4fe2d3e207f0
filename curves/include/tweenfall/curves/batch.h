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
  /// Curves are fast if their spans are at most cubic, without easing shapes or weighted handles, and if they hold
  /// outside their knots; all others are sampled one by one.
  explicit CurveBatch(std::span<const Curve<double>> curves);

  [[nodiscard]] std::size_t size() const noexcept { return tracks_.size(); }

  /// The curves' values (U) and rates (U/s) at any finite `time`, in the order in which they were given.
  /// Not to be called by two threads at once: it changes what the batch remembers.
  /// @param values, rates  `size()` numbers each; `rates` may be left empty
  /// @throws std::invalid_argument for another size.
  void sample(double time, std::span<double> values, std::span<double> rates = {});

 private:
  // One stretch of a curve with its cubic. The stretch from minus infinity to the first knot is constant, and so is the
  // one from the last knot to infinity.
  struct Stretch {
    double start, end;
    double c0, c1, c2, c3;
  };
  // For a first guess at the stretch of a curve that holds a time.
  struct Track {
    std::uint32_t last;  // number of its last stretch
    double start, end, spans_per_second;
  };
  // A curve that is sampled by itself.
  struct Apart {
    std::size_t index;
    Curve<double> curve;
  };

  [[nodiscard]] const Stretch& stretch(std::uint32_t number, std::size_t track) const noexcept {
    return stretches_[rows_[number] + track];
  }
  [[nodiscard]] static std::uint32_t guess(const Track& track, double time) noexcept;
  [[nodiscard]] std::uint32_t search(std::size_t track, double time) const noexcept;
  template <class TrackOf, class Found>
  void seek(std::size_t count, double time, const TrackOf& track_of, const Found& found) noexcept;
  void remember(std::size_t track) noexcept;
  void go_on(double time) noexcept;
  void play(double time, double* values, double* rates) noexcept;
  void jump(double time, double* values, double* rates) noexcept;

  // The first stretches of all curves, then the second ones of all, and so on: at any time, similar curves are in
  // stretches that lie side by side. Curves with more stretches come first, so each row holds the first so many curves.
  std::vector<Stretch> stretches_;
  std::vector<std::size_t> rows_;     // where the row of each stretch number starts in `stretches_`
  std::vector<Track> tracks_;         // in that same order of curves
  std::vector<std::uint32_t> order_;  // index of each curve as given; empty where the order is the same
  std::vector<double> found_;         // values and rates, where the order differs
  std::vector<Apart> apart_;
  double time_ = 0, stride_ = 0;  // last time sampled; longest step after which the next stretch is the likely one

  // The stretch that each curve was last in: its number and, while the batch is played forwards, its cubic.
  bool remembered_ = true;
  std::vector<std::uint32_t> place_, stale_;
  std::vector<double> start_, end_, inverse_, c0_, c1_, c2_, c3_;
};

}  // namespace tweenfall
