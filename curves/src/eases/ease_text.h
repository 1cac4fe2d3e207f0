#pragma once

// Writing the calls of eases as they are read back.

#include <tweenfall/curves/number_text.h>

#include <initializer_list>
#include <string>

namespace tweenfall {

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
