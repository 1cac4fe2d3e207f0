#pragma once

// All that is wrong with one document, gathered while it is read; places are looked up at the end, once.

#include <tweenfall/importers/document.h>

#include "json/json_tree.h"

#include <string>
#include <vector>

namespace tweenfall::document {

class Problems {
 public:
  void add(const JsonFault& fault) { entries_.push_back({fault, {}}); }
  void add(const JsonValue& at, std::string message);
  void add_name(const JsonMember& at, std::string message);
  // Problems of an imported file, at their places there.
  void add_foreign(std::vector<Problem> problems);

  [[nodiscard]] bool empty() const { return entries_.empty() && foreign_.empty(); }
  [[nodiscard]] std::size_t size() const { return entries_.size() + foreign_.size(); }

  // Whether suggestions, which look at all names, are no longer worth their time.
  [[nodiscard]] bool crowded() const { return size() > most_listed || looked_at_ > most_looked_at; }
  // Names were looked at for a suggestion.
  void look_at(std::size_t names) { looked_at_ += names; }

  // In order of the text; of very many the first.
  [[nodiscard]] std::vector<Problem> located(const std::string& file, const JsonTree& tree) const;

  static constexpr std::size_t most_listed = 400;

 private:
  static constexpr std::size_t most_looked_at = 400000;

  struct Entry {
    JsonFault fault;
    JsonValue value;  // whose length is the fault's, unless it has one
  };

  std::vector<Entry> entries_;
  std::vector<Problem> foreign_;
  std::size_t looked_at_ = 0;
};

// A problem of a whole file.
[[nodiscard]] Problem file_problem(std::string file, std::string message);

}  // namespace tweenfall::document
