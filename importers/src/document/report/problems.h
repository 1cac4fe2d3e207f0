#pragma once

// All that is wrong with one document, gathered while it is read; places are looked up at the end, once.

#include <tweenfall/importers/document.h>

#include "json/json_tree.h"

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::document {

class Problems {
 public:
  void add(const json::Fault& fault) { errors_.entries.push_back({fault, {}}); }
  void add(const json::Value& at, std::string message);
  void add_name(const json::Member& at, std::string message);
  // The same of two members, the second of which is where the first stands, too.
  void add_name_beside(const json::Member& at, std::string message, const json::Member& other);
  // Forgets errors that another says better. @param count  errors that stay, the first
  void keep(std::size_t count);
  // What is no fault; it is told beside errors, too.
  void note(const json::Value& at, std::string message);
  void note_name(const json::Member& at, std::string message);
  // Problems and notes of an imported file, at their places there.
  void add_foreign(const std::vector<Problem>& problems);

  // Of errors; notes do not count
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] std::size_t size() const { return errors_.entries.size() + errors_.foreign.size(); }

  // Where errors of this text stand, in its order
  [[nodiscard]] std::vector<std::size_t> places() const;

  // Whether suggestions, which look at all names, are no longer worth their time.
  [[nodiscard]] bool crowded() const { return size() > most_listed || looked_at_ > most_looked_at; }
  // Names were looked at for a suggestion.
  void look_at(std::size_t names) { looked_at_ += names; }

  // In order of the text; of very many the first.
  [[nodiscard]] std::vector<Problem> located(Severity severity, const std::string& file, const json::Tree& tree) const;

  static constexpr std::size_t most_listed = 400;

 private:
  static constexpr std::size_t most_looked_at = 400000;

  struct Entry {
    json::Fault fault;
    json::Value value;                      // whose length is the fault's, unless it has one
    std::optional<std::size_t> other = {};  // where the other stands that has part in it
  };

  struct Told {
    std::vector<Entry> entries;
    std::vector<Problem> foreign;
  };

  Told errors_, notes_;
  std::size_t looked_at_ = 0;
};

// A problem of a whole file.
[[nodiscard]] Problem file_problem(std::string file, std::string message);

}  // namespace tweenfall::document
