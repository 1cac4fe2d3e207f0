#pragma once

// The bytes of an FBX file, and how a place in them is told.

#include <filesystem>
#include <string>
#include <string_view>

namespace tweenfall::fbx {

class Source {
 public:
  Source(std::string_view bytes, const std::filesystem::path& file, bool text)
      : bytes_(bytes), file_(file.string()), text_(text) {}

  [[nodiscard]] std::string_view bytes() const { return bytes_; }
  [[nodiscard]] bool text() const { return text_; }

  /// "line 3" or "byte 120".
  [[nodiscard]] std::string place(std::size_t at) const;

  /// @throws ModelError naming the file, and the line and column or the byte.
  [[noreturn]] void fail(std::size_t at, const std::string& what) const;

 private:
  std::string_view bytes_;
  std::string file_;
  bool text_;
};

}  // namespace tweenfall::fbx
