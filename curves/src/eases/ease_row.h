#pragma once

// The rows that turn words into eases. A row determines how an ease is read and printed, what the document's schema
// says about it, and what is suggested for a misspelled word. A new kind of ease is a file with its row, and an entry
// in ease_rows.cpp.

#include <tweenfall/curves/number_text.h>

#include <array>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "eases/ease_form.h"
#include "eases/shapes.h"
#include "text/quoted.h"

namespace tweenfall::eases {

/// A word with arguments, as they were written.
struct Call {
  std::string_view name;
  bool called = false;  ///< whether there are brackets
  std::vector<std::string_view> arguments{};

  /// @throws std::invalid_argument unless there are `least` to `most` arguments; `form` is how the call is written.
  void expect(std::size_t least, std::size_t most, std::string_view form) const;
  /// Argument number i, with or without its unit. @throws std::invalid_argument unless it is a finite number.
  [[nodiscard]] double number(std::size_t i, std::string_view unit = "") const;
};

/// An ease written as a word, as a call, or as both.
struct Row {
  std::string_view word;
  Ease (*plain)() = nullptr;  ///< the word by itself; null where it needs numbers
  std::string_view form{};    ///< the arguments of a call, "(count,jump)"; empty where there is no call
  Ease (*called)(const Call& call) = nullptr;  ///< @throws std::invalid_argument
};

using Numbers = std::array<double, 2>;

/// A number that a family takes, and its value in the plain word.
struct FamilyNumber {
  std::string_view name{};
  double plain = 0, least = 0, most = 0;
};

/// A shape with -in, -out and -in-out.
struct FamilyRow {
  std::string_view word;
  Pieces (*make)(const Numbers& numbers, Flow flow);
  std::array<FamilyNumber, 2> numbers{};  ///< those with a name are in use; a call states the first, or both
};

/// All of them, in the order of the documentation.
[[nodiscard]] std::span<const Row* const> rows() noexcept;
[[nodiscard]] std::span<const FamilyRow* const> families() noexcept;

/// The whole of a text as a finite number.
[[nodiscard]] std::optional<double> number_in(std::string_view text);
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// "name(1,0.5)", as it is read back.
[[nodiscard]] std::string call_text(std::string_view name, std::span<const double> numbers);

/// @throws std::invalid_argument unless the value lies in the range; `what` is "the period of elastic-in".
void check_range(const std::string& what, double value, double least, double most);

[[noreturn]] inline void refuse(const std::string& reason) {
  throw std::invalid_argument(reason);
}

}  // namespace tweenfall::eases
