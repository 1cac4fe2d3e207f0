#pragma once

// Curves on which questions and edits have failed somewhere before, each with its name.

#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/keys.h>

#include "support.h"

#include <limits>
#include <utility>

namespace tweenfall::test {

struct Exhibit {
  std::string name;
  Curve<double> curve;
};

inline Key<double> sloped(double time, double value, double rate, double weight = 1.0 / 3) {
  const Tangent<double> slope{Tangent<double>::Kind::given, rate, weight};
  return {time, value, Ease::smooth_clamped(), slope, slope};
}

/// Steep, tiny, huge, jumping, resting, eased and formula curves, all with an end.
inline std::vector<Exhibit> museum() {
  std::vector<Exhibit> result;
  const auto add = [&result](const char* name, const Curve<double>& curve) { result.push_back({name, curve}); };
  const auto word = [](const char* name) { return *Ease::named(name); };
  add("one key", keyed_curve<double>({{2, 3}}));
  add("a constant", Curve<double>(5.0));
  add("two keys", keyed_curve<double>({{0, 1}, {1, 2}}));
  add("vertical tangents", keyed_curve<double>({sloped(0, 0, 0, 1), sloped(1, 1, 0, 1), sloped(2, -1, 0, 1)}));
  add("vertical in the middle", keyed_curve<double>({{0, 0, Ease::bezier(1, 0, 0, 1)}, {1, 1}}));
  add("slopes of a million", keyed_curve<double>({sloped(0, 0, 1e6), sloped(1, 0, -1e6)}));
  add("near-coincident keys",
      keyed_curve<double>({{0, 0}, {1, 1}, {1 + 1e-12, 2}, {2, 0}, {2 + 4e-16 * 2, 1}, {3, 0}}));
  add("spans of 1e-9 s", keyed_curve<double>({{0, 0}, {1e-9, 1}, {2e-9, -1}, {1, 0}}));
  add("spans of 1e9 s", keyed_curve<double>({{-1e9, 0}, {0, 1}, {1e9, -1}, {1e9 + 1, 4}}));
  add("short after long", keyed_curve<double>({{0, 0}, {1e9, 1}, {1e9 + 1e-6, 2}}));
  add("huge values", keyed_curve<double>({{0, -1e300}, {1, 1e300}, {2, 1e299}}));
  add("tiny values", keyed_curve<double>({{0, -1e-300}, {1, 1e-300}, {2, 1e-301}}));
  add("large offset", keyed_curve<double>({{0, 1e9}, {1, 1e9 + 1e-3}, {2, 1e9}}));
  add("a jump", keyed_curve<double>({{0, 0, Ease::linear()}, {1, 5, Ease::linear(), {}, {}, 1.0}, {2, 4}}));
  add("holds", keyed_curve<double>({{0, 0, Ease::hold()}, {1, 5, Ease::hold()}, {2, -1}}));
  add("flat", keyed_curve<double>({{0, 2}, {1, 2}, {2, 2}}));
  add("an inflection at rest", keyed_curve<double>({sloped(-1, -1, 3), sloped(1, 1, 3)}));
  add("a circle's quarter", keyed_curve<double>({{0, 0, word("circ-out")}, {1, 1}}));
  add("elastic", keyed_curve<double>({{0, 0, word("elastic-out")}, {1, 1}}));
  add("bounce", keyed_curve<double>({{0, 0, word("bounce-out")}, {1, 1}}));
  add("steps", keyed_curve<double>({{0, 0, word("steps(4)")}, {1, 1}}));
  add("a spring", keyed_curve<double>({{0, 0, Ease::spring(0.1, 0.05)}, {2, 1}}));
  add("exponential", keyed_curve<double>({{0, 0, word("expo-in-out")}, {1, 1}}));
  KeyOptions ratio;
  ratio.logarithmic = true;
  add("by ratio", keyed_curve<double>({{0, 1e-6}, {1, 1}, {3, 1e6}}, ratio));
  add("a formula", Curve<double>([](double t, Side) { return Sample<double>{t * t * t, 3 * t * t, 6 * t}; }, -1, 2));
  add("a formula that jumps", Curve<double>(
                                  [](double t, Side) {
                                    return Sample<double>{t < 0.3 ? 0.0 : 1.0, 0, 0};
                                  },
                                  0, 1));
  return result;
}

/// A curve of mixed kinds through a few random keys.
inline Curve<double> random_curve(Random& random, bool eases = true) {
  std::vector<Key<double>> keys;
  double time = random.between(-3, 3);
  const int count = 2 + static_cast<int>(random.between(0, 7));
  for (int i = 0; i < count; ++i) {
    Key<double> key{time, random.between(-5, 5)};
    const int kind = static_cast<int>(random.between(0, eases ? 8 : 6));
    if (kind == 0) key.ease = Ease::linear();
    if (kind == 1) key.ease = Ease::catmull_rom();
    if (kind == 2) key.ease = Ease::natural();
    if (kind == 3 || kind == 4) {
      key.out = Tangent<double>{Tangent<double>::Kind::given, random.between(-9, 9)};
      if (kind == 4) key.out->weight = random.between(0.05, 1);
    }
    if (kind == 5)
      key.in = Tangent<double>{Tangent<double>::Kind::given, random.between(-9, 9), random.between(0.05, 1)};
    if (kind == 6) key.ease = *Ease::named("sine-in-out");
    if (kind == 7) key.ease = *Ease::named("back-out");
    if (key.out) key.ease = Ease::smooth_clamped();
    keys.push_back(key);
    time += random.between(0.05, 2);
  }
  return keyed_curve<double>(std::span<const Key<double>>(keys));
}

/// The greatest distance seen at many times between two curves, at both sides of their knots too.
inline double seen_apart(const Curve<double>& a, const Curve<double>& b, double from, double to) {
  double most = 0;
  const auto look = [&](double t) {
    if (t > from) most = std::max(most, std::abs(a.value(t, Side::in) - b.value(t, Side::in)));
    if (t < to) most = std::max(most, std::abs(a.value(t) - b.value(t)));
  };
  for (int i = 0; i <= 997; ++i) look(i == 997 ? to : from + (to - from) * i / 997);
  for (const double knot : a.knots())
    if (knot >= from && knot <= to) look(knot);
  for (const double knot : b.knots())
    if (knot >= from && knot <= to) look(knot);
  return most;
}

}  // namespace tweenfall::test
