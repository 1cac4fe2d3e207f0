#pragma once

// Times as people write them: "12f", "50%", "+0.25".

#include <optional>
#include <string_view>

namespace tweenfall::document {

struct TimeInWords {
  enum class Unit { seconds, frames, percent };
  double amount = 0;
  Unit unit = Unit::seconds;
  bool after_previous = false;  // a '+' before it
};

[[nodiscard]] std::optional<TimeInWords> time_in_words(std::string_view text);

}  // namespace tweenfall::document
