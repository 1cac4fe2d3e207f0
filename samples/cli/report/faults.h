#pragma once

/// Faults of files and runs as the command prints them: every one, in the form that compilers use, and their number.

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace tweenfall::cli {

/// Faults whose texts already name their place, one text each; the command ends with exit code 1.
class Faults : public std::runtime_error {
 public:
  explicit Faults(std::vector<std::string> texts);
  [[nodiscard]] const std::vector<std::string>& texts() const noexcept { return texts_; }

 private:
  std::vector<std::string> texts_;
};

/// The texts of a library's exception, for a document followed by its notes; `source` precedes those without a file.
[[nodiscard]] std::vector<std::string> faults_of(const std::exception& error, const std::string& source);

/// How many there are: a document with very many faults has more than it has texts.
[[nodiscard]] std::size_t fault_count(const std::exception& error, const std::string& source);

/// Prints all on stderr, and "2 problems" below them.
void say_faults(const std::exception& error, const std::string& source);

}  // namespace tweenfall::cli
