#pragma once

// Where a byte of a text stands, for people.

#include <cstddef>
#include <string_view>

namespace tweenfall::json {

struct TextPlace {
  std::size_t line = 1, column = 1;  // in characters
};

[[nodiscard]] TextPlace place_in(std::string_view text, std::size_t offset);

// How many characters bytes of UTF-8 are.
[[nodiscard]] std::size_t characters_in(std::string_view utf8);

}  // namespace tweenfall::json
