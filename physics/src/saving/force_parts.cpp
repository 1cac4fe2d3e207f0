#include "saving/force_fields.h"

#include <algorithm>

#include "state/checks.h"

namespace tweenfall::saving {

namespace {

OutsideRule<double> rule_of(const StrengthParts::Beyond& beyond) {
  state::require(beyond.rule <= Outside::pingpong, "there is no such rule for times beyond the keys");
  return {beyond.rule, beyond.slope, beyond.plays};
}

}  // namespace

StrengthParts parts_of(const Strength& strength) {
  StrengthParts parts;
  parts.text = strength.text();
  if (const std::optional<Curve<double>>& curve = strength.curve()) {
    parts.spans = curve->spans();
    // Coefficients above the degree are zero, whatever they hold.
    for (Span<double>& span : parts.spans)
      std::fill(span.coefficients.begin() + span.degree + 1, span.coefficients.end(), 0.0);
    const auto beyond = [](const OutsideRule<double>& rule) -> StrengthParts::Beyond {
      return {rule.rule, rule.slope, rule.plays};
    };
    parts.before = beyond(curve->rule_before());
    parts.after = beyond(curve->rule_after());
  } else if (parts.text.empty()) {
    parts.factor = strength.at(0);
  }
  return parts;
}

Strength made_of(const StrengthParts& parts) {
  if (!parts.text.empty()) return Strength::formula(parts.text);
  if (parts.spans.empty()) return {parts.factor};
  for (const Span<double>& span : parts.spans)
    state::require(span.degree >= 0 && span.degree <= max_degree, "a strength has a span of an impossible degree");
  const Curve<double> curve(parts.spans);
  return {curve.with_outside(rule_of(parts.before), rule_of(parts.after))};
}

FormulaParts parts_of(const ForceFormula& formula) {
  return {formula.texts(), formula.parameters()};
}

ForceFormula made_of(const FormulaParts& parts) {
  if (parts.texts.size() == 1) return ForceFormula::potential(parts.texts[0], parts.parameters);
  state::require(parts.texts.size() == 3, "a force must have three formulas, or one of its potential energy");
  return ForceFormula({parts.texts[0], parts.texts[1], parts.texts[2]}, parts.parameters);
}

}  // namespace tweenfall::saving
