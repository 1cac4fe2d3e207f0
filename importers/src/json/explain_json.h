#pragma once

// Explains what is wrong where a parser stopped, and what would be right.

#include "json/json_tree.h"

#include <optional>

namespace tweenfall::json {

// The point at which the parser stopped.
struct Stop {
  std::size_t at = 0;  // after everything valid
  enum class After { nothing, open_object, open_list, name, value_in_object, value_in_list, whole };
  After after = After::nothing;
  std::optional<std::size_t> open{};  // the innermost bracket that is not closed
  std::string_view name{};            // the last one, after a name
};

[[nodiscard]] Fault explained(std::string_view text, const Stop& stop, bool comments);

}  // namespace tweenfall::json
