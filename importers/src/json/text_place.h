#pragma once

// The line and column of a byte in a text, for messages.

#include <cstddef>
#include <string_view>

namespace tweenfall::json {

struct TextPlace {
  std::size_t line = 1, column = 1;  // in characters
};

[[nodiscard]] TextPlace place_in(std::string_view text, std::size_t offset);

// Number of characters in UTF-8 bytes.
[[nodiscard]] std::size_t characters_in(std::string_view utf8);

}  // namespace tweenfall::json
