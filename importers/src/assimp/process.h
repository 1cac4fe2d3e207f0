#pragma once

// Starts a program, reads its output, and ends it in time.

#include <filesystem>
#include <string>
#include <vector>

namespace tweenfall::assimp {

struct Heard {
  std::string said;          ///< what it wrote to its standard output
  bool in_time = true;       ///< false if it was ended because it took too long
  bool too_much = false;     ///< it was ended because it wrote more than allowed
  std::string how_it_ended;  ///< empty for exit code 0
};

/// Whether this system can start programs at all.
[[nodiscard]] bool can_start_programs() noexcept;

/// Runs a program and waits only for it. It gets nothing from this process but its arguments, an empty standard input,
/// and a pipe for its standard output; what it writes to standard error is lost.
/// @param seconds time after which it is ended
/// @param most greatest number of bytes read from it
/// @throws std::runtime_error when it cannot be started
[[nodiscard]] Heard hear(const std::filesystem::path& program, const std::vector<std::string>& words, double seconds,
                         std::size_t most);

/// For a program just started: closes all inherited descriptors.
void close_inherited() noexcept;

/// For a program just started: bounds its memory (bytes) and processor time (s), and prevents core dumps.
void limit_this_process(std::size_t memory, unsigned seconds) noexcept;

/// The path of the running program; empty where the system does not tell.
[[nodiscard]] std::filesystem::path this_program();

}  // namespace tweenfall::assimp
