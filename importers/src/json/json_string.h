#pragma once

// Texts as JSON strings that may also stand inside a page.

#include <string>

namespace tweenfall {

/// A JSON string with its quotes. `<` is escaped too, so that the text may stand inside an HTML script element.
void append_json_string(std::string& out, const std::string& text);

}  // namespace tweenfall
