#include "document/forces/forces.h"

#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/forces/force.h"
#include "document/report/spellings.h"

#include <algorithm>

namespace tweenfall::document::forces {

namespace {

using Described = ForceDescription;

const Form* bodies_form(FormStore& store, const ValueForms& values) {
  return store.add(choice_of("a name, a pattern (\"leaf/*\"), or a list of them",
                             {values.name, store.add(list_of(values.name, "a list of names or patterns"))}));
}

void read_bodies(const json::Value& value, Described& force, Building& building) {
  const auto add = [&](const json::Value& name) {
    for (const std::size_t node : fields::bodies_named(name, building)) force.bodies.push_back(node);
  };
  add(value);
  for (const json::Value& name : value.items()) add(name);
  std::sort(force.bodies.begin(), force.bodies.end());
  force.bodies.erase(std::unique(force.bodies.begin(), force.bodies.end()), force.bodies.end());
}

std::string useless_bodies(const Described& force) {
  const bool names_them = std::holds_alternative<Spring>(force.force) || std::holds_alternative<Damper>(force.force) ||
                          std::holds_alternative<Push>(force.force);
  return names_them ? "beside a force that names its bodies itself" : "";
}

const fields::Table<Described>& force_table() {
  static const fields::Table<Described> table("a force", [] {
    std::vector<fields::Row<Described>> rows = kinds();
    rows.push_back({"bodies",
                    bodies_form,
                    "nodes with bodies; it acts on these alone; absent: on all",
                    {read_bodies},
                    false,
                    useless_bodies,
                    {"only", "on", "targets"}});
    rows.push_back({"strength", strength_form, "by which it is multiplied", {read_strength, "1"}});
    return rows;
  }());
  return table;
}

}  // namespace

const Form* form(FormStore& store, const ValueForms& values) {
  Form form = force_table().form(store, values);
  std::vector<std::string> names;
  form.what += ": one of ";
  for (const fields::Row<Described>& row : kinds()) {
    form.what += (names.empty() ? "" : ", ") + json::in_quotes(row.name);
    names.push_back(row.name);
  }
  form.foremost_fault = [names](const json::Value& value) {
    const std::string meant = kind_meant(value, names, {"bodies", "strength"});
    return meant.empty() ? meant : "a force says its kind by the name of a field" + meant;
  };
  form.together = {exactly_one(std::move(names))};
  form.definition = "force";
  return store.add(std::move(form));
}

json::Value place_of_stiffness(const json::Value& force) {
  return below(force, {"spring", "stiffness"});
}

void read(const json::Value& value, std::vector<Described>& forces, Building& building) {
  Described& force = forces.emplace_back();
  force_table().read(value, force, building);
}

}  // namespace tweenfall::document::forces
