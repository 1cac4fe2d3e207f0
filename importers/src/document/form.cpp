#include "document/form.h"

#include "document/report/foreign_words.h"
#include "document/report/suggestion.h"

#include <algorithm>
#include <utility>

namespace tweenfall::document {

namespace {

bool kind_fits(const Form& form, const json::Value& value) {
  switch (form.kind) {
    case Form::Kind::any:
      return true;
    case Form::Kind::number:
      return value.is(json::Value::Kind::number);
    case Form::Kind::boolean:
      return value.is(json::Value::Kind::boolean);
    case Form::Kind::text:
      return value.is(json::Value::Kind::text);
    case Form::Kind::list:
    case Form::Kind::tuple:
      return value.is(json::Value::Kind::list);
    case Form::Kind::object:
      return value.is(json::Value::Kind::object);
    case Form::Kind::choice:
      return resolved(form, value) != nullptr;
  }
  return false;
}

bool ends_with(std::string_view name, std::string_view ending) {
  return name.size() > ending.size() && name.substr(name.size() - ending.size()) == ending;
}

}  // namespace

const Field* Form::field(std::string_view name) const {
  for (const Field& each : fields)
    if (each.name == name) return &each;
  return nullptr;
}

const Form* Form::member(std::string_view name) const {
  if (const Field* known = field(name)) return known->form;
  for (const Ending& each : endings)
    if (ends_with(name, each.ending)) return each.form;
  return others;
}

std::vector<std::string> Form::field_names() const {
  std::vector<std::string> names;
  for (const Field& each : fields) names.push_back(each.name);
  return names;
}

std::string Form::field_called(std::string_view name) const {
  const std::string small = small_letters(name);
  for (const Field& each : fields)
    if (std::find(each.elsewhere.begin(), each.elsewhere.end(), small) != each.elsewhere.end()) return each.name;
  return {};
}

std::string Form::field_meant(std::string_view name) const {
  const std::string called = field_called(name);
  return called.empty() ? document::name_meant(name, field_names()) : called;
}

bool is_free_name(std::string_view name) {
  return name.substr(0, 2) == "//" || name.substr(0, 2) == "x-";
}

const Form* resolved(const Form& form, const json::Value& value) {
  if (form.kind != Form::Kind::choice) return kind_fits(form, value) ? &form : nullptr;
  if (form.select) {
    const Form* selected = form.select(value);
    return selected ? resolved(*selected, value) : nullptr;
  }
  for (const Form* alternative : form.alternatives)
    if (kind_fits(*alternative, value)) return resolved(*alternative, value);
  return nullptr;
}

const Form* FormStore::add(Form form) {
  forms_.push_back(std::move(form));
  return &forms_.back();
}

Form* FormStore::reserve() {
  forms_.emplace_back();
  return &forms_.back();
}

}  // namespace tweenfall::document
