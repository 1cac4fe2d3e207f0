#pragma once

// The bytes of a file, if it is a regular file of reasonable size.

#include <filesystem>
#include <optional>
#include <string>

namespace tweenfall::models {

/// The file's content, or empty and the reason. Never blocks on a device or pipe.
[[nodiscard]] std::optional<std::string> model_bytes(const std::filesystem::path& file, std::string& reason);

/// Whether `below`, a path relative to `folder`, leads outside it: by its parts, or by a link on the way.
[[nodiscard]] bool leads_out_of(const std::filesystem::path& folder, const std::filesystem::path& below);

}  // namespace tweenfall::models
