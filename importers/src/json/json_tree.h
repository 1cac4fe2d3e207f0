#pragma once

// JSON text as a compact tree that remembers the place of each value: sixteen bytes for each value, and no copies of
// texts. Names and texts are read in place; only those with escapes are stored decoded. Children are stored side by
// side, so that elements of lists are found directly.

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::json {

class Items;
class Members;

struct Node;
struct Content;

// One value of a tree, or none. It is small and cheap to copy, and must not outlive its tree.
class Value {
 public:
  // `faulty` is a value that was reported already; readers treat it as absent.
  enum class Kind { null, boolean, number, text, list, object, faulty };

  Value() = default;
  explicit operator bool() const { return node_ != nullptr; }                 // whether there is a value
  bool operator==(const Value& other) const { return node_ == other.node_; }  // the same place of the same tree

  [[nodiscard]] Kind kind() const;
  [[nodiscard]] bool is(Kind kind) const { return node_ && this->kind() == kind; }

  // For values of other kinds, an empty result (false, 0, "", no items, no members).
  [[nodiscard]] bool boolean() const;
  [[nodiscard]] double number() const;
  [[nodiscard]] std::string_view text() const;
  [[nodiscard]] Items items() const;
  [[nodiscard]] Members members() const;                  // in the order of the text
  [[nodiscard]] Value find(std::string_view name) const;  // none when absent or not an object

  [[nodiscard]] std::size_t offset() const;  // of the value's first byte
  [[nodiscard]] std::size_t length() const;  // bytes; found by scanning to the value's end

 private:
  friend class Tree;
  friend class Items;
  friend class Members;
  friend struct Member;
  Value(const Content* content, const Node* node) : content_(content), node_(node) {}

  const Content* content_ = nullptr;
  const Node* node_ = nullptr;
};

struct Member {
  std::string_view name;
  Value value;

  [[nodiscard]] std::size_t name_offset() const;
  [[nodiscard]] std::size_t name_length() const;  // with its quotes
};

// The parts of a container; `Part` is the type of its elements.
template <class Range, class Part>
class PartIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = Part;
  using difference_type = std::ptrdiff_t;
  using pointer = const Part*;
  using reference = Part;

  PartIterator(const Range& range, std::size_t at) : range_(range), at_(at) {}
  Part operator*() const { return range_[at_]; }
  PartIterator& operator++() {
    ++at_;
    return *this;
  }
  bool operator==(const PartIterator& other) const { return at_ == other.at_; }

 private:
  Range range_;
  std::size_t at_;
};

class Items {
 public:
  using Iterator = PartIterator<Items, Value>;

  Items() = default;
  explicit Items(const Value& list);
  // A list of a single value from anywhere.
  static Items only(const Value& value);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] Value operator[](std::size_t i) const;
  [[nodiscard]] Value front() const { return (*this)[0]; }
  [[nodiscard]] Value back() const { return (*this)[size_ - 1]; }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size_}; }

 private:
  Value first_{};
  std::size_t size_ = 0;
};

class Members {
 public:
  using Iterator = PartIterator<Members, Member>;

  Members() = default;
  explicit Members(const Value& object);

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] Member operator[](std::size_t i) const;
  [[nodiscard]] Member front() const { return (*this)[0]; }
  [[nodiscard]] Iterator begin() const { return {*this, 0}; }
  [[nodiscard]] Iterator end() const { return {*this, size_}; }

 private:
  Value first_{};
  std::size_t size_ = 0;
};

// Something wrong at a place of the text.
struct Fault {
  std::size_t offset = 0, length = 1;
  std::string message;
};

inline constexpr std::size_t deepest_nesting = 200;
inline constexpr std::size_t largest_json_text = std::size_t{1} << 31;  // bytes

// What a text may contain beyond plain JSON, and how much.
struct Rules {
  bool comments = true;  // accepted and dropped
  // If a name is given twice in one object, the last value counts; otherwise that is a fault and the first one counts.
  bool names_twice = false;
  std::size_t largest = largest_json_text;  // greatest number of bytes
};

// A whole text and the values in it.
class Tree {
 public:
  Tree();  // of no text, with a faulty root
  ~Tree();
  Tree(Tree&&) noexcept;
  Tree& operator=(Tree&&) noexcept;

  // Continues after faults where possible, so that one fault does not hide the others; where it cannot, the root is
  // faulty. It can after extra commas, texts in single quotes, invalid numbers and members given twice.
  [[nodiscard]] static Tree parse(std::string text, std::vector<Fault>& faults, const Rules& rules = {});

  [[nodiscard]] Value root() const;
  [[nodiscard]] std::string_view text() const;  // as it was given

  // Marks a value of this tree as reported.
  void mark_faulty(const Value& value);

  // JSON pointer of the value, name or text that contains a byte; empty where the byte is between them.
  [[nodiscard]] std::string pointer_to(std::size_t offset) const;

 private:
  std::unique_ptr<Content> content_;
};

// Writing on one line
[[nodiscard]] std::string in_quotes(std::string_view text);
[[nodiscard]] std::string on_one_line(const Value& value);

}  // namespace tweenfall::json
