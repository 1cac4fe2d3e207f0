#include "document/report/homes.h"

#include "document/report/suggestion.h"

#include <algorithm>

namespace tweenfall::document {

namespace {

// "a clip" of "a clip: {"duration", ...}", "a rule" of "a rule of the hand-off"
std::string head_of(const std::string& what) {
  return what.substr(0, std::min(what.find_first_of(":;,"), what.find(" of ")));
}

void add_once(std::vector<std::string>& places, const std::string& place) {
  if (std::ranges::find(places, place) == places.end()) places.push_back(place);
}

// "in \"a\" or in \"b\"", the first ones of very many
std::string told(const std::vector<std::string>& places) {
  constexpr std::size_t most = 6;
  std::string out;
  for (std::size_t i = 0; i < std::min(places.size(), most); ++i)
    out += (i == 0 ? "; it belongs " : " or ") + places[i];
  return places.size() > most ? out + " or others" : out;
}

}  // namespace

Homes::Homes(const Form& root) {
  add(root, "", "", false, nullptr);
  for (std::size_t i = 0; i < objects_.size(); ++i) {
    const Object& object = objects_[i];
    for (const Field& field : object.form->fields) add(*field.form, field.form->what, field.name, false, &object);
  }
}

// Adds the objects with fields that a value of this form contains directly.
void Homes::add(const Form& form, std::string what, const std::string& field, bool one_of_many, const Object* holder) {
  if (!form.what.empty()) what = form.what;
  for (const Form* alternative : form.alternatives) add(*alternative, what, field, one_of_many, holder);
  if (form.element) add(*form.element, what, field, true, holder);
  for (const Form* part : form.parts) add(*part, what, field, true, holder);
  if (form.kind != Form::Kind::object) return;
  for (const Ending& each : form.endings) add(*each.form, what, field, true, holder);
  if (form.others) add(*form.others, what, field, true, holder);
  if (form.fields.empty() || std::ranges::find(objects_, &form, &Object::form) != objects_.end()) return;
  const std::string where = !holder       ? "at the top of the document"
                            : one_of_many ? "in " + head_of(what) + " of " + json::in_quotes(field)
                                          : "in " + json::in_quotes(field);
  objects_.push_back({&form, where, holder, holder ? holder->depth + 1 : 0});
}

std::string Homes::near(std::string_view name, const Form& here, std::span<const Form* const> around) const {
  std::vector<std::string> places;
  // A name deep inside is more likely a wrong word than a misplaced part of the document.
  constexpr std::size_t deepest = 2;
  const auto own = std::ranges::find(objects_, &here, &Object::form);
  const bool deep = own != objects_.end() && own->depth > deepest;
  for (const Object& object : objects_) {
    if (deep && !object.holder) continue;
    const bool inside = object.holder && object.holder->form == &here;
    const bool outside = std::ranges::find(around, object.form) != around.end();
    if ((inside || outside) && object.form->field(name)) add_once(places, object.where);
  }
  return told(places);
}

bool Homes::is_in(const Object& object, const Form& holder) {
  const Object* up = object.holder;
  while (up && up->form != &holder) up = up->holder;
  return up != nullptr;
}

std::string Homes::anywhere(std::string_view name, const Form& here) const {
  constexpr std::size_t most = 3;  // a name that more things have is not helpful
  // A name deeper inside is more likely a wrong word than one of the large parts misplaced.
  constexpr std::size_t deepest = 2;
  const auto own = std::ranges::find(objects_, &here, &Object::form);
  if (own == objects_.end() || own->depth > deepest) return {};
  std::vector<std::string> places;
  std::size_t depth = 0;
  // Objects inside this one are preferred to others.
  const bool inside = std::ranges::any_of(
      objects_, [&](const Object& object) { return object.form->field(name) && is_in(object, here); });
  for (const Object& object : objects_) {
    if (!places.empty() && object.depth > depth) break;
    if (!object.form->field(name) || object.where == own->where || (inside && !is_in(object, here))) continue;
    depth = object.depth;
    std::string place = object.where;
    for (const Object* holder = object.holder; holder && holder->holder; holder = holder->holder)
      place += " of " + holder->where.substr(holder->where.find(' ') + 1);
    add_once(places, place);
  }
  return places.size() > most ? std::string() : told(places);
}

std::string Homes::meant_inside(std::string_view name, const Form& here, Meant meant) const {
  for (const Object& object : objects_) {
    if (!object.holder || object.holder->form != &here) continue;
    if (const std::string field = (object.form->*meant)(name); !field.empty())
      return "; did you mean " + json::in_quotes(field) + " " + object.where + "?";
  }
  return {};
}

const Form* Homes::meant_form(std::string_view name, const Form& here, std::span<const Form* const> around) const {
  if (const Field* const called = here.field(here.field_called(name))) return called->form;
  const Form* found = nullptr;
  for (const Object& object : objects_) {
    const bool inside = object.holder && object.holder->form == &here;
    if (!inside && std::ranges::find(around, object.form) == around.end()) continue;
    const Field* const field = object.form->field(name);
    if (!field || field->form == found) continue;
    if (found) return nullptr;
    found = field->form;
  }
  return found;
}

std::string Homes::of(std::string_view name, const Form& here, std::span<const Form* const> around) const {
  std::string out = suggestion_of(here.field_called(name), {});
  if (out.empty()) out = near(name, here, around);
  if (out.empty()) out = suggestion_of(here.field_meant(name), {});
  if (out.empty()) out = meant_inside(name, here, &Form::field_called);
  if (out.empty()) out = anywhere(name, here);
  if (out.empty()) out = meant_inside(name, here, &Form::field_meant);
  return out;
}

}  // namespace tweenfall::document
