#include "islands/small/extrapolation.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::small {

namespace {

/// Rounding of a difference, relative.
constexpr double nothing = 1e-7;

double dot(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}

void subtract(std::vector<double>& a, double share, const std::vector<double>& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= share * b[i];
}

}  // namespace

const std::vector<double>& Extrapolation::next(const std::vector<double>& from, const std::vector<double>& to) {
  change_.resize(size_);
  for (std::size_t i = 0; i < size_; ++i) change_[i] = to[i] - from[i];
  next_ = to;
  if (started_) {
    newest_ = known_ == 0 ? 0 : (newest_ + 1) % most;
    known_ = std::min(known_ + 1, most);
    Difference& newest = differences_[newest_];
    newest.change = change_;
    newest.result = to;
    subtract(newest.change, 1, last_change_);
    subtract(newest.result, 1, last_result_);
  }
  started_ = true;
  last_change_ = change_;
  last_result_ = to;
  const auto at = [&](std::size_t age) -> Difference& { return differences_[(newest_ + most - age) % most]; };
  // Least squares, the newest first; what they have in common is left out.
  rest_ = change_;
  for (std::size_t age = 0; age < known_; ++age) {
    Difference& difference = at(age);
    difference.direction = difference.change;
    const double whole = std::sqrt(dot(difference.change, difference.change));
    for (std::size_t newer = 0; newer < age; ++newer) {
      const Difference& other = at(newer);
      difference.along[newer] = other.length > 0 ? dot(other.direction, difference.direction) : 0;
      subtract(difference.direction, difference.along[newer], other.direction);
    }
    const double length = std::sqrt(dot(difference.direction, difference.direction));
    difference.length = length > nothing * whole ? length : 0;
    difference.share = 0;
    if (difference.length == 0) {
      std::fill(difference.direction.begin(), difference.direction.end(), 0.0);
      continue;
    }
    for (double& part : difference.direction) part /= length;
    difference.share = dot(difference.direction, rest_);
    subtract(rest_, difference.share, difference.direction);
  }
  for (std::size_t age = known_; age-- > 0;) {
    Difference& difference = at(age);
    if (difference.length == 0) continue;
    for (std::size_t older = age + 1; older < known_; ++older)
      if (at(older).length > 0) difference.share -= at(older).along[age] * at(older).share;
    difference.share /= difference.length;
    subtract(next_, difference.share, difference.result);
  }
  return next_;
}

}  // namespace tweenfall::small
