#pragma once

// The built command, run in a folder of its own, and a few documents to run it on.

#include "support.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace tweenfall::test {

/// What a run of the command left behind.
struct Ran {
  int code = -1;
  std::string out, err;
};

/// A new empty folder, removed at the end; the command runs in it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& text) const;
  [[nodiscard]] std::string read(const std::string& name) const;
  [[nodiscard]] bool has(const std::string& name) const;
  [[nodiscard]] std::vector<std::string> names() const;  ///< of all files, sorted
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  /// @param arguments  as a shell reads them
  [[nodiscard]] Ran run(const std::string& arguments, const std::string& input = "") const;

  /// Everything that the command prints when its output is a terminal. @param environment  "NAME=VALUE ..."
  [[nodiscard]] std::string run_on_terminal(const std::string& arguments, const std::string& environment) const;

 private:
  std::filesystem::path path_;
};

/// A ball's clip of three seconds: linear position, a turn about z, colors, a switch, and an event.
extern const std::string ball_document;

/// A body that its clip throws and that is free from 0.5 s on, above a floor.
extern const std::string thrown_document;

/// Its third key stands before its second.
extern const std::string faulty_document;

}  // namespace tweenfall::test
