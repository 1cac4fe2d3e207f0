#include "document/fields/things.h"
#include "document/forces/force.h"
#include "document/tracks/read_expression.h"

#include <tweenfall/curves/expression.h>
#include <tweenfall/curves/number_text.h>

#include <array>

namespace tweenfall::document::forces {

namespace {

using Parameters = std::vector<ForceFormula::Parameter>;

// A field while it is read: its formula needs all of its parts.
struct FieldBeingRead {
  Parameters parameters;
  std::array<json::Value, 3> force{};
  json::Value potential{};
};

const Form* formula_form(FormStore& store, const ValueForms& values) {
  Form text;
  text.kind = Form::Kind::text;
  text.what = "an expression of x, y, z, vx, vy, vz, t and mass";
  return store.add(choice_of(text.what + ", or a number", {store.add(text), values.number}));
}

const Form* force_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(formula_form(store, values), "a list of 3 expressions", 3, 3));
}

const Form* potential_form(FormStore& store, const ValueForms&) {
  Form text;
  text.kind = Form::Kind::text;
  text.what = "an expression of x, y, z, t and mass";
  return store.add(std::move(text));
}

const Form* parameters_form(FormStore& store, const ValueForms& values) {
  return store.add(map_of(values.number, "an object of numbers by name"));
}

// Reads a formula; faults are reported at its place.
template <class Make>
void attempt(const json::Value& at, Building& building, const Make& make) {
  try {
    make();
  } catch (const ExpressionError& fault) {
    add_fault_of_expression(at, fault, building.problems);
  } catch (const std::invalid_argument& fault) {
    building.problems.add(at, fault.what());
  }
}

void read_parameters(const json::Value& value, FieldBeingRead& field, Building& building) {
  for (const json::Member& each : value.members()) {
    if (!each.value.is(json::Value::Kind::number)) continue;
    const ForceFormula::Parameter one{std::string(each.name), each.value.number()};
    try {
      static_cast<void>(ForceFormula({"0", "0", "0"}, {one}));
      field.parameters.push_back(one);
    } catch (const std::invalid_argument& fault) {
      building.problems.add_name(each, fault.what());
    }
  }
}

const fields::Table<FieldBeingRead>& field_table() {
  const auto read_force = [](const json::Value& value, FieldBeingRead& field, Building&) {
    for (std::size_t i = 0; i < 3 && i < value.items().size(); ++i) field.force[i] = value.items()[i];
  };
  const auto read_potential = [](const json::Value& value, FieldBeingRead& field, Building&) {
    field.potential = value;
  };
  static const fields::Table<FieldBeingRead> table(
      "a field", {{"force", force_form, "its three components, N", {read_force}},
                  {"potential",
                   potential_form,
                   "instead: a potential energy, J; the force is its negative gradient",
                   {read_potential}},
                  {"parameters", parameters_form, "numbers that the expressions call by name", {read_parameters}}});
  return table;
}

void read_field(const json::Value& value, ForceDescription& force, Building& building) {
  FieldBeingRead field;
  field_table().read(value, field, building);
  const std::size_t before = building.problems.size();
  if (field.potential) {
    attempt(field.potential, building,
            [&] { force.force = ForceFormula::potential(std::string(field.potential.text()), field.parameters); });
    return;
  }
  std::array<std::string, 3> texts{"0", "0", "0"};
  for (std::size_t i = 0; i < texts.size(); ++i) {
    const json::Value& part = field.force[i];
    if (!part || part.is(json::Value::Kind::faulty)) continue;
    texts[i] = part.is(json::Value::Kind::number) ? number_text(part.number()) : std::string(part.text());
    attempt(part, building, [&] { static_cast<void>(ForceFormula({texts[i], "0", "0"}, field.parameters)); });
  }
  if (building.problems.size() == before) force.force = ForceFormula(texts, field.parameters);
}

}  // namespace

fields::Row<ForceDescription> field_row() {
  const auto field_form = [](FormStore& store, const ValueForms& values) -> const Form* {
    Form form = field_table().listing_form(store, values);
    form.together = {exactly_one({"force", "potential"})};
    return store.add(std::move(form));
  };
  return {"field",
          fields::FormOf(+field_form),
          "by formulas of place, velocity and time",
          {read_field},
          false,
          {},
          {"force_field", "expression", "custom"}};
}

}  // namespace tweenfall::document::forces
