#include "forces/formula_leaps.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tweenfall::forces {

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
