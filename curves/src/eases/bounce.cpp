#include "eases/ease_row.h"

namespace tweenfall::eases {
namespace {

// A parabola 121/16 (u - center)^2 + height over [from, to], in the piece's own position.
Span<double> hop(double from, double to, double center, double height, double end) {
  const double k = 121.0 / 16, length = to - from, offset = from - center;
  Span<double> p{};
  p.start = from;
  p.duration = length;
  p.degree = 2;
  p.coefficients = {k * offset * offset + height, 2 * k * offset * length, k * length * length, 0, 0, 0};
  p.end = end;
  return p;
}

}  // namespace

// Source: Penner, 2002: four hops at 4/11, 8/11 and 10/11.
static Pieces bounce(Flow flow) {
  Pieces out = {hop(0, 4.0 / 11, 0, 0, 1), hop(4.0 / 11, 8.0 / 11, 6.0 / 11, 0.75, 1),
                hop(8.0 / 11, 10.0 / 11, 9.0 / 11, 15.0 / 16, 1), hop(10.0 / 11, 1, 21.0 / 22, 63.0 / 64, 1)};
  // Every later hop begins at 1, where the one before touched.
  for (std::size_t i = 1; i < out.size(); ++i) out[i].coefficients[0] = 1;
  // The "in" form is the reflection of the "out" form.
  const Pieces in = flowing(out, Flow::out);
  return flow == Flow::out ? out : flowing(in, flow);
}

extern const FamilyRow bounce_family{"bounce", [](const Numbers&, Flow flow) { return bounce(flow); }};

}  // namespace tweenfall::eases
