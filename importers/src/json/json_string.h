#pragma once

// Texts as JSON strings that may also stand inside a page.

#include <string>
#include <string_view>

namespace tweenfall {

/// A JSON string with its quotes; U+FFFD in place of bytes that are not UTF-8. `<` is escaped too, so that the text may
/// stand inside an HTML script element.
void append_json_string(std::string& out, std::string_view text);

}  // namespace tweenfall
