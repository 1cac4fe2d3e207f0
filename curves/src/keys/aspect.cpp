#include "curve/curve_data.h"

namespace tweenfall {

Curve<Vec2> aspect_curve(const Curve<double>& ratio) {
  return CurveAccess::converted<Vec2>(ratio, [](const Curve<double>& curve, double time, Side side) {
    const Sample<double> r = curve.sample(time, side);
    const Vec2 none(0, 0);
    if (!(r.value > 0)) return Sample<Vec2>{Vec2(1, 1), none, none};
    // Of x = r^k: x' / x = k r'/r and x'' / x = k r''/r + k (k - 1) (r'/r)^2, with k = 1/2 and -1/2.
    const double root = std::sqrt(r.value), change = r.rate / r.value, bend = r.acceleration / r.value;
    const double wide = 0.5 * bend - 0.25 * change * change, high = -0.5 * bend + 0.75 * change * change;
    return Sample<Vec2>{Vec2(root, 1 / root), Vec2(0.5 * change * root, -0.5 * change / root),
                        Vec2(wide * root, high / root)};
  });
}

}  // namespace tweenfall
