#pragma once

// What must never occur in anything that is written.

#include <stdexcept>
#include <string>
#include <string_view>

namespace tweenfall::attack {

/// Whether `text` is UTF-8 throughout.
[[nodiscard]] bool is_utf8(std::string_view text);

/// A NaN or an infinity in place of a number, or bytes that are not UTF-8; empty if there is none.
/// @param names  that the text may show; words in them are ignored
[[nodiscard]] std::string fault_of_text(const std::string& text, const std::string& names);

/// The same for JSON, whose names may be any words.
[[nodiscard]] std::string fault_of_json(const std::string& text);

/// What `judge` finds wrong with the output of `write`. Refusing in words (std::runtime_error,
/// std::invalid_argument) is right.
template <class Write, class Judge>
[[nodiscard]] std::string written(const Write& write, const Judge& judge) {
  try {
    return judge(write());
  } catch (const std::runtime_error&) {
    return {};
  } catch (const std::invalid_argument&) {
    return {};
  }
}

}  // namespace tweenfall::attack
