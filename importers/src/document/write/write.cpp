#include "document/write/write.h"

#include "document/report/check.h"

#include <optional>
#include <utility>

namespace tweenfall::document {

namespace {

using Kind = JsonValue::Kind;

constexpr std::size_t line_width = 110;

// Members that only stand for one thing give way to that thing: a key of time, value and ease is a row, a track of
// keys alone is its keys.
std::optional<JsonValue> shorter(const Shape& shape, const JsonValue& value) {
  const auto has_only = [&](std::initializer_list<std::string_view> names) {
    for (const JsonMember& member : value.members) {
      bool known = false;
      for (const std::string_view name : names) known = known || member.name == name;
      if (!known) return false;
    }
    return true;
  };
  if (shape.field("t") && shape.field("v") && has_only({"t", "v", "ease"})) {
    JsonValue row = json_list({*value.find("t"), *value.find("v")});
    if (const JsonValue* ease = value.find("ease")) row.items.push_back(*ease);
    return row;
  }
  const Field* keys = shape.field("keys");
  if (keys && value.members.size() == 1 && value.find("keys") && keys->shape->kind == Shape::Kind::list) {
    for (const Field& field : shape.fields)
      if (field.required) return {};
    return *value.find("keys");
  }
  if (shape.field("source") && value.members.size() == 1 && value.find("source")) return *value.find("source");
  return {};
}

// The same value in the order of the table, without what says a default.
JsonValue in_order(const Shape& shape, const JsonValue& value) {
  const Shape* chosen = resolved(shape, value);
  if (!chosen) return value;
  JsonValue out = value;
  switch (chosen->kind) {
    case Shape::Kind::list:
      for (JsonValue& item : out.items) item = in_order(*chosen->element, item);
      return out;
    case Shape::Kind::tuple:
      for (std::size_t i = 0; i < out.items.size() && i < chosen->parts.size(); ++i)
        out.items[i] = in_order(*chosen->parts[i], out.items[i]);
      // The third of a key is its ease.
      if (out.items.size() == 3 && chosen->parts[2]->definition == "ease" && out.items[2].text == "smooth-clamped")
        out.items.pop_back();
      return out;
    case Shape::Kind::object:
      break;
    default:
      return out;
  }
  out.members.clear();
  for (const Field& field : chosen->fields) {
    const JsonValue* member = value.find(field.name);
    if (!member) continue;
    JsonValue written = in_order(*field.shape, *member);
    if (!field.required && !field.standard.empty()) {
      std::vector<JsonFault> faults;
      if (same(written, parse_json(field.standard, faults))) continue;
      if (written.is(Kind::object) && written.members.empty()) continue;
    }
    add_member(out, field.name, std::move(written));
  }
  for (const JsonMember& member : value.members) {
    if (chosen->field(member.name)) continue;
    const Shape* expected = is_free_name(member.name) ? nullptr : chosen->member(member.name);
    add_member(out, member.name, expected ? in_order(*expected, member.value) : member.value);
  }
  if (std::optional<JsonValue> brief = shorter(*chosen, out)) return *brief;
  return out;
}

class Writer {
 public:
  void value(const Shape* shape, const JsonValue& value, std::size_t indent, std::size_t column) {
    const Shape* chosen = shape ? resolved(*shape, value) : nullptr;
    const bool many = value.is(Kind::list) ? !value.items.empty() : value.is(Kind::object) && !value.members.empty();
    const std::string line = on_one_line(value);
    const bool fits = column + line.size() <= line_width;
    if (!many || (chosen && chosen->on_one_line) || (fits && !(chosen && chosen->one_a_line)) || !has_parts(value)) {
      out += line;
      return;
    }
    const std::string inner(indent + 2, ' ');
    out += value.is(Kind::list) ? "[" : "{";
    bool first = true;
    const auto next = [&] {
      out += first ? "\n" : ",\n";
      out += inner;
      first = false;
    };
    for (std::size_t i = 0; i < value.items.size(); ++i) {
      next();
      this->value(item_shape(chosen, i), value.items[i], indent + 2, indent + 2);
    }
    for (const JsonMember& member : value.members) {
      next();
      const std::string name = in_quotes(member.name) + ": ";
      out += name;
      const Shape* below = !chosen || is_free_name(member.name) ? nullptr : chosen->member(member.name);
      this->value(below, member.value, indent + 2, indent + 2 + name.size());
    }
    out += "\n" + std::string(indent, ' ') + (value.is(Kind::list) ? "]" : "}");
  }

  std::string out;

 private:
  // Rows of plain numbers stay rows, however long.
  static bool has_parts(const JsonValue& value) {
    if (value.is(Kind::object)) return true;
    for (const JsonValue& item : value.items)
      if (item.is(Kind::list) || item.is(Kind::object) || item.is(Kind::text)) return true;
    return false;
  }

  static const Shape* item_shape(const Shape* list, std::size_t i) {
    if (!list) return nullptr;
    if (list->kind == Shape::Kind::list) return list->element;
    return list->kind == Shape::Kind::tuple && i < list->parts.size() ? list->parts[i] : nullptr;
  }
};

}  // namespace

std::string write(const Shape& shape, const JsonValue& value) {
  Writer writer;
  writer.value(&shape, in_order(shape, value), 0, 0);
  return writer.out + "\n";
}

}  // namespace tweenfall::document
