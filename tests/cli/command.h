#pragma once

// The built command, run in a folder of its own, and a few documents to run it on.

#include "support.h"

#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

namespace tweenfall::test {

/// A ball's clip of three seconds: linear position, a turn about z, a color, a switch, and an event.
inline const std::string ball_document = R"({
  "tweenfall": 1,
  "fps": 10,
  "nodes": {"pivot": {"position": [1, 2, 3]}, "ball": {"parent": "pivot"}},
  "clips": {
    "roll": {
      "tracks": {
        "ball.position": [[0, [0, 0, 0], "linear"], [1, [2, 0, 0], "linear"], [3, [2, 4, 0]]],
        "pivot.rotation": {"axis": "z", "keys": [[0, 0, "linear"], [3, 270]]},
        "ball.color": [[0, "#ff0000"], [3, "#ff0000"]],
        "ball.lit": {"kind": "switch", "keys": [[0, false], [1.5, true]]}
      },
      "events": [[1, "corner"]]
    }
  }
})";

/// A body that its clip throws and that is free from 0.5 s on, above a floor.
inline const std::string thrown_document = R"({
  "tweenfall": 1,
  "name": "thrown",
  "nodes": {
    "floor": {"body": {"shape": {"plane": {"normal": [0, 1, 0]}}, "static": true}},
    "ball": {"position": [0, 2, 0], "body": {"shape": {"sphere": {"radius": 0.1}}}}
  },
  "clips": {"throw": {"tracks": {"ball.position": [[0, [0, 2, 0], "linear"], [1, [3, 2, 0]]]}}},
  "handoff": [{"body": "ball", "when": {"at": 0.5}, "to": "free"}]
})";

/// Its third key comes before its second.
inline const std::string faulty_document =
    R"({"tweenfall": 1,
 "clips": {"drop": {"tracks": {
  "ball.position": [
    [0, [0, 3, 0]],
    [0.8, [0, 0, 0]],
    {"t": 0.5, "v": [0, 3, 0]}
  ]}}}}
)";

namespace detail {

inline std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

inline std::string content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// Where the output streams of a run are kept: not in its folder, whose files are counted.
inline std::filesystem::path beside(const std::filesystem::path& folder, const char* what) {
  return folder.string() + "." + what;
}

}  // namespace detail

/// What a run of the command left behind.
struct Ran {
  int code = -1;
  std::string out, err;
};

/// The command as a shell runs it: for a minute at most, then its exit code is 124.
inline std::string command_word() {
  return "timeout 60 " + detail::quoted(TWEENFALL_COMMAND);
}

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

  /// A script of a shell, in which `command_word()` is the command.
  [[nodiscard]] Ran shell(const std::string& script, const std::string& input = "") const;

  /// Everything that the command prints when its output is a terminal. @param environment  "NAME=VALUE ..."
  [[nodiscard]] std::string run_on_terminal(const std::string& arguments, const std::string& environment) const;

 private:
  std::filesystem::path path_;
};

inline Folder::Folder() {
  static int made = 0;
  path_ = std::filesystem::temp_directory_path() /
          ("tweenfall-cli-" + std::to_string(getpid()) + "-" + std::to_string(++made));
  std::filesystem::remove_all(path_);
  std::filesystem::create_directories(path_);
}

inline Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  for (const char* stream : {"in", "out", "err"}) std::filesystem::remove(detail::beside(path_, stream), ignored);
}

inline void Folder::write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name, std::ios::binary) << text;
}

inline std::string Folder::read(const std::string& name) const {
  return detail::content(path_ / name);
}

inline bool Folder::has(const std::string& name) const {
  return std::filesystem::exists(path_ / name);
}

inline std::vector<std::string> Folder::names() const {
  std::vector<std::string> found;
  for (const auto& entry : std::filesystem::directory_iterator(path_))
    found.push_back(entry.path().filename().string());
  std::sort(found.begin(), found.end());
  return found;
}

inline Ran Folder::run(const std::string& arguments, const std::string& input) const {
  return shell(command_word() + " " + arguments, input);
}

inline Ran Folder::shell(const std::string& script, const std::string& input) const {
  std::ofstream(detail::beside(path_, "in"), std::ios::binary) << input;
  const std::string line = "cd " + detail::quoted(path_.string()) + " && ( " + script + " ) <" +
                           detail::quoted(detail::beside(path_, "in").string()) + " >" +
                           detail::quoted(detail::beside(path_, "out").string()) + " 2>" +
                           detail::quoted(detail::beside(path_, "err").string());
  const int status = std::system(line.c_str());
  Ran ran;
  ran.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  ran.out = detail::content(detail::beside(path_, "out"));
  ran.err = detail::content(detail::beside(path_, "err"));
  return ran;
}

inline std::string Folder::run_on_terminal(const std::string& arguments, const std::string& environment) const {
  const std::string inner =
      "env -u NO_COLOR TERM=xterm " + environment + " " + detail::quoted(TWEENFALL_COMMAND) + " " + arguments;
  const std::string line = "cd " + detail::quoted(path_.string()) + " && script -qec " + detail::quoted(inner) +
                           " /dev/null >" + detail::quoted(detail::beside(path_, "out").string()) + " </dev/null";
  CHECK(std::system(line.c_str()) != -1);
  return detail::content(detail::beside(path_, "out"));
}

}  // namespace tweenfall::test
