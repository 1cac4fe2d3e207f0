#include "curve/time_bezier.h"
#include "eases/ease_row.h"

namespace tweenfall::eases {

// Source: W3C, "CSS Easing Functions Level 1", cubic-bezier.
static Pieces bezier(double x1, double y1, double x2, double y2) {
  Span<double> p{};
  p.degree = 3;
  p.coefficients = {0, 3 * y1, 3 * y2 - 6 * y1, 1 + 3 * y1 - 3 * y2, 0, 0};
  p.end = 1;
  p.warp = spans::time_bezier_warp(x1, x2);
  return {p};
}

namespace {

Ease called_bezier(const Call& call) {
  call.expect(4, 4, std::string(call.name) + "(x1,y1,x2,y2)");
  return Ease::bezier(call.number(0), call.number(1), call.number(2), call.number(3));
}

}  // namespace

extern const Row bezier_row{"bezier", nullptr, "(x1,y1,x2,y2)", &called_bezier};

// CSS names. Source: W3C, "CSS Easing Functions Level 1".
extern const Row cubic_bezier_row{"cubic-bezier", nullptr, "(x1,y1,x2,y2)", &called_bezier};
extern const Row css_ease_row{"ease", [] { return Ease::shape("ease", bezier(0.25, 0.1, 0.25, 1)); }};
extern const Row css_ease_in_row{"ease-in", [] { return Ease::shape("ease-in", bezier(0.42, 0, 1, 1)); }};
extern const Row css_ease_out_row{"ease-out", [] { return Ease::shape("ease-out", bezier(0, 0, 0.58, 1)); }};
extern const Row css_ease_in_out_row{"ease-in-out",
                                     [] { return Ease::shape("ease-in-out", bezier(0.42, 0, 0.58, 1)); }};

}  // namespace tweenfall::eases

namespace tweenfall {

Ease Ease::bezier(double x1, double y1, double x2, double y2) {
  for (const double x : {x1, x2})
    if (!(x >= 0 && x <= 1))
      throw std::invalid_argument(
          "the handles' times x1 and x2 must lie in 0 to 1, or time would run backwards; one is " + number_text(x));
  for (const double y : {y1, y2}) eases::check_range("a handle's value", y, -1e6, 1e6);
  return shape(eases::call_text("bezier", std::array{x1, y1, x2, y2}), eases::bezier(x1, y1, x2, y2));
}

}  // namespace tweenfall
