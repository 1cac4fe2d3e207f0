#include <tweenfall/anim/component.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "compiling/fit.h"

namespace tweenfall::crowd {

namespace {

/// Repeats of a curve beyond this number are found by sampling, as for formulas.
constexpr std::size_t most_knots = 200000;

void add_inside(double time, double duration, std::vector<double>& out) {
  if (time > 0 && time < duration && out.size() < most_knots) out.push_back(time);
}

/// The knots of a curve that continues beyond an end by a rule, forwards or backwards.
template <class T>
void add_repeats(const Curve<T>& curve, Outside rule, bool after, double duration, std::vector<double>& out) {
  add_inside(after ? curve.end() : curve.start(), duration, out);
  if (rule == Outside::hold || rule == Outside::linear) return;
  const double period = curve.duration(), edge = after ? curve.end() : curve.start();
  if (!(period > 0) || !std::isfinite(period)) return;
  const std::span<const double> knots = curve.knots();
  for (std::size_t play = 1; out.size() < most_knots; ++play) {
    const double begin =
        after ? edge + static_cast<double>(play - 1) * period : edge - static_cast<double>(play) * period;
    if (after ? begin > duration : begin + period < 0) break;
    add_inside(begin, duration, out);
    for (const double knot : knots) {
      add_inside(begin + (knot - curve.start()), duration, out);
      if (rule == Outside::pingpong) add_inside(begin + (curve.end() - knot), duration, out);
    }
  }
}

template <class T>
[[nodiscard]] bool is_formula(const Curve<T>& curve) {
  const bool constant = curve.knots().empty() && curve.start() == curve.end();
  return !constant && curve.spans().empty();
}

template <class T>
void add_knots(const Curve<T>& curve, double duration, double look, std::vector<double>& out) {
  for (const double knot : curve.knots()) add_inside(knot, duration, out);
  if (std::isfinite(curve.start())) add_repeats(curve, curve.before(), false, duration, out);
  if (std::isfinite(curve.end())) add_repeats(curve, curve.after(), true, duration, out);
  if (!is_formula(curve)) return;
  const auto looks = static_cast<std::size_t>(std::min(std::ceil(duration / look), 1e5));
  for (std::size_t i = 1; i < looks; ++i)
    add_inside(duration * static_cast<double>(i) / static_cast<double>(looks), duration, out);
}

}  // namespace

CurveKnots::CurveKnots(const Clip& clip, const Hierarchy& nodes, double longest_look) : look(longest_look) {
  for (auto& kind : of) kind.resize(nodes.size());
  for (auto& kind : formula) kind.resize(nodes.size(), 0);
  for (const Track& track : clip.tracks) {
    const std::optional<Kind> kind = kind_of(track);
    const std::optional<std::size_t> node = nodes.find(track.node);
    if (!kind || !node) continue;
    std::vector<double>& out = of[static_cast<std::size_t>(*kind)][*node];
    char& by_formula = formula[static_cast<std::size_t>(*kind)][*node];
    // The last track of a whole property is the one that counts.
    if (!component_named(track.property)) {
      out.clear();
      by_formula = 0;
    }
    const auto add = [&](const auto& curve) {
      add_knots(curve, clip.duration, longest_look, out);
      if (is_formula(curve)) by_formula = 1;
    };
    if (const auto* vectors = std::get_if<Curve<Vec3>>(&track.curve)) add(*vectors);
    if (const auto* rotations = std::get_if<Curve<Quat>>(&track.curve)) add(*rotations);
    if (const auto* numbers = std::get_if<Curve<double>>(&track.curve)) add(*numbers);
  }
}

}  // namespace tweenfall::crowd
