#include "document/fields/things.h"
#include "document/forces/force.h"
#include "document/tracks/read_expression.h"
#include "document/tracks/read_track.h"

#include <tweenfall/curves/expression.h>

namespace tweenfall::document::forces {

namespace {

Form expression_form() {
  Form text;
  text.kind = Form::Kind::text;
  text.what = "an expression of t, such as \"2*cos(t)\"";
  return text;
}

}  // namespace

const Form* strength_form(FormStore& store, const ValueForms& values) {
  Form formula =
      object_of("{\"expression\": text}", {{"expression", store.add(expression_form()), "of t, stage time", true}});
  formula.on_one_line = true;
  return store.add(choice_of("a factor, a list of keys in stage time, or {\"expression\": text}",
                             {values.number, weight_keys_form(store, values), store.add(std::move(formula))}));
}

void read_strength(const json::Value& value, ForceDescription& force, Building& building) {
  const json::Value text = value.is(json::Value::Kind::object) ? usable(value, "expression") : json::Value();
  try {
    if (value.is(json::Value::Kind::number)) {
      force.strength = Strength(value.number());
    } else if (text) {
      force.strength = Strength::formula(std::string(text.text()));
    } else if (value.is(json::Value::Kind::list)) {
      if (const auto keys = read_play_keys(value, building.fps, {}, 0, building.problems))
        force.strength = Strength(*keys);
    }
  } catch (const ExpressionError& fault) {
    add_fault_of_expression(text, fault, building.problems);
  } catch (const std::invalid_argument& fault) {
    building.problems.add(value, fault.what());
  }
}

}  // namespace tweenfall::document::forces
