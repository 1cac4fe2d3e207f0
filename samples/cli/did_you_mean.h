#pragma once

/// The name that was probably meant by a mistyped one.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace tweenfall::cli {

/// The name with the fewest edits from `typed`; none when all are far from it.
[[nodiscard]] std::optional<std::string> nearest_name(std::string_view typed, std::span<const std::string> names);

/// "; did you mean X?", or nothing when no name is near.
[[nodiscard]] std::string did_you_mean(std::string_view typed, std::span<const std::string> names);

/// "a, b and c"; the first ten and how many more there are when the list is long.
[[nodiscard]] std::string listed(std::span<const std::string> names);

}  // namespace tweenfall::cli
