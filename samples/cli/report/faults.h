#pragma once

/// Faults of files and runs as the command tells them: every one, as compilers print them, and their number.

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

namespace tweenfall::cli {

/// Faults that already say their place, one text each; the command ends with 1.
class Faults : public std::runtime_error {
 public:
  explicit Faults(std::vector<std::string> texts);
  [[nodiscard]] const std::vector<std::string>& texts() const noexcept { return texts_; }

 private:
  std::vector<std::string> texts_;
};

/// The texts of what a library threw, of a document its notes below; `source` stands before those that name no file.
[[nodiscard]] std::vector<std::string> faults_of(const std::exception& error, const std::string& source);

/// How many there are: of a document with very many, more than have a text.
[[nodiscard]] std::size_t fault_count(const std::exception& error, const std::string& source);

/// All on stderr, and "2 problems" below them.
void say_faults(const std::exception& error, const std::string& source);

}  // namespace tweenfall::cli
