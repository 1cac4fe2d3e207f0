#pragma once

// The files that assimp may see: the model, already in memory, and plain files beside it.

#include <assimp/IOSystem.hpp>

#include <filesystem>
#include <string>

namespace tweenfall {

class MemoryFiles : public Assimp::IOSystem {
 public:
  /// @param bytes  the content of `file`; must outlive this
  MemoryFiles(const std::string& bytes, const std::filesystem::path& file);

  bool Exists(const char* path) const override;
  char getOsSeparator() const override { return '/'; }
  Assimp::IOStream* Open(const char* path, const char* mode) override;
  void Close(Assimp::IOStream* stream) override;

 private:
  [[nodiscard]] bool is_beside(const std::filesystem::path& path) const;

  const std::string& bytes_;
  std::filesystem::path file_;
};

}  // namespace tweenfall
