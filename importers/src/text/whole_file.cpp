#include <tweenfall/importers/whole_file.h>

#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace tweenfall {

namespace {

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& reason) {
  throw std::runtime_error("cannot write " + file.string() + ": " + reason);
}

void write_to(const std::filesystem::path& place, const std::filesystem::path& file, std::string_view content) {
  errno = 0;
  std::ofstream stream(place, std::ios::binary | std::ios::trunc);
  stream.write(content.data(), static_cast<std::streamsize>(content.size()));
  stream.close();
  if (!stream) fail(file, errno != 0 ? std::strerror(errno) : "the file could not be opened");
}

}  // namespace

void write_whole_file(const std::filesystem::path& file, std::string_view content) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::file_status status = fs::status(file, error);
  if (fs::is_directory(status)) fail(file, "it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) return write_to(file, file, content);
  const fs::path folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, error)) fail(file, "there is no folder " + folder.string());

  static std::atomic<unsigned> counter{0};
  // Through a link to what it points at, so that the link stays.
  const fs::path target = fs::exists(status) ? fs::canonical(file, error) : file;
  if (target.empty()) fail(file, error.message());
  fs::path beside = target;
  beside += ".part-" + std::to_string(getpid()) + "-" + std::to_string(counter++);
  try {
    write_to(beside, file, content);
    if (fs::exists(status)) fs::permissions(beside, status.permissions(), error);
    fs::rename(beside, target);
  } catch (const fs::filesystem_error& problem) {
    fs::remove(beside, error);
    fail(file, problem.code().message());
  } catch (...) {
    fs::remove(beside, error);
    throw;
  }
}

}  // namespace tweenfall
