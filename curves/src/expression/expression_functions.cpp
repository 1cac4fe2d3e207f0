#include "expression/expression_functions.h"

#include "expression/expression_kinds.h"

namespace tweenfall::expressions {
namespace {

template <class Kind>
constexpr ExpressionFunction row(std::string_view name, std::string_view arguments) {
  return {name, arguments, Kind::count, [](const Jet* a, double way) noexcept -> Jet { return Kind::of(a, way); },
          kinds::All::place_of<Kind>()};
}
template <class Kind>
constexpr ExpressionFunction jumping(std::string_view name, std::string_view arguments) {
  ExpressionFunction function = row<Kind>(name, arguments);
  function.jumps = true;
  return function;
}
template <class Kind>
constexpr ExpressionFunction folded(std::string_view name, std::string_view arguments) {
  ExpressionFunction function = row<Kind>(name, arguments);
  function.any_number = true;
  return function;
}

constexpr ExpressionFunction functions[] = {row<kinds::Sine>("sin", "x"),
                                            row<kinds::Cosine>("cos", "x"),
                                            jumping<kinds::Tangent>("tan", "x"),
                                            row<kinds::ArcSine>("asin", "x"),
                                            row<kinds::ArcCosine>("acos", "x"),
                                            row<kinds::ArcTangent>("atan", "x"),
                                            jumping<kinds::AngleOf>("atan2", "y, x"),
                                            row<kinds::HyperbolicSine>("sinh", "x"),
                                            row<kinds::HyperbolicCosine>("cosh", "x"),
                                            row<kinds::HyperbolicTangent>("tanh", "x"),
                                            row<kinds::Exponential>("exp", "x"),
                                            row<kinds::Logarithm>("log", "x"),
                                            row<kinds::SquareRoot>("sqrt", "x"),
                                            row<kinds::CubeRoot>("cbrt", "x"),
                                            row<kinds::Power>("pow", "x, y"),
                                            row<kinds::Hypotenuse>("hypot", "x, y"),
                                            row<kinds::Magnitude>("abs", "x"),
                                            jumping<kinds::Sign>("sign", "x"),
                                            jumping<kinds::Floor>("floor", "x"),
                                            jumping<kinds::Ceiling>("ceil", "x"),
                                            jumping<kinds::Round>("round", "x"),
                                            jumping<kinds::Fraction>("fract", "x"),
                                            jumping<kinds::Remainder>("mod", "x, y"),
                                            folded<kinds::Lesser>("min", "a, b, ..."),
                                            folded<kinds::Greater>("max", "a, b, ..."),
                                            row<kinds::Clamped>("clamp", "x, low, high"),
                                            row<kinds::Mixed>("mix", "a, b, weight"),
                                            jumping<kinds::Step>("step", "edge, x"),
                                            row<kinds::SmoothStep>("smoothstep", "from, to, x")};

constexpr ExpressionFunction operators[] = {
    row<kinds::Sum>("+", "a, b"),          row<kinds::Difference>("-", "a, b"), row<kinds::Product>("*", "a, b"),
    jumping<kinds::Quotient>("/", "a, b"), row<kinds::Power>("^", "a, b"),      row<kinds::Negative>("_", "a"),
};

}  // namespace

std::span<const ExpressionFunction> expression_functions() noexcept {
  return functions;
}

const ExpressionFunction* expression_operator(char symbol) noexcept {
  for (const ExpressionFunction& each : operators)
    if (each.name[0] == symbol) return &each;
  return nullptr;
}

}  // namespace tweenfall::expressions
