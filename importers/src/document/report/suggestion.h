#pragma once

// What a message about an unknown name says of the known ones.

#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::document {

// `; did you mean "drive"?`, or `; available: "a", "b"` when none is near (up to 24), or nothing without names.
[[nodiscard]] std::string suggestion(std::string_view wrong, const std::vector<std::string>& names);

}  // namespace tweenfall::document
