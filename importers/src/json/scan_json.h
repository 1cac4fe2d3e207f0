#pragma once

// Scans of JSON text that need no grammar: over spaces and comments, to a value's end, and once over the whole to count
// its values and to repair what would stop a strict parser.

#include "json/json_tree.h"

#include <cstdint>

namespace tweenfall::json {

// The first byte from `at` on that is neither space nor comment. A comment without end is not skipped.
[[nodiscard]] std::size_t skip_space(std::string_view text, std::size_t at, bool comments);

// The end of a number, a word or anything else without spaces, quotes, brackets and commas.
[[nodiscard]] std::size_t word_end(std::string_view text, std::size_t at);

// The end of the value that begins at `at`, or of the text if it has no end.
[[nodiscard]] std::size_t value_end(std::string_view text, std::size_t at, bool comments);

struct Survey {
  std::size_t most_values = 1;  // upper bound
  std::string mended{};         // the text, of the same length, where something had to be repaired; else empty
  std::vector<Fault> faults{};
  std::vector<std::size_t> faulty_values{};  // their places, in order
};

// Repairs commas before closing brackets, texts in single quotes, and numbers that are invalid or too large.
[[nodiscard]] Survey survey(std::string_view text, bool comments);

}  // namespace tweenfall::json
