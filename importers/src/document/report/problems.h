#pragma once

// Collects the problems of one document while it is read; places are looked up once, at the end.

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
  // The same for two members that conflict.
  void add_name_beside(const json::Member& at, std::string message, const json::Member& other);
  // Removes errors that another one explains better. @param count number of first errors to keep
  void keep(std::size_t count);
  // A note, which is not a fault; it is reported even if there are errors.
  void note(const json::Value& at, std::string message);
  void note_name(const json::Member& at, std::string message);
  // Problems and notes of an imported file, at their places there.
  void add_foreign(const std::vector<Problem>& problems);

  // About errors; notes do not count
  [[nodiscard]] bool empty() const { return size() == 0; }
  [[nodiscard]] std::size_t size() const { return errors_.entries.size() + errors_.foreign.size(); }

  // The places of errors in this text, in order
  [[nodiscard]] std::vector<std::size_t> places() const;

  // Whether there are so many errors that suggestions, which search all names, are not worth the time.
  [[nodiscard]] bool crowded() const { return size() > most_listed || looked_at_ > most_looked_at; }
  // Counts names searched for a suggestion.
  void look_at(std::size_t names) { looked_at_ += names; }

  // In order of the text; the first ones of very many.
  [[nodiscard]] std::vector<Problem> located(Severity severity, const std::string& file, const json::Tree& tree) const;

  static constexpr std::size_t most_listed = 400;

 private:
  static constexpr std::size_t most_looked_at = 400000;

  struct Entry {
    json::Fault fault;
    json::Value value;                      // its length is that of the fault, unless the fault has one
    std::optional<std::size_t> other = {};  // place of the other member involved
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
