#pragma once

#include <string>
#include <string_view>

namespace tweenfall::words {

/// A word as messages show it, between double quotes.
inline std::string quoted(std::string_view word) {
  return "\"" + std::string(word) + "\"";
}

}  // namespace tweenfall::words
