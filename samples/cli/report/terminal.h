#pragma once

/// What the command says, and how: results on stdout, messages on stderr, color on a terminal only.

#include <atomic>
#include <string>
#include <string_view>
#include <thread>

namespace tweenfall::cli {

/// Whether stdout or stderr is a terminal that wants color; false when NO_COLOR is set.
[[nodiscard]] bool styled_output();
[[nodiscard]] bool styled_messages();

/// Results, byte for byte. @throws std::runtime_error when stdout takes no more.
void print(std::string_view text);

/// A line for people on stdout; what would drive a terminal is spelled out in this and the next. @throws as `print`.
void tell(std::string_view text);

/// A line or several on stderr; "error:" and "note:" in it are colored.
void say(std::string_view text);

/// While it lives: what is going on and for how long, on one line of a terminal, from the second second on.
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
