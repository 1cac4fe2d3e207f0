#include "assimp/process.h"

#if defined(__unix__) || defined(__APPLE__)
#define TWEENFALL_POSIX 1
#else
#define TWEENFALL_POSIX 0
#endif

#if TWEENFALL_POSIX
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#endif

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <stdexcept>

#if TWEENFALL_POSIX
extern char** environ;
#endif

#ifndef __has_feature
#define __has_feature(x) 0
#endif

namespace tweenfall::assimp {

#if TWEENFALL_POSIX

namespace {

[[noreturn]] void fail(const char* what, int error) {
  throw std::runtime_error(std::string(what) + ": " + std::strerror(error));
}

/// A file descriptor, closed by the destructor.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  void set(int number) {
    close();
    number_ = number;
  }
  [[nodiscard]] int number() const { return number_; }

 private:
  int number_;
};

/// Moves a descriptor above the standard ones, which may be closed in this process, and closes it when a program is
/// started.
int moved_up(int number) {
  const int moved = ::fcntl(number, F_DUPFD_CLOEXEC, 3);
  const int error = errno;
  ::close(number);
  if (moved < 0) fail("a pipe cannot be made", error);
  return moved;
}

class Pipe {
 public:
  Pipe() {
    int ends[2];
    if (make(ends) != 0) fail("a pipe cannot be made", errno);
    Descriptor second(ends[1]);
    in.set(moved_up(ends[0]));
    out.set(::fcntl(second.number(), F_DUPFD_CLOEXEC, 3));
    if (out.number() < 0) fail("a pipe cannot be made", errno);
  }
  Descriptor in, out;

 private:
  static int make(int* ends) {
#if defined(__linux__)
    return ::pipe2(ends, O_CLOEXEC);
#else
    return ::pipe(ends);
#endif
  }
};

class Actions {
 public:
  Actions() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~Actions() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  Actions(const Actions&) = delete;
  Actions& operator=(const Actions&) = delete;

  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
};

pid_t start(const std::filesystem::path& program, const std::vector<std::string>& words, int out) {
  Actions actions;
  posix_spawn_file_actions_addopen(&actions.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions.files, out, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&actions.files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  sigset_t none, usual;
  sigemptyset(&none);
  sigemptyset(&usual);
  for (const int number : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGXCPU, SIGPIPE, SIGTERM, SIGINT})
    sigaddset(&usual, number);
  posix_spawnattr_setsigmask(&actions.attributes, &none);
  posix_spawnattr_setsigdefault(&actions.attributes, &usual);
  posix_spawnattr_setflags(&actions.attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  std::vector<std::string> own{program.string()};
  own.insert(own.end(), words.begin(), words.end());
  std::vector<char*> list;
  list.reserve(own.size() + 1);
  for (std::string& word : own) list.push_back(word.data());
  list.push_back(nullptr);
  pid_t child = 0;
  const int error = ::posix_spawn(&child, program.c_str(), &actions.files, &actions.attributes, list.data(), environ);
  if (error != 0) fail(("\"" + program.string() + "\" cannot be started").c_str(), error);
  return child;
}

std::string how_it_ended(int status) {
  if (WIFEXITED(status)) return WEXITSTATUS(status) == 0 ? "" : "exit code " + std::to_string(WEXITSTATUS(status));
  const int number = WTERMSIG(status);
  if (number == SIGXCPU || number == SIGKILL) return "out of time";
  return ::strsignal(number);
}

}  // namespace

bool can_start_programs() noexcept {
  return true;
}

Heard hear(const std::filesystem::path& program, const std::vector<std::string>& words, double seconds,
           std::size_t most) {
  using Clock = std::chrono::steady_clock;
  Pipe pipe;
  const pid_t child = start(program, words, pipe.out.number());
  pipe.out.close();
  const Clock::time_point end =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  Heard heard;
  std::vector<char> part(1 << 16);
  while (true) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now()).count();
    pollfd ready{pipe.in.number(), POLLIN, 0};
    const int count = left > 0 ? ::poll(&ready, 1, static_cast<int>(std::min<long long>(left, 1000))) : 0;
    if (left <= 0) {
      heard.in_time = false;
      break;
    }
    if (count == 0 || (count < 0 && errno == EINTR)) continue;
    const ssize_t size = ::read(pipe.in.number(), part.data(), part.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) break;
    if (static_cast<std::size_t>(size) > most - heard.said.size()) {
      heard.too_much = true;
      break;
    }
    heard.said.append(part.data(), static_cast<std::size_t>(size));
  }
  if (!heard.in_time || heard.too_much) ::kill(child, SIGKILL);
  int status = 0;
  pid_t waited = 0;
  do waited = ::waitpid(child, &status, 0);
  while (waited < 0 && errno == EINTR);
  // Where the host ignores SIGCHLD, the exit status is not known; then the output decides.
  if (waited == child) heard.how_it_ended = how_it_ended(status);
  return heard;
}

void close_inherited() noexcept {
  const long most = ::sysconf(_SC_OPEN_MAX);
  const int end = most > 3 && most < 65536 ? static_cast<int>(most) : 65536;
  for (int number = 3; number < end; ++number) ::close(number);
}

void limit_this_process(std::size_t memory, unsigned seconds) noexcept {
  const auto limit = [](auto resource, rlim_t most) {
    const rlimit both{most, most};
    static_cast<void>(::setrlimit(resource, &both));
  };
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, seconds);
  // The address sanitizer reserves terabytes for itself.
#if !defined(__SANITIZE_ADDRESS__) && !__has_feature(address_sanitizer)
  limit(RLIMIT_AS, memory);
#else
  static_cast<void>(memory);
#endif
}

std::filesystem::path this_program() {
  std::error_code failed;
  for (const char* link : {"/proc/self/exe", "/proc/curproc/file"}) {
    const std::filesystem::path found = std::filesystem::read_symlink(link, failed);
    if (!failed) return found;
  }
  return {};
}

#else

bool can_start_programs() noexcept {
  return false;
}

Heard hear(const std::filesystem::path&, const std::vector<std::string>&, double, std::size_t) {
  throw std::runtime_error("programs cannot be started on this system");
}

void close_inherited() noexcept {}

void limit_this_process(std::size_t, unsigned) noexcept {}

std::filesystem::path this_program() {
  return {};
}

#endif

}  // namespace tweenfall::assimp
