#pragma once

/// Files that the command writes: completely or not at all, "-" for stdout, never over the file it read.

#include <span>
#include <string>
#include <string_view>

namespace tweenfall::cli {

/// @throws UsageError if `output` has none of the endings (unless it is "-"), or is the file that was read.
void require_output(const std::string& output, const std::string& input, std::span<const std::string> endings);

/// Writes a new file and puts it in the place of `file`; "-" prints. @throws std::runtime_error naming the file.
void write_output(const std::string& file, std::string_view content);

/// Prints the line that says what was written and what it shows; on stderr if stdout holds the result itself.
void say_written(const std::string& file, std::string_view shows, bool stdout_is_taken = false);

}  // namespace tweenfall::cli
