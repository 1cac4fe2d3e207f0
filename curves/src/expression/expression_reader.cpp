#include <tweenfall/curves/nearest_name.h>

#include <algorithm>
#include <charconv>
#include <optional>

#include "expression/expression_program.h"
#include "text/quoted.h"

namespace tweenfall::expressions {
namespace {

constexpr std::size_t longest_text = 4000;
constexpr int deepest_nesting = 60;

struct Constant {
  std::string_view name;
  double value;
};
constexpr Constant constants[] = {
    {"pi", 0x1.921fb54442d18p+1}, {"tau", 0x1.921fb54442d18p+2}, {"e", 0x1.5bf0a8b145769p+1}};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}

// Recursive descent over
//     sum = product {("+" | "-") product}      product = signed {("*" | "/") signed}
//     signed = ("-" | "+") signed | power      power = value ["^" signed]
//     value = number | name | name "(" sum {"," sum} ")" | "(" sum ")"
class Reader {
 public:
  using Program = Expression::Program;

  Reader(std::string_view text, std::span<const std::string> variables,
         std::span<const Expression::Parameter> parameters)
      : text_(text), variables_(variables), parameters_(parameters) {}

  std::vector<Program::Step> read() {
    if (text_.size() > longest_text)
      fault(longest_text, "an expression has at most " + std::to_string(longest_text) + " characters; this has " +
                              std::to_string(text_.size()));
    sum();
    if (!at_end()) fault(at_, unexpected("an operator"));
    return std::move(steps_);
  }

 private:
  [[noreturn]] static void fault(std::size_t place, const std::string& what) { throw ExpressionError(place, what); }

  bool at_end() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
    return at_ == text_.size();
  }

  bool next_is(char c) { return !at_end() && text_[at_] == c; }

  bool taken(char c) {
    if (!next_is(c)) return false;
    ++at_;
    return true;
  }

  std::string_view name_here() const {
    std::size_t end = at_;
    while (end < text_.size() && (starts_name(text_[end]) || is_digit(text_[end]))) ++end;
    return text_.substr(at_, end - at_);
  }

  // What stands here instead of `expected`.
  std::string unexpected(const std::string& expected) {
    if (at_end()) return "expected " + expected + ", found the end";
    const char c = text_[at_];
    if (starts_name(c) || is_digit(c) || c == '(' || c == '.') {
      const std::string_view word = starts_name(c) ? name_here() : text_.substr(at_, 1);
      return "expected " + expected + ", found " + words::quoted(word) + "; a product is written with *";
    }
    if (c == '*' && at_ > 0 && text_[at_ - 1] == '*')
      return "expected " + expected + ", found \"**\"; a power is written with ^";
    if (static_cast<unsigned char>(c) < 0x20 || static_cast<unsigned char>(c) > 0x7e)
      return "expected " + expected + ", found a character that no expression has";
    return "expected " + expected + ", found " + words::quoted(text_.substr(at_, 1));
  }

  void deeper() {
    if (++nesting_ > deepest_nesting)
      fault(at_, "an expression may be nested at most " + std::to_string(deepest_nesting) + " deep");
  }

  void sum() {
    deeper();
    product();
    while (next_is('+') || next_is('-')) {
      const char symbol = text_[at_++];
      product();
      call(*expression_operator(symbol));
    }
    --nesting_;
  }

  void product() {
    signed_power();
    while (next_is('*') || next_is('/')) {
      const char symbol = text_[at_++];
      signed_power();
      call(*expression_operator(symbol));
    }
  }

  void signed_power() {
    deeper();
    if (taken('-')) {
      signed_power();
      call(*expression_operator('_'));
    } else if (taken('+')) {
      signed_power();
    } else {
      value();
      if (taken('^')) {
        signed_power();
        call(*expression_operator('^'));
      }
    }
    --nesting_;
  }

  void value() {
    if (at_end()) fault(at_, unexpected("a value"));
    const char c = text_[at_];
    if (c == '(') {
      const std::size_t open = at_++;
      sum();
      close(open);
    } else if (is_digit(c) || c == '.') {
      number();
    } else if (starts_name(c)) {
      name();
    } else {
      fault(at_, unexpected("a value"));
    }
  }

  void close(std::size_t open) {
    if (!taken(')'))
      fault(at_, unexpected("\")\" for the \"(\" at character " + std::to_string(open + 1) + " of the formula"));
  }

  void number() {
    double parsed = 0;
    const char* first = text_.data() + at_;
    const auto [end, error] = std::from_chars(first, text_.data() + text_.size(), parsed);
    if (error == std::errc::invalid_argument) fault(at_, unexpected("a number"));
    if (error != std::errc{}) fault(at_, "this number is beyond the range of numbers");
    at_ += static_cast<std::size_t>(end - first);
    push({.number = parsed});
  }

  void name() {
    const std::size_t start = at_;
    const std::string_view word = name_here();
    at_ += word.size();
    for (const ExpressionFunction& each : expression_functions())
      if (each.name == word) return arguments(each, start);
    const bool called = next_is('(');
    for (std::size_t i = 0; i < variables_.size(); ++i)
      if (variables_[i] == word) return called ? not_a_function(start, word) : push({.variable = static_cast<int>(i)});
    for (const Expression::Parameter& each : parameters_)
      if (each.name == word) return called ? not_a_function(start, word) : push({.number = each.value});
    for (const Constant& each : constants)
      if (each.name == word) return called ? not_a_function(start, word) : push({.number = each.value});
    unknown(start, word, called);
  }

  [[noreturn]] static void not_a_function(std::size_t start, std::string_view word) {
    fault(start, words::quoted(word) + " is a number, not a function; a product is written with *");
  }

  [[noreturn]] void unknown(std::size_t start, std::string_view word, bool called) const {
    std::vector<std::string> known;
    if (!called) {
      known.assign(variables_.begin(), variables_.end());
      for (const Expression::Parameter& each : parameters_) known.push_back(each.name);
      for (const Constant& each : constants) known.emplace_back(each.name);
    }
    const std::size_t numbers = known.size();
    for (const ExpressionFunction& each : expression_functions()) known.emplace_back(each.name);
    const std::string what = "unknown " + std::string(called ? "function " : "name ") + words::quoted(word);
    if (const std::string near = nearest_name(word, known); !near.empty())
      fault(start, what + "; did you mean " + words::quoted(near) + "?");
    if (!called) known.resize(numbers);
    std::string list;
    for (const std::string& each : known) list += (list.empty() ? "" : ", ") + each;
    fault(start, what + "; known: " + list);
  }

  void arguments(const ExpressionFunction& function, std::size_t start) {
    const std::string form = std::string(function.name) + "(" + std::string(function.arguments) + ")";
    const std::size_t open = at_;
    if (!taken('(')) fault(start, "a function is called with parentheses: " + form);
    int count = 0;
    if (!next_is(')')) {
      do {
        sum();
        ++count;
        if (function.any_number && count > 1) call(function);
      } while (taken(','));
    }
    close(open);
    if (function.any_number ? count < function.count : count != function.count)
      fault(start, "expected " + form + ", found " + std::to_string(count) + " argument" + (count == 1 ? "" : "s"));
    if (!function.any_number) call(function);
  }

  void push(const Program::Step& step) {
    if (++depth_ > Program::most_depth)
      fault(at_, "this expression keeps more than " + std::to_string(Program::most_depth) + " values at once");
    steps_.push_back(step);
  }

  // A function of constants is folded into a constant, unless it has no finite value there.
  void call(const ExpressionFunction& function) {
    const auto count = static_cast<std::size_t>(function.count);
    depth_ -= function.count - 1;
    const auto last = steps_.end() - static_cast<std::ptrdiff_t>(std::min(count, steps_.size()));
    const bool fixed =
        std::all_of(last, steps_.end(), [](const Program::Step& s) { return !s.function && s.variable < 0; });
    if (fixed) {
      math::Jet values[3];
      std::transform(last, steps_.end(), values, [](const Program::Step& s) { return math::constant(s.number); });
      const math::Jet result = function.apply(values, 1);
      if (std::isfinite(result.v)) {
        steps_.erase(last, steps_.end());
        steps_.push_back({.number = result.v});
        return;
      }
    }
    steps_.push_back({.function = &function});
  }

  std::string_view text_;
  std::span<const std::string> variables_;
  std::span<const Expression::Parameter> parameters_;
  std::size_t at_ = 0;
  int nesting_ = 0, depth_ = 0;
  std::vector<Program::Step> steps_;
};

bool is_reserved(std::string_view name) {
  return std::any_of(std::begin(constants), std::end(constants), [&](const Constant& c) { return c.name == name; }) ||
         std::any_of(expression_functions().begin(), expression_functions().end(),
                     [&](const ExpressionFunction& f) { return f.name == name; });
}

void check_name(const std::string& name) {
  const bool fits = !name.empty() && starts_name(name[0]) &&
                    std::all_of(name.begin(), name.end(), [](char c) { return starts_name(c) || is_digit(c); });
  if (!fits)
    throw std::invalid_argument(
        "a name in an expression has letters, digits and \"_\" and does not start with a digit; " +
        words::quoted(name) + " is not such a name");
  if (is_reserved(name))
    throw std::invalid_argument(words::quoted(name) + " is a name that expressions already have; choose another");
}

}  // namespace

std::vector<Expression::Program::Step> read_expression(std::string_view text, std::span<const std::string> variables,
                                                       std::span<const Expression::Parameter> parameters) {
  for (const std::string& name : variables) check_name(name);
  for (const Expression::Parameter& each : parameters) {
    check_name(each.name);
    if (!std::isfinite(each.value))
      throw std::invalid_argument("the parameter " + words::quoted(each.name) + " must be finite");
    if (std::find(variables.begin(), variables.end(), each.name) != variables.end())
      throw std::invalid_argument("the parameter " + words::quoted(each.name) + " has the name of a variable");
  }
  return Reader(text, variables, parameters).read();
}

}  // namespace tweenfall::expressions
