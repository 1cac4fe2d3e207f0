#include "files/output_file.h"

#include "line/arguments.h"
#include "report/did_you_mean.h"
#include "report/terminal.h"

#include <tweenfall/importers/whole_file.h>

#include <algorithm>
#include <filesystem>

namespace tweenfall::cli {

void require_output(const std::string& output, const std::string& input, std::span<const std::string> endings) {
  if (output == "-") return;
  std::string ending = std::filesystem::path(output).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (std::find(endings.begin(), endings.end(), ending) == endings.end())
    throw UsageError("the name of the file to write, \"" + output + "\", must end in " + one_of(endings));
  std::error_code error;
  if (std::filesystem::equivalent(output, input, error))
    throw UsageError("\"" + output + "\" is the file that is read; write to another");
}

void write_output(const std::string& file, std::string_view content) {
  if (file == "-") return print(content);
  write_whole_file(file, content);
}

void say_written(const std::string& file, std::string_view shows, bool stdout_is_taken) {
  const std::string line = "wrote " + (file == "-" ? "to standard output" : file) + ": " + std::string(shows);
  if (stdout_is_taken || file == "-")
    say(line);
  else
    tell(line);
}

}  // namespace tweenfall::cli
