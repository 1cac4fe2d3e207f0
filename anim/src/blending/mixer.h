#pragma once

// A weighted mean of any number of values, without storing them all.

#include <tweenfall/curves/values.h>

#include <array>
#include <span>

#include "blending/shares.h"

namespace tweenfall::blending {

/// The mean of values added one after the other. It holds a few at a time; when there are more, the ones held are mixed
/// into one with the sum of their weights.
/// @tparam Mean takes two values or more, with shares that do not sum to zero
template <class Value, class Mean>
class Mixer {
 public:
  explicit Mixer(const Mean& mean) : mean_(mean) {}

  void clear() noexcept { count_ = 0; }
  void put(const Value& value, const Sample<double>& share) noexcept {
    if (count_ == most) {
      Sample<double> all{0, 0, 0};
      for (const Sample<double>& one : shares_)
        all = {all.value + one.value, all.rate + one.rate, all.acceleration + one.acceleration};
      values_[0] = mixed();
      shares_[0] = all;
      count_ = 1;
    }
    values_[count_] = value;
    shares_[count_] = share;
    ++count_;
  }
  [[nodiscard]] Value mixed() const noexcept {
    double sum = 0;
    for (std::size_t i = 0; i < count_; ++i) sum += shares_[i].value;
    if (count_ == 1 || !(sum > 1e-100)) return values_[0];
    return mean_(std::span<const Value>(values_.data(), count_),
                 std::span<const Sample<double>>(shares_.data(), count_));
  }

 private:
  static constexpr std::size_t most = 16;
  const Mean& mean_;
  std::array<Value, most> values_{};
  std::array<Sample<double>, most> shares_{};
  std::size_t count_ = 0;
};

/// Adds all values with a weight to the mixer: `weight(i)` and `value(i)` of each, and the rest, up to `least`.
/// @return false where all weights are zero
template <class M, class Weight, class Get, class Rest>
[[nodiscard]] bool fill(M& mixer, std::size_t count, const Weight& weight, const Get& value, const Rest& rest,
                        double least) noexcept {
  Whole whole;
  for (std::size_t i = 0; i < count; ++i) whole.add(weight(i));
  whole.fill_up_to(least);
  if (whole.is_nothing()) return false;
  mixer.clear();
  if (counts(whole.filling)) mixer.put(rest, whole.share(whole.filling));
  for (std::size_t i = 0; i < count; ++i)
    if (const Sample<double> w = weight(i); counts(w)) mixer.put(value(i), whole.share(w));
  return true;
}

}  // namespace tweenfall::blending
