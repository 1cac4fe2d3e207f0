#include "output_file.h"

#include "arguments.h"
#include "nearest_name.h"
#include "terminal.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace tweenfall::cli {

void require_output(const std::string& output, const std::string& input, std::span<const std::string> endings) {
  if (output == "-") return;
  const std::string ending = std::filesystem::path(output).extension().string();
  if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    throw UsageError("the name of the file to write, \"" + output + "\", must end in " + listed(endings));
  std::error_code error;
  if (std::filesystem::equivalent(output, input, error))
    throw UsageError("\"" + output + "\" is the file that is read; write to another");
}

void write_output(const std::string& file, std::string_view content) {
  if (file == "-") return print(content);
  // A device or pipe cannot be replaced by a new file.
  const bool special = std::filesystem::exists(file) && !std::filesystem::is_regular_file(file);
  const std::string target = special ? file : file + ".part" + std::to_string(getpid());
  const auto fail = [&] {
    const int reason = errno;
    if (!special) std::remove(target.c_str());
    throw std::runtime_error("cannot write " + file + ": " + std::strerror(reason));
  };
  {
    std::ofstream stream(target, std::ios::binary);
    stream.write(content.data(), static_cast<std::streamsize>(content.size()));
    stream.flush();
    if (!stream) fail();
  }
  if (!special && std::rename(target.c_str(), file.c_str()) != 0) fail();
}

void say_written(const std::string& file, std::string_view shows, bool stdout_is_taken) {
  const std::string line = "wrote " + (file == "-" ? "to standard output" : file) + ": " + std::string(shows);
  if (stdout_is_taken || file == "-")
    say(line);
  else
    print(line + "\n");
}

}  // namespace tweenfall::cli
