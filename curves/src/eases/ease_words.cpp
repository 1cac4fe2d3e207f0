#include <tweenfall/curves/ease.h>

#include <array>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>

#include "eases/ease_text.h"
#include "eases/shapes.h"
#include "text/quoted.h"

namespace tweenfall {
namespace {

using shapes::Flow;
using shapes::Pieces;

struct Word {
  std::string_view name;
  Ease (*make)();
};

constexpr Word plain_words[] = {
    {"hold", &Ease::hold},
    {"step-next", &Ease::step_next},
    {"linear", &Ease::linear},
    {"smooth", &Ease::smooth},
    {"smooth-clamped", &Ease::smooth_clamped},
    {"monotone", &Ease::monotone},
    {"akima", &Ease::akima},
    {"makima", &Ease::makima},
    {"natural", &Ease::natural},
    {"clamped", &Ease::clamped},
    {"periodic", &Ease::periodic},
    {"not-a-knot", &Ease::not_a_knot},
    {"catmull-rom", &Ease::catmull_rom},
    {"catmull-rom-monotone", &Ease::catmull_rom_monotone},
    {"uniform", &Ease::uniform},
    {"centripetal", &Ease::centripetal},
    {"chordal", &Ease::chordal},
    {"nlerp", &Ease::nlerp},
    {"squad", &Ease::squad},
    {"barry-goldman", &Ease::barry_goldman},
};

// CSS names with their handles. Source: W3C, "CSS Easing Functions Level 1".
struct CssWord {
  std::string_view name;
  double x1, y1, x2, y2;
};
constexpr CssWord css_words[] = {{"ease", 0.25, 0.1, 0.25, 1},
                                 {"ease-in", 0.42, 0, 1, 1},
                                 {"ease-out", 0, 0, 0.58, 1},
                                 {"ease-in-out", 0.42, 0, 0.58, 1}};

// The families; up to two numbers in a call, with the values they have in a plain word.
struct Family {
  std::string_view name;
  std::string_view form;  // of the numbers
  int numbers;
  std::array<double, 2> defaults;
  Pieces (*make)(const std::array<double, 2>& numbers, Flow flow);
};
using Numbers = const std::array<double, 2>&;
constexpr Family families[] = {
    {"sine", "", 0, {}, [](Numbers, Flow flow) { return shapes::sine(flow); }},
    {"quad", "", 0, {}, [](Numbers, Flow flow) { return shapes::power(2, flow); }},
    {"cubic", "", 0, {}, [](Numbers, Flow flow) { return shapes::power(3, flow); }},
    {"quart", "", 0, {}, [](Numbers, Flow flow) { return shapes::power(4, flow); }},
    {"quint", "", 0, {}, [](Numbers, Flow flow) { return shapes::power(5, flow); }},
    {"poly", "(exponent)", 1, {3}, [](Numbers n, Flow flow) { return shapes::power(n[0], flow); }},
    {"expo", "", 0, {}, [](Numbers, Flow flow) { return shapes::exponential(flow); }},
    {"circ", "", 0, {}, [](Numbers, Flow flow) { return shapes::circular(flow); }},
    {"back", "(overshoot)", 1, {1.70158}, [](Numbers n, Flow flow) { return shapes::back(n[0], flow); }},
    {"elastic",
     "(amplitude,period)",
     2,
     {1, 0.3},
     [](Numbers n, Flow flow) { return shapes::elastic(n[0], n[1], flow); }},
    {"penner-elastic",
     "(amplitude,period)",
     2,
     {1, 0.3},
     [](Numbers n, Flow flow) { return shapes::penner_elastic(n[0], n[1], flow); }},
    {"bounce", "", 0, {}, [](Numbers, Flow flow) { return shapes::bounce(flow); }},
};

struct FlowWord {
  std::string_view suffix;
  Flow flow;
};
constexpr FlowWord flows[] = {{"-in", Flow::in}, {"-out", Flow::out}, {"-in-out", Flow::in_out}};

constexpr std::string_view call_forms[] = {
    "bezier(x1,y1,x2,y2)",          "linear(stop,...)",   "steps(count,jump)", "spring(period,damping)",
    "tcb(tension,continuity,bias)", "natural(start,end)", "clamped(start,end)"};
constexpr std::string_view jumps[] = {"jump-start", "jump-end", "jump-none", "jump-both"};

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

[[noreturn]] void refuse(const std::string& reason) {
  throw std::invalid_argument(reason);
}

std::optional<double> number_in(std::string_view text) {
  double value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

// A word, or a call with its arguments.
struct Call {
  std::string_view name;
  bool called = false;
  std::vector<std::string_view> arguments;

  explicit Call(std::string_view text) {
    const std::size_t open = text.find('(');
    name = trimmed(text.substr(0, open));
    if (open == std::string_view::npos) return;
    called = true;
    if (text.back() != ')') refuse(quoted(text) + " has no closing parenthesis");
    std::string_view rest = text.substr(open + 1, text.size() - open - 2);
    if (trimmed(rest).empty()) return;
    for (;;) {
      const std::size_t comma = rest.find(',');
      arguments.push_back(trimmed(rest.substr(0, comma)));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
  }

  void expect(std::size_t least, std::size_t most, std::string_view form) const {
    if (arguments.size() >= least && arguments.size() <= most) return;
    refuse(std::string(name) + " is written " + std::string(form) + "; " + std::to_string(arguments.size()) +
           " values were given");
  }

  [[nodiscard]] double number(std::size_t i, std::string_view unit = "") const {
    std::string_view text = arguments[i];
    if (!unit.empty() && text.size() > unit.size() && text.substr(text.size() - unit.size()) == unit)
      text.remove_suffix(unit.size());
    const std::optional<double> value = number_in(text);
    if (!value) refuse(quoted(arguments[i]) + " in " + std::string(name) + "(...) is not a number");
    return *value;
  }
};

std::optional<Ease> in_family(const Call& call) {
  for (const Family& family : families) {
    if (call.name.substr(0, family.name.size()) != family.name) continue;
    for (const FlowWord& word : flows) {
      if (call.name.substr(family.name.size()) != word.suffix) continue;
      if (!call.called) return Ease::shape(std::string(call.name), family.make(family.defaults, word.flow));
      if (family.numbers == 0) refuse(std::string(call.name) + " takes no numbers");
      call.expect(1, static_cast<std::size_t>(family.numbers), std::string(call.name) + std::string(family.form));
      std::array<double, 2> numbers = family.defaults;
      for (std::size_t i = 0; i < call.arguments.size(); ++i) numbers[i] = call.number(i);
      if (family.name == "elastic" && !(numbers[0] >= 1))
        refuse("the amplitude of " + std::string(call.name) + " must be >= 1; it is " + number_text(numbers[0]));
      if (family.numbers == 2 && !(numbers[1] > 0))
        refuse("the period of " + std::string(call.name) + " must be > 0; it is " + number_text(numbers[1]));
      if (family.form == "(exponent)" && !(numbers[0] > 0))
        refuse("the exponent of " + std::string(call.name) + " must be > 0; it is " + number_text(numbers[0]));
      const std::string name = family.numbers == 1 ? call_text(std::string(call.name), {numbers[0]})
                                                   : call_text(std::string(call.name), {numbers[0], numbers[1]});
      return Ease::shape(name, family.make(numbers, word.flow));
    }
  }
  return std::nullopt;
}

Ease stepped(const Call& call) {
  call.expect(1, 2, "steps(count,jump)");
  const double count = call.number(0);
  const std::string_view jump = call.arguments.size() == 2 ? call.arguments[1] : "jump-end";
  bool known = false;
  for (const std::string_view word : jumps) known = known || word == jump;
  if (!known) refuse(quoted(jump) + " in steps(...) must be jump-start, jump-end, jump-none or jump-both");
  const double least = jump == "jump-none" ? 2 : 1;
  if (count != std::floor(count) || count < least || count > 100000)
    refuse("the count in steps(...) must be a whole number from " + number_text(least) + " to 100000; it is " +
           number_text(count));
  return Ease::shape("steps(" + number_text(count) + "," + std::string(jump) + ")",
                     shapes::steps(static_cast<int>(count), jump));
}

// An output, and up to two percentages before or after it.
shapes::LinearStop linear_stop(std::string_view text) {
  std::optional<double> output;
  std::vector<double> percents;
  std::string_view rest = text;
  while (!rest.empty()) {
    std::string_view part = rest.substr(0, rest.find(' '));
    rest = trimmed(rest.substr(part.size()));
    const bool percent = part.back() == '%';
    const std::optional<double> number = number_in(percent ? part.substr(0, part.size() - 1) : part);
    const bool expected = percent ? percents.size() < 2 : !output;
    if (!number || !expected)
      refuse(quoted(text) + " in linear(...) must be a number with none, one or two percentages, as 0.5 25% 75%");
    if (percent)
      percents.push_back(*number);
    else
      output = number;
  }
  if (!output) refuse(quoted(text) + " in linear(...) has no output, as the 0.5 of 0.5 25%");
  return {*output, percents};
}

Ease linear_stops(const Call& call) {
  if (call.arguments.empty()) refuse("linear(...) needs at least one stop; none was given");
  std::vector<shapes::LinearStop> stops;
  std::string name;
  for (const std::string_view argument : call.arguments) {
    stops.push_back(linear_stop(argument));
    name += (name.empty() ? "linear(" : ",") + number_text(stops.back().output);
    for (const double percent : stops.back().percents) name += " " + number_text(percent) + "%";
  }
  return Ease::shape(name + ")", shapes::linear(stops));
}

Ease parsed(std::string_view text) {
  const Call call(trimmed(text));
  if (!call.called) {
    for (const Word& word : plain_words)
      if (call.name == word.name) return word.make();
    for (const CssWord& word : css_words)
      if (call.name == word.name)
        return Ease::shape(std::string(word.name), shapes::bezier(word.x1, word.y1, word.x2, word.y2));
  } else if (call.name == "bezier") {
    call.expect(4, 4, "bezier(x1,y1,x2,y2)");
    return Ease::bezier(call.number(0), call.number(1), call.number(2), call.number(3));
  } else if (call.name == "linear") {
    return linear_stops(call);
  } else if (call.name == "steps") {
    return stepped(call);
  } else if (call.name == "spring") {
    call.expect(2, 2, "spring(period,damping), as spring(0.3s,0.5)");
    return Ease::spring(call.number(0, "s"), call.number(1));
  } else if (call.name == "natural") {
    call.expect(2, 2, "natural(start,end), second derivatives at the ends");
    return Ease::natural(call.number(0), call.number(1));
  } else if (call.name == "clamped") {
    call.expect(2, 2, "clamped(start,end), slopes at the ends");
    return Ease::clamped(call.number(0), call.number(1));
  } else if (call.name == "tcb") {
    call.expect(3, 3, "tcb(tension,continuity,bias)");
    return Ease::tcb(call.number(0), call.number(1), call.number(2));
  }
  if (std::optional<Ease> ease = in_family(call)) return *ease;
  refuse("there is no ease " + quoted(trimmed(text)));
}

}  // namespace

std::optional<Ease> Ease::named(std::string_view word, std::string* reason) {
  try {
    return parsed(word);
  } catch (const std::invalid_argument& error) {
    if (reason) *reason = error.what();
    return std::nullopt;
  }
}

std::vector<std::string> Ease::names() {
  std::vector<std::string> result;
  for (const Word& word : plain_words) result.emplace_back(word.name);
  for (const CssWord& word : css_words) result.emplace_back(word.name);
  for (const Family& family : families)
    for (const FlowWord& word : flows) result.push_back(std::string(family.name) + std::string(word.suffix));
  for (const Family& family : families)
    for (const FlowWord& word : flows)
      if (family.numbers > 0)
        result.push_back(std::string(family.name) + std::string(word.suffix) + std::string(family.form));
  for (const std::string_view form : call_forms) result.emplace_back(form);
  return result;
}

}  // namespace tweenfall
