#include "json/json_string.h"

#include <tweenfall/importers/shown_text.h>

namespace tweenfall::json {

void append_string(std::string& out, std::string_view text) {
  static constexpr char hex[] = "0123456789abcdef";
  out += '"';
  while (!text.empty()) {
    const Character next = first_character(text);
    const char32_t code = next.code;
    if (code == '"' || code == '\\')
      (out += '\\') += text[0];
    else if (code == '\n')
      out += "\\n";
    else if (code < 0x20 || code == '<' || code == 0x7f)
      ((out += "\\u00") += hex[code >> 4]) += hex[code & 15];
    else
      out += next.is_valid ? text.substr(0, next.length) : "\xef\xbf\xbd";
    text.remove_prefix(next.length);
  }
  out += '"';
}

}  // namespace tweenfall::json
