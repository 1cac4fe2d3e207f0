#pragma once

// Names as text that can be shown: UTF-8 whatever the file holds.

#include <string>
#include <string_view>

namespace tweenfall {

/// `bytes` where they are UTF-8; else each byte as the character that Windows-1252 has for it, of which Latin-1 is a
/// part; the five bytes that it leaves open become U+FFFD.
[[nodiscard]] std::string readable_text(std::string_view bytes);

/// The place of the first byte that is no UTF-8, or npos. Overlong forms and surrogates are none.
[[nodiscard]] std::size_t first_not_utf8(std::string_view bytes) noexcept;

}  // namespace tweenfall
