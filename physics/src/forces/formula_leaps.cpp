#include "forces/formula_leaps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tweenfall::forces {

namespace {

constexpr double no_leap = std::numeric_limits<double>::infinity();

/// Where a formula that leaps in between does so; infinity where it only goes there fast.
double leap_in(const Along& formula, double from, double to) {
  const auto before = [&](double place) { return formula(place, Side::in).value; };
  const auto after = [&](double place) { return formula(place, Side::out).value; };
  const double whole = std::abs(before(to) - after(from));
  while (true) {
    const double middle = from + 0.5 * (to - from);
    if (!(middle > from && middle < to)) break;
    const double left = std::abs(before(middle) - after(from));
    const double right = std::abs(before(to) - after(middle));
    const double here = std::abs(after(middle) - before(middle));
    if (here >= std::max({left, right, 0.25 * whole})) return middle;
    (left >= right ? to : from) = middle;
  }
  for (const double place : {from, to})
    if (std::abs(after(place) - before(place)) > 0.25 * whole) return place;
  return std::abs(before(to) - after(from)) > 0.25 * whole ? to : no_leap;
}

}  // namespace

std::vector<Expression> leaping_parts(std::span<const Expression> formulas, std::size_t time, std::size_t variables) {
  std::vector<Expression> parts;
  for (const Expression& formula : formulas)
    for (const Expression& part : formula.jumping_parts()) {
      bool by_time_alone = part.reads(time);
      for (std::size_t i = 0; i < variables; ++i) by_time_alone = by_time_alone && (i == time || !part.reads(i));
      if (by_time_alone) parts.push_back(part);
    }
  return parts;
}

Along by_time(const Expression& part, std::size_t time) {
  return [&part, time](double t, Side side) {
    constexpr std::size_t most = 8;
    std::array<Sample<double>, most> at{};
    at[time] = {t, 1, 0};
    return part.sample(std::span<const Sample<double>>(at.data(), time + 1), side);
  };
}

bool leaps(const Along& formula, double from, double to) {
  const Sample<double> before = formula(from, Side::out), after = formula(to, Side::in);
  const double change = std::abs(after.value - before.value);
  const double rate = std::max(std::abs(before.rate), std::abs(after.rate));
  const double rounding = 1e-12 * std::max(std::abs(before.value), std::abs(after.value));
  return std::isfinite(change) && std::isfinite(rate) && change > 4 * rate * (to - from) + rounding;
}

double next_leap(const Along& formula, double from, double to) {
  constexpr int looks = 8;
  double begin = from;
  for (int i = 1; i <= looks && to > from; ++i) {
    const double end = i < looks ? from + (to - from) * i / looks : to;
    double leap = no_leap;
    // Of several the first: what lies before the one that was found is looked at again.
    for (double last = end; leaps(formula, begin, last);) {
      const double found = leap_in(formula, begin, last);
      if (!(found > from && found <= to && found < leap)) break;
      last = leap = found;
    }
    if (leap <= to) return leap;
    // One that falls on the look itself.
    const double here = formula(end, Side::in).value, there = formula(end, Side::out).value;
    if (here != there && std::isfinite(here) && std::isfinite(there)) return end;
    begin = end;
  }
  return no_leap;
}

double beside_leaps(std::span<const Expression> parts, std::size_t time_variable, double time, Side side) {
  const double beside = side == Side::in ? time - at_a_leap : time + at_a_leap;
  for (const Expression& part : parts) {
    const Along along = by_time(part, time_variable);
    if (along(time, Side::in).value != along(time, Side::out).value ||
        leaps(along, std::min(time, beside), std::max(time, beside)))
      return beside;
  }
  return time;
}

}  // namespace tweenfall::forces
