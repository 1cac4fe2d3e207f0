#pragma once

// From one name to another by a pair of patterns.

#include <optional>
#include <string>
#include <string_view>

namespace tweenfall::pose {

/// How many `*` a pattern has.
[[nodiscard]] std::size_t stars_in(std::string_view pattern) noexcept;

/// The name made by `to` with the texts that the stars of `from` match in `name`, each as short as possible; empty
/// where `name` does not match, or the patterns have different numbers of stars.
[[nodiscard]] std::optional<std::string> renamed(std::string_view name, std::string_view from, std::string_view to);

}  // namespace tweenfall::pose
