#pragma once

// Slopes from the two secants on each side of a key, as weighted by Akima's rules.

#include <algorithm>
#include <cmath>

#include "slopes/slope_rule.h"

namespace tweenfall::slopes {

/// Beyond the ends of an open curve the secants are extrapolated linearly, as for a parabola.
[[nodiscard]] inline double secant_beyond(const SlopeProblem& p, std::ptrdiff_t span, std::size_t c) noexcept {
  const std::ptrdiff_t count = static_cast<std::ptrdiff_t>(p.spans);
  if (span >= 0 && span < count) return p.secant(static_cast<std::size_t>(span), c);
  if (p.ends == Ends::wrap) return p.secant(static_cast<std::size_t>((span % count + count) % count), c);
  const std::size_t end = span < 0 ? 0 : p.spans - 1;
  if (p.spans == 1) return p.secant(end, c);
  const double own = p.secant(end, c), next = p.secant(span < 0 ? 1 : p.spans - 2, c);
  const double steps = static_cast<double>(span < 0 ? -span : span - count + 1);
  return own + steps * (own - next);
}

/// `rule(m0, m1, m2, m3)` with m1 arriving at the key and m2 leaving it.
template <class Rule>
void akima_slopes(const SlopeProblem& p, const Rule& rule) {
  p.for_each_key([&p, &rule](std::size_t key, std::size_t c) {
    if (p.ends == Ends::flat && (key == 0 || key == p.spans)) return 0.0;
    const std::ptrdiff_t k = static_cast<std::ptrdiff_t>(key);
    return rule(secant_beyond(p, k - 2, c), secant_beyond(p, k - 1, c), secant_beyond(p, k, c),
                secant_beyond(p, k + 1, c));
  });
}

}  // namespace tweenfall::slopes
