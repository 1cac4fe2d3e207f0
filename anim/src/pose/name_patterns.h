#pragma once

// From one name to another by a pair of patterns.

#include <optional>
#include <string>
#include <string_view>

namespace tweenfall::pose {

/// How many `*` a pattern has.
[[nodiscard]] std::size_t stars_in(std::string_view pattern) noexcept;

/// The name that `to` makes of what the stars of `from` stand for in `name`, each for as little as can be; nothing
/// where `name` does not match, or the patterns have not as many stars.
[[nodiscard]] std::optional<std::string> renamed(std::string_view name, std::string_view from, std::string_view to);

}  // namespace tweenfall::pose
