#include "keys/tangent_rules.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::keying {
namespace {

double limited(double slope, double limit) noexcept {
  return std::clamp(slope, -limit, limit);
}

// From 0 to 1 with f, but drawn more to the nearer end. Source: Autodesk, AnimX (autoTangent), the family
// g(c, f) = 1/2 + (f - 1/2)(1 - c + 4 c (f - 1/2)^2) with c = -1/2.
double drawn_to_nearer(double f) noexcept {
  const double h = f - 0.5;
  return 0.5 + h * (1.5 - 2 * h * h);
}

}  // namespace
}  // namespace tweenfall::keying

namespace tweenfall {

bool keying::is_extreme(double secant_before, double secant_after) noexcept {
  return !((secant_before > 0 && secant_after > 0) || (secant_before < 0 && secant_after < 0));
}

double keying::neighbor_slope(TangentKind kind, const keying::KeyNeighbors& key) noexcept {
  const double d0 = key.secant_before, d1 = key.secant_after;
  if (kind == TangentKind::automatic) return 0.5 * d0 + 0.5 * d1;
  if (kind == TangentKind::flat || keying::is_extreme(d0, d1)) return 0;
  if (kind == TangentKind::auto_clamped)
    return keying::limited(0.5 * d0 + 0.5 * d1, std::min(std::abs(d0) / key.weight_in, std::abs(d1) / key.weight_out));
  const double f = key.duration_before / (key.duration_before + key.duration_after);
  const double limit = 3 * std::min(std::abs(d0), std::abs(d1));
  switch (kind) {
    case TangentKind::auto_chord:
      return keying::limited(f * d0 + (1 - f) * d1, limit);
    case TangentKind::auto_mix:
      return keying::limited((1 - f) * d0 + f * d1, limit);
    case TangentKind::auto_ease: {
      const double g = keying::drawn_to_nearer(f);
      return keying::limited((1 - g) * d0 + g * d1, limit);
    }
    default:
      return f * d0 + (1 - f) * d1;
  }
}

}  // namespace tweenfall
