#pragma once

/// Tables for people: a title, a head, aligned columns.

#include <string>
#include <vector>

namespace tweenfall::cli {

class Table {
 public:
  /// @param head  one name per column; a leading ">" aligns the column to the right
  Table(std::string title, std::vector<std::string> head);

  void row(std::vector<std::string> cells);
  void note(std::string text);  ///< a line below the rows
  [[nodiscard]] bool empty() const noexcept { return rows_.empty(); }

  /// Title, head, rows and notes; ends with a new line.
  /// @param styled  with the title and head marked for a terminal
  [[nodiscard]] std::string text(bool styled) const;

 private:
  std::string title_;
  std::vector<std::string> head_;
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> rows_;
  std::vector<std::string> notes_;
};

}  // namespace tweenfall::cli
