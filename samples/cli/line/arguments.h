#pragma once

/// The arguments of the command and its verbs, declared once: parsing, help and completion all come from here.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace tweenfall::cli {

/// A mistake in how the command was called; the command ends with exit code 2.
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The arguments of one verb. Every call binds a variable, which must live until the verb has run.
class Arguments {
 public:
  /// @param implementation  the parser's own object for the verb
  explicit Arguments(void* implementation) : implementation_(implementation) {}

  void file(const char* name, std::string& value, const char* says);
  void optional_file(const char* name, std::string& value, const char* says);
  void files(const char* name, std::vector<std::string>& values, const char* says);
  void word(const char* name, std::string& value, const std::vector<std::string>& choices, const char* says);

  void flag(const char* option, bool& value, const char* says);
  void text(const char* option, const char* kind, std::optional<std::string>& value, const char* says);
  void texts(const char* option, const char* kind, std::vector<std::string>& values, const char* says);
  void number(const char* option, const char* kind, std::optional<double>& value, const char* says);
  void output(std::string& value, const char* kind, const char* says);  ///< -o, --output
  void numbers(const char* option, const char* kind, std::vector<double>& values, const char* says);

 private:
  void* implementation_;
};

/// What a verb does once its arguments are parsed; @returns the exit code.
using Run = std::function<int()>;

struct Verb {
  const char* name;
  const char* summary;
  const char* example;
  Run (*declare)(Arguments&);
};

/// An option for completion.
struct OptionName {
  std::string name;         ///< "--clip", "-o"
  std::string says;         ///< its line of the help
  bool takes_value = true;  ///< false for a flag
};

class CommandLine {
 public:
  explicit CommandLine(std::span<const Verb* const> verbs);
  ~CommandLine();

  /// Parses, and runs the verb. Help and version go to stdout. @throws UsageError; and whatever the verb throws.
  int run(const std::vector<std::string>& arguments);

  [[nodiscard]] std::vector<OptionName> options(std::string_view verb) const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace tweenfall::cli
