#include <tweenfall/curves/nearest_name.h>

#include <charconv>
#include <cmath>

#include "eases/ease_row.h"

namespace tweenfall {
namespace eases {
namespace {

struct FlowWord {
  std::string_view suffix;
  Flow flow;
};
constexpr FlowWord flows[] = {{"-in", Flow::in}, {"-out", Flow::out}, {"-in-out", Flow::in_out}};

Call call_in(std::string_view text) {
  Call call;
  const std::size_t open = text.find('(');
  call.name = trimmed(text.substr(0, open));
  if (open == std::string_view::npos) return call;
  call.called = true;
  if (text.back() != ')') refuse(words::quoted(text) + " has no closing parenthesis");
  std::string_view rest = text.substr(open + 1, text.size() - open - 2);
  if (trimmed(rest).empty()) return call;
  for (;;) {
    const std::size_t comma = rest.find(',');
    call.arguments.push_back(trimmed(rest.substr(0, comma)));
    if (comma == std::string_view::npos) return call;
    rest.remove_prefix(comma + 1);
  }
}

std::size_t count_of(const FamilyRow& family) noexcept {
  return family.numbers[0].name.empty() ? 0 : family.numbers[1].name.empty() ? 1 : 2;
}

// "(amplitude,period)"
std::string form_of(const FamilyRow& family) {
  std::string form = "(" + std::string(family.numbers[0].name);
  if (count_of(family) == 2) form += "," + std::string(family.numbers[1].name);
  return form + ")";
}

Ease of_family(const FamilyRow& family, Flow flow, const Call& call) {
  Numbers numbers = {family.numbers[0].plain, family.numbers[1].plain};
  const std::string name(call.name);
  if (!call.called) return Ease::shape(name, family.make(numbers, flow));
  const std::size_t count = count_of(family);
  if (count == 0) refuse(name + " takes no numbers");
  call.expect(1, count, name + form_of(family));
  for (std::size_t i = 0; i < call.arguments.size(); ++i) {
    const FamilyNumber& number = family.numbers[i];
    numbers[i] = call.number(i);
    check_range("the " + std::string(number.name) + " of " + name, numbers[i], number.least, number.most);
  }
  return Ease::shape(call_text(name, std::span(numbers).first(count)), family.make(numbers, flow));
}

Ease parsed(std::string_view text) {
  const Call call = call_in(text);
  for (const Row* row : rows())
    if (call.name == row->word) {
      if (call.called && row->called) return row->called(call);
      if (!call.called && row->plain) return row->plain();
      refuse(call.called ? words::quoted(call.name) + " takes no numbers"
                         : std::string(row->word) + " is written " + std::string(row->word) + std::string(row->form));
    }
  for (const FamilyRow* family : families())
    for (const FlowWord& word : flows)
      if (call.name.starts_with(family->word) && call.name.substr(family->word.size()) == word.suffix)
        return of_family(*family, word.flow, call);
  const std::string meant = Ease::ours(text);
  refuse("there is no ease " + words::quoted(text) + (meant.empty() ? "" : "; here it is " + words::quoted(meant)));
}

}  // namespace

void Call::expect(std::size_t least, std::size_t most, std::string_view form) const {
  if (arguments.size() >= least && arguments.size() <= most) return;
  refuse(std::string(name) + " is written " + std::string(form) + "; " + std::to_string(arguments.size()) +
         (arguments.size() == 1 ? " value was given" : " values were given"));
}

double Call::number(std::size_t i, std::string_view unit) const {
  std::string_view text = arguments[i];
  if (!unit.empty() && text.size() > unit.size() && text.ends_with(unit)) text.remove_suffix(unit.size());
  const std::optional<double> value = number_in(text);
  if (!value) refuse(words::quoted(arguments[i]) + " in " + std::string(name) + "(...) is not a number");
  return *value;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::string call_text(std::string_view name, std::span<const double> numbers) {
  std::string text = std::string(name) + "(";
  for (std::size_t i = 0; i < numbers.size(); ++i) text += (i > 0 ? "," : "") + number_text(numbers[i]);
  return text + ")";
}

void check_range(const std::string& what, double value, double least, double most) {
  if (!(value >= least && value <= most))
    refuse(what + " must lie in " + number_text(least) + " to " + number_text(most) + "; it is " + number_text(value));
}

}  // namespace eases

std::optional<Ease> Ease::named(std::string_view word, std::string* reason) {
  try {
    return eases::parsed(eases::trimmed(word));
  } catch (const std::invalid_argument& error) {
    if (reason) *reason = error.what();
    return std::nullopt;
  }
}

std::vector<std::string> Ease::names() {
  std::vector<std::string> words, calls;
  for (const eases::Row* row : eases::rows()) {
    if (row->plain) words.emplace_back(row->word);
    if (row->called) calls.push_back(std::string(row->word) + std::string(row->form));
  }
  for (const eases::FamilyRow* family : eases::families())
    for (const eases::FlowWord& flow : eases::flows) {
      const std::string word = std::string(family->word) + std::string(flow.suffix);
      words.push_back(word);
      if (eases::count_of(*family) > 0) calls.push_back(word + eases::form_of(*family));
    }
  words.insert(words.end(), calls.begin(), calls.end());
  return words;
}

}  // namespace tweenfall
