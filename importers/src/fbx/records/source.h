#pragma once

// The bytes of an FBX file, and places in them for messages.

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

  /// "line 3" or "byte 120". For one thread only, since it remembers how far lines were counted.
  [[nodiscard]] std::string place(std::size_t at) const;

  /// @throws ModelError naming the file, and the line and column or the byte.
  [[noreturn]] void fail(std::size_t at, const std::string& what) const;

 private:
  /// Continues from the place of the previous call: most calls come in the file's order.
  [[nodiscard]] std::size_t line_of(std::size_t at) const;

  std::string_view bytes_;
  std::string file_;
  bool text_;
  mutable std::size_t counted_ = 0, lines_ = 0;  ///< number of line ends before a byte
};

}  // namespace tweenfall::fbx
