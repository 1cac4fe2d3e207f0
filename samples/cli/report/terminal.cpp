#include "report/terminal.h"

#include <tweenfall/importers/shown_text.h>

#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>

namespace tweenfall::cli {

namespace {

bool wants_color(int descriptor) {
  const char* refused = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  if (refused && *refused) return false;
  return isatty(descriptor) && terminal && std::string_view(terminal) != "dumb";
}

}  // namespace

bool styled_output() {
  return wants_color(STDOUT_FILENO);
}
bool styled_messages() {
  return wants_color(STDERR_FILENO);
}

void print(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw std::runtime_error("standard output cannot be written");
}

void tell(std::string_view text) {
  print(terminal_text(text) + "\n");
}

void say(std::string_view text) {
  std::string line = terminal_lines(text);
  if (styled_messages()) {
    for (const auto& [word, color] : {std::pair{"error:", "\033[1;31m"}, std::pair{"note:", "\033[1;36m"}}) {
      const std::size_t at = line.find(word);
      if (at == std::string::npos || at > line.find('\n')) continue;
      line.insert(at + std::string_view(word).size(), "\033[0m");
      line.insert(at, color);
      break;
    }
  }
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

Progress::Progress(const std::string& what) {
  if (!isatty(STDERR_FILENO)) return;
  thread_ = std::thread([this, what = terminal_text(what)] {
    using namespace std::chrono_literals;
    // Only the thread that writes files handles signals; it tidies up before it obeys them.
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    bool shown = false;
    for (int tenths = 0; !over_; ++tenths) {
      if (tenths >= 10 && tenths % 5 == 0) {
        std::fprintf(stderr, "\r\033[K%s: %d s", what.c_str(), tenths / 10);
        shown = true;
      }
      std::this_thread::sleep_for(100ms);
    }
    if (shown) std::fputs("\r\033[K", stderr);
  });
}

Progress::~Progress() {
  over_ = true;
  if (thread_.joinable()) thread_.join();
}

}  // namespace tweenfall::cli
