#pragma once

// The JSON values that a place of a document may hold. One table of forms (grammar.h) drives the reader's checks, its
// "did you mean", the writer's layout and defaults, and the JSON Schema, so that the four cannot disagree.

#include "json/json_tree.h"

#include <deque>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace tweenfall::document {

struct Form;

struct Field {
  std::string name;
  const Form* form = nullptr;
  std::string help{};
  bool required = false;
  std::string standard{};                // JSON text of the default; a member with this value is not written
  std::vector<std::string> elsewhere{};  // names in other programs, in lower case
};

// A rule about combinations of members.
struct Together {
  enum class Rule { exactly_one, at_most_one, first_needs_second };
  Rule rule;
  std::vector<std::string> names;
  std::string otherwise{};  // text after "give one of them": an alternative
};

// Forms of members with names chosen by the author, by the ending of the name.
struct Ending {
  std::string ending;
  const Form* form = nullptr;
};

struct Form {
  enum class Kind { any, number, boolean, text, list, tuple, object, choice };
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr std::size_t no_limit = static_cast<std::size_t>(-1);

  Kind kind = Kind::any;
  std::string what{};        // "a mass in kg, above 0": completes "expected ..."
  std::string definition{};  // its name in the schema; empty: written in full where it is used

  // number
  double low = -infinite, high = infinite;
  bool above_low = false;  // low itself is excluded
  bool whole = false;

  // boolean
  bool only_true = false;

  // What to write instead of a value of another kind, "; say ...", or empty
  std::function<std::string(const json::Value&)> instead{};

  // text: one of `words`, or anything of `pattern` (ECMA 262); no limit when both are empty
  std::vector<std::string> words{};
  std::string pattern{};
  std::function<bool(std::string_view)> fits{};        // the same as the pattern
  std::function<std::string(std::string_view)> why{};  // explains why a text does not fit; may be empty
  std::vector<std::string> hints{};                    // words to suggest beside `words`

  // list
  const Form* element = nullptr;
  std::size_t fewest = 0, most = no_limit;

  // tuple: the first `fewest` are required
  std::vector<const Form*> parts{};

  // object
  std::vector<Field> fields{};
  std::vector<Together> together{};
  std::vector<Ending> endings{};                              // names of the author's
  const Form* others = nullptr;                               // all other author's names; null: none are allowed
  std::string name_pattern{};                                 // pattern for author's names
  std::function<std::string(std::string_view)> name_fault{};  // what is wrong with such a name, or empty
  // The known name that an author's name may be meant for, or empty
  std::function<std::string(std::string_view)> name_meant{};
  std::function<std::string(std::string_view)> said_of{};           // "; ..." about an unknown name, or empty
  std::function<std::string(const json::Value&)> foremost_fault{};  // one that makes others irrelevant, or empty

  // choice: the first alternative of the value's kind, or the one that `select` names
  std::vector<const Form*> alternatives{};
  std::function<const Form*(const json::Value&)> select{};

  // Writing
  bool one_per_line = false;  // each member or item on its own line, however short
  bool on_one_line = false;   // never broken

  [[nodiscard]] const Field* field(std::string_view name) const;
  [[nodiscard]] const Form* member(std::string_view name) const;  // form of a member's value; null: no such name
  [[nodiscard]] std::vector<std::string> field_names() const;
  // The field that has this name in other programs, or empty.
  [[nodiscard]] std::string field_called(std::string_view name) const;
  // The field meant by an unknown name: the one with this name in other programs, or the nearest; or empty.
  [[nodiscard]] std::string field_meant(std::string_view name) const;
};

// Names that start with "//" or "x-" are the author's own and ignored.
[[nodiscard]] bool is_free_name(std::string_view name);

// The alternative that applies to a value (through nested choices); null when the value's kind fits none.
[[nodiscard]] const Form* resolved(const Form& form, const json::Value& value);

// Forms live as long as the store.
class FormStore {
 public:
  const Form* add(Form form);
  Form* reserve();  // for forms that are referred to before they are made

 private:
  std::deque<Form> forms_;
};

}  // namespace tweenfall::document
