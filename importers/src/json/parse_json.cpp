#include "json/explain_json.h"
#include "json/json_content.h"
#include "json/scan_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <limits>
#include <utility>

namespace tweenfall::json {

namespace {

using Kind = Value::Kind;

// Iterates over a text and counts how far it is; the parser makes copies of it.
class CountingIterator {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  CountingIterator(const char* at, const char** reached) : at_(at), reached_(reached) {}
  reference operator*() const { return *at_; }
  CountingIterator& operator++() {
    *reached_ = ++at_;
    return *this;
  }
  bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
  bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** reached_;
};

// Removes members with repeated names from a row of members; returns how many are left.
class NamesOnce {
 public:
  NamesOnce(const Content& content, std::vector<Fault>& faults) : content_(content), faults_(faults) {}

  std::size_t left_of(Node* first, std::size_t count) {
    constexpr std::size_t most_looked_through = 16;
    kept_ = first;
    size_ = 0;
    if (count <= most_looked_through) {
      for (std::size_t i = 0; i < count; ++i) keep(first[i], looked_through(first[i]));
      return size_;
    }
    std::size_t places = 64;
    while (places < 2 * count) places *= 2;
    table_.assign(places, {0, 0});
    // A few at a time, so that their places are loaded from memory in parallel.
    constexpr std::size_t at_once = 16;
    std::array<std::size_t, at_once> hashes;
    for (std::size_t i = 0; i < count; ++i) {
      if (i % at_once == 0)
        for (std::size_t k = 0; k < std::min(at_once, count - i); ++k) {
          hashes[k] = std::hash<std::string_view>{}(content_.name(first[i + k]));
          fetch(place_of(hashes[k]));
        }
      keep(first[i], known(first[i], hashes[i % at_once]));
    }
    return size_;
  }

 private:
  [[nodiscard]] Node* looked_through(const Node& node) const {
    const std::string_view name = content_.name(node);
    for (std::size_t i = 0; i < size_; ++i) {
      const Node& kept = kept_[i];
      // Without escapes, names of different lengths are different.
      if (kept.name_length != node.name_length && !kept.name_escaped && !node.name_escaped) continue;
      if (content_.name(kept) == name) return kept_ + i;
    }
    return nullptr;
  }

  [[nodiscard]] Node* known(const Node& node, std::size_t hash) {
    const auto tag = static_cast<std::uint32_t>(hash >> (std::numeric_limits<std::size_t>::digits / 2));
    for (std::size_t place = hash;; ++place) {
      Place& entry = place_of(place);
      if (entry.number == 0) {
        entry = {tag, static_cast<std::uint32_t>(size_ + 1)};
        return nullptr;
      }
      if (entry.tag == tag && content_.name(kept_[entry.number - 1]) == content_.name(node))
        return kept_ + entry.number - 1;
    }
  }

  /// @param same the member kept with the same name; null for none
  void keep(const Node& node, Node* same) {
    if (!same) {
      kept_[size_++] = node;
    } else if (content_.rules.names_twice) {
      *same = node;
    } else {
      faults_.push_back({node.offset, node.name_length + std::size_t{2},
                         in_quotes(content_.name(node)) + " is given twice in one object; keep one of them"});
    }
  }

  // Names that share a place by chance mostly differ in the tag, so they need not be fetched from the text.
  struct Place {
    std::uint32_t tag, number;  // index of the member kept, from 1; 0 is free
  };

  Place& place_of(std::size_t hash) { return table_[hash & (table_.size() - 1)]; }

  static void fetch(const Place& place) {
#if defined(__GNUC__)
    __builtin_prefetch(&place, 1);
#else
    static_cast<void>(place);
#endif
  }

  const Content& content_;
  std::vector<Fault>& faults_;
  Node* kept_ = nullptr;
  std::size_t size_ = 0;
  std::vector<Place> table_;
};

// Makes nodes from the parser's events. Children of open containers wait at the high end of the nodes, the last one
// lowest, and move to the low end together when their container is closed.
class Builder {
 public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  Builder(Content& content, Survey& survey, std::vector<Fault>& faults)
      : content_(content),
        text_(content.text),
        faulty_(survey.faulty_values),
        faults_(faults),
        names_(content, faults),
        capacity_(survey.most_values),
        top_(survey.most_values) {
    content.nodes = std::make_unique_for_overwrite<Node[]>(capacity_);
    if (text_.starts_with("\xef\xbb\xbf")) last_end_ = 3;
  }

  bool whole() {
    const char* const end = text_.data() + text_.size();
    const bool right =
        nlohmann::json::sax_parse(CountingIterator(text_.data(), &reached_), CountingIterator(end, &reached_), this,
                                  nlohmann::json::input_format_t::json, true, content_.rules.comments);
    if (stopped_) return false;
    // The parser takes a byte of 0 for the end of the text.
    const bool at_end = skip_space(text_, last_end_, content_.rules.comments) == text_.size();
    if (right && at_end) {
      content_.root = content_.nodes[top_];
      return true;
    }
    explain();
    return false;
  }

  bool null() {
    return add(Kind::null, [](Node&) {});
  }
  bool boolean(bool value) {
    return add(Kind::boolean, [&](Node& node) { node.boolean = value; });
  }
  bool number_integer(number_integer_t value) {
    // The parser's integers have no -0.
    return number(value == 0 ? -0.0 : static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) { return number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) { return number(value); }
  bool binary(binary_t&) { return false; }

  bool string(string_t& value) {
    return add(Kind::text, [&](Node& node) {
      const std::size_t from = last_start_ + 1, size = last_end_ - from - 1;
      node.text = {static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(size)};
      node.escaped = keep_decoded(from, size, value);
    });
  }

  bool key(string_t& value) {
    name_offset_ = start();
    last_end_ = reached();
    name_length_ = last_end_ - name_offset_ - 2;
    if (name_length_ > longest_name) return stop(name_offset_, "a name this long has no use");
    name_escaped_ = keep_decoded(name_offset_ + 1, name_length_, value);
    named_ = true;
    return true;
  }

  bool start_object(std::size_t) { return open(true); }
  bool start_array(std::size_t) { return open(false); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  template <class Error>
  bool parse_error(std::size_t, const std::string&, const Error&) {
    return false;
  }

 private:
  struct Open {
    std::size_t bottom;  // where the children's stack ended when it was opened
    Node node;
  };

  [[nodiscard]] std::size_t reached() const { return static_cast<std::size_t>(reached_ - text_.data()); }

  // The start of the token that the parser has just reported: after the last one, and a comma or colon.
  [[nodiscard]] std::size_t start() const {
    const bool comments = content_.rules.comments;
    const std::size_t at = skip_space(text_, last_end_, comments);
    return at < text_.size() && (text_[at] == ',' || text_[at] == ':') ? skip_space(text_, at + 1, comments) : at;
  }

  bool keep_decoded(std::size_t from, std::size_t size, const std::string& decoded) {
    if (decoded.size() == size) return false;  // every escape is longer than its character
    content_.decoded.push_back({static_cast<std::uint32_t>(from), static_cast<std::uint32_t>(content_.letters.size()),
                                static_cast<std::uint32_t>(decoded.size())});
    content_.letters += decoded;
    return true;
  }

  [[nodiscard]] Node begun(Kind kind) {
    last_start_ = start();
    Node node{};
    node.offset = static_cast<std::uint32_t>(named_ ? name_offset_ : last_start_);
    node.kind = static_cast<unsigned>(kind) & 7u;
    node.named = named_;
    node.name_escaped = named_ && name_escaped_;
    node.name_length = named_ ? name_length_ & longest_name : 0;
    named_ = false;
    return node;
  }

  // The parser reads one byte more than the number where there is one, to see its end.
  [[nodiscard]] std::size_t number_end() const {
    const auto is_digit = [&](std::size_t at) { return at < text_.size() && text_[at] >= '0' && text_[at] <= '9'; };
    const std::size_t first = last_start_ + (text_[last_start_] == '-' ? 1 : 0), end = reached();
    if (text_[first] == '0' && is_digit(first + 1)) return first + 1;
    return is_digit(end - 1) ? end : end - 1;
  }

  bool number(double value) {
    return add(Kind::number, [&](Node& node) {
      last_end_ = number_end();
      node.number = value == 0 && text_[last_start_] != '-' ? 0.0 : value;
      if (next_faulty_ < faulty_.size() && faulty_[next_faulty_] == last_start_) {
        node.faulty = 1;
        ++next_faulty_;
      }
    });
  }

  template <class Fill>
  bool add(Kind kind, const Fill& fill) {
    Node node = begun(kind);
    last_end_ = reached();
    fill(node);
    return push(node);
  }

  bool push(const Node& node) {
    if (top_ <= content_.size) return stop(node.offset, "this text cannot be read");
    content_.nodes[--top_] = node;
    return true;
  }

  bool open(bool object) {
    Node node = begun(object ? Kind::object : Kind::list);
    last_end_ = reached();
    if (open_.size() >= deepest_nesting)
      return stop(last_start_, "nested more than " + std::to_string(deepest_nesting) + " deep; no document needs that");
    open_.push_back({top_, node});
    return true;
  }

  bool close() {
    last_end_ = reached();
    const auto [bottom, opened] = open_.back();
    open_.pop_back();
    Node node = opened;
    Node *const first = content_.nodes.get() + top_, *const kept = content_.nodes.get() + content_.size;
    std::size_t count = bottom - top_;
    if (kept + count <= first) {
      std::reverse_copy(first, first + count, kept);
    } else {  // the two ends are so near that they overlap
      std::reverse(first, first + count);
      std::copy(first, first + count, kept);
    }
    if (static_cast<Kind>(node.kind) == Kind::object) count = names_.left_of(kept, count);
    node.children = {static_cast<std::uint32_t>(content_.size), static_cast<std::uint32_t>(count)};
    content_.size += count;
    top_ = bottom;
    return push(node);
  }

  bool stop(std::size_t offset, std::string message) {
    faults_.push_back({offset, 1, std::move(message)});
    stopped_ = true;
    return false;
  }

  void explain() {
    Stop stop;
    stop.at = last_end_;
    if (open_.empty()) {
      stop.after = top_ == capacity_ ? Stop::After::nothing : Stop::After::whole;
    } else {
      const Open& inner = open_.back();
      const bool object = static_cast<Kind>(inner.node.kind) == Kind::object;
      const bool empty = top_ == inner.bottom;
      stop.open = content_.value_offset(inner.node);
      stop.after = named_   ? Stop::After::name
                   : empty  ? (object ? Stop::After::open_object : Stop::After::open_list)
                   : object ? Stop::After::value_in_object
                            : Stop::After::value_in_list;
      if (named_)
        stop.name = content_.between_quotes(
            {static_cast<std::uint32_t>(name_offset_ + 1), static_cast<std::uint32_t>(name_length_)}, name_escaped_);
    }
    faults_.push_back(explained(text_, stop, content_.rules.comments));
  }

  Content& content_;
  std::string_view text_;
  const std::vector<std::size_t>& faulty_;
  std::vector<Fault>& faults_;
  NamesOnce names_;
  std::size_t capacity_, top_;
  std::vector<Open> open_;
  const char* reached_ = text_.data();
  std::size_t last_start_ = 0, last_end_ = 0, next_faulty_ = 0;
  bool named_ = false, name_escaped_ = false, stopped_ = false;
  std::size_t name_offset_ = 0, name_length_ = 0;
};

/// By its mark, or by a byte of 0 in its first letter, which no JSON in UTF-8 has.
bool is_utf_16(std::string_view text) {
  return text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff") ||
         text.substr(0, 2).find('\0') != std::string_view::npos;
}

}  // namespace

Tree Tree::parse(std::string text, std::vector<Fault>& faults, const Rules& rules) {
  Tree tree;
  Content& content = *tree.content_;
  content.rules = rules;
  content.text = std::move(text);
  const std::size_t largest = std::min(rules.largest, largest_json_text);
  if (content.text.size() > largest) {
    faults.push_back({0, 1, "the text is larger than " + std::to_string(largest >> 20) + " MiB"});
    return tree;
  }
  if (is_utf_16(content.text)) {
    faults.push_back({0, 1, "this text is UTF-16; save it as UTF-8"});
    return tree;
  }
  Survey survey = json::survey(content.text, rules.comments);
  faults.insert(faults.end(), survey.faults.begin(), survey.faults.end());
  if (!survey.mended.empty()) content.given = std::exchange(content.text, std::move(survey.mended));
  if (!Builder(content, survey, faults).whole()) {
    content.nodes.reset();
    content.size = 0;
    content.root = {};
    content.root.faulty = 1;
  }
  return tree;
}

}  // namespace tweenfall::json
