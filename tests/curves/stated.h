#pragma once

// Each file's conventions state the required accuracy in words: these are the numbers in those words.

#include "support.h"

#include <cctype>

namespace tweenfall::test {

/// The first number in `conventions[member]` after the words `after`, as in "1e-10 relative; root times 1e-7 of span".
inline double stated(const nlohmann::json& file, const std::string& member, const std::string& after = "") {
  const std::string text = file.at("conventions").at(member);
  std::size_t at = text.find(after);
  REQUIRE_MESSAGE(at != std::string::npos, "\"" << after << "\" is not in the conventions' " << member << ": " << text);
  at += after.size();
  while (at < text.size() && std::isdigit(static_cast<unsigned char>(text[at])) == 0) ++at;
  REQUIRE_MESSAGE(at < text.size(), "no number after \"" << after << "\" in " << text);
  return std::strtod(text.c_str() + at, nullptr);
}

/// The first number of the file's tolerance.
inline double tolerance(const nlohmann::json& file) {
  return stated(file, "tolerance");
}

/// The largest absolute number in a list of numbers or of lists; null counts for nothing.
inline double largest(const nlohmann::json& list) {
  double top = 0;
  for (const auto& part : list)
    if (part.is_array())
      top = std::max(top, largest(part));
    else if (part.is_number())
      top = std::max(top, std::abs(part.get<double>()));
  return top;
}

}  // namespace tweenfall::test
