#include <tweenfall/importers/shown_text.h>

#include <algorithm>
#include <utility>

namespace tweenfall {

namespace shown {

namespace {

constexpr std::string_view replacement = "\xef\xbf\xbd";

bool is_control(char32_t code) {
  return code < 0x20 || (code >= 0x7f && code < 0xa0);
}

/// Code points that the Unicode Standard reserves permanently (section 23.7).
bool is_noncharacter(char32_t code) {
  return (code & 0xfffe) == 0xfffe || (code >= 0xfdd0 && code <= 0xfdef);
}

/// Invisible characters that end lines, hide letters or change the direction of writing: Unicode's Default_Ignorable,
/// Bidi_Control and line separators, except variation selectors, which belong to the character before them.
bool is_unseen(char32_t code) {
  static constexpr std::pair<char32_t, char32_t> unseen[] = {
      {0xad, 0xad},     {0x34f, 0x34f},   {0x61c, 0x61c},   {0x115f, 0x1160},  {0x17b4, 0x17b5},
      {0x180e, 0x180e}, {0x200b, 0x200f}, {0x2028, 0x202e}, {0x2060, 0x206f},  {0x3164, 0x3164},
      {0xfeff, 0xfeff}, {0xffa0, 0xffa0}, {0xfff0, 0xfffb}, {0xe0000, 0xe0fff}};
  return std::any_of(std::begin(unseen), std::end(unseen),
                     [&](const auto& range) { return code >= range.first && code <= range.second; });
}

std::string in_hexadecimal(char32_t number, std::size_t digits) {
  std::string out;
  for (; number != 0 || out.size() < digits; number /= 16) out.insert(out.begin(), "0123456789abcdef"[number % 16]);
  return out;
}

std::string spelled_out(char32_t code) {
  return code > 0xffff ? "\\u{" + in_hexadecimal(code, 5) + "}" : "\\u" + in_hexadecimal(code, 4);
}

std::string for_terminal(std::string_view text, bool keeps_lines) {
  std::string out;
  while (!text.empty()) {
    const Character next = first_character(text);
    const bool stays = keeps_lines && next.code == '\n';
    if (!next.is_valid)
      out += "\\x" + in_hexadecimal(static_cast<unsigned char>(text[0]), 2);
    else if (!stays && (is_control(next.code) || is_noncharacter(next.code) || is_unseen(next.code)))
      out += spelled_out(next.code);
    else
      out += text.substr(0, next.length);
    text.remove_prefix(next.length);
  }
  return out;
}

}  // namespace

}  // namespace shown

Character first_character(std::string_view text) noexcept {
  constexpr Character none{0xfffd, 1, false};
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return {first, 1, true};
  const std::size_t length = first >> 5 == 6 ? 2 : first >> 4 == 14 ? 3 : first >> 3 == 30 ? 4 : 0;
  if (length == 0 || length > text.size()) return none;
  char32_t code = first & (0x7fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return none;
    code = code << 6 | (byte(i) & 0x3f);
  }
  // Forms longer than needed, halves of surrogate pairs, and numbers past the last character.
  const char32_t least = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
  if (code < least || (code >= 0xd800 && code <= 0xdfff) || code > 0x10ffff) return none;
  return {code, length, true};
}

std::string utf8_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character next = first_character(text);
    out += next.is_valid ? text.substr(0, next.length) : shown::replacement;
    text.remove_prefix(next.length);
  }
  return out;
}

std::string utf8_or_latin1(std::string_view text) {
  std::string out = utf8_text(text);
  if (out == text) return out;
  out.clear();
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      out += c;
    } else {
      out += static_cast<char>(0xc0 | byte >> 6);
      out += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return out;
}

std::string markup_text(std::string_view text) {
  std::string out;
  while (!text.empty()) {
    const Character next = first_character(text);
    const char32_t code = next.code;
    const bool is_blank = code == '\t' || code == '\n';
    if (code == '&')
      out += "&amp;";
    else if (code == '<')
      out += "&lt;";
    else if (code == '>')  // it ends a CDATA section
      out += "&gt;";
    else if (code == '"')
      out += "&quot;";
    else if (code == '\r')  // which readers would take for a line end
      out += "&#13;";
    else if (!next.is_valid || (shown::is_control(code) && !is_blank) || shown::is_noncharacter(code))
      out += shown::replacement;
    else
      out += text.substr(0, next.length);
    text.remove_prefix(next.length);
  }
  return out;
}

std::string terminal_text(std::string_view text) {
  return shown::for_terminal(text, false);
}

std::string terminal_lines(std::string_view text) {
  return shown::for_terminal(text, true);
}

}  // namespace tweenfall
