#include "attack/written.h"

#include <nlohmann/json.hpp>

#include <cctype>

namespace tweenfall::attack {

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const auto first = static_cast<unsigned char>(text[i]);
    const std::size_t more = first < 0x80 ? 0 : first >= 0xc2 && first < 0xe0 ? 1 : (first & 0xf0) == 0xe0 ? 2 : 3;
    if (first >= 0x80 && (first < 0xc2 || first > 0xf4)) return false;
    if (i + more >= text.size()) return false;
    std::uint32_t code = more == 0 ? first : first & (0x3f >> more);
    for (std::size_t k = 1; k <= more; ++k) {
      const auto next = static_cast<unsigned char>(text[i + k]);
      if ((next & 0xc0) != 0x80) return false;
      code = code << 6 | (next & 0x3f);
    }
    if (more == 2 && (code < 0x800 || (code >= 0xd800 && code < 0xe000))) return false;
    if (more == 3 && (code < 0x10000 || code > 0x10ffff)) return false;
    i += more + 1;
  }
  return true;
}

namespace {

/// Where `word` occurs as a word of its own, including in attributes of a picture; npos if nowhere.
std::size_t place_of_word(std::string_view word, const std::string& text) {
  const auto beside = [&](std::size_t at) {
    return at < text.size() && (std::isalnum(static_cast<unsigned char>(text[at])) || text[at] == '_');
  };
  for (std::size_t i = text.find(word); i != std::string::npos; i = text.find(word, i + 1)) {
    // "joint-inf" is a name.
    const std::size_t begin = i > 0 && text[i - 1] == '-' ? i - 1 : i;
    if (!(begin > 0 && beside(begin - 1)) && !beside(i + word.size())) return i;
  }
  return std::string::npos;
}

}  // namespace

std::string fault_of_text(const std::string& text, const std::string& names) {
  if (!is_utf8(text)) return "not UTF-8";
  for (const std::string_view word : {"nan", "NaN", "inf", "Infinity"}) {
    const std::size_t at = place_of_word(word, text);
    if (at == std::string::npos || names.find(word) != std::string::npos) continue;
    const std::size_t from = at < 40 ? 0 : at - 40;
    return "\"" + std::string(word) + "\" where a number belongs, after \"" + text.substr(from, at - from) + "\"";
  }
  return {};
}

std::string fault_of_json(const std::string& text) {
  if (!is_utf8(text)) return "not UTF-8";
  return nlohmann::json::accept(text) ? "" : "not JSON, as where a NaN stands";
}

}  // namespace tweenfall::attack
