#include <tweenfall/importers/whole_file.h>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <istream>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>

namespace tweenfall {

namespace whole_file {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const fs::path& file, const std::string& reason) {
  throw std::runtime_error("cannot write " + file.string() + ": " + reason);
}

/// Blocks signals that would end the process during its lifetime, so that a partial file can be removed first.
class Signals {
 public:
  Signals() noexcept {
    sigemptyset(&ending_);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU}) sigaddset(&ending_, signal);
    pthread_sigmask(SIG_BLOCK, &ending_, &before_);
  }
  ~Signals() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  Signals(const Signals&) = delete;
  Signals& operator=(const Signals&) = delete;

  /// Whether a signal has arrived that was not blocked before.
  [[nodiscard]] bool has_come() const noexcept {
    sigset_t pending;
    sigpending(&pending);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGXCPU})
      if (sigismember(&pending, signal) == 1 && sigismember(&before_, signal) == 0) return true;
    return false;
  }

 private:
  sigset_t ending_, before_;
};

class Descriptor {
 public:
  explicit Descriptor(int number) noexcept : number_(number) {}
  ~Descriptor() { static_cast<void>(close()); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] bool close() noexcept {
    const int number = std::exchange(number_, -1);
    return number < 0 || ::close(number) == 0;
  }

 private:
  int number_;
};

/// Writes `content` while `goes_on` returns true. @returns the error that stopped it, 0 for none.
template <class GoesOn>
int write_all(int descriptor, std::string_view content, GoesOn goes_on) {
  constexpr std::size_t most_at_once = std::size_t{1} << 20;
  while (!content.empty()) {
    if (!goes_on()) return EINTR;
    const ssize_t written = ::write(descriptor, content.data(), std::min(content.size(), most_at_once));
    if (written < 0 && errno != EINTR) return errno;
    if (written > 0) content.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

/// Writes directly to a file that is not a regular one, such as a pipe or a device.
void write_into(const fs::path& file, std::string_view content) {
  Descriptor target(::open(file.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY));
  if (target.number() < 0) fail(file, std::strerror(errno));
  const int fault = write_all(target.number(), content, [] { return true; });
  if (fault != 0 || !target.close()) fail(file, std::strerror(fault != 0 ? fault : errno));
}

/// A name that nobody can guess to prepare something there.
fs::path name_beside(const fs::path& target) {
  std::random_device random;
  std::string name = ".tweenfall-";
  for (int i = 0; i < 16; ++i) name += "abcdefghijklmnopqrstuvwxyz234567"[random() % 32];
  return target.parent_path() / (name + ".part");
}

/// Removes the file unless it was renamed.
struct Part {
  fs::path name;
  bool is_there = false;
  ~Part() {
    if (is_there) ::unlink(name.c_str());
  }
};

/// The file actually written: for a link its target, so that the link stays.
fs::path target_of(const fs::path& file, const fs::file_status& status) {
  std::error_code error;
  const fs::path target = fs::exists(status) ? fs::canonical(file, error) : fs::absolute(file, error);
  if (error) fail(file, error.message());
  if (!fs::exists(status) && fs::is_symlink(fs::symlink_status(file, error)))
    fail(file, "it is a link to a file that does not exist");
  return target;
}

}  // namespace

}  // namespace whole_file

void write_whole_file(const std::filesystem::path& file, std::string_view content) {
  using namespace whole_file;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) fail(file, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_into(file, content);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) fail(file, "there is no folder " + folder.string());
  const fs::path target = target_of(file, status);

  struct stat replaced {};
  const bool replaces = fs::exists(status);
  if (replaces) {
    if (::stat(target.c_str(), &replaced) != 0) fail(file, std::strerror(errno));
    // The privileges of root do not override its owner's wish.
    if ((replaced.st_mode & 0222) == 0 || ::access(target.c_str(), W_OK) != 0)
      fail(file, "it is read-only; make it writable, or write to another file");
  }

  const Signals signals;
  Part part;
  int opened = -1;
  for (int attempt = 0; opened < 0 && attempt < 8; ++attempt) {
    part.name = name_beside(target);
    // The replacement of a private file is not readable for others; a new file has the user's default permissions.
    opened = ::open(part.name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, replaces ? 0600 : 0666);
    if (opened < 0 && errno != EEXIST) break;
  }
  if (opened < 0) fail(file, std::strerror(errno));
  part.is_there = true;
  Descriptor descriptor(opened);
  int fault = write_all(opened, content, [&] { return !signals.has_come(); });
  if (fault == 0 && replaces) {
    // The owner is kept if possible; the group's permissions are not given to another group.
    mode_t mode = replaced.st_mode & 0777;
    if (::fchown(opened, replaced.st_uid, replaced.st_gid) != 0 && ::fchown(opened, uid_t(-1), replaced.st_gid) != 0) {
      struct stat made {};
      if (::fstat(opened, &made) != 0 || made.st_gid != replaced.st_gid) mode &= 0707;
    }
    if (::fchmod(opened, mode) != 0) fault = errno;
  }
  // Not every file system supports fsync.
  if (fault == 0 && ::fsync(opened) != 0 && errno != EINVAL && errno != ENOTSUP) fault = errno;
  if (!descriptor.close() && fault == 0) fault = errno;
  if (fault == 0 && ::rename(part.name.c_str(), target.c_str()) != 0) fault = errno;
  if (fault != 0) fail(file, std::strerror(fault));
  part.is_there = false;
  const Descriptor parent(::open(target.parent_path().c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (parent.number() >= 0) static_cast<void>(::fsync(parent.number()));
}

std::optional<std::string> read_within(std::istream& stream, std::size_t most) {
  constexpr std::size_t piece = std::size_t{1} << 16;
  std::string text;
  while (stream && text.size() <= most) {
    const std::size_t before = text.size(), wanted = std::min(piece, most - before + 1);
    text.resize(before + wanted);
    stream.read(text.data() + before, static_cast<std::streamsize>(wanted));
    text.resize(before + static_cast<std::size_t>(stream.gcount()));
  }
  if (text.size() > most) return std::nullopt;
  return text;
}

}  // namespace tweenfall
