#pragma once

// The bytes of a file, when it is a plain file of reasonable size.

#include <filesystem>
#include <optional>
#include <string>

namespace tweenfall {

/// The file's content, or nothing and the reason. Never blocks on a device or pipe.
[[nodiscard]] std::optional<std::string> model_bytes(const std::filesystem::path& file, std::string& reason);

}  // namespace tweenfall
