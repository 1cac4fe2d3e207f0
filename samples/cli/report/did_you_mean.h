#pragma once

/// What a message about a mistyped name says of the right ones.

#include <span>
#include <string>
#include <string_view>

namespace tweenfall::cli {

/// "; did you mean X?", or nothing when no name is near.
[[nodiscard]] std::string did_you_mean(std::string_view typed, std::span<const std::string> names);

/// "a, b and c"; the first twelve and how many more there are when the list is long.
[[nodiscard]] std::string listed(std::span<const std::string> names);

/// "a, b or c", where one of them is to be chosen; of a long list the end as above.
[[nodiscard]] std::string one_of(std::span<const std::string> names);

}  // namespace tweenfall::cli
