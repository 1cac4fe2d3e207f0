#pragma once

// Writing the names of easings: numbers in the shortest form that reads back to the same bits.

#include <charconv>
#include <initializer_list>
#include <string>

namespace tweenfall {

inline std::string number_text(double v) {
  char buffer[32];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, v).ptr;
  return std::string(buffer, end);
}

inline std::string call_text(const std::string& name, std::initializer_list<double> numbers) {
  std::string text = name + "(";
  bool first = true;
  for (const double v : numbers) {
    if (!first) text += ",";
    first = false;
    text += number_text(v);
  }
  return text + ")";
}

}  // namespace tweenfall
