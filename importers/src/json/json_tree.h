#pragma once

// JSON text as a compact tree that remembers where each value stands: sixteen bytes for each value, and no copy of any
// text in it. Names and texts are read where they stand; only those with escapes are kept decoded. Children lie side by
// side, so that a list is reached into at once.

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

class JsonItems;
class JsonMembers;

namespace json_tree {

struct JsonNode;
struct Content;

}  // namespace json_tree

// One value of a tree, or none. It is small and copied freely, and lives no longer than its tree.
class JsonValue {
 public:
  // `faulty` is a value that was reported already; whoever meets it goes on as if it were not there.
  enum class Kind { null, boolean, number, text, list, object, faulty };

  JsonValue() = default;
  explicit operator bool() const { return node_ != nullptr; }                     // whether there is a value
  bool operator==(const JsonValue& other) const { return node_ == other.node_; }  // the same place of the same tree

  [[nodiscard]] Kind kind() const;
  [[nodiscard]] bool is(Kind kind) const { return node_ && this->kind() == kind; }

  // Nothing of use (false, 0, "", no items, no members) from values of other kinds.
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] double number() const;
  [[nodiscard]] std::string_view text() const;
  [[nodiscard]] JsonItems items() const;
  [[nodiscard]] JsonMembers members() const;                  // in the order of the text
  [[nodiscard]] JsonValue find(std::string_view name) const;  // none when absent or not an object

  [[nodiscard]] std::size_t offset() const;  // of the value's first byte
  [[nodiscard]] std::size_t length() const;  // bytes; found by reading on to the value's end

 private:
  friend class JsonTree;
  friend class JsonItems;
  friend class JsonMembers;
  friend struct JsonMember;
  JsonValue(const json_tree::Content* content, const json_tree::JsonNode* node) : content_(content), node_(node) {}

  const json_tree::Content* content_ = nullptr;
  const json_tree::JsonNode* node_ = nullptr;
};

struct JsonMember {
  std::string_view name;
  JsonValue value;

  [[nodiscard]] std::size_t name_offset() const;
  [[nodiscard]] std::size_t name_length() const;  // with its quotes
};

// The parts of a container; `Part` is what one of them is handed out as.
template <class Range, class Part>
class JsonIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = Part;
  using difference_type = std::ptrdiff_t;
  using pointer = const Part*;
  using reference = Part;

  JsonIterator(const Range& range, std::size_t at) : range_(range), at_(at) {}
  Part operator*() const { return range_[at_]; }
  JsonIterator& operator++() {
    ++at_;
    return *this;
  }
  bool operator==(const JsonIterator& other) const { return at_ == other.at_; }

 private:
  Range range_;
  std::size_t at_;
};

class JsonItems {
 public:
  using Iterator = JsonIterator<JsonItems, JsonValue>;

  JsonItems() = default;
  explicit JsonItems(const JsonValue& list);
  // A list of one value that stands anywhere.
  static JsonItems only(const JsonValue& value);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] JsonValue operator[](std::size_t i) const;
  [[nodiscard]] JsonValue front() const { return (*this)[0]; }
  [[nodiscard]] JsonValue back() const { return (*this)[size_ - 1]; }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size_}; }

 private:
  JsonValue first_{};
  std::size_t size_ = 0;
};

class JsonMembers {
 public:
  using Iterator = JsonIterator<JsonMembers, JsonMember>;

  JsonMembers() = default;
  explicit JsonMembers(const JsonValue& object);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] JsonMember operator[](std::size_t i) const;
  [[nodiscard]] JsonMember front() const { return (*this)[0]; }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size_}; }

 private:
  JsonValue first_{};
  std::size_t size_ = 0;
};

// Something wrong at a place of the text.
struct JsonFault {
  std::size_t offset = 0, length = 1;
  std::string message;
};

inline constexpr std::size_t deepest_nesting = 200;
inline constexpr std::size_t largest_json_text = std::size_t{1} << 31;  // bytes

// What a text may hold beyond plain JSON, and how much.
struct JsonRules {
  bool comments = true;  // accepted and dropped
  // Of a name given twice in one object the last value counts; else it is a fault and the first does.
  bool names_twice = false;
  std::size_t largest = largest_json_text;  // bytes, at most as many
};

// A whole text and the values in it.
class JsonTree {
 public:
  JsonTree();  // of no text, with a faulty root
  ~JsonTree();
  JsonTree(JsonTree&&) noexcept;
  JsonTree& operator=(JsonTree&&) noexcept;

  // Reads on past what can be read past, so that one fault does not hide the others; the root is faulty where it
  // cannot. Commas too many, texts in single quotes, numbers that are none and members given twice can be.
  [[nodiscard]] static JsonTree parse(std::string text, std::vector<JsonFault>& faults, const JsonRules& rules = {});

  [[nodiscard]] JsonValue root() const;
  [[nodiscard]] std::string_view text() const;  // as it was given

  // Makes a value of this tree one that was reported.
  void mark_faulty(const JsonValue& value);

  // JSON pointer of the value, name or text in which a byte stands; empty where it stands between them.
  [[nodiscard]] std::string pointer_to(std::size_t offset) const;

 private:
  std::unique_ptr<json_tree::Content> content_;
};

// Writing on one line
[[nodiscard]] std::string in_quotes(std::string_view text);
[[nodiscard]] std::string on_one_line(const JsonValue& value);

}  // namespace tweenfall
