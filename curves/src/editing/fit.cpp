#include <tweenfall/curves/fitting.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "editing/fit_target.h"
#include "keys/key_check.h"
#include "splines/control_points.h"

namespace tweenfall::editing {
namespace {

// Goes from each key as far as the error allows.
template <class T>
class Fitter {
 public:
  using Kind = typename FitTarget<T>::Kind;

  Fitter(const Curve<T>& curve, double error, const FitOptions& options, bool cubic)
      : target_(curve, error, options), cubic_(cubic) {}

  std::vector<Key<T>> keys() {
    const Curve<T>& curve = target_.curve();
    if (curve.start() == curve.end()) return {Key<T>{curve.start(), curve.value(curve.start())}};
    std::vector<Key<T>> keys = {Key<T>{curve.start(), curve.value(curve.start())}};
    double from = curve.start();
    while (from < curve.end()) {
      const double to = longest(from);
      append(keys, best(from, to));
      from = to;
    }
    return keys;
  }

 private:
  struct Try {
    bool tried;
    Kind kind;
    const Rate<T>* leaving;
  };

  // The best span from `from` to `to`; `found` tells whether it is near enough.
  FittedSpan<T> best(double from, double to, bool* found = nullptr) {
    if (found) *found = true;
    // A stretch that is straight gets a linear key.
    FittedSpan<T> straight = target_.span(from, to, Kind::linear);
    if (target_.is_near(straight, target_.least_error())) return straight;
    if (cubic_) {
      // Smooth across the key first, then with a corner, then at the curve's own slopes, which suit any short span.
      const bool suits = target_.suits();
      for (const auto& [tried, kind, leaving] : {Try{suits && has_arrived_, Kind::suited, &arrived_},
                                                 Try{suits, Kind::suited, nullptr}, Try{true, Kind::cubic, nullptr}}) {
        if (!tried) continue;
        const FittedSpan<T> span = target_.span(from, to, kind, leaving);
        if (target_.is_near(span, target_.error())) return span;
      }
    }
    if (target_.is_near(straight, target_.error())) return straight;
    if (found) *found = false;
    return straight;
  }

  bool reaches(double from, double to) {
    bool found;
    (void)best(from, to, &found);
    return found;
  }

  double longest(double from) {
    const std::vector<double>& marks = target_.boundaries();
    const std::size_t first =
        static_cast<std::size_t>(std::upper_bound(marks.begin(), marks.end(), from) - marks.begin());
    double good = from, bad;
    if (reaches(from, marks[first])) {
      // Twice as many boundaries each time, then bisection between the last two tries.
      std::size_t low = first, high = marks.size();
      for (std::size_t step = 1; low + step < marks.size(); step *= 2) {
        if (!reaches(from, marks[low + step])) {
          high = low + step;
          break;
        }
        low += step;
      }
      while (high - low > 1) {
        const std::size_t middle = low + (high - low) / 2;
        (reaches(from, marks[middle]) ? low : high) = middle;
      }
      if (high == marks.size()) return marks.back();
      good = marks[low];
      bad = marks[high];
    } else {
      bad = marks[first];
      // Steep places may need extremely short spans.
      for (double length = bad - from; good == from; length *= 0.5) {
        const double to = from + length;
        if (!(to > from))
          throw std::invalid_argument("at " + spans::text_of(from) + " s no span is within " +
                                      spans::text_of(target_.error()) + " of the curve");
        if (reaches(from, to))
          good = to;
        else
          bad = to;
      }
    }
    for (int i = 0; i < 24; ++i) {
      const double middle = good + 0.5 * (bad - good);
      if (!(middle > good && middle < bad)) break;
      (reaches(from, middle) ? good : bad) = middle;
    }
    return good;
  }

  void append(std::vector<Key<T>>& keys, FittedSpan<T> span) {
    has_arrived_ = false;
    if (span.to.in && !span.to.value_in) {
      arrived_ = span.to.in->rate;
      // A corner stays a corner.
      const Sample<T> in = target_.curve().sample(span.to.time, Side::in);
      const Sample<T> out = target_.curve().sample(span.to.time, Side::out);
      has_arrived_ = splines::length_of(Rate<T>(in.rate - out.rate)) <=
                     1e-6 * (splines::length_of(in.rate) + splines::length_of(out.rate));
    }
    Key<T>& last = keys.back();
    last.ease = span.from.ease;
    last.out = span.from.out;
    keys.push_back(span.to);
  }

  FitTarget<T> target_;
  bool cubic_;
  Rate<T> arrived_ = zero<Rate<T>>();
  bool has_arrived_ = false;
};

}  // namespace
}  // namespace tweenfall::editing

namespace tweenfall {

template <class T>
std::vector<Key<T>> fit(const Curve<T>& curve, double error, const FitOptions& options) {
  return editing::Fitter<T>(curve, error, options, true).keys();
}

template <class T>
std::vector<Key<T>> fit_linear(const Curve<T>& curve, double error, const FitOptions& options) {
  return editing::Fitter<T>(curve, error, options, false).keys();
}

template <class T>
std::vector<Key<T>> fit_samples(std::span<const double> times, std::span<const T> values, double error,
                                const FitOptions& options) {
  if (times.size() != values.size())
    throw std::invalid_argument("there must be one value per time; there are " + std::to_string(times.size()) +
                                " times and " + std::to_string(values.size()) + " values");
  std::vector<Key<T>> keys;
  for (std::size_t i = 0; i < times.size(); ++i) keys.push_back({times[i], values[i], Ease::catmull_rom()});
  return fit(keyed_curve<T>(std::span<const Key<T>>(keys), options.keys), error, options);
}

#define TWEENFALL_FIT(T)                                                                  \
  template std::vector<Key<T>> fit<T>(const Curve<T>&, double, const FitOptions&);        \
  template std::vector<Key<T>> fit_linear<T>(const Curve<T>&, double, const FitOptions&); \
  template std::vector<Key<T>> fit_samples<T>(std::span<const double>, std::span<const T>, double, const FitOptions&);
TWEENFALL_FIT(double)
TWEENFALL_FIT(Vec2)
TWEENFALL_FIT(Vec3)
TWEENFALL_FIT(Vec4)
TWEENFALL_FIT(Color)
TWEENFALL_FIT(Quat)
#undef TWEENFALL_FIT

}  // namespace tweenfall
