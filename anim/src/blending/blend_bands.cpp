#include <tweenfall/anim/blend_space.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

#include "blending/heading.h"
#include "blending/places.h"

namespace tweenfall {

namespace blending {
namespace {

bool is_less(const Sample<double>& a, const Sample<double>& b, const Sample<Vec2>& at, Side side) noexcept {
  return heading(without_rounding({b.value - a.value, b.rate - a.rate, b.acceleration - a.acceleration}, at), side) > 0;
}

}  // namespace
}  // namespace blending

BlendBands::BlendBands(std::vector<Vec2> places) : places_(std::move(places)) {
  std::string problems;
  if (places_.size() < 2)
    problems += "\n  they need two entries or more; there " +
                std::string(places_.size() == 1 ? "is 1" : "are " + std::to_string(places_.size()));
  const blending::PlaneFrame frame = blending::framed(places_, scaled_places_, problems);
  center_ = frame.center;
  size_ = frame.size;
  if (!problems.empty()) throw std::invalid_argument("gradient bands cannot be made of their entries:" + problems);
}

void BlendBands::weights(const Sample<Vec2>& parameter, std::span<Sample<double>> weights, Side side) const noexcept {
  const Sample<Vec2> at{blending::PlaneFrame{center_, size_}.scaled(parameter.value), parameter.rate / size_,
                        parameter.acceleration / size_};
  Sample<double> sum{0, 0, 0};
  std::size_t nearest = 0;
  double greatest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < scaled_places_.size(); ++i) {
    Sample<double>& least = weights[i];
    least = {1, 0, 0};
    const Vec2 from = at.value - scaled_places_[i];
    for (std::size_t j = 0; j < scaled_places_.size(); ++j) {
      if (j == i) continue;
      const Vec2 way = scaled_places_[j] - scaled_places_[i];
      const double length = way.squaredNorm();
      const Sample<double> band{1 - from.dot(way) / length, -at.rate.dot(way) / length,
                                -at.acceleration.dot(way) / length};
      if (blending::is_less(band, least, at, side)) least = band;
    }
    if (least.value > greatest) {
      greatest = least.value;
      nearest = i;
    }
    const Sample<double> clear = blending::without_rounding(least, at);
    if (blending::heading(clear, side) <= 0) least = {0, 0, 0};
    if (clear.value == 0) least.value = 0;
    sum.value += least.value;
    sum.rate += least.rate;
    sum.acceleration += least.acceleration;
  }
  // The influence of the nearest entry is a half or more, except for rounding very far away.
  if (!(sum.value > 0)) {
    weights[nearest].value = 1;
    return;
  }
  for (Sample<double>& weight : weights.first(scaled_places_.size())) {
    weight.value /= sum.value;
    weight.rate = (weight.rate - weight.value * sum.rate) / sum.value;
    weight.acceleration =
        (weight.acceleration - 2 * weight.rate * sum.rate - weight.value * sum.acceleration) / sum.value;
  }
}

}  // namespace tweenfall
