#include <tweenfall/anim/blend_space.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "blending/heading.h"

namespace tweenfall {

BlendLine::BlendLine(std::vector<double> places) : places_(std::move(places)), order_(places_.size()) {
  std::string problems;
  if (places_.size() < 2)
    problems += "\n  it needs two entries or more; there " +
                std::string(places_.size() == 1 ? "is 1" : "are " + std::to_string(places_.size()));
  bool finite = true;
  for (std::size_t i = 0; i < places_.size(); ++i)
    if (!std::isfinite(places_[i])) {
      finite = false;
      problems += "\n  the place of entry " + std::to_string(i) + " must be finite; it is " + number_text(places_[i]);
    }
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  if (finite) {
    std::ranges::stable_sort(order_, {}, [this](std::size_t i) { return places_[i]; });
    for (std::size_t i = 1; i < order_.size(); ++i)
      if (places_[order_[i - 1]] == places_[order_[i]])
        problems += "\n  entries " + std::to_string(order_[i - 1]) + " and " + std::to_string(order_[i]) +
                    " are both at " + number_text(places_[order_[i]]);
    if (order_.size() >= 2 && !std::isfinite(places_[order_.back()] - places_[order_.front()]))
      problems += "\n  its places are too far apart for a number to hold the distance";
  }
  if (!problems.empty()) throw std::invalid_argument("a blend line cannot be made of its entries:" + problems);
}

void BlendLine::weights(const Sample<double>& parameter, std::span<Sample<double>> weights, Side side) const noexcept {
  std::ranges::fill(weights, Sample<double>{0, 0, 0});
  // The first place beyond the parameter; exactly at a place, the direction of the parameter decides.
  const auto beyond = std::ranges::partition_point(order_, [&](std::size_t entry) {
    const double past = parameter.value - places_[entry];
    return past > 0 || (past == 0 && blending::heading(parameter.rate, parameter.acceleration, side) >= 0);
  });
  if (beyond == order_.begin()) {
    weights[order_.front()].value = 1;
    return;
  }
  const std::size_t below = *std::prev(beyond);
  if (beyond == order_.end()) {
    weights[below].value = 1;
    return;
  }
  const double length = places_[*beyond] - places_[below];
  const Sample<double> share{(parameter.value - places_[below]) / length, parameter.rate / length,
                             parameter.acceleration / length};
  weights[*beyond] = share;
  weights[below] = {1 - share.value, -share.rate, -share.acceleration};
}

}  // namespace tweenfall
