#pragma once

// "did you mean": the valid name nearest to one that is not.

#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::document {

// Edits (a character added, dropped or changed, two neighbors swapped) that lead from `a` to `b`. Optimal string
// alignment, a restriction of Damerau, "A technique for computer detection and correction of spelling errors", 1964.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// The name with the fewest edits to `wrong`, the first of several; empty when all are too far to be meant.
[[nodiscard]] std::string nearest_name(std::string_view wrong, const std::vector<std::string>& names);

// `; did you mean "drive"?`, or `; available: "a", "b"` when none is near (up to 24), or nothing without names.
[[nodiscard]] std::string suggestion(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace tweenfall::document
