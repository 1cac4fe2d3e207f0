#pragma once

// Passes over JSON text that need no grammar: over spaces and comments, to a value's end, and once over the whole to
// count its values and to mend what a strict parser would stop at.

#include "json/json_tree.h"

#include <cstdint>

namespace tweenfall::json {

// The first byte from `at` on that is neither space nor comment. A comment without end is not passed over.
[[nodiscard]] std::size_t skip_space(std::string_view text, std::size_t at, bool comments);

// After a number, a word or what else stands there without spaces, quotes, brackets and commas.
[[nodiscard]] std::size_t word_end(std::string_view text, std::size_t at);

// After the value that begins at `at`, or the text's end where it has none.
[[nodiscard]] std::size_t value_end(std::string_view text, std::size_t at, bool comments);

struct Survey {
  std::size_t most_values = 1;  // as many as there can be
  std::string mended{};         // the text, as long as it was, where something had to be mended; else empty
  std::vector<Fault> faults{};
  std::vector<std::size_t> faulty_values{};  // their places, in order
};

// Mends commas before closing brackets, texts in single quotes, and numbers that are none or too large.
[[nodiscard]] Survey survey(std::string_view text, bool comments);

}  // namespace tweenfall::json
