#include <algorithm>

#include "eases/shapes.h"

namespace tweenfall::eases {
namespace {

Span<double> piece(double start, double duration, const std::vector<double>& coefficients, double end,
                   const Warp& warp) {
  Span<double> result{};
  result.start = start;
  result.duration = duration;
  result.degree = static_cast<int>(coefficients.size()) - 1;
  std::copy(coefficients.begin(), coefficients.end(), result.coefficients.begin());
  result.end = end;
  result.warp = warp;
  return result;
}

// 1 - p(1 - s), by repeated synthetic division about 1.
std::vector<double> reflected(std::vector<double> c) {
  const std::size_t n = c.size();
  for (std::size_t i = 0; i + 1 < n; ++i)
    for (std::size_t k = n - 1; k-- > i;) c[k] += c[k + 1];
  for (std::size_t k = 0; k < n; ++k) c[k] *= k % 2 == 0 ? -1 : 1;
  c[0] += 1;
  return c;
}

Span<double> reflected(const Span<double>& p) {
  const std::vector<double> c(p.coefficients.begin(), p.coefficients.begin() + p.degree + 1);
  return piece(1 - (p.start + p.duration), p.duration, reflected(c), 1 - p.coefficients[0], {});
}

// Appends `p`, shrunk into the half of the unit interval that begins at `from`.
void append_half(Pieces& pieces, Span<double> p, double from) {
  p.start = from + 0.5 * p.start;
  p.duration *= 0.5;
  for (double& c : p.coefficients) c *= 0.5;
  p.coefficients[0] += from;
  p.end = from + 0.5 * p.end;
  pieces.push_back(p);
}

}  // namespace

Pieces flowing(const WayIn& way_in, Flow flow) {
  const Span<double> in = piece(0, 1, way_in.coefficients, 1, way_in.warp);
  const Span<double> out = piece(0, 1, reflected(way_in.coefficients), 1, {way_in.reversed, way_in.warp.parameters});
  if (flow == Flow::in) return {in};
  if (flow == Flow::out) return {out};
  Pieces result;
  append_half(result, in, 0);
  append_half(result, out, 0.5);
  return result;
}

Pieces flowing(const Pieces& way_in, Flow flow) {
  if (flow == Flow::in) return way_in;
  Pieces out;
  for (auto p = way_in.rbegin(); p != way_in.rend(); ++p) out.push_back(reflected(*p));
  out.front().start = 0;
  if (flow == Flow::out) return out;
  Pieces result;
  for (const auto& p : way_in) append_half(result, p, 0);
  for (const auto& p : out) append_half(result, p, 0.5);
  return result;
}

}  // namespace tweenfall::eases
