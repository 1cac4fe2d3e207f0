#pragma once

// The checks for the data of every spline; errors name the index and the value.

#include <cmath>
#include <span>
#include <stdexcept>
#include <string>

#include "curve/components.h"

namespace tweenfall::splines {

[[noreturn]] inline void refuse_spline(const std::string& what) {
  throw std::invalid_argument("a spline " + what);
}

inline void check_spline_times(std::span<const double> times) {
  if (times.size() < 2) refuse_spline("needs two or more times; " + std::to_string(times.size()) + " were given");
  bool increase = std::isfinite(times.front()) && std::isfinite(times.back());
  for (std::size_t i = 1; i < times.size(); ++i) increase &= times[i] > times[i - 1];
  if (increase) return;
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (!std::isfinite(times[i]))
      refuse_spline("has the non-finite time " + spans::text_of(times[i]) + " at " + std::to_string(i));
    if (i > 0 && !(times[i] > times[i - 1]))
      refuse_spline("needs increasing times; number " + std::to_string(i) + ", " + spans::text_of(times[i]) +
                    " s, does not come after " + spans::text_of(times[i - 1]) + " s");
  }
}

/// @param what  names the list, as "rate"
template <class T>
void check_spline_list(std::span<const T> list, std::size_t expected, const char* what) {
  if (list.size() != expected)
    refuse_spline("needs " + std::to_string(expected) + " " + what + "s here; " + std::to_string(list.size()) +
                  " were given");
  for (std::size_t i = 0; i < list.size(); ++i)
    if (!spans::all_finite(list[i]))
      refuse_spline("has the non-finite " + std::string(what) + " " + spans::text_of(list[i]) + " at " +
                    std::to_string(i));
}

}  // namespace tweenfall::splines
