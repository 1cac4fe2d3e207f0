#include "json/json_tree.h"

#include <tweenfall/curves/number_text.h>

#include "json/json_content.h"
#include "json/scan_json.h"

#include <algorithm>
#include <utility>

namespace tweenfall::json {

std::string_view Content::between_quotes(Node::Range range, bool escaped) const {
  if (!escaped) return std::string_view(text).substr(range.first, range.size);
  const auto found = std::lower_bound(decoded.begin(), decoded.end(), range.first,
                                      [](const Decoded& each, std::uint32_t offset) { return each.offset < offset; });
  return std::string_view(letters).substr(found->first, found->size);
}

std::string_view Content::name(const Node& node) const {
  return between_quotes({node.offset + 1, node.name_length}, node.name_escaped);
}

std::size_t Content::value_offset(const Node& node) const {
  if (!node.named) return node.offset;
  const std::size_t colon = skip_space(text, node.offset + node.name_length + 2, rules.comments);
  return skip_space(text, colon + 1, rules.comments);
}

Value::Kind Value::kind() const {
  return !node_ ? Kind::null : node_->faulty ? Kind::faulty : static_cast<Kind>(node_->kind);
}

bool Value::boolean() const {
  return is(Kind::boolean) && node_->boolean;
}

double Value::number() const {
  return is(Kind::number) ? node_->number : 0;
}

std::string_view Value::text() const {
  if (!node_ || static_cast<Kind>(node_->kind) != Kind::text) return {};
  return content_->between_quotes(node_->text, node_->escaped);
}

Items Value::items() const {
  return Items(*this);
}

Members Value::members() const {
  return Members(*this);
}

Value Value::find(std::string_view name) const {
  for (const Member& member : members())
    if (member.name == name) return member.value;
  return {};
}

std::size_t Value::offset() const {
  return node_ ? content_->value_offset(*node_) : 0;
}

std::size_t Value::length() const {
  if (!node_) return 0;
  const std::size_t from = offset();
  return value_end(content_->text, from, content_->rules.comments) - from;
}

std::size_t Member::name_offset() const {
  return value.node_->offset;
}

std::size_t Member::name_length() const {
  return value.node_->name_length + 2;
}

namespace {

// The stored kind, which does not change when a node is marked faulty: its parts are still there.
bool is_stored_as(const Node* node, Value::Kind kind) {
  return node && static_cast<Value::Kind>(node->kind) == kind;
}

}  // namespace
Items::Items(const Value& list) {
  if (!is_stored_as(list.node_, Value::Kind::list)) return;
  first_ = {list.content_, list.content_->nodes.get() + list.node_->children.first};
  size_ = list.node_->children.size;
}

Items Items::only(const Value& value) {
  Items items;
  items.first_ = value;
  items.size_ = value ? 1 : 0;
  return items;
}

Value Items::operator[](std::size_t i) const {
  return {first_.content_, first_.node_ + i};
}

Members::Members(const Value& object) {
  if (!is_stored_as(object.node_, Value::Kind::object)) return;
  first_ = {object.content_, object.content_->nodes.get() + object.node_->children.first};
  size_ = object.node_->children.size;
}

Member Members::operator[](std::size_t i) const {
  const Value value{first_.content_, first_.node_ + i};
  return {value.content_->name(*value.node_), value};
}

Tree::Tree() : content_(std::make_unique<Content>()) {
  content_->root = {};
  content_->root.faulty = 1;
}

Tree::~Tree() = default;
Tree::Tree(Tree&&) noexcept = default;
Tree& Tree::operator=(Tree&&) noexcept = default;

Value Tree::root() const {
  return {content_.get(), &content_->root};
}

std::string_view Tree::text() const {
  return content_->given.empty() ? content_->text : content_->given;
}

void Tree::mark_faulty(const Value& value) {
  Node& node = value.node_ == &content_->root
                   ? content_->root
                   : content_->nodes[static_cast<std::size_t>(value.node_ - content_->nodes.get())];
  node.faulty = 1;
}

std::string Tree::pointer_to(std::size_t offset) const {
  std::string pointer;
  Value at = root();
  if (at.is(Value::Kind::faulty) && content_->size == 0) return {};
  while (true) {
    const std::size_t from = at.offset();
    if (offset == from || at.node_->offset == offset) return pointer;
    if (is_stored_as(at.node_, Value::Kind::text))
      return offset > from && offset < from + at.length() ? pointer : std::string();
    if (!is_stored_as(at.node_, Value::Kind::list) && !is_stored_as(at.node_, Value::Kind::object)) return {};
    const Node* const first = content_->nodes.get() + at.node_->children.first;
    const Node* const last = first + at.node_->children.size;
    const Node* const after =
        std::upper_bound(first, last, offset, [](std::size_t place, const Node& node) { return place < node.offset; });
    if (after == first) return {};
    const Node* const inside = after - 1;
    pointer += '/';
    if (inside->named) {
      for (const char c : content_->name(*inside)) {
        if (c == '~')
          pointer += "~0";
        else if (c == '/')
          pointer += "~1";
        else
          pointer += c;
      }
    } else {
      pointer += std::to_string(inside - first);
    }
    at = {content_.get(), inside};
  }
}

std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    static constexpr std::string_view plain = "\"\\\b\f\n\r\t", names = "\"\\bfnrt";
    const std::size_t which = plain.find(c);
    if (which != std::string_view::npos) {
      out += '\\';
      out += names[which];
    } else if (static_cast<unsigned char>(c) < 0x20) {
      static constexpr char digits[] = "0123456789abcdef";
      out += "\\u00";
      out += digits[(c >> 4) & 15];
      out += digits[c & 15];
    } else {
      out += c;
    }
  }
  return out + '"';
}

namespace {

void append_on_one_line(std::string& out, const Value& value) {
  using Kind = Value::Kind;
  const char* gap = "";
  switch (value.kind()) {
    case Kind::null:
    case Kind::faulty:
      out += "null";
      return;
    case Kind::boolean:
      out += value.boolean() ? "true" : "false";
      return;
    case Kind::number:
      append_number(out, value.number());
      return;
    case Kind::text:
      out += in_quotes(value.text());
      return;
    case Kind::list:
      out += '[';
      for (const Value& item : value.items()) {
        out += std::exchange(gap, ", ");
        append_on_one_line(out, item);
      }
      out += ']';
      return;
    case Kind::object:
      out += '{';
      for (const Member& member : value.members()) {
        out += std::exchange(gap, ", ");
        out += in_quotes(member.name) + ": ";
        append_on_one_line(out, member.value);
      }
      out += '}';
      return;
  }
}

}  // namespace
std::string on_one_line(const Value& value) {
  std::string out;
  append_on_one_line(out, value);
  return out;
}

}  // namespace tweenfall::json
