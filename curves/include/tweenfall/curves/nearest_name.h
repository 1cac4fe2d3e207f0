#pragma once

/// "did you mean": the valid name nearest to one that is not.

#include <span>
#include <string>
#include <string_view>

namespace tweenfall {

/// Number of edits that lead from `a` to `b`: a character added, dropped or changed, two neighbors
/// swapped. Capitals count as lower case, and '-' and ' ' as '_'. Source: optimal string alignment, a
/// restriction of Damerau, "A technique for computer detection and correction of spelling errors",
/// 1964.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name with the fewest edits to `wrong`, the first of several: at most one edit for each three characters of
/// `wrong`, but at least one. Where none is that near, the first name that begins with `wrong` (if that has two
/// characters or more); else empty. Looks at the first 5000 names, and at none longer than 64 characters.
[[nodiscard]] std::string nearest_name(std::string_view wrong, std::span<const std::string> names);

}  // namespace tweenfall
