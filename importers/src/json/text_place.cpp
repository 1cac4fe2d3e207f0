#include "json/text_place.h"

#include <algorithm>

namespace tweenfall::json {

std::size_t characters_in(std::string_view utf8) {
  return static_cast<std::size_t>(
      std::count_if(utf8.begin(), utf8.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}

TextPlace place_in(std::string_view text, std::size_t offset) {
  const std::size_t mark = text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0;
  const std::string_view before = text.substr(0, offset);
  const std::size_t line_end = before.rfind('\n');
  const std::size_t line_start = line_end == std::string_view::npos ? std::min(mark, before.size()) : line_end + 1;
  return {1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')),
          1 + characters_in(before.substr(line_start))};
}

}  // namespace tweenfall::json
