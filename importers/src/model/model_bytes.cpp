#include "model/model_bytes.h"

#include <algorithm>
#include <fstream>

namespace tweenfall::models {

std::optional<std::string> model_bytes(const std::filesystem::path& file, std::string& reason) {
  constexpr std::uintmax_t most_bytes = std::uintmax_t{1} << 31;
  std::error_code failed;
  const auto status = std::filesystem::status(file, failed);
  if (!std::filesystem::exists(status)) {
    reason = "there is no such file";
    return std::nullopt;
  }
  if (!std::filesystem::is_regular_file(status)) {
    reason = "is not a plain file";
    return std::nullopt;
  }
  const std::uintmax_t size = std::filesystem::file_size(file, failed);
  if (failed || size > most_bytes) {
    reason = failed ? "cannot be read: " + failed.message()
                    : "has " + std::to_string(size) + " bytes; models of up to 2 GiB can be read";
    return std::nullopt;
  }
  std::string bytes(static_cast<std::size_t>(size), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) {
    reason = "cannot be read";
    return std::nullopt;
  }
  return bytes;
}

bool leads_out_of(const std::filesystem::path& folder, const std::filesystem::path& below) {
  if (below.empty() || below.is_absolute()) return true;
  if (std::ranges::find(below, std::filesystem::path("..")) != below.end()) return true;
  std::error_code failed;
  const std::filesystem::path home = std::filesystem::canonical(folder.empty() ? "." : folder, failed);
  const std::filesystem::path real = std::filesystem::weakly_canonical(home / below, failed);
  if (failed) return false;  // a missing file cannot be read either
  const std::filesystem::path way = real.lexically_relative(home);
  return way.empty() || *way.begin() == "..";
}

}  // namespace tweenfall::models
