#pragma once

/// Suggestions for messages about a mistyped name.

#include <span>
#include <string>
#include <string_view>

namespace tweenfall::cli {

/// "; did you mean X?", or empty if no name is near.
[[nodiscard]] std::string did_you_mean(std::string_view typed, std::span<const std::string> names);

/// "a, b and c"; of a long list, the first twelve and how many more there are.
[[nodiscard]] std::string listed(std::span<const std::string> names);

/// "a, b or c", if one of them is to be chosen; a long list ends as above.
[[nodiscard]] std::string one_of(std::span<const std::string> names);

}  // namespace tweenfall::cli
