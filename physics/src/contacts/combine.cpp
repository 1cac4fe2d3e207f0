#include "contacts/combine.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::contacts {

namespace {

double combined(double a, double b, Combine rule) {
  switch (rule) {
    case Combine::average:
      return 0.5 * (a + b);
    case Combine::minimum:
      return std::min(a, b);
    case Combine::multiply:
      return a * b;
    case Combine::maximum:
      return std::max(a, b);
    case Combine::usual:
    case Combine::geometric_mean:
      break;
  }
  return std::sqrt(a * b);
}

}  // namespace

double combined_friction(double a, Combine rule_a, double b, Combine rule_b) {
  return combined(a, b, std::max(rule_a, rule_b));
}

double combined_restitution(double a, Combine rule_a, double b, Combine rule_b) {
  const Combine rule = std::max(rule_a, rule_b);
  return combined(a, b, rule == Combine::usual ? Combine::maximum : rule);
}

}  // namespace tweenfall::contacts
