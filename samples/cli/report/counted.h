#pragma once

/// Counts with the word for what is counted.

#include <string>
#include <string_view>

namespace tweenfall::cli {

/// "1 problem", "2 problems".
/// @param many  the word for counts other than one; if empty, `one` with an s
[[nodiscard]] std::string counted(std::size_t count, std::string_view one, std::string_view many = {});

}  // namespace tweenfall::cli
