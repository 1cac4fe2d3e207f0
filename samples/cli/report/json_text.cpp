#include "report/json_text.h"

#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/shown_text.h>

#include <cmath>

namespace tweenfall::cli {

std::string json_string(std::string_view text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string out = "\"";
  while (!text.empty()) {
    const Character next = first_character(text);
    if (!next.is_valid)
      out += "\\ufffd";
    else if (next.code == '"' || next.code == '\\')
      (out += '\\') += text[0];
    else if (next.code == '\n')
      out += "\\n";
    else if (next.code == '\t')
      out += "\\t";
    else if (next.code < 0x20)
      ((out += "\\u00") += digits[next.code >> 4]) += digits[next.code & 15];
    else
      out += text.substr(0, next.length);
    text.remove_prefix(next.length);
  }
  return out + '"';
}

std::string json_number(double number) {
  return std::isfinite(number) ? number_text(number) : "null";
}

std::string json_array(std::span<const double> numbers) {
  std::string out = "[";
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (i > 0) out += ',';
    out += json_number(numbers[i]);
  }
  return out + "]";
}

std::string json_array(const std::vector<std::string>& items) {
  std::string out = "[";
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i > 0) out += ',';
    out += items[i];
  }
  return out + "]";
}

}  // namespace tweenfall::cli
