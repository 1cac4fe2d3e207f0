#pragma once

// Encodes numbers at knots as rows of few bits.

#include <array>
#include <vector>

#include "crowd/compiled_clip.h"

namespace tweenfall::crowd {

/// The fitted values of a channel at the knots of a timeline.
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

/// The sufficiently fine steps for each slot and lane.
using Steps = std::vector<std::array<double, CrowdGroup::size>>;

/// A channel in stored form: its own rows, to be interleaved with those of others.
struct Encoded {
  std::vector<float> numbers;
  std::vector<std::int32_t> base, fine;  ///< row after row
};

/// A way to store a channel, and what that costs.
struct Way {
  Form form;    ///< the number of the timeline is not set
  double cost;  ///< in lines of eight words, with the time to read them converted to lines where that counts
};

/// The remainders of every way of storing a channel, so that the ways for given steps are found quickly.
class Survey {
 public:
  explicit Survey(const Fitted& fitted);

  /// All ways in which no number is further off than about half its step; at least one.
  /// @param line_for_row  the cost of reading a slot from a further row, in lines per knot
  [[nodiscard]] std::vector<Way> ways(const Steps& steps, double line_for_row) const;

 private:
  /// Half the range of a sequence of numbers, and its largest magnitude.
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
