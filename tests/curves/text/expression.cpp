#include <tweenfall/curves/expression.h>

#include <functional>

#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

// A text, and what it means according to the C library in long double.
struct Pair {
  std::string text;
  std::function<long double(long double)> meaning;
};

// Smooth and finite at every t: arguments of partial functions are kept in range.
Pair random_pair(Random& random, int depth) {
  if (depth == 0 || random.unit() < 0.1) {
    if (random.unit() < 0.6) return {"t", [](long double t) { return t; }};
    const double n = std::round(random.between(-40, 40)) / 8;
    return {n < 0 ? "(" + std::to_string(n) + ")" : std::to_string(n), [n](long double) { return n; }};
  }
  const Pair a = random_pair(random, depth - 1), b = random_pair(random, depth - 1);
  const auto f = a.meaning, g = b.meaning;
  switch (random.bits() % 18) {
    case 0:
      return {"(" + a.text + "+" + b.text + ")", [=](long double t) { return f(t) + g(t); }};
    case 1:
      return {"(" + a.text + " - " + b.text + ")", [=](long double t) { return f(t) - g(t); }};
    case 2:
      return {"sin(" + a.text + ")*" + b.text, [=](long double t) { return std::sin(f(t)) * g(t); }};
    case 3:
      return {"-cos(" + a.text + ")", [=](long double t) { return -std::cos(f(t)); }};
    case 4:
      return {"tan(sin(" + a.text + "))", [=](long double t) { return std::tan(std::sin(f(t))); }};
    case 5:
      return {"exp(sin(" + a.text + "))", [=](long double t) { return std::exp(std::sin(f(t))); }};
    case 6:
      return {"log(1.5+cos(" + a.text + "))", [=](long double t) { return std::log(1.5L + std::cos(f(t))); }};
    case 7:
      return {"sqrt(1.5+sin(" + a.text + "))", [=](long double t) { return std::sqrt(1.5L + std::sin(f(t))); }};
    case 8:
      return {"(" + a.text + ")/(1.5+sin(" + b.text + "))",
              [=](long double t) { return f(t) / (1.5L + std::sin(g(t))); }};
    case 9:
      return {"sin(" + a.text + ")^3", [=](long double t) { return std::pow(std::sin(f(t)), 3); }};
    case 10:
      return {"(1.5+sin(" + a.text + "))^cos(" + b.text + ")",
              [=](long double t) { return std::pow(1.5L + std::sin(f(t)), std::cos(g(t))); }};
    case 11:
      return {"atan2(1.5+sin(" + a.text + "), cos(" + b.text + "))",
              [=](long double t) { return std::atan2(1.5L + std::sin(f(t)), std::cos(g(t))); }};
    case 12:
      return {"asin(0.9*sin(" + a.text + "))", [=](long double t) { return std::asin(0.9 * std::sin(f(t))); }};
    case 13:
      return {"acos(0.9*cos(" + a.text + "))", [=](long double t) { return std::acos(0.9 * std::cos(f(t))); }};
    case 14:
      return {"atan(" + a.text + ")", [=](long double t) { return std::atan(f(t)); }};
    case 15:
      return {"(sinh(sin(" + a.text + "))-cosh(sin(" + b.text + ")))",
              [=](long double t) { return std::sinh(std::sin(f(t))) - std::cosh(std::sin(g(t))); }};
    case 16:
      return {"mix(" + a.text + ", tanh(" + b.text + "), 0.25)",
              [=](long double t) { return f(t) + (std::tanh(g(t)) - f(t)) * 0.25L; }};
    default:
      return {"hypot(1+sin(" + a.text + ")^2, " + b.text + ")",
              [=](long double t) { return std::hypot(1 + std::pow(std::sin(f(t)), 2), g(t)); }};
  }
}

double at(const std::string& text, double t = 0) {
  return Expression(text).sample(t).value;
}

std::string fault_of(const std::string& text) {
  try {
    (void)Expression(text);
    return "none";
  } catch (const ExpressionError& error) {
    return error.what();
  }
}

}  // namespace

TEST_CASE("random expressions have the value of the C library's functions, and its numerical derivatives") {
  Random random(5);
  for (int round = 0; round < 400; ++round) {
    const Pair pair = random_pair(random, 3);
    CAPTURE(pair.text);
    const Expression expression(pair.text);
    for (const double t : {-1.3, 0.4, 2.1}) {
      const Sample<double> s = expression.sample(t);
      const auto f = pair.meaning;
      CHECK(near(s.value, static_cast<double>(f(t)), 1e-13));
      // Differences of sixth order; what they leave shrinks with a smaller step.
      const long double h = 1e-3L, x = t;
      const auto sum = [&](int i, long double sign) { return f(x + i * h) + sign * f(x - i * h); };
      const long double rate = (45 * sum(1, -1) - 9 * sum(2, -1) + sum(3, -1)) / (60 * h);
      const long double bend = (270 * sum(1, 1) - 27 * sum(2, 1) + 2 * sum(3, 1) - 490 * f(x)) / (180 * h * h);
      CHECK(near(s.rate, static_cast<double>(rate), 1e-9));
      CHECK(near(s.acceleration, static_cast<double>(bend), 1e-6));
    }
  }
}

TEST_CASE("operators bind and group as they do on paper") {
  CHECK(at("2+3*4") == 14);
  CHECK(at("(2+3)*4") == 20);
  CHECK(at("2^3^2") == 512);
  CHECK(at("-2^2") == -4);
  CHECK(at("2^-1") == 0.5);
  CHECK(at("2*-3") == -6);
  CHECK(at("8/4/2") == 1);
  CHECK(at("8-4-2") == 2);
  CHECK(at(" + 1.5e2 -.5 ") == 149.5);
  CHECK(at("--t", 3) == 3);
  CHECK(at("pi") == pi);
  CHECK(at("tau/4") == pi / 2);
  CHECK(at("log(e)") == doctest::Approx(1).epsilon(1e-15));
  CHECK(at("2*cos(t)", 1) == 2 * std::cos(1.0));
}

TEST_CASE("functions of several arguments mean what their names say") {
  CHECK(at("min(3, 1, 2)") == 1);
  CHECK(at("max(3, 1, 2)+t", 1) == 4);
  CHECK(at("clamp(t, 0, 2)", 5) == 2);
  CHECK(at("clamp(t, 0, 2)", -5) == 0);
  CHECK(at("mod(t, 3)", -1) == 2);
  CHECK(at("fract(t)", -0.25) == 0.75);
  CHECK(at("floor(t)", -0.25) == -1);
  CHECK(at("ceil(t)", 0.25) == 1);
  CHECK(at("round(t)", 2.5) == 3);
  CHECK(at("sign(t)", -2) == -1);
  CHECK(at("step(1, t)", 0.5) == 0);
  CHECK(at("step(1, t)", 1.5) == 1);
  CHECK(at("smoothstep(1, 3, t)", 2) == 0.5);
  CHECK(at("smoothstep(1, 3, t)", 9) == 1);
  CHECK(at("mix(2, 4, 0.25)") == 2.5);
  CHECK(at("atan2(1, -1)") == doctest::Approx(0.75 * pi));
  CHECK(at("pow(t, 3)", -2) == -8);
  CHECK(at("cbrt(t)", -27) == -3);
  CHECK(at("hypot(3, 4)") == 5);
}

TEST_CASE("powers with whole exponents have rates at zero and below") {
  const auto at_zero = Expression("t^2").sample(0);
  CHECK(at_zero.value == 0);
  CHECK(at_zero.rate == 0);
  CHECK(at_zero.acceleration == 2);
  CHECK(Expression("t^1").sample(0).rate == 1);
  CHECK(Expression("t^0").sample(0).value == 1);
  CHECK(Expression("t^3").sample(-2).rate == 12);
  CHECK(Expression("t^-2").sample(-2).acceleration == 6.0 / 16);
  CHECK(Expression("t^101").sample(-1).value == -1);
  CHECK(std::isnan(Expression("t^0.5").sample(-1).value));
}

TEST_CASE("where a formula jumps or kinks, each side has its own limit") {
  const Expression kink("abs(t-1)"), saw("mod(t, 2)"), stair("floor(-t)"), up("step(1, t)"), lesser("min(t, 2-t)");
  CHECK(kink.sample(1, Side::in).rate == -1);
  CHECK(kink.sample(1, Side::out).rate == 1);
  CHECK(saw.sample(2, Side::in).value == 2);
  CHECK(saw.sample(2, Side::out).value == 0);
  CHECK(saw.sample(2, Side::in).rate == 1);
  CHECK(stair.sample(1, Side::in).value == -1);
  CHECK(stair.sample(1, Side::out).value == -2);
  CHECK(up.sample(1, Side::in).value == 0);
  CHECK(up.sample(1, Side::out).value == 1);
  CHECK(lesser.sample(1, Side::in).rate == 1);
  CHECK(lesser.sample(1, Side::out).rate == -1);
  CHECK(Expression("abs(t^2)").sample(0, Side::in).acceleration == 2);
  CHECK(Expression("smoothstep(0, 1, t)").sample(0, Side::in).acceleration == 0);
  CHECK(Expression("smoothstep(0, 1, t)").sample(0, Side::out).acceleration == 6);
}

TEST_CASE("parameters stand for their numbers, and variables carry rates of their own") {
  const std::vector<Expression::Parameter> parameters = {{"speed", 3}, {"high_2", -1}};
  CHECK(Expression("speed*t + high_2", parameters).sample(2).value == 5);
  const std::vector<std::string> names = {"x", "y", "t"};
  const Expression field("x*y^2 + t", names, {});
  // Along x = 2 + 3 s, y = 5 - s + s^2, t = s at s = 0: x y^2 + t has the rate 3 25 + 2 2 5 (-1) + 1.
  const std::vector<Sample<double>> motion = {{2, 3, 0}, {5, -1, 2}, {0, 1, 0}};
  const Sample<double> s = field.sample(motion);
  CHECK(s.value == 50);
  CHECK(s.rate == 75 - 20 + 1);
  // d2/ds2 (x y^2) = 2 x' 2 y y' + x (2 y'^2 + 2 y y'').
  CHECK(s.acceleration == 2 * 3 * 2 * 5 * -1 + 2 * (2 * 1 + 2 * 5 * 2));
  const std::vector<Sample<double>> along_y = {{2, 0, 0}, {5, 1, 0}, {0, 0, 0}};
  CHECK(field.sample(along_y).rate == 20);
  CHECK_THROWS_WITH_AS((void)Expression("t", std::vector<Expression::Parameter>{{"pi", 3}}), doctest::Contains("pi"),
                       std::invalid_argument);
  CHECK_THROWS_WITH_AS((void)Expression("t", std::vector<Expression::Parameter>{{"2x", 3}}), doctest::Contains("2x"),
                       std::invalid_argument);
  CHECK_THROWS_AS((void)Expression("t", std::vector<Expression::Parameter>{{"t", 3}}), std::invalid_argument);
  CHECK_THROWS_AS((void)Expression("t", std::vector<Expression::Parameter>{{"a", std::nan("")}}),
                  std::invalid_argument);
}

TEST_CASE("a curve of an expression is finite everywhere, also where its formula is not") {
  const Curve<double> root = expression_curve(Expression("sqrt(t)"));
  CHECK(root.value(4) == 2);
  CHECK(root.rate(4) == 0.25);
  for (const char* text : {"sqrt(t)", "1/t", "log(t)", "exp(1e6*t)", "t^0.5", "asin(t)", "t^t", "0/0*t"})
    for (const double t : {-2.0, 0.0, 1.0, 1e9, -1e300}) {
      const Sample<double> s = expression_curve(Expression(text)).sample(t);
      CHECK((std::isfinite(s.value) && std::isfinite(s.rate) && std::isfinite(s.acceleration)));
    }
}

TEST_CASE("a faulty expression is refused with its column and what would be right") {
  CHECK(fault_of("2*cas(t)") == "column 3: unknown function \"cas\"; did you mean \"cos\"?");
  CHECK(fault_of("2*taw") == "column 3: unknown name \"taw\"; did you mean \"tau\"?");
  CHECK(fault_of("1+quux") == "column 3: unknown name \"quux\"; known: t, pi, tau, e");
  CHECK(fault_of("2t") == "column 2: expected an operator, found \"t\"; a product is written with *");
  CHECK(fault_of("t**2") == "column 3: expected a value, found \"**\"; a power is written with ^");
  CHECK(fault_of("(1+t") == "column 5: expected \")\" for the \"(\" at character 1 of the formula, found the end");
  CHECK(fault_of("") == "column 1: expected a value, found the end");
  CHECK(fault_of("1+") == "column 3: expected a value, found the end");
  CHECK(fault_of("1+)") == "column 3: expected a value, found \")\"");
  CHECK(fault_of("sin t") == "column 1: a function is called with parentheses: sin(x)");
  CHECK(fault_of("clamp(t, 1)") == "column 1: expected clamp(x, low, high), found 2 arguments");
  CHECK(fault_of("min(t)") == "column 1: expected min(a, b, ...), found 1 argument");
  CHECK(fault_of("sin()") == "column 1: expected sin(x), found 0 arguments");
  CHECK(fault_of("pi(2)") == "column 1: \"pi\" is a number, not a function; a product is written with *");
  CHECK(fault_of("1e999") == "column 1: this number is beyond the range of numbers");
  CHECK(fault_of("t \xc3\xa4") == "column 3: expected an operator, found a character that no expression has");
  CHECK(fault_of("t $") == "column 3: expected an operator, found \"$\"");
}

TEST_CASE("hostile texts are refused or read, and never crash") {
  CHECK(fault_of(std::string(1000000, '(')).find("at most 4000 characters") != std::string::npos);
  CHECK(fault_of(std::string(3000, '(')).find("nested at most") != std::string::npos);
  CHECK(fault_of(std::string(3000, '-') + "1").find("nested at most") != std::string::npos);
  std::string tower = "t";
  for (int i = 0; i < 900; ++i) tower += "^t";
  CHECK(fault_of(tower).find("nested at most") != std::string::npos);
  std::string deep = "t";
  for (int i = 0; i < 900; ++i) deep += "+t*t";
  CHECK(fault_of(deep) == "none");
  Random random(9);
  const std::string letters = "t01.e+-*/^(),sincoaxmp \x80";
  int refused = 0;
  for (int round = 0; round < 20000; ++round) {
    std::string text;
    for (std::uint64_t i = random.bits() % 24; i > 0; --i) text += letters[random.bits() % letters.size()];
    try {
      (void)Expression(text).sample(0.5);
    } catch (const ExpressionError& error) {
      CHECK(error.place() <= text.size());
      ++refused;
    }
  }
  CHECK(refused > 1000);
}

TEST_CASE("every function that is listed can be called as it is listed") {
  for (const std::string& form : Expression::functions()) {
    CAPTURE(form);
    std::string text;
    for (std::size_t i = 0; i < form.size(); ++i) text += form[i];
    // The names of the arguments become numbers.
    const std::size_t open = text.find('(');
    std::string call = text.substr(0, open + 1);
    std::size_t arguments = 1;
    for (const char c : text) arguments += c == ',';
    if (text.find("...") != std::string::npos) ++arguments;
    for (std::size_t i = 0; i < arguments; ++i) call += (i ? ", 0.5" : "0.5");
    CHECK(fault_of(call + ")") == "none");
  }
}
