#pragma once

// The content of a tree.

#include "json/json_tree.h"

namespace tweenfall::json {

// A value; for a member including its name, which comes before it.
struct Node {
  std::uint32_t offset;  // of the name for a member, else of the value
  std::uint32_t kind : 3;
  std::uint32_t faulty : 1;
  std::uint32_t escaped : 1;  // a text with escapes, which is stored decoded in `Content::decoded`
  std::uint32_t named : 1;
  std::uint32_t name_escaped : 1;
  std::uint32_t name_length : 25;  // bytes between its quotes
  struct Range {
    std::uint32_t first, size;
  };
  union {
    bool boolean;
    double number;
    Range text;      // bytes between the quotes
    Range children;  // nodes
  };
};
static_assert(sizeof(Node) == 16);

inline constexpr std::size_t longest_name = (std::size_t{1} << 25) - 1;

// A name or text with escapes, decoded.
struct Decoded {
  std::uint32_t offset;  // of the text between its quotes
  std::uint32_t first, size;
};

struct Content {
  std::string given;  // the original text, where `text` had to be repaired
  std::string text;   // the text to which the nodes' offsets refer: as long as the given one
  Rules rules;
  std::unique_ptr<Node[]> nodes;  // the children of each container side by side
  std::size_t size = 0;
  Node root;
  std::vector<Decoded> decoded;  // in order of the text
  std::string letters;           // the decoded texts

  [[nodiscard]] std::string_view between_quotes(Node::Range range, bool escaped) const;
  [[nodiscard]] std::string_view name(const Node& node) const;
  [[nodiscard]] std::size_t value_offset(const Node& node) const;
};

}  // namespace tweenfall::json
