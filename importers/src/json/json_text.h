#pragma once

// JSON text as a tree that remembers where each value stands. What can be read past is read past, so that one fault
// does not hide the others.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

struct JsonMember;

struct JsonValue {
  // `faulty` is a value that was reported already; whoever meets it goes on as if it were not there.
  enum class Kind { null, boolean, number, text, list, object, faulty };

  Kind kind = Kind::null;
  bool boolean = false;
  double number = 0;
  std::size_t offset = 0;  // of the value's first byte
  std::size_t length = 0;  // bytes
  std::string text{};
  std::vector<JsonValue> items{};
  std::vector<JsonMember> members;  // in the order of the text

  [[nodiscard]] bool is(Kind other) const { return kind == other; }
  [[nodiscard]] const JsonValue* find(std::string_view name) const;  // null when absent or not an object
};

struct JsonMember {
  std::string name;
  std::size_t name_offset = 0, name_length = 0;
  JsonValue value;
};

// Something wrong at a place of the text.
struct JsonFault {
  std::size_t offset = 0, length = 1;
  std::string message;
};

inline constexpr std::size_t deepest_nesting = 200;
inline constexpr std::size_t largest_text = std::size_t{1} << 28;  // bytes

// What a text may hold beyond plain JSON, and how much.
struct JsonRules {
  bool comments = true;  // accepted and dropped
  // Of a name given twice in one object the last value counts; else it is a fault and the first does.
  bool names_twice = false;
  std::size_t largest = largest_text;
};

// The tree of `text`. Syntax errors end the reading; members given twice and numbers that are none do not.
[[nodiscard]] JsonValue parse_json(std::string_view text, std::vector<JsonFault>& faults, const JsonRules& rules = {});

// Where a byte of a text stands.
struct TextPlace {
  std::size_t line = 1, column = 1;  // in characters
};

[[nodiscard]] TextPlace place_in(std::string_view text, std::size_t offset);

// Making trees
[[nodiscard]] JsonValue json_number(double number);
[[nodiscard]] JsonValue json_text(std::string text);
[[nodiscard]] JsonValue json_boolean(bool boolean);
[[nodiscard]] JsonValue json_list(std::vector<JsonValue> items);
[[nodiscard]] JsonValue json_object(std::vector<JsonMember> members = {});
void add_member(JsonValue& object, std::string name, JsonValue value);

// Equal as data, wherever they stand; members in any order.
[[nodiscard]] bool same(const JsonValue& a, const JsonValue& b);

// Writing on one line
[[nodiscard]] std::string in_quotes(std::string_view text);
[[nodiscard]] std::string on_one_line(const JsonValue& value);

}  // namespace tweenfall
