#pragma once

#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/leaps.h>

#include <span>
#include <vector>

namespace tweenfall::forces {

/// A formula along one number, with its rate by it.
using Along = NumberOverTime;

/// The parts of formulas that leap from one value to another by the time alone, whatever else the formulas read.
/// @param time       the variable that is the time
/// @param variables  how many there are, with it
[[nodiscard]] std::vector<Expression> leaping_parts(std::span<const Expression> formulas, std::size_t time,
                                                    std::size_t variables);
/// Such a part along the time. @param part  outlives it
[[nodiscard]] Along by_time(const Expression& part, std::size_t time);

using tweenfall::leaps;
using tweenfall::next_leap;

/// When to ask in place of an instant that lies beside a leap, on the side that is asked for.
/// @param parts  that leap by the time alone
[[nodiscard]] double beside_leaps(std::span<const Expression> parts, std::size_t time_variable, double time, Side side);

/// Times nearer to a leap or a key than this, s, are its own: what is summed up from steps is a little off.
constexpr double at_a_leap = 1e-9;

}  // namespace tweenfall::forces
