#include "document/report/check.h"

#include <tweenfall/curves/number_text.h>

#include "document/report/homes.h"
#include "document/report/spellings.h"
#include "document/report/suggestion.h"
#include "document/report/units.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

class Checker {
 public:
  Checker(const Form& root, json::Tree& tree, Problems& problems) : root_(root), tree_(tree), problems_(problems) {}

  void value(const Form& form, const json::Value& value) {
    if (value.is(Kind::faulty)) return;
    const Form* chosen = resolved(form, value);
    if (!chosen) {
      fault(value, "expected " + form.what + ", found " + described(value) + instead_of(form, value));
      return;
    }
    const std::string& what = chosen->what.empty() ? form.what : chosen->what;
    switch (chosen->kind) {
      case Form::Kind::number:
        number(*chosen, what, value);
        break;
      case Form::Kind::boolean:
        if (chosen->only_true && !value.boolean()) fault(value, "expected true; leave the field out instead of false");
        break;
      case Form::Kind::text:
        text(*chosen, what, value);
        break;
      case Form::Kind::list:
        list(*chosen, what, value);
        break;
      case Form::Kind::tuple:
        tuple(*chosen, what, value);
        break;
      case Form::Kind::object:
        object(*chosen, what, value);
        break;
      case Form::Kind::any:
      case Form::Kind::choice:
        break;
    }
  }

 private:
  // What could be written instead of a value of another kind.
  std::string instead_of(const Form& form, const json::Value& value) const {
    if (form.instead)
      if (std::string better = form.instead(value); !better.empty()) return better;
    const auto is_number = [](const Form* alternative) { return alternative->kind == Form::Kind::number; };
    if (value.is(Kind::text) && std::ranges::any_of(form.alternatives, is_number))
      return number_meant(value.text(), unit_of(form));
    if (std::string better = as_field_of(form, value); !better.empty()) return better;
    if (form.kind == Form::Kind::list && form.fewest <= 1) {
      if (resolved(*form.element, value)) return "; write it in a list, [...]";
      const std::string better = form.element->instead ? form.element->instead(value) : std::string();
      return better.empty() ? better : better + ", in a list";
    }
    if (form.kind == Form::Kind::list && form.element->kind == Form::Kind::number) return vector_meant(value);
    if (form.kind == Form::Kind::number && value.is(Kind::text)) return number_meant(value.text(), unit_of(form));
    if (!form.words.empty()) return suggestion_of({}, form.words);
    for (const Form* alternative : form.alternatives)
      if (!alternative->words.empty()) return suggestion_of({}, alternative->words);
    return {};
  }

  std::string_view unit_of(const Form& form) const { return unit_told(help_, form.what); }

  void fault(const json::Value& at, std::string message) {
    problems_.add(at, std::move(message));
    tree_.mark_faulty(at);
  }

  // The object that a bare value may be meant for: with the first field that accepts it, if no other field is required.
  static std::string as_field_of(const Form& form, const json::Value& value) {
    const Form* object = form.kind == Form::Kind::object ? &form : nullptr;
    for (const Form* alternative : form.alternatives)
      if (!object && alternative->kind == Form::Kind::object) object = alternative;
    if (!object) return {};
    constexpr std::size_t most = 8;  // with more fields, it is unclear which one is meant
    if (object->fields.size() > most) return {};
    for (const Field& field : object->fields) {
      if (may_stand_alone(*object, field.name) && holds(*field.form, value)) return member_said(field.name, value);
    }
    return {};
  }

  static bool may_stand_alone(const Form& object, const std::string& name) {
    const auto needs_more = [&](const Together& rule) {
      const bool in = std::ranges::find(rule.names, name) != rule.names.end();
      return (rule.rule == Together::Rule::exactly_one && !in) ||
             (rule.rule == Together::Rule::first_needs_second && rule.names.front() == name);
    };
    return std::ranges::none_of(object.together, needs_more) &&
           std::ranges::none_of(object.fields,
                                [&](const Field& other) { return other.required && other.name != name; });
  }

  static bool in_range(const Form& form, double number) {
    const bool low = form.above_low ? number > form.low : number >= form.low;
    return low && number <= form.high && (!form.whole || number == std::floor(number));
  }

  // Whether a number, a text or a list of them is valid as it is.
  static bool holds(const Form& form, const json::Value& value) {
    const Form* chosen = resolved(form, value);
    if (!chosen) return false;
    switch (chosen->kind) {
      case Form::Kind::number:
        return in_range(*chosen, value.number());
      case Form::Kind::text:
        return (chosen->words.empty() && !chosen->fits) || (chosen->fits && chosen->fits(value.text())) ||
               std::ranges::find(chosen->words, value.text()) != chosen->words.end();
      case Form::Kind::list:
        return value.items().size() >= std::max<std::size_t>(1, chosen->fewest) &&
               value.items().size() <= chosen->most &&
               std::all_of(value.items().begin(), value.items().end(),
                           [&](const json::Value& item) { return holds(*chosen->element, item); });
      default:
        return false;
    }
  }

  void number(const Form& form, const std::string& what, const json::Value& value) {
    if (!in_range(form, value.number())) fault(value, "expected " + what + ", found " + number_text(value.number()));
  }

  void text(const Form& form, const std::string& what, const json::Value& value) {
    if (form.words.empty() && !form.fits) return;
    if (std::find(form.words.begin(), form.words.end(), value.text()) != form.words.end()) return;
    if (form.fits && form.fits(value.text())) return;
    std::string reason = form.why ? form.why(value.text()) : std::string();
    if (reason.empty()) {
      std::vector<std::string> known = form.words;
      known.insert(known.end(), form.hints.begin(), form.hints.end());
      reason = suggestion(value.text(), known);
    }
    fault(value, "expected " + what + ", found " + described(value) + reason);
  }

  void count(const std::string& what, const json::Value& value, bool fits) {
    if (!fits) problems_.add(value, "expected " + what + ", found " + described(value));
  }

  void list(const Form& form, const std::string& what, const json::Value& value) {
    if (is_flat(form, value)) {
      fault(value, "expected " + what + ", found a list of " + std::to_string(value.items().size()) +
                       " with numbers among them; each item is " + form.element->what);
      return;
    }
    const bool fits = value.items().size() >= form.fewest && value.items().size() <= form.most;
    for (const json::Value& item : value.items()) this->value(*form.element, item);
    count(what, value, fits);
    if (!fits) tree_.mark_faulty(value);
  }

  // Whether numbers stand in a row, or by turns with other things, that belong in lists of their own: one fault, not
  // one for each of them.
  bool is_flat(const Form& form, const json::Value& value) const {
    const auto is_stray = [&](const json::Value& item) {
      return item.is(Kind::number) && !resolved(*form.element, item);
    };
    const auto strays = std::count_if(value.items().begin(), value.items().end(), is_stray);
    return strays > 1 && 2 * static_cast<std::size_t>(strays) >= value.items().size() &&
           instead_of(*form.element, value.items().front()).empty();
  }

  void tuple(const Form& form, const std::string& what, const json::Value& value) {
    if (is_foremost_fault(form, value)) return;
    const bool fits = value.items().size() >= form.fewest && value.items().size() <= form.parts.size();
    const std::string meant = !fits && form.instead ? form.instead(value) : std::string();
    if (!meant.empty()) {
      // Faults of its items, in the wrong places, would be noise.
      fault(value, "expected " + what + ", found " + described(value) + meant);
      return;
    }
    for (std::size_t i = 0; i < std::min(value.items().size(), form.parts.size()); ++i)
      this->value(*form.parts[i], value.items()[i]);
    count(what, value, fits);
    if (!fits) tree_.mark_faulty(value);
  }

  bool is_foremost_fault(const Form& form, const json::Value& value) {
    std::string message = form.foremost_fault ? form.foremost_fault(value) : std::string();
    if (message.empty()) return false;
    fault(value, std::move(message));
    return true;
  }

  void object(const Form& form, const std::string& what, const json::Value& value) {
    if (is_foremost_fault(form, value)) return;
    std::vector<std::string> meant;  // fields similar to a misspelled name
    around_.push_back(&form);
    for (const json::Member& member : value.members()) {
      if (is_free_name(member.name)) continue;
      const Form* expected = form.member(member.name);
      if (!expected) {
        meant.push_back(form.field_meant(member.name));
        unknown(form, member);
        continue;
      }
      if (form.name_fault && !form.field(member.name)) {
        if (std::string message = form.name_fault(member.name); !message.empty()) {
          problems_.add_name(member, std::move(message));
          tree_.mark_faulty(member.value);
          continue;
        }
      }
      const std::size_t before = problems_.size();
      const Field* const known = form.field(member.name);
      const std::string_view outer = std::exchange(help_, known ? std::string_view(known->help) : std::string_view());
      this->value(*expected, member.value);
      help_ = outer;
      if (problems_.size() == before || expected != form.others || !form.name_meant) continue;
      // If the name is wrong, the faults of its value under that name would be noise.
      const std::string ours = form.name_meant(member.name);
      if (ours.empty()) continue;
      problems_.keep(before);
      problems_.add_name(member, "did you mean " + json::in_quotes(ours) + "? " + json::in_quotes(member.name) +
                                     " is a property of your own, and does not hold this value");
      tree_.mark_faulty(member.value);
    }
    around_.pop_back();
    for (const Field& field : form.fields)
      if (field.required && !value.find(field.name) && std::find(meant.begin(), meant.end(), field.name) == meant.end())
        problems_.add(value, "expected " + what + "; " + json::in_quotes(field.name) + " is missing");
    for (const Together& rule : form.together) together(rule, what, value);
  }

  void unknown(const Form& form, const json::Member& member) {
    std::string hint;
    if (!problems_.crowded()) {
      if (!homes_) homes_.emplace(root_);
      if (form.said_of) hint = form.said_of(member.name);
      if (hint.empty()) hint = homes_->of(member.name, form, around_);
      if (hint.empty()) hint = suggestion_of({}, form.field_names());
    }
    problems_.add_name(member, "unknown field " + json::in_quotes(member.name) + hint);
    // Faults inside it would be faults at the right place, too.
    if (homes_ && member.value.is(Kind::object))
      if (const Form* meant = homes_->meant_form(member.name, form, around_))
        if (const Form* chosen = resolved(*meant, member.value); chosen && chosen->kind == Form::Kind::object)
          this->value(*meant, member.value);
    tree_.mark_faulty(member.value);
  }

  void together(const Together& rule, const std::string& what, const json::Value& value) {
    std::optional<json::Member> first, second;
    for (const json::Member& member : value.members()) {
      if (std::find(rule.names.begin(), rule.names.end(), member.name) == rule.names.end()) continue;
      (first ? second : first) = member;
      if (second) break;
    }
    if (rule.rule == Together::Rule::first_needs_second) {
      if (first && !second && first->name == rule.names[0])
        problems_.add_name(*first,
                           json::in_quotes(rule.names[0]) + " needs " + json::in_quotes(rule.names[1]) + " beside it");
      return;
    }
    if (second) {
      problems_.add_name(*second, json::in_quotes(second->name) + " beside " + json::in_quotes(first->name) +
                                      "; give one of them" + rule.otherwise);
      tree_.mark_faulty(second->value);
    }
    if (!first && rule.rule == Together::Rule::exactly_one) {
      std::string names;
      for (const std::string& name : rule.names) names += (names.empty() ? "" : ", ") + json::in_quotes(name);
      // If a name is misspelled, the unknown field was reported; reporting it as missing too would be noise.
      for (const json::Member& member : value.members())
        if (member.value.is(Kind::faulty)) return;
      problems_.add(value, "expected " + what + "; one of " + names + " is missing");
    }
  }

  const Form& root_;
  json::Tree& tree_;
  Problems& problems_;
  std::vector<const Form*> around_;  // the enclosing objects, the outermost first
  std::string_view help_;            // of the field that is read
  std::optional<Homes> homes_;       // made at the first use
};

}  // namespace

void check(const Form& form, json::Tree& tree, Problems& problems) {
  Checker(form, tree, problems).value(form, tree.root());
}

std::string described(const json::Value& value) {
  switch (value.kind()) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return value.boolean() ? "true" : "false";
    case Kind::number:
      return number_text(value.number());
    case Kind::text: {
      std::string out = json::in_quotes(value.text());
      if (out.size() <= 60) return out;
      std::size_t end = 57;
      while (end > 0 && (static_cast<unsigned char>(out[end]) & 0xc0) == 0x80) --end;
      return out.substr(0, end) + "...\"";
    }
    case Kind::list:
      return value.items().empty() ? "an empty list" : "a list of " + std::to_string(value.items().size());
    case Kind::object: {
      if (value.members().empty()) return "an empty object";
      return "an object with " + json::in_quotes(value.members().front().name);
    }
    case Kind::faulty:
      break;
  }
  return "nothing of use";
}

}  // namespace tweenfall::document
