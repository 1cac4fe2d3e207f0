#include "document/write/write.h"

#include <tweenfall/curves/number_text.h>

#include <initializer_list>
#include <utility>
#include <vector>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

constexpr std::size_t line_width = 110;

// A part of a list or an object to be written, with its form if it has one.
struct Part {
  std::string_view name;  // of a member
  json::Value value;
  const Form* form = nullptr;
};

// What is written for a value: itself, or its parts in the order of the table.
struct Written {
  json::Value value;
  const Form* form = nullptr;  // as it was resolved
  char open = 0;               // '[' or '{'; 0 if it has no parts
  std::vector<Part> parts{};
};

Written written(const Form* form, const json::Value& value);

// Appends its text on one line; stops once that is longer than `most` bytes.
void append_line(std::string& out, const Written& what, std::size_t most) {
  if (what.open == 0) {
    out += json::on_one_line(what.value);
    return;
  }
  const char* gap = "";
  out += what.open;
  for (const Part& part : what.parts) {
    if (out.size() > most) return;
    out += std::exchange(gap, ", ");
    if (what.open == '{') out += json::in_quotes(part.name) + ": ";
    append_line(out, written(part.form, part.value), most);
  }
  out += what.open == '[' ? ']' : '}';
}

std::string line_of(const Written& what, std::size_t most) {
  std::string out;
  append_line(out, what, most);
  return out;
}

// Whether a member has its default value.
bool says_nothing(const Field& field, const json::Value& value) {
  if (field.required || field.standard.empty()) return false;
  const std::string line = line_of(written(field.form, value), field.standard.size() + 2);
  return line == field.standard || line == "{}";
}

Written of_list(const Form& form, const json::Value& value) {
  Written out{value, &form, '[', {}};
  std::size_t i = 0;
  for (const json::Value& item : value.items()) {
    const Form* const below = form.kind == Form::Kind::list                             ? form.element
                              : form.kind == Form::Kind::tuple && i < form.parts.size() ? form.parts[i]
                                                                                        : nullptr;
    out.parts.push_back({{}, item, below});
    ++i;
  }
  // The third element of a key is its ease.
  if (form.kind == Form::Kind::tuple && out.parts.size() == 3 && form.parts[2]->definition == "ease" &&
      out.parts[2].value.text() == "smooth-clamped")
    out.parts.pop_back();
  return out;
}

// Objects are replaced by a shorter form where one exists: a key of time, value and ease by a row, a track with only
// keys by its keys.
Written shorter(const Form& form, Written object) {
  const auto has_only = [&](std::initializer_list<std::string_view> names) {
    for (const Part& part : object.parts) {
      bool known = false;
      for (const std::string_view name : names) known = known || part.name == name;
      if (!known) return false;
    }
    return true;
  };
  if (form.field("t") && form.field("v") && has_only({"t", "v", "ease"})) {
    object.open = '[';
    return object;
  }
  if (object.parts.size() != 1) return object;
  const Part& only = object.parts.front();
  const Field* const keys = form.field("keys");
  if (keys && only.name == "keys" && keys->form->kind == Form::Kind::list) {
    for (const Field& field : form.fields)
      if (field.required) return object;
    return written(only.form, only.value);
  }
  if (form.field("source") && only.name == "source") return written(only.form, only.value);
  return object;
}

Written of_object(const Form& form, const json::Value& value) {
  Written out{value, &form, '{', {}};
  for (const Field& field : form.fields)
    if (const json::Value member = value.find(field.name); member && !says_nothing(field, member))
      out.parts.push_back({field.name, member, field.form});
  for (const json::Member& member : value.members())
    if (!form.field(member.name))
      out.parts.push_back({member.name, member.value, is_free_name(member.name) ? nullptr : form.member(member.name)});
  return shorter(form, std::move(out));
}

Written written(const Form* form, const json::Value& value) {
  static const Form any;
  const Form* const chosen = form ? resolved(*form, value) : nullptr;
  if (value.is(Kind::list)) return of_list(chosen ? *chosen : any, value);
  if (value.is(Kind::object)) return of_object(chosen ? *chosen : any, value);
  return {value, chosen, 0, {}};
}

class Writer {
 public:
  void write(const Form* form, const json::Value& value, std::size_t indent, std::size_t column) {
    const Written what = written(form, value);
    const bool on_one_line = what.form && what.form->on_one_line, one_per_line = what.form && what.form->one_per_line;
    const std::size_t room = line_width - std::min(column, line_width);
    if (on_one_line || !has_parts(what)) {
      append_line(out, what, static_cast<std::size_t>(-1));
      return;
    }
    if (!one_per_line) {
      if (const std::string line = line_of(what, room); line.size() <= room) {
        out += line;
        return;
      }
    }
    const std::string inner(indent + 2, ' ');
    out += what.open;
    const char* gap = "\n";
    for (const Part& part : what.parts) {
      out += std::exchange(gap, ",\n");
      out += inner;
      const std::string name = what.open == '{' ? json::in_quotes(part.name) + ": " : std::string();
      out += name;
      write(part.form, part.value, indent + 2, indent + 2 + name.size());
    }
    out += "\n" + std::string(indent, ' ') + (what.open == '[' ? "]" : "}");
  }

  std::string out;

 private:
  // Rows of plain numbers stay rows, however long.
  static bool has_parts(const Written& what) {
    if (what.open == '{') return !what.parts.empty();
    for (const Part& part : what.parts)
      if (part.value.is(Kind::list) || part.value.is(Kind::object) || part.value.is(Kind::text)) return true;
    return false;
  }
};

}  // namespace

std::string write(const Form& form, const json::Value& value) {
  Writer writer;
  writer.write(&form, value, 0, 0);
  return writer.out + "\n";
}

}  // namespace tweenfall::document
