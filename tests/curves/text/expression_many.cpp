#include "expression/expression_many.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <sstream>

#include "curves/counted_allocations.h"
#include "random.h"
#include "support.h"

using namespace tweenfall;
using namespace tweenfall::test;

namespace {

const std::vector<std::string> many_names{"x", "y", "z", "mass"};

/// Any function there is, of anything.
std::string text_of_any_kind(Random& random, int depth) {
  static const std::vector<std::string> functions = Expression::functions();
  if (depth == 0 || random.unit() < 0.15) {
    if (random.unit() < 0.7) return many_names[random.bits() % many_names.size()];
    const double numbers[] = {0, 1, 2, 3, -1, 0.5, -2, 1.5, 7, 65, 0.125};
    std::ostringstream text;
    text << "(" << numbers[random.bits() % std::size(numbers)] << ")";
    return text.str();
  }
  if (random.unit() < 0.5) {
    const char operators[] = "+-*/^";
    const std::string symbol(1, operators[random.bits() % 5]);
    const std::string left = text_of_any_kind(random, depth - 1), right = text_of_any_kind(random, depth - 1);
    return "(" + left + symbol + right + ")";
  }
  const std::string& function = functions[random.bits() % functions.size()];
  std::string text = function.substr(0, function.find('(') + 1);
  const auto commas = std::count(function.begin(), function.end(), ',');
  const auto more = function.find("...") == std::string::npos ? commas : commas - 1;
  for (std::ptrdiff_t i = 0; i <= more; ++i) text += (i > 0 ? "," : "") + text_of_any_kind(random, depth - 1);
  return text + ")";
}

double number_of_any_kind(Random& random) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double odd[] = {0,      -0.0,   1,   -1,  2,     0.5, infinity, -infinity, std::nan(""),         1e300,
                        -1e300, 1e-310, 5e8, 2e9, -3e15, 709, -745,     710,       0x1.921fb54442d18p-1, 1e-300};
  if (random.unit() < 0.1) return odd[random.bits() % std::size(odd)];
  return random.between(-5, 5) * (random.unit() < 0.2 ? 100 : 1);
}

bool are_the_same_number(double a, double b) {
  return (std::isnan(a) && std::isnan(b)) || std::memcmp(&a, &b, sizeof a) == 0;
}

}  // namespace

TEST_CASE("expressions of many numbers have the bits of each alone, by every instruction set") {
  Random random(11);
  for (int round = 0; round < 1500; ++round) {
    const std::string text = text_of_any_kind(random, 1 + static_cast<int>(random.bits() % 4));
    CAPTURE(text);
    const Expression expression(text, many_names, {});
    // Not always a multiple of how many are taken together.
    const std::size_t count = 1 + random.bits() % 150;
    std::vector<std::vector<double>> numbers(many_names.size());
    for (std::vector<double>& list : numbers) {
      list.resize(random.unit() < 0.2 ? 1 : count);
      for (double& each : list) each = number_of_any_kind(random);
    }
    const std::vector<std::span<const double>> lists(numbers.begin(), numbers.end());
    const auto alone = [&](std::size_t i, std::size_t by, Side side) {
      std::vector<Sample<double>> at;
      for (std::size_t k = 0; k < lists.size(); ++k)
        at.push_back({lists[k][lists[k].size() == 1 ? 0 : i], k == by ? 1.0 : 0.0, 0});
      return expression.sample(at, side);
    };
    std::vector<double> found(count);
    for (const expressions::ExpressionKernels* kernels : expressions::expression_kernels()) {
      const Expression::Program program{expressions::read_expression(text, many_names, {})};
      expressions::find_values(*kernels, program, lists, found);
      for (std::size_t i = 0; i < count; ++i)
        REQUIRE(are_the_same_number(found[i], alone(i, many_names.size(), Side::out).value));
      const std::size_t by = random.bits() % many_names.size();
      const Side side = random.unit() < 0.5 ? Side::out : Side::in;
      const std::span<double> slopes[] = {found};
      expressions::find_slopes(*kernels, program, lists, by, side == Side::out ? 1 : -1, slopes);
      for (std::size_t i = 0; i < count; ++i) REQUIRE(are_the_same_number(found[i], alone(i, by, side).rate));
    }
    expression.values(lists, found);
    for (std::size_t i = 0; i < count; ++i)
      REQUIRE(are_the_same_number(found[i], alone(i, many_names.size(), Side::out).value));
  }
}

TEST_CASE("a variable without a number is 0 for many as for one") {
  const Expression expression("x + 2*y", std::vector<std::string>{"x", "y"}, {});
  const std::vector<double> x{1, 2, 3};
  const std::vector<std::span<const double>> given{x};
  std::vector<double> found(3);
  expression.values(given, found);
  CHECK(found == x);
}

TEST_CASE("derivatives in several variables at once are those in each, also of very long expressions") {
  std::string text = "exp(0.1*x)^1.5";
  for (const std::string function : {"sin", "exp", "cos", "log", "exp", "sin", "log", "cos", "exp", "log"})
    text += " + y*" + function + "(1 + 0.1*x^2)*z";
  const Expression expression(text, many_names, {});
  const std::vector<double> x{0.3, -2, 5, 0.1}, y{1, 2, -3, 4}, z{0.5, 0.25, 3, -1}, mass{2};
  const std::vector<std::span<const double>> given{x, y, z, mass};
  std::array<std::vector<double>, 3> found;
  found.fill(std::vector<double>(x.size()));
  const std::span<double> slopes[] = {found[0], found[1], found[2]};
  expression.slopes(given, 0, slopes);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t by = 0; by < 3; ++by) {
      const std::vector<Sample<double>> at{
          {x[i], by == 0 ? 1.0 : 0.0, 0}, {y[i], by == 1 ? 1.0 : 0.0, 0}, {z[i], by == 2 ? 1.0 : 0.0, 0}, {2, 0, 0}};
      CHECK(found[by][i] == expression.sample(at).rate);
    }
}

TEST_CASE("an expression of many numbers takes no memory") {
  const Expression expression("sin(x)^y + exp(-x^2)*max(x, y, 3)", std::vector<std::string>{"x", "y"}, {});
  const std::vector<double> x(1000, 0.3), y(1000, 2.5);
  const std::vector<std::span<const double>> given{x, y};
  std::vector<double> found(1000), others(1000);
  const std::span<double> slopes[] = {found, others};
  const std::size_t before = allocations();
  expression.values(given, found);
  expression.slopes(given, 0, slopes);
  CHECK(allocations() == before);
}
