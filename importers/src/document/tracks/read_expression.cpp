#include "document/tracks/read_expression.h"

#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/number_text.h>

#include "document/read/values.h"

#include <cmath>
#include <utility>
#include <vector>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

class ExpressionReader {
 public:
  ExpressionReader(const json::Value& track, Problems& problems) : problems_(problems) {
    const json::Value parameters = usable(track, "parameters");
    if (!parameters) return;
    for (const json::Member& each : parameters.members()) {
      if (!each.value.is(Kind::number)) continue;
      const Expression::Parameter one{std::string(each.name), each.value.number()};
      // A trial expression finds names that expressions already have.
      try {
        (void)Expression("t", std::span<const Expression::Parameter>(&one, 1));
        parameters_.push_back(one);
      } catch (const std::invalid_argument& fault) {
        problems_.add_name(each, fault.what());
      }
    }
  }

  std::optional<Curve<double>> number(const json::Value& value) {
    if (value.is(Kind::number)) return Curve<double>(value.number());
    if (!value.is(Kind::text)) return {};
    try {
      const Expression expression(value.text(), parameters_);
      note_gap(value, expression);
      return expression_curve(expression);
    } catch (const ExpressionError& error) {
      add_fault_of_expression(value, error, problems_);
      return {};
    }
  }

 private:
  /// Tells of the first instant of the first second at which a formula has no value.
  void note_gap(const json::Value& text, const Expression& expression) {
    constexpr int looks = 16;
    for (int i = 0; i <= looks; ++i) {
      const double time = static_cast<double>(i) / looks;
      if (std::isfinite(expression.sample(time).value)) continue;
      problems_.note(text, "this has no finite value at " + brief_text(time) + " s; where it has none, it is 0");
      return;
    }
  }

  Problems& problems_;
  std::vector<Expression::Parameter> parameters_;
};

template <class T>
Curve<T> vector_of_parts(const std::vector<Curve<double>>& parts) {
  std::vector<T> axes;
  for (std::size_t i = 0; i < parts.size(); ++i) axes.push_back(T::Unit(static_cast<Eigen::Index>(i)));
  return combined<T>(parts, axes);
}

}  // namespace

void add_fault_of_expression(const json::Value& text, const ExpressionError& fault, Problems& problems) {
  // Without escapes, bytes of the text correspond to bytes of the file after the quote.
  const bool plain = text.length() == text.text().size() + 2;
  problems.add(
      plain ? json::Fault{text.offset() + 1 + fault.place(), 1, fault.fault()}
            : json::Fault{text.offset(), text.length(),
                          "character " + std::to_string(fault.place() + 1) + " of the formula: " + fault.fault()});
}

std::optional<TrackCurve> read_expression(const json::Value& track, Problems& problems) {
  const json::Value expression = usable(track, "expression");
  if (!expression) return {};
  ExpressionReader reader(track, problems);
  if (expression.is(Kind::text)) {
    const std::optional<Curve<double>> curve = reader.number(expression);
    return curve ? std::optional<TrackCurve>(*curve) : std::nullopt;
  }
  std::vector<Curve<double>> parts;
  for (const json::Value& each : expression.items())
    if (const std::optional<Curve<double>> part = reader.number(each)) parts.push_back(*part);
  if (parts.size() != expression.items().size()) return {};
  if (parts.size() == 2) return TrackCurve(parametric(parts[0], parts[1]));
  if (parts.size() == 3) return TrackCurve(parametric(parts[0], parts[1], parts[2]));
  return TrackCurve(vector_of_parts<Vec4>(parts));
}

}  // namespace tweenfall::document
