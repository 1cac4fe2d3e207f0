#include <tweenfall/curves/editing.h>
#include <tweenfall/curves/fitting.h>

#include <algorithm>

#include "editing/fit_target.h"

namespace tweenfall::editing {
namespace {

template <class T>
class Reducer {
 public:
  using Kind = typename FitTarget<T>::Kind;

  Reducer(std::span<const Key<T>> keys, double error, const FitOptions& options)
      : given_(with_given_slopes(keys, options.keys)), target_(keyed_curve<T>(keys, options.keys), error, options) {}

  std::vector<Key<T>> keys() const {
    std::vector<Key<T>> result = {given_.front()};
    for (std::size_t from = 0; from + 1 < given_.size();) {
      const std::size_t to = longest(from);
      FittedSpan<T> span{given_[from], given_[to]};
      if (to > from + 1) (void)reaches(from, to, &span);
      result.back().ease = span.from.ease;
      result.back().out = span.from.out;
      Key<T> next = given_[to];
      next.in = span.to.in;
      if (to > from + 1) next.value_in = span.to.value_in;
      result.push_back(next);
      from = to;
    }
    return result;
  }

 private:
  // Whether one span may replace those between two keys.
  bool reaches(std::size_t from, std::size_t to, FittedSpan<T>* used = nullptr) const {
    const double start = given_[from].time, end = given_[to].time;
    const FittedSpan<T> straight = target_.span(start, end, Kind::linear);
    const FittedSpan<T> cubic = target_.span(start, end, Kind::cubic);
    const FittedSpan<T>* found = target_.is_near(straight, target_.least_error()) ? &straight
                                 : target_.is_near(cubic, target_.error())        ? &cubic
                                 : target_.is_near(straight, target_.error())     ? &straight
                                                                                  : nullptr;
    if (found && used) *used = *found;
    return found != nullptr;
  }

  // Index of the farthest key to which one span reaches.
  std::size_t longest(std::size_t from) const {
    std::size_t low = from + 1, high = given_.size();
    for (std::size_t step = 1; low + step < given_.size(); step *= 2) {
      if (!reaches(from, low + step)) {
        high = low + step;
        break;
      }
      low += step;
    }
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (reaches(from, middle) ? low : high) = middle;
    }
    return low;
  }

  std::vector<Key<T>> given_;
  FitTarget<T> target_;
};

}  // namespace
}  // namespace tweenfall::editing

namespace tweenfall {

template <class T>
std::vector<Key<T>> reduce(std::span<const Key<T>> keys, double error, const FitOptions& options) {
  if (keys.size() < 3) return with_given_slopes(keys, options.keys);
  return editing::Reducer<T>(keys, error, options).keys();
}

#define TWEENFALL_REDUCE(T) template std::vector<Key<T>> reduce<T>(std::span<const Key<T>>, double, const FitOptions&);
TWEENFALL_REDUCE(double)
TWEENFALL_REDUCE(Vec2)
TWEENFALL_REDUCE(Vec3)
TWEENFALL_REDUCE(Vec4)
TWEENFALL_REDUCE(Color)
TWEENFALL_REDUCE(Quat)
#undef TWEENFALL_REDUCE

}  // namespace tweenfall
