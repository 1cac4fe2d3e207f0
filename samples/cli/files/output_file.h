#pragma once

/// Files that the command writes: whole or not at all, "-" for stdout, never over what it read.

#include <span>
#include <string>
#include <string_view>

namespace tweenfall::cli {

/// @throws UsageError when `output` has none of the endings (unless it is "-"), or is the file that was read.
void require_output(const std::string& output, const std::string& input, std::span<const std::string> endings);

/// Writes a new file beside `file` and puts it in its place; "-" prints. @throws std::runtime_error naming the file.
void write_output(const std::string& file, std::string_view content);

/// The line that says what was written and what it shows; on stderr when stdout holds the result itself.
void say_written(const std::string& file, std::string_view shows, bool stdout_is_taken = false);

}  // namespace tweenfall::cli
