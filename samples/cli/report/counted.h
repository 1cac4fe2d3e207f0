#pragma once

/// Counts with the word for what is counted.

#include <string>
#include <string_view>

namespace tweenfall::cli {

/// "1 problem", "2 problems".
/// @param many  the word for other counts than one; `one` with an s when empty
[[nodiscard]] std::string counted(std::size_t count, std::string_view one, std::string_view many = {});

}  // namespace tweenfall::cli
