#pragma once

// Units: which one a field takes, and what a number in another one is in it.

#include <optional>
#include <string_view>

namespace tweenfall::document {

// The unit that a field's help names, as "of the strut, N/m"; or else what it expects, as "a frequency above 0 Hz";
// empty where neither does.
[[nodiscard]] std::string_view unit_told(std::string_view help, std::string_view what);

// What a number of `given`, such as "ft" or "km/h", is multiplied by to be in `unit`; none where that is not sure.
[[nodiscard]] std::optional<double> factor_to(std::string_view unit, std::string_view given);

}  // namespace tweenfall::document
