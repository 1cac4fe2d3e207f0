#pragma once

// A program started, heard out, and ended in time.

#include <filesystem>
#include <string>
#include <vector>

namespace tweenfall::assimp {

struct Heard {
  std::string said;          ///< what it wrote to its standard output
  bool in_time = true;       ///< false where it was ended for taking too long
  bool too_much = false;     ///< it was ended for saying more than was asked for
  std::string how_it_ended;  ///< empty for exit code 0
};

/// Whether this system can start programs at all.
[[nodiscard]] bool can_start_programs() noexcept;

/// Runs a program and waits for it alone. It has nothing of ours but its words, an empty standard input, and a pipe for
/// its standard output; what it writes to standard error is lost.
/// @param seconds  after which it is ended
/// @param most     bytes that are heard
/// @throws std::runtime_error when it cannot be started
[[nodiscard]] Heard hear(const std::filesystem::path& program, const std::vector<std::string>& words, double seconds,
                         std::size_t most);

/// For a program just started: lets go of whatever descriptors came along by inheritance.
void close_inherited() noexcept;

/// For a program just started: bounds its memory (bytes) and processor time (s), and leaves no core behind.
void limit_this_process(std::size_t memory, unsigned seconds) noexcept;

/// Where the program that runs is; empty where the system does not tell.
[[nodiscard]] std::filesystem::path this_program();

}  // namespace tweenfall::assimp
