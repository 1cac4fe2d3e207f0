#pragma once

/// Files that are written whole or not at all.

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace tweenfall {

/// Writes `content` beside `file` under an unpredictable name and renames it into place, so that a reader never sees
/// half of it and a failure leaves the old file. A file that is replaced keeps its permissions, which apply from the
/// first byte on; a link stays a link; a pipe or a device is written to directly. A file without write permission is
/// refused, for root too. Signals that end a process (interrupt, terminate, hang up, quit) take effect once the file is
/// complete or its partial copy is removed, which is soon; to make sure that this thread receives them, other threads
/// should block them.
/// @throws std::runtime_error with the file and the system's reason.
void write_whole_file(const std::filesystem::path& file, std::string_view content);

/// The whole content of a stream, which may be a pipe or an endless device; empty when it has more than `most` bytes,
/// of which at most one more is read.
[[nodiscard]] std::optional<std::string> read_within(std::istream& stream, std::size_t most);

}  // namespace tweenfall
