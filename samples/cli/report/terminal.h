#pragma once

/// Where and how the command prints: results on stdout, messages on stderr, color only on a terminal.

#include <atomic>
#include <string>
#include <string_view>
#include <thread>

namespace tweenfall::cli {

/// Whether stdout or stderr is a terminal that wants color; false when NO_COLOR is set.
[[nodiscard]] bool styled_output();
[[nodiscard]] bool styled_messages();

/// Results, byte for byte. @throws std::runtime_error when stdout cannot be written.
void print(std::string_view text);

/// A line for people on stdout; here and in `say`, control characters are spelled out. @throws as `print`.
void tell(std::string_view text);

/// A line or several on stderr; "error:" and "note:" in it are colored.
void say(std::string_view text);

/// While it lives, shows what is going on and for how long, on one line of a terminal, from the second second on.
class Progress {
 public:
  explicit Progress(const std::string& what);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

 private:
  std::atomic<bool> over_ = false;
  std::thread thread_;
};

}  // namespace tweenfall::cli
