// Files that are there completely or not at all.

#include "importers/models/model_support.h"

#include <tweenfall/importers/whole_file.h>

#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <thread>

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

namespace fs = std::filesystem;

std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

std::string refusal(const fs::path& file) {
  try {
    write_whole_file(file, "new");
    return "";
  } catch (const std::runtime_error& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("a file is written and replaced, and nothing is left beside it") {
  const ScratchFolder folder("write");
  const std::string content("a\0b\r\n", 5);
  write_whole_file(folder / "new.bin", content);
  CHECK(text_of(folder / "new.bin") == content);
  write_whole_file(folder / "new.bin", "");
  CHECK(text_of(folder / "new.bin").empty());
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a file that is replaced keeps its permissions, and a link stays a link") {
  const ScratchFolder folder("keep");
  const fs::path file = folder.file("file.txt", "old"), link = folder / "link.txt";
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("file.txt", link);
  write_whole_file(link, "new");
  CHECK(fs::is_symlink(link));
  CHECK(text_of(file) == "new");
  CHECK(fs::status(file).permissions() == (fs::perms::owner_read | fs::perms::owner_write));
}

TEST_CASE("a file that cannot be written is named with the reason, and what was there stays") {
  const ScratchFolder folder("refuse");
  CHECK(refusal(folder.path()) == "cannot write " + folder.path().string() + ": it is a folder");
  const fs::path nowhere = folder / "none" / "file.txt";
  CHECK(refusal(nowhere) ==
        "cannot write " + nowhere.string() + ": there is no folder " + nowhere.parent_path().string());
  CHECK(entries(folder.path()) == 0);
  if (fs::exists("/dev/full")) CHECK(refusal("/dev/full") == "cannot write /dev/full: No space left on device");
}

TEST_CASE("a read-only file is refused, for root too, and stays as it was") {
  const ScratchFolder folder("read-only");
  const fs::path file = folder.file("file.txt", "old");
  fs::permissions(file, fs::perms::owner_read | fs::perms::group_read);
  CHECK(refusal(file) ==
        "cannot write " + file.string() + ": it is read-only; make it writable, or write to another file");
  CHECK(text_of(file) == "old");
  CHECK(entries(folder.path()) == 1);
}

TEST_CASE("a link to what is not there is refused and stays") {
  const ScratchFolder folder("dangling");
  fs::create_symlink("nowhere.txt", folder / "link.txt");
  CHECK(refusal(folder / "link.txt").ends_with(": it is a link to a file that does not exist"));
  CHECK(fs::is_symlink(fs::symlink_status(folder / "link.txt")));
}

TEST_CASE("what replaces a private file is private from its first byte on") {
  const ScratchFolder folder("private");
  const fs::path file = folder.file("file.txt", "old");
  fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
  const std::string content(std::size_t{64} << 20, 'x');
  const pid_t writer = fork();
  REQUIRE(writer >= 0);
  if (writer == 0) {
    write_whole_file(file, content);
    _exit(0);
  }
  std::size_t parts_seen = 0;
  for (int status = 0; waitpid(writer, &status, WNOHANG) == 0;) {
    std::error_code gone;
    for (fs::directory_iterator entry(folder.path(), gone), end; !gone && entry != end; entry.increment(gone)) {
      struct stat seen {};
      if (entry->path().extension() != ".part" || ::stat(entry->path().c_str(), &seen) != 0) continue;
      ++parts_seen;
      CHECK((seen.st_mode & 0077) == 0);
    }
  }
  CHECK(parts_seen > 0);
  CHECK(fs::file_size(file) == content.size());
}

TEST_CASE("a signal in the midst of writing leaves the old file and nothing beside it") {
  const ScratchFolder folder("signal");
  const fs::path file = folder.file("file.txt", "old");
  const std::string content(std::size_t{256} << 20, 'x');
  int ended_by_signal = 0;
  for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
    const pid_t writer = fork();
    REQUIRE(writer >= 0);
    if (writer == 0) {
      std::signal(signal, SIG_DFL);
      write_whole_file(file, content);
      _exit(0);
    }
    // As soon as it has begun.
    int status = 0;
    while (entries(folder.path()) == 1 && waitpid(writer, &status, WNOHANG) == 0) std::this_thread::yield();
    kill(writer, signal);
    waitpid(writer, &status, 0);
    ended_by_signal += WIFSIGNALED(status) && WTERMSIG(status) == signal;
    CHECK(entries(folder.path()) == 1);
    CHECK((text_of(file) == "old" || fs::file_size(file) == content.size()));
  }
  CHECK(ended_by_signal > 0);
}
