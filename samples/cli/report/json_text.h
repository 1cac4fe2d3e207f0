#pragma once

/// Small pieces of JSON text, written directly: the command prints one flat shape per verb.

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::cli {

[[nodiscard]] std::string json_string(
    std::string_view text);  ///< quoted and escaped; bytes that are not UTF-8 replaced
/// The shortest text that reads back to the same bits; "null" when not finite, as JSON has nothing else.
[[nodiscard]] std::string json_number(double number);
[[nodiscard]] std::string json_array(std::span<const double> numbers);
[[nodiscard]] std::string json_array(const std::vector<std::string>& items);  ///< of texts that are already JSON

}  // namespace tweenfall::cli
