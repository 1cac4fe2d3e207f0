#pragma once

#include <span>
#include <vector>

#include "strategies/gathering.h"

namespace tweenfall::strategies {

/// The velocities of an island in more digits than its parties have. What presses hard on what is light makes it fast
/// and stops it again: of a million m/s the last digit of a double is 1e-10 m/s, which would be left at the end.
class FineSpeeds {
 public:
  explicit FineSpeeds(const Gathering& island);

  /// An impulse along the normal of a touch, N s.
  void push(const Touch& touch, long double impulse);
  /// How fast the surfaces part at a touch, m/s.
  [[nodiscard]] long double parting(const Touch& touch) const;
  /// Gives the parties these velocities.
  void tell(Gathering& island) const;

 private:
  using Fine = Eigen::Matrix<long double, 3, 1>;
  struct Speed {
    Fine linear, angular;
  };
  const Gathering& island_;
  std::vector<Speed> speeds_;  ///< by party
  std::vector<char> touched_;
};

}  // namespace tweenfall::strategies
