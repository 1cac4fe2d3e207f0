#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/report/suggestion.h"

namespace tweenfall::document::fields {

namespace {

using Forces = std::vector<ForceDescription>;

const Table<Drag>& drag_table() {
  static const Table<Drag> table("a drag",
                                 {{"linear", &ValueForms::not_negative, "kg/s", member<Drag>(&Drag::linear)},
                                  {"quadratic", &ValueForms::not_negative, "kg/m", member<Drag>(&Drag::quadratic)},
                                  {"angular", &ValueForms::not_negative, "kg m^2/s", member<Drag>(&Drag::angular)}});
  return table;
}

const Table<SpringDescription>& spring_table() {
  using Described = SpringDescription;
  const auto of_spring = [](auto Spring::*part) {
    return member<Described>([part](Described & described) -> auto& { return described.spring.*part; });
  };
  const Meaning<Described> a = {
      [](const json::Value& value, Described& out, Building& building) { out.a = body_called(value, building); }};
  const Meaning<Described> b = {[](const json::Value& value, Described& out, Building& building) {
    out.b = body_called(value, building);
    if (out.a != no_node && out.a == out.b)
      building.problems.add(value, "a spring cannot pull a body to itself; leave \"b\" out for the world");
  }};
  static const Table<Described> table(
      "a spring", {{"a", &ValueForms::name, "node with a body", a, true},
                   {"b", &ValueForms::name, "node with a body; absent: the world", b},
                   {"anchor_a", &ValueForms::vector, "on a, m", of_spring(&Spring::anchor_a)},
                   {"anchor_b", &ValueForms::vector, "on b or in the world, m", of_spring(&Spring::anchor_b)},
                   {"rest_length", &ValueForms::not_negative, "m", of_spring(&Spring::rest_length)},
                   {"stiffness", &ValueForms::not_negative, "N/m", of_spring(&Spring::stiffness), true},
                   {"damping", &ValueForms::not_negative, "N s/m", of_spring(&Spring::damping)}});
  return table;
}

// A kind of force, which is added to those that are there.
template <class Described, class Part>
Row<Forces> kind_of_force(std::string name, const Table<Part>& table, std::string help) {
  const auto read = [&table](const json::Value& value, Forces& forces, Building& building) {
    Part given{};
    table.read(value, given, building);
    forces.emplace_back(Described{given});
  };
  return {std::move(name), form_of(table), std::move(help), {read}};
}

const Table<Forces>& force_table() {
  static const Table<Forces> table(
      "a force", {kind_of_force<DragDescription>("drag", drag_table(), "of the medium, on every body"),
                  kind_of_force<SpringDescription>("spring", spring_table(), "")});
  return table;
}

}  // namespace

const Form* force_form(FormStore& store, const ValueForms& values) {
  Form form = force_table().choosing_form(store, values);
  form.definition = "force";
  return store.add(std::move(form));
}

std::size_t body_called(const json::Value& name, Building& building) {
  const auto found = building.nodes.find(name.text());
  if (found != building.nodes.end() && building.stage.nodes[found->second].body) return found->second;
  if (building.excused(name.text())) return no_node;
  building.problems.add(name,
                        (found == building.nodes.end() ? "there is no node " + json::in_quotes(name.text())
                                                       : "the node " + json::in_quotes(name.text()) + " has no body") +
                            suggestion_or_import(name.text(), building.body_names()));
  return no_node;
}

json::Value place_of_stiffness(const json::Value& force) {
  return below(force, {"spring", "stiffness"});
}

void read_force(const json::Value& force, std::vector<ForceDescription>& forces, Building& building) {
  force_table().read(force, forces, building);
}

}  // namespace tweenfall::document::fields
