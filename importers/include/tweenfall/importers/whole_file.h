#pragma once

/// Files that are there whole or not at all.

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>

namespace tweenfall {

/// Writes `content` beside `file` under a name that nobody can foresee and renames it into place, so that a reader
/// never sees half of it and a failure leaves what was there. A file that is replaced keeps its permissions, which hold
/// from the first byte on; a link stays a link; a pipe or a device is written to directly. A file without write
/// permission is refused, for root too. Signals that end a process (interrupt, terminate, hang up, quit) take effect
/// when the file is whole or its beginning is removed, which is soon; so that one finds this thread, others should
/// block them.
/// @throws std::runtime_error with the file and the system's reason.
void write_whole_file(const std::filesystem::path& file, std::string_view content);

/// All that a stream, which may be a pipe or a device without end, has to give; nothing when it is more than `most`
/// bytes, of which no more than that are read.
[[nodiscard]] std::optional<std::string> read_within(std::istream& stream, std::size_t most);

}  // namespace tweenfall
