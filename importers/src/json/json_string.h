#pragma once

// Texts as JSON strings that can also be put inside a page.

#include <string>
#include <string_view>

namespace tweenfall::json {

/// A JSON string with its quotes; U+FFFD in place of bytes that are not UTF-8. `<` is escaped too, so that the text can
/// be put inside an HTML script element.
void append_string(std::string& out, std::string_view text);

}  // namespace tweenfall::json
