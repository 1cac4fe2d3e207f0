#pragma once

/// Texts that others wrote, names above all, made fit for where they are shown: pictures, pages, files, terminals.
/// What a place cannot hold is replaced by U+FFFD or spelled out, never passed on.

#include <string>
#include <string_view>

namespace tweenfall {

/// A character at the beginning of a text.
struct Character {
  char32_t code = 0;       ///< U+FFFD where `is_valid` is false
  std::size_t length = 1;  ///< bytes; 1 where `is_valid` is false
  bool is_valid = true;    ///< the bytes are UTF-8 as RFC 3629 has it
};

/// @param text  not empty
[[nodiscard]] Character first_character(std::string_view text) noexcept;

/// UTF-8: U+FFFD in place of each byte that is none.
[[nodiscard]] std::string utf8_text(std::string_view text);

/// UTF-8 as it is; what is not, as old programs wrote it: each byte is the character of that number, ISO 8859-1.
[[nodiscard]] std::string utf8_or_latin1(std::string_view text);

/// As content or as an attribute's value in XML and HTML: markup as entities, U+FFFD in place of control characters
/// (save tab and line ends) and of noncharacters, which XML forbids or discourages.
[[nodiscard]] std::string markup_text(std::string_view text);

/// For terminals: on one line, with everything spelled out that would drive the terminal, hide or reorder text
/// (control characters, formatting that is not seen, direction of writing): "\u001b". Bytes that are not UTF-8 are
/// "\xff".
[[nodiscard]] std::string terminal_text(std::string_view text);

/// The same for several lines, whose ends stay.
[[nodiscard]] std::string terminal_lines(std::string_view text);

}  // namespace tweenfall
