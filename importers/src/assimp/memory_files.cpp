#include "assimp/memory_files.h"

#include "model/model_bytes.h"

#include <assimp/IOStream.hpp>
#include <assimp/IOSystem.hpp>

#include <algorithm>
#include <cstring>
#include <optional>
#include <string_view>

namespace tweenfall::assimp {

namespace {

class MemoryStream : public Assimp::IOStream {
 public:
  explicit MemoryStream(std::string_view bytes) : bytes_(bytes) {}
  explicit MemoryStream(std::string own) : own_(std::move(own)), bytes_(own_) {}

  size_t Read(void* out, size_t size, size_t count) override {
    const std::size_t whole = size == 0 ? 0 : std::min(count, (bytes_.size() - at_) / size);
    if (whole) std::memcpy(out, bytes_.data() + at_, whole * size);
    at_ += whole * size;
    return whole;
  }
  size_t Write(const void*, size_t, size_t) override { return 0; }
  aiReturn Seek(size_t offset, aiOrigin origin) override {
    const std::size_t from = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? at_ : bytes_.size();
    if (offset > bytes_.size() - from) return aiReturn_FAILURE;
    at_ = from + offset;
    return aiReturn_SUCCESS;
  }
  size_t Tell() const override { return at_; }
  size_t FileSize() const override { return bytes_.size(); }
  void Flush() override {}

 private:
  std::string own_;
  std::string_view bytes_;
  std::size_t at_ = 0;
};

class MemoryFiles : public Assimp::IOSystem {
 public:
  MemoryFiles(const std::string& bytes, const std::filesystem::path& file, std::vector<std::string>& missing)
      : bytes_(bytes), file_(file), missing_(missing) {}

  bool Exists(const char* path) const override {
    std::error_code failed;
    return path == file_.string() || (is_beside(path) && std::filesystem::is_regular_file(path, failed));
  }

  char getOsSeparator() const override { return '/'; }

  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (std::strchr(mode, 'w') || std::strchr(mode, 'a')) return nullptr;
    if (path == file_.string()) return new MemoryStream(std::string_view(bytes_));
    std::string reason;
    auto bytes = is_beside(path) ? models::model_bytes(path, reason) : std::nullopt;
    if (bytes) return new MemoryStream(std::move(*bytes));
    const std::string_view given = path, folder = folder_;
    missing_.emplace_back(given.substr(given.starts_with(folder) ? folder.size() : 0));
    return nullptr;
  }

  void Close(Assimp::IOStream* stream) override { delete stream; }

 private:
  [[nodiscard]] bool is_beside(const std::filesystem::path& path) const {
    // A hostile file must not be able to read the rest of the disk.
    return path.parent_path().lexically_normal() == file_.parent_path().lexically_normal() && path.filename() != ".." &&
           !models::leads_out_of(file_.parent_path(), path.filename());
  }

  const std::string& bytes_;
  std::filesystem::path file_;
  std::string folder_ = (file_.parent_path() / "").string();
  std::vector<std::string>& missing_;
};

}  // namespace

std::unique_ptr<Assimp::IOSystem> memory_files(const std::string& bytes, const std::filesystem::path& file,
                                               std::vector<std::string>& missing) {
  return std::make_unique<MemoryFiles>(bytes, file, missing);
}

}  // namespace tweenfall::assimp
