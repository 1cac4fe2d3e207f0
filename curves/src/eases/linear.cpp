#include <algorithm>
#include <cmath>

#include "eases/shapes.h"

namespace tweenfall::shapes {
namespace {

struct Point {
  double input, output;
};

// Every stop with its input: the first at 0 and the last at 1 unless given, none before an earlier one, the rest
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

// Straight through two points, from one input to another.
Span<double> straight(const Point& a, const Point& b, double from, double to) {
  const auto at = [&a, &b](double input) {
    // Two points at one input: what the second says holds on both sides.
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
// the first two, or the last two, goes on; where these share an input, the second one's output holds.
Pieces linear(const std::vector<LinearStop>& stops) {
  std::vector<Point> points = placed(stops);
  if (points.size() == 1) points.push_back(points[0]);
  Pieces result;
  double from = 0;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const bool last = i + 2 == points.size();
    const double to = last ? 1 : std::clamp(points[i + 1].input, 0.0, 1.0);
    if (!(to > from)) continue;
    // Two points at one input are a jump, except at either end, where they are all there is to go by.
    const bool jump = !(points[i + 1].input > points[i].input);
    if (jump && i > 0 && !last) continue;
    result.push_back(straight(points[i], points[i + 1], from, to));
    from = to;
  }
  return result;
}

}  // namespace tweenfall::shapes
