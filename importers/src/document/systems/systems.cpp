#include "document/systems/systems.h"

#include <tweenfall/anim/component.h>
#include <tweenfall/curves/number_text.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "document/fields/table.h"
#include "document/fields/things.h"
#include "document/report/suggestion.h"
#include "document/systems/outputs.h"

namespace tweenfall::document::systems {

namespace {

using Kind = json::Value::Kind;
using Table = fields::Table<Draft>;

constexpr std::size_t most_variables = 12, most_starts = 64;

fields::Meaning<Draft> kept(json::Value Draft::*member) {
  return {[member](const json::Value& value, Draft& draft, Building&) { draft.*member = value; }};
}

const Form* numbers_form(FormStore& store, const ValueForms& values) {
  Form numbers = object_of("an object with numbers by name", {});
  numbers.others = values.number;
  return store.add(std::move(numbers));
}

Form expression_form() {
  Form text;
  text.kind = Form::Kind::text;
  text.what = "an expression of t and the state";
  return text;
}

const Form* value_form(FormStore& store, const ValueForms& values) {
  return store.add(
      choice_of("an expression of t and the state, or a number", {store.add(expression_form()), values.number}));
}

const Form* rates_form(FormStore& store, const ValueForms& values) {
  Form rates = object_of("an object with expressions by the names of the state", {});
  rates.others = value_form(store, values);
  return store.add(std::move(rates));
}

const Form* starts_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(numbers_form(store, values), "a list of starts", 0, most_starts));
}

const Form* portrait_form(FormStore& store, const ValueForms& values) {
  return store.add(list_of(values.name, "a list of two names", 2, 2));
}

const Form* outputs_form(FormStore& store, const ValueForms& values) {
  const Form* value = value_form(store, values);
  Form tracks = object_of("an object with tracks by name", {});
  tracks.others = store.add(choice_of(
      "an expression of t and the state, or a list of 2 to 4",
      {store.add(expression_form()), values.number, store.add(list_of(value, "a list of 2 to 4 expressions", 2, 4))}));
  tracks.one_per_line = true;
  return store.add(std::move(tracks));
}

const Table& table() {
  static const Table rows(
      "a system",
      {{"state", numbers_form, "its numbers by name, at the start", kept(&Draft::state), true},
       {"rates", rates_form, "of each per second; of verlet and semi-implicit-euler the first half are places",
        kept(&Draft::rates), true},
       {"parameters", numbers_form, "numbers that the expressions call by name", kept(&Draft::parameters)},
       {"energy", fields::FormOf(expression_form()), "what a plot shows beside the portrait", kept(&Draft::energy)},
       fields::one_of<Draft, Integrator>("integrator", "an integrator", fields::integrator_words(), "",
                                         [](Draft& draft) -> Integrator& { return draft.system.integrator; }),
       {"step",
        fields::step_form,
        "s",
        {[](const json::Value& value, Draft& draft, Building&) { draft.system.step = fields::seconds_of_step(value); },
         fields::text_of_default(ExpressionSystem{}.step)}},
       {"duration", &ValueForms::positive, "s",
        fields::member<Draft>([](Draft& draft) -> double& { return draft.system.duration; })},
       {"starts", starts_form, "others, for the portrait; what they leave out is as in \"state\"",
        kept(&Draft::starts)},
       {"portrait", portrait_form, "what it shows across and up; absent: the first two of the state",
        kept(&Draft::portrait)},
       {"tracks", outputs_form, "what follows from the state; of a node's rotation one angle, in degrees",
        kept(&Draft::tracks)}});
  return rows;
}

// Reads the numbers of a start by the names of the state; false where there is an unknown name.
bool take_numbers(const json::Value& value, const ExpressionSystem& system, std::vector<double>& numbers,
                  Problems& problems) {
  const std::size_t before = problems.size();
  for (const json::Member& each : value.members()) {
    if (is_free_name(each.name)) continue;
    const auto found = std::ranges::find(system.variables, each.name);
    if (found == system.variables.end())
      problems.add_name(each,
                        "the state has no " + json::in_quotes(each.name) + suggestion(each.name, system.variables));
    else if (each.value.is(Kind::number))
      numbers[static_cast<std::size_t>(found - system.variables.begin())] = each.value.number();
  }
  return problems.size() == before;
}

void take_state(const Draft& draft, ExpressionSystem& system, Problems& problems) {
  for (const json::Member& each : draft.state.members()) {
    if (is_free_name(each.name)) continue;
    try {
      const std::string names[] = {"t", std::string(each.name)};
      (void)Expression("0", names, {});
    } catch (const std::invalid_argument& fault) {
      problems.add_name(each, fault.what());
      continue;
    }
    system.variables.emplace_back(each.name);
    system.start.push_back(each.value.is(Kind::number) ? each.value.number() : 0);
  }
  if (system.variables.empty()) problems.add(draft.state, "a state has one number at least");
  if (system.variables.size() > most_variables)
    problems.add(draft.state, "a state can have " + std::to_string(most_variables) + " numbers, but has " +
                                  std::to_string(system.variables.size()));
}

void take_rates(const Draft& draft, const Expressions& expressions, ExpressionSystem& system, Problems& problems) {
  std::vector<json::Value> of(system.variables.size());
  for (const json::Member& each : draft.rates.members()) {
    if (is_free_name(each.name)) continue;
    const auto found = std::ranges::find(system.variables, each.name);
    if (found == system.variables.end())
      problems.add_name(each,
                        "the state has no " + json::in_quotes(each.name) + suggestion(each.name, system.variables));
    else
      of[static_cast<std::size_t>(found - system.variables.begin())] = each.value;
  }
  for (std::size_t i = 0; i < of.size(); ++i) {
    if (!of[i]) {
      problems.add(draft.rates, json::in_quotes(system.variables[i]) + " has no rate; say how it changes, or 0");
    } else if (const std::optional<Expression> rate = expressions.read(of[i])) {
      system.rates.push_back(*rate);
    }
  }
}

void take_portrait(const Draft& draft, ExpressionSystem& system, Problems& problems) {
  if (system.variables.size() < 2) {
    system.across = 0;
    system.up = 1;
  }
  if (!draft.portrait) return;
  const auto place = [&](const json::Value& name, bool time) -> std::size_t {
    if (time && name.text() == "t") return 0;
    const auto found = std::ranges::find(system.variables, name.text());
    if (found == system.variables.end())
      problems.add(name,
                   "the state has no " + json::in_quotes(name.text()) + suggestion(name.text(), system.variables));
    return static_cast<std::size_t>(found - system.variables.begin()) + 1;
  };
  if (draft.portrait.items().size() != 2) return;
  const std::size_t across = place(draft.portrait.items()[0], true), up = place(draft.portrait.items()[1], false);
  if (across <= system.variables.size() && up <= system.variables.size()) {
    system.across = across;
    system.up = up;
  }
}

// Reports a path that ends too early.
bool check_way(const json::Value& value, const ExpressionSystem& system, const FirstOrderPath& path,
               Problems& problems) {
  if (path.times.back() + 0.5 * system.step >= system.duration) return true;
  problems.add(value, "the state is no longer finite after " + brief_text(path.times.back()) +
                          " s; take shorter steps, another integrator or a shorter duration");
  return false;
}

void read_one(const json::Member& member, Building& building) {
  Problems& problems = building.problems;
  const std::size_t before = problems.size();
  Draft draft;
  table().read(member.value, draft, building);
  ExpressionSystem& system = draft.system;
  system.name = member.name;
  if (draft.tracks) take_track_nodes(draft.tracks, building);
  if (!draft.state || !draft.rates) return;
  take_state(draft, system, problems);
  const Expressions expressions(system.variables, draft.parameters, problems);
  take_rates(draft, expressions, system, problems);
  if (draft.energy) system.energy = expressions.read(draft.energy);
  for (const json::Value& each : draft.starts ? draft.starts.items() : json::Value().items()) {
    std::vector<double> start = system.start;
    if (take_numbers(each, system, start, problems)) system.starts.push_back(std::move(start));
  }
  take_portrait(draft, system, problems);
  if (problems.size() != before) return;
  try {
    const FirstOrderPath path = path_of(system, system.start);
    if (!check_way(member.value, system, path, problems)) return;
    if (!building.clips.emplace(member.name, building.stage.clips.size()).second) {
      problems.add_name(member,
                        "there is a clip " + json::in_quotes(member.name) + " already; give this system another name");
      return;
    }
    building.stage.clips.push_back(clip_of(draft, path, expressions, building));
    building.systems.push_back(std::move(system));
  } catch (const std::invalid_argument& fault) {
    problems.add(member.value, fault.what());
  }
}

}  // namespace

const Form* form(FormStore& store, const ValueForms& values) {
  Form system = table().listing_form(store, values);
  system.definition = "system";
  return store.add(map_of(store.add(std::move(system)), "an object with systems by name"));
}

void read(const json::Value& value, Building& building) {
  if (!value) return;
  for (const json::Member& member : value.members())
    if (!is_free_name(member.name) && member.value.is(Kind::object)) read_one(member, building);
}

}  // namespace tweenfall::document::systems
