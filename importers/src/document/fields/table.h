#pragma once

// Fields of the things that a document describes, one row for each. A row defines what the field may hold (and with it
// the checks and the schema), how it is read, and its default (which is not written).

#include <tweenfall/curves/color.h>
#include <tweenfall/curves/pose.h>

#include "document/content.h"
#include "document/grammar/grammar_parts.h"
#include "document/read/values.h"
#include "document/report/spellings.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tweenfall::document::fields {

// What a field may hold: a shared form, one of its own, or one made from others.
class FormOf {
 public:
  using Make = std::function<const Form*(FormStore&, const ValueForms&)>;

  FormOf(const Form* ValueForms::*shared)
      : make_([shared](FormStore&, const ValueForms& values) { return values.*shared; }) {}
  FormOf(Form own) : make_([own = std::move(own)](FormStore& store, const ValueForms&) { return store.add(own); }) {}
  FormOf(Make make) : make_(std::move(make)) {}
  FormOf(const Form* (*make)(FormStore&, const ValueForms&)) : make_(make) {}

  [[nodiscard]] const Form* in(FormStore& store, const ValueForms& values) const { return make_(store, values); }

 private:
  Make make_;
};

// The effect of a field on its thing.
template <class Thing>
struct Meaning {
  std::function<void(const json::Value&, Thing&, Building&)> read;
  std::string standard{};  // JSON text of the default; empty if there is none in JSON
};

// Copies a value to a member; a value that was reported already leaves the member unchanged.
void take(const json::Value& value, double& out, Building& building);
void take(const json::Value& value, int& out, Building& building);
void take(const json::Value& value, bool& out, Building& building);
void take(const json::Value& value, std::string& out, Building& building);
void take(const json::Value& value, std::optional<double>& out, Building& building);
void take(const json::Value& value, std::optional<Color>& out, Building& building);
void take(const json::Value& value, Vec3& out, Building& building);
void take(const json::Value& value, Quat& out, Building& building);

// The JSON text of a member's default; empty if there is none.
[[nodiscard]] std::string text_of_default(double value);
[[nodiscard]] std::string text_of_default(bool value);
[[nodiscard]] std::string text_of_default(const Vec3& value);
template <class Other>
[[nodiscard]] std::string text_of_default(const Other&) {
  return {};
}
[[nodiscard]] inline std::string text_of_default(int value) {
  return text_of_default(static_cast<double>(value));
}

// A member that holds the value; `access` is a pointer to it or a function that gives it.
template <class Thing, class Access>
[[nodiscard]] Meaning<Thing> member(Access access) {
  Thing fresh{};
  return {[access](const json::Value& value, Thing& thing, Building& building) {
            take(value, std::invoke(access, thing), building);
          },
          text_of_default(std::invoke(access, fresh))};
}

// A vector in degrees or degrees/s whose member holds radians.
template <class Thing, class Access>
[[nodiscard]] Meaning<Thing> turning(Access access) {
  return {[access](const json::Value& value, Thing& thing, Building&) {
            const std::optional<Vec3> given = vector_of(value);
            if (given)
              std::invoke(access, thing) = Vec3(radians((*given)[0]), radians((*given)[1]), radians((*given)[2]));
          },
          text_of_default(Vec3(0, 0, 0))};
}

template <class Thing>
struct Row {
  std::string name;
  FormOf form;
  std::string help;
  Meaning<Thing> meaning;
  bool required = false;
  // Why the field has no effect for this thing, to follow "means nothing"; empty if it has an effect.
  std::function<std::string(const Thing&)> useless{};
  std::vector<std::string> elsewhere{};  // names in other programs, in lower case
};

template <class Thing>
class Table {
 public:
  // `what` completes "expected ...": "a drive".
  Table(std::string what, std::vector<Row<Thing>> rows) : what_(std::move(what)), rows_(std::move(rows)) {}

  // The form of an object with these fields.
  [[nodiscard]] Form form(FormStore& store, const ValueForms& values) const {
    std::vector<Field> fields;
    for (const Row<Thing>& row : rows_)
      fields.push_back({row.name, row.form.in(store, values), row.help, row.required,
                        row.required ? std::string() : row.meaning.standard, row.elsewhere});
    return object_of(what_, std::move(fields));
  }
  // The same, with a message that lists the fields.
  [[nodiscard]] Form listing_form(FormStore& store, const ValueForms& values) const {
    Form out = form(store, values);
    out.what += ": {";
    for (const Row<Thing>& row : rows_) out.what += (&row == &rows_.front() ? "" : ", ") + json::in_quotes(row.name);
    out.what += "}";
    return out;
  }
  // The form of an object with exactly one of these fields.
  [[nodiscard]] Form choosing_form(FormStore& store, const ValueForms& values) const {
    Form out = form(store, values);
    out.what += ": one of ";
    for (const Row<Thing>& row : rows_) out.what += (&row == &rows_.front() ? "" : ", ") + json::in_quotes(row.name);
    out.together = {exactly_one(names())};
    out.instead = [kinds = names()](const json::Value& value) { return kind_meant(value, kinds); };
    out.foremost_fault = [kinds = names(), what = what_](const json::Value& value) {
      const std::string meant = kind_meant(value, kinds);
      return meant.empty() ? meant : what + " says its kind by the name of its one field" + meant;
    };
    return out;
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const Row<Thing>& row : rows_) out.push_back(row.name);
    return out;
  }

  // Reads the object's fields, row by row, then reports fields that have no effect beside the others.
  void read(const json::Value& object, Thing& thing, Building& building) const {
    for (const Row<Thing>& row : rows_)
      if (const json::Value value = usable(object, row.name)) row.meaning.read(value, thing, building);
    for (const Row<Thing>& row : rows_) {
      const json::Value value = row.useless ? usable(object, row.name) : json::Value();
      if (!value) continue;
      if (const std::string why = row.useless(thing); !why.empty())
        building.problems.add(value, json::in_quotes(row.name) + " means nothing " + why);
    }
  }

 private:
  std::string what_;
  std::vector<Row<Thing>> rows_;
};

// The rows of a part, for the thing that contains it. @param access gives the thing's part
template <class Thing, class Part, class Access>
[[nodiscard]] std::vector<Row<Thing>> rows_of_part(const std::vector<Row<Part>>& rows, Access access) {
  std::vector<Row<Thing>> out;
  for (const Row<Part>& row : rows) {
    const auto read = [read = row.meaning.read, access](const json::Value& value, Thing& thing, Building& building) {
      read(value, std::invoke(access, thing), building);
    };
    std::function<std::string(const Thing&)> useless;
    if (row.useless)
      useless = [useless = row.useless, access](const Thing& thing) { return useless(std::invoke(access, thing)); };
    out.push_back({row.name, row.form, row.help, {read, row.meaning.standard}, row.required, useless, row.elsewhere});
  }
  return out;
}

// A field whose words stand for values of a member.
template <class Thing, class Word, class Access>
[[nodiscard]] Row<Thing> one_of(std::string name, std::string what, std::vector<std::pair<std::string, Word>> words,
                                std::string help, Access access) {
  std::vector<std::string> spelled;
  std::string standard;
  Thing fresh{};
  for (const auto& [word, meant] : words) {
    spelled.push_back(word);
    if (meant == std::invoke(access, fresh)) standard = json::in_quotes(word);
  }
  const auto read = [words, access](const json::Value& value, Thing& thing, Building&) {
    for (const auto& [word, meant] : words)
      if (value.text() == word) std::invoke(access, thing) = meant;
  };
  return {std::move(name), words_of(std::move(what), std::move(spelled)), std::move(help), {read, standard}};
}

// The form of an object with the fields of a table.
template <class Part>
[[nodiscard]] FormOf form_of(const Table<Part>& table) {
  return FormOf::Make(
      [&table](FormStore& store, const ValueForms& values) { return store.add(table.listing_form(store, values)); });
}

// A field that is an object with a table of its own; if absent, it counts as empty.
template <class Thing, class Part, class Access>
[[nodiscard]] Row<Thing> part(std::string name, const Table<Part>& table, std::string help, Access access) {
  const auto read = [&table, access](const json::Value& value, Thing& thing, Building& building) {
    table.read(value, std::invoke(access, thing), building);
  };
  return {std::move(name), form_of(table), std::move(help), {read, "{}"}};
}

}  // namespace tweenfall::document::fields
