#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace tweenfall::small {

/// The limit of passes that each map a vector to the next: from the last few passes, the combination whose change
/// is least. In a smooth problem this ends after as many passes as there are unknowns, however slowly the passes alone
/// would converge.
/// Source: Anderson, Iterative Procedures for Nonlinear Integral Equations, Journal of the ACM 12, 1965; Walker and Ni,
/// Anderson Acceleration for Fixed-Point Iterations, SIAM Journal on Numerical Analysis 49, 2011.
class Extrapolation {
 public:
  /// Starts over, with vectors of this size.
  void begin(std::size_t size) {
    size_ = size;
    known_ = 0;
    started_ = false;
  }
  /// One pass mapped `from` to `to`. @return the vector for the next pass to start with
  const std::vector<double>& next(const std::vector<double>& from, const std::vector<double>& to);

 private:
  static constexpr std::size_t most = 6;

  struct Difference {
    std::vector<double> change, result;  ///< differences of what a pass changes, and of what it returns
    std::vector<double> direction;       ///< of the change, without what newer ones contain
    double length = 0;                   ///< of `direction`; 0 if the newer ones contain it all
    double share = 0;
    std::array<double, most> along{};  ///< components along the directions of the newer ones
  };

  std::size_t size_ = 0, known_ = 0, newest_ = 0;
  bool started_ = false;
  std::array<Difference, most> differences_;
  std::vector<double> change_, last_change_, last_result_, next_, rest_;
};

}  // namespace tweenfall::small
