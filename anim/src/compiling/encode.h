#pragma once

// From numbers at knots to rows of few bits.

#include <array>
#include <vector>

#include "crowd/compiled_clip.h"

namespace tweenfall::crowd {

/// What a channel is at the knots of a timeline, as it was fitted.
struct Fitted {
  Kind kind = Kind::translation;
  bool cubic = false;
  std::vector<double> knots;   ///< s; one for a channel that is constant
  std::vector<double> values;  ///< for each knot, each slot (values, then rates of cubic ones) and each lane

  [[nodiscard]] std::size_t slots() const { return (cubic ? 2 : 1) * components(kind); }
  [[nodiscard]] double at(std::size_t knot, std::size_t slot, std::size_t lane) const {
    return values[(knot * slots() + slot) * CrowdGroup::size + lane];
  }
};

/// The steps that are fine enough for each slot and lane.
using Steps = std::vector<std::array<double, CrowdGroup::size>>;

/// A channel as it is stored: rows of its own, to be woven with those of others.
struct Encoded {
  std::vector<float> numbers;
  std::vector<std::int32_t> base, fine;  ///< row after row
};

/// A way to store a channel, and what that costs.
struct Way {
  Form form;    ///< the number of the timeline is not set
  double cost;  ///< lines of eight words; and what it takes to read them, where that counts, as so many lines
};

/// What every way of storing a channel would leave, so that the ways for some steps are known at once.
class Survey {
 public:
  explicit Survey(const Fitted& fitted);

  /// All ways in which no number is further off than half its step, or hardly. One at least.
  /// @param smallest  only room counts, and not time
  [[nodiscard]] std::vector<Way> ways(const Steps& steps, bool smallest) const;

 private:
  /// Of a sequence of numbers: half its range, and its largest magnitude.
  struct Extent {
    double half = 0, most = 0;
  };
  using Extents = std::vector<Extent>;  // of each slot and lane
  struct Rest {
    std::uint32_t stride;
    Packing base;
    Extents left;
  };

  const Fitted* fitted_;
  Extents whole_;
  std::vector<Rest> rests_;
};

/// @param form  of one of the ways
[[nodiscard]] Encoded encoded(const Fitted& fitted, const Form& form);

}  // namespace tweenfall::crowd
