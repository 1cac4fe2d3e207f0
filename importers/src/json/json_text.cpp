#include "json/json_text.h"

#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <utility>

namespace tweenfall {

namespace {

using Kind = JsonValue::Kind;

}  // namespace

const JsonValue* JsonValue::find(std::string_view name) const {
  for (const JsonMember& member : members)
    if (member.name == name) return &member.value;
  return nullptr;
}

JsonValue json_number(double number) {
  JsonValue value;
  value.kind = Kind::number;
  value.number = number;
  return value;
}

JsonValue json_text(std::string text) {
  JsonValue value;
  value.kind = Kind::text;
  value.text = std::move(text);
  return value;
}

JsonValue json_boolean(bool boolean) {
  JsonValue value;
  value.kind = Kind::boolean;
  value.boolean = boolean;
  return value;
}

JsonValue json_list(std::vector<JsonValue> items) {
  JsonValue value;
  value.kind = Kind::list;
  value.items = std::move(items);
  return value;
}

JsonValue json_object(std::vector<JsonMember> members) {
  JsonValue value;
  value.kind = Kind::object;
  value.members = std::move(members);
  return value;
}

void add_member(JsonValue& object, std::string name, JsonValue value) {
  object.members.push_back({std::move(name), 0, 0, std::move(value)});
}

bool same(const JsonValue& a, const JsonValue& b) {
  if (a.kind != b.kind) return false;
  switch (a.kind) {
    case Kind::null:
    case Kind::faulty:
      return true;
    case Kind::boolean:
      return a.boolean == b.boolean;
    case Kind::number:
      return a.number == b.number;
    case Kind::text:
      return a.text == b.text;
    case Kind::list:
      return std::equal(a.items.begin(), a.items.end(), b.items.begin(), b.items.end(), same);
    case Kind::object:
      break;
  }
  if (a.members.size() != b.members.size()) return false;
  return std::all_of(a.members.begin(), a.members.end(), [&](const JsonMember& member) {
    const JsonValue* other = b.find(member.name);
    return other && same(member.value, *other);
  });
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

std::string on_one_line(const JsonValue& value) {
  switch (value.kind) {
    case Kind::null:
    case Kind::faulty:
      return "null";
    case Kind::boolean:
      return value.boolean ? "true" : "false";
    case Kind::number:
      return number_text(value.number);
    case Kind::text:
      return in_quotes(value.text);
    case Kind::list: {
      std::string out = "[";
      for (const JsonValue& item : value.items) {
        if (out.size() > 1) out += ", ";
        out += on_one_line(item);
      }
      return out + "]";
    }
    case Kind::object:
      break;
  }
  std::string out = "{";
  for (const JsonMember& member : value.members) {
    if (out.size() > 1) out += ", ";
    out += in_quotes(member.name) + ": " + on_one_line(member.value);
  }
  return out + "}";
}

}  // namespace tweenfall
