#include "forces/formula_leaps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace tweenfall::forces {

namespace {

/// The time of a jump in between; infinity if the formula only changes fast.
double leap_in(const Expression& formula, double from, double to) {
  const auto before = [&](double time) { return formula.sample(time, Side::in).value; };
  const double first = formula.sample(from, Side::out).value, whole = std::abs(before(to) - first);
  while (true) {
    const double middle = from + 0.5 * (to - from);
    if (!(middle > from && middle < to)) break;
    const double left = std::abs(before(middle) - formula.sample(from, Side::out).value);
    const double right = std::abs(before(to) - formula.sample(middle, Side::out).value);
    const double here = std::abs(formula.sample(middle, Side::out).value - before(middle));
    if (here >= std::max({left, right, 0.25 * whole})) return middle;
    (left >= right ? to : from) = middle;
  }
  for (const double time : {from, to})
    if (std::abs(formula.sample(time, Side::out).value - before(time)) > 0.25 * whole) return time;
  return std::abs(before(to) - formula.sample(from, Side::out).value) > 0.25 * whole
             ? to
             : std::numeric_limits<double>::infinity();
}

}  // namespace

bool may_leap(const std::string& text) {
  const auto is_of_name = [](char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; };
  for (const std::string_view name : {"floor", "ceil", "round", "fract", "mod", "sign", "step", "atan2", "tan", "/"}) {
    for (std::size_t at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
      const bool begins = at == 0 || !is_of_name(text[at - 1]) || name == "/";
      if (begins && (name == "/" || at + name.size() == text.size() || !is_of_name(text[at + name.size()])))
        return true;
    }
  }
  return false;
}

bool leaps(const Expression& formula, double from, double to) {
  const Sample<double> before = formula.sample(from, Side::out), after = formula.sample(to, Side::in);
  const double change = std::abs(after.value - before.value);
  const double rate = std::max(std::abs(before.rate), std::abs(after.rate));
  const double rounding = 1e-12 * std::max(std::abs(before.value), std::abs(after.value));
  return std::isfinite(change) && std::isfinite(rate) && change > 4 * rate * (to - from) + rounding;
}

double next_leap(const Expression& formula, double from, double to) {
  constexpr int looks = 8;
  double begin = from;
  for (int i = 1; i <= looks && to > from; ++i) {
    const double end = i < looks ? from + (to - from) * i / looks : to;
    if (leaps(formula, begin, end))
      if (const double leap = leap_in(formula, begin, end); leap > from && leap <= to) return leap;
    // A jump exactly at the sample.
    const double here = formula.sample(end, Side::in).value, there = formula.sample(end, Side::out).value;
    if (here != there && std::isfinite(here) && std::isfinite(there)) return end;
    begin = end;
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace tweenfall::forces
