#pragma once

// All that is wrong with one document, gathered while it is read; places are looked up at the end, once.

#include <tweenfall/importers/document.h>

#include "json/json_text.h"

#include <string>
#include <vector>

namespace tweenfall::document {

class Problems {
 public:
  void add(const JsonFault& fault) { faults_.push_back(fault); }
  void add(const JsonValue& at, std::string message);
  void add_name(const JsonMember& at, std::string message);
  // Problems of an imported file, at their places there.
  void add_foreign(std::vector<Problem> problems);

  [[nodiscard]] bool empty() const { return faults_.empty() && foreign_.empty(); }
  [[nodiscard]] std::size_t size() const { return faults_.size() + foreign_.size(); }

  // So many that suggestions, which look at all names, are no longer worth their time.
  [[nodiscard]] bool crowded() const { return size() > 500; }

  // In order of the text; `root` gives the pointers.
  [[nodiscard]] std::vector<Problem> located(const std::string& file, std::string_view text,
                                             const JsonValue& root) const;

 private:
  std::vector<JsonFault> faults_;
  std::vector<Problem> foreign_;
};

// A problem of a whole file.
[[nodiscard]] Problem file_problem(std::string file, std::string message);

}  // namespace tweenfall::document
