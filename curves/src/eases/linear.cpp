#include <algorithm>
#include <cmath>

#include "eases/ease_row.h"

namespace tweenfall::eases {
namespace {

// A stop of CSS linear(): an output and zero, one or two inputs in percent at which it applies.
struct LinearStop {
  double output;
  std::vector<double> percents{};
};

struct Point {
  double input, output;
};

// Every stop with its input: the first at 0 and the last at 1 unless given, no stop before an earlier one, the rest
// spread evenly between their neighbors.
std::vector<Point> placed(const std::vector<LinearStop>& stops) {
  constexpr double open = -HUGE_VAL;
  std::vector<Point> points;
  double largest = open;
  const auto add = [&points, &largest](double input, double output) {
    largest = std::max(largest, input);
    points.push_back({largest, output});
  };
  for (std::size_t i = 0; i < stops.size(); ++i) {
    for (const double percent : stops[i].percents) add(percent / 100, stops[i].output);
    if (!stops[i].percents.empty()) continue;
    if (i == 0)
      add(0, stops[i].output);
    else if (i + 1 == stops.size())
      add(1, stops[i].output);
    else
      points.push_back({open, stops[i].output});
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].input != open) continue;
    std::size_t next = i;
    while (points[next].input == open) ++next;
    const double from = points[i - 1].input, step = (points[next].input - from) / static_cast<double>(next - i + 1);
    for (std::size_t k = i; k < next; ++k) points[k].input = from + static_cast<double>(k - i + 1) * step;
  }
  return points;
}

// The straight line through two points, from one input to another.
Span<double> straight(const Point& a, const Point& b, double from, double to) {
  const auto at = [&a, &b](double input) {
    // Two points at one input: the output of the second holds on both sides.
    if (!(b.input > a.input)) return b.output;
    const double u = (input - a.input) / (b.input - a.input);
    return u == 0 ? a.output : u == 1 ? b.output : a.output + u * (b.output - a.output);
  };
  Span<double> p{};
  p.start = from;
  p.duration = to - from;
  p.degree = 1;
  p.coefficients[0] = at(from);
  p.coefficients[1] = at(to) - at(from);
  p.end = at(to);
  return p;
}

}  // namespace

// Source: W3C, "CSS Easing Functions Level 2", output of a linear easing function: outside the points the line through
// the first two, or the last two, is continued; where these share an input, the second one's output holds.
static Pieces linear(const std::vector<LinearStop>& stops) {
  std::vector<Point> points = placed(stops);
  if (points.size() == 1) points.push_back(points[0]);
  Pieces result;
  double from = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const bool last = i + 2 == points.size();
    const double to = last ? 1 : std::clamp(points[i + 1].input, 0.0, 1.0);
    // Nearer than this the slope between them means nothing.
    if (!(to - from > 1e-12)) continue;
    // Two points at one input are a jump, except at either end, where there are no others to continue from.
    const bool jump = !(points[i + 1].input > points[i].input);
    if (jump && i > 0 && !last) continue;
    result.push_back(straight(points[i], points[i + 1], from, to));
    from = to;
  }
  return result;
}

namespace {

// An output, and up to two percentages before or after it.
LinearStop linear_stop(std::string_view text) {
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
      refuse(words::quoted(text) +
             " in linear(...) must be a number with none, one or two percentages, as 0.5 25% 75%");
    if (percent)
      percents.push_back(*number);
    else
      output = number;
  }
  if (!output) refuse(words::quoted(text) + " in linear(...) has no output, as the 0.5 of 0.5 25%");
  check_range("an output in linear(...)", *output, -1e6, 1e6);
  for (const double percent : percents) check_range("a percentage in linear(...)", percent, -1e6, 1e6);
  return {*output, percents};
}

Ease linear_stops(const Call& call) {
  if (call.arguments.empty()) refuse("linear(...) needs at least one stop; none was given");
  std::vector<LinearStop> stops;
  std::string name;
  for (const std::string_view argument : call.arguments) {
    stops.push_back(linear_stop(argument));
    name += (name.empty() ? "linear(" : ",") + number_text(stops.back().output);
    for (const double percent : stops.back().percents) name += " " + number_text(percent) + "%";
  }
  return Ease::shape(name + ")", linear(stops));
}

}  // namespace

extern const Row linear_row{"linear", &Ease::linear, "(stop,...)", &linear_stops};

}  // namespace tweenfall::eases

namespace tweenfall {

Ease Ease::linear() {
  static const Ease ease(Form{.rule = Rule::linear, .name = "linear"});
  return ease;
}

}  // namespace tweenfall
