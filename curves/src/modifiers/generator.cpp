#include <stdexcept>

#include "modifiers/modifier_form.h"

namespace tweenfall::forms {
namespace {

using modifiers::Generator;

class GeneratorForm : public ModifierForm {
 public:
  explicit GeneratorForm(const Generator& generator) : generator_(generator) {}

  void change(math::Jet& value, const Moment& m, double) const noexcept override {
    const math::Jet result = generator_.factorized ? product(m.time) : sum(m.time);
    value = generator_.additive ? value + result : result;
  }

 private:
  [[nodiscard]] math::Jet sum(const math::Jet& t) const noexcept {
    math::Jet result;
    const std::vector<double>& c = generator_.coefficients;
    for (auto k = c.rbegin(); k != c.rend(); ++k) result = result * t + *k;
    return result;
  }

  [[nodiscard]] math::Jet product(const math::Jet& t) const noexcept {
    math::Jet result = math::constant(1);
    const std::vector<double>& c = generator_.coefficients;
    for (std::size_t i = 0; i + 1 < c.size(); i += 2) result = result * (c[i] * t + c[i + 1]);
    return result;
  }

  Generator generator_;
};

}  // namespace

FormPointer form_of(const Generator& generator, const Curve<double>&) {
  if (generator.coefficients.empty()) throw std::invalid_argument("a generator needs at least one coefficient");
  for (const double c : generator.coefficients) check_finite(c, "a generator's coefficient");
  if (generator.factorized && generator.coefficients.size() % 2 != 0)
    throw std::invalid_argument("a factorized generator needs its coefficients in pairs; there are " +
                                std::to_string(generator.coefficients.size()));
  return std::make_unique<const GeneratorForm>(generator);
}

}  // namespace tweenfall::forms
