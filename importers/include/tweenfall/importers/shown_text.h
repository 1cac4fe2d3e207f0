#pragma once

/// Makes texts written by others, above all names, safe to show in pictures, pages, files and terminals. Characters
/// that cannot be shown there are replaced by U+FFFD or spelled out, never passed on.

#include <string>
#include <string_view>

namespace tweenfall {

/// A character at the beginning of a text.
struct Character {
  char32_t code = 0;       ///< U+FFFD where `is_valid` is false
  std::size_t length = 1;  ///< bytes; 1 where `is_valid` is false
  bool is_valid = true;    ///< the bytes are UTF-8 by RFC 3629
};

/// @param text  not empty
[[nodiscard]] Character first_character(std::string_view text) noexcept;

/// Valid UTF-8, with U+FFFD in place of each invalid byte.
[[nodiscard]] std::string utf8_text(std::string_view text);

/// UTF-8 unchanged; any other text, as of old programs, read as ISO 8859-1: each byte is the character of that number.
[[nodiscard]] std::string utf8_or_latin1(std::string_view text);

/// For content or an attribute's value in XML and HTML: markup becomes entities, and control characters (except tab and
/// line ends) and noncharacters, which XML forbids or discourages, become U+FFFD.
[[nodiscard]] std::string markup_text(std::string_view text);

/// For terminals: on one line, with everything spelled out that could control the terminal, or hide or reorder
/// text (control characters, invisible formatting, direction of writing): "\u001b". Bytes that are not UTF-8 are
/// "\xff".
[[nodiscard]] std::string terminal_text(std::string_view text);

/// The same for several lines; line ends stay.
[[nodiscard]] std::string terminal_lines(std::string_view text);

}  // namespace tweenfall
