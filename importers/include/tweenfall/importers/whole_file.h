#pragma once

/// Files that are there whole or not at all.

#include <filesystem>
#include <string_view>

namespace tweenfall {

/// Writes `content` beside `file` under a name of its own and renames it into place, so that a reader never sees half
/// of it and a failure leaves what was there. A file that is replaced keeps its permissions, a link stays a link, and
/// a pipe or a device is written to directly.
/// @throws std::runtime_error with the file and the system's reason.
void write_whole_file(const std::filesystem::path& file, std::string_view content);

}  // namespace tweenfall
