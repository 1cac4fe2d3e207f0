// Files that are there whole or not at all.

#include "model_support.h"

#include <tweenfall/importers/whole_file.h>

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
