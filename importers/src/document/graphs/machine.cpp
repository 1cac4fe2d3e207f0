#include "document/graphs/parts.h"

namespace tweenfall::document::graphs {

namespace {

using fields::Table;
using When = GraphCondition::Kind;

Form yes() {
  Form only;
  only.kind = Form::Kind::boolean;
  only.what = "true";
  only.only_true = true;
  return only;
}

// When

fields::Row<GraphCondition> comparison(const char* word, When kind, const char* help) {
  const auto read = [kind](const json::Value& value, GraphCondition& condition, Building&) {
    condition.kind = kind;
    condition.value = read_setting(value);
  };
  return {word, fields::FormOf(setting_form), help, {read}};
}

const Table<GraphCondition>& condition_table() {
  const auto event = [](const json::Value& value, GraphCondition& condition, Building&) {
    condition = {When::event, std::string(value.text()), 0};
  };
  const auto seconds = [](const json::Value& value, GraphCondition& condition, Building&) {
    condition = {When::time_in_state, {}, value.number()};
  };
  const auto end = [](const json::Value&, GraphCondition& condition, Building&) { condition.kind = When::clip_end; };
  static const Table<GraphCondition> table(
      "a condition",
      {{"parameter", &ValueForms::name, "of the graph", fields::member<GraphCondition>(&GraphCondition::name)},
       comparison("above", When::above, "it is greater than this"),
       comparison("below", When::below, "it is less than this"),
       comparison("equals", When::equals, "it is exactly this"),
       {"event", &ValueForms::name, "that was sent, or happened in a clip of the state", {event}},
       {"time_in_state", &ValueForms::not_negative, "seconds since the state was entered", {seconds}},
       {"clip_end", yes(), "all clips of the state have ended", {end}}});
  return table;
}

std::vector<Together> condition_rules(const std::vector<std::string>& ends) {
  std::vector<Together> rules = {exactly_one(ends)};
  for (const char* const word : {"above", "below", "equals"})
    rules.push_back({Together::Rule::first_needs_second, {word, "parameter"}});
  for (const char* const word : {"event", "time_in_state", "clip_end"})
    rules.push_back(at_most_one({"parameter", word}));
  return rules;
}

const Form* transition_when_form(FormStore& store, const ValueForms& values) {
  const std::vector<std::string> ends = {"above", "below", "equals", "event", "time_in_state", "clip_end"};
  Form condition = condition_table().form(store, values);
  condition.what = "a condition: {\"parameter\", \"above\"}, {\"event\"}, {\"time_in_state\"} or {\"clip_end\"}";
  condition.on_one_line = true;
  condition.instead = comparison_meant;
  Form when = condition;
  condition.together = condition_rules(ends);
  condition.definition = "condition";
  const Form* list = store.add(list_of(store.add(std::move(condition)), "a list of conditions"));
  when.what = "a condition, or \"all\" of a list";
  when.on_one_line = false;
  when.fields.push_back({"all", list, "every one", false, "", {"and", "every"}});
  std::vector<std::string> all = ends;
  all.push_back("all");
  when.together = condition_rules(all);
  when.together.push_back(at_most_one({"parameter", "all"}));
  when.together.front().otherwise = ", or a list: {\"all\": [...]}; for this or that give two transitions";
  when.definition = "transition when";
  return store.add(std::move(when));
}

void read_when(const json::Value& value, GraphTransition& transition, Building& building) {
  const json::Value list = usable(value, "all");
  if (!list) condition_table().read(value, transition.when.emplace_back(), building);
  for (const json::Value& condition : list.items())
    condition_table().read(condition, transition.when.emplace_back(), building);
}

// How

fields::Row<GraphChange> settling(const char* word, GraphChange::Kind kind) {
  const auto read = [kind](const json::Value& value, GraphChange& change, Building&) {
    change.kind = kind;
    change.seconds = value.number();
  };
  return {word, &ValueForms::positive, "s", {read}};
}

const Table<GraphChange>& settle_table() {
  using Change = GraphChange::Kind;
  static const Table<GraphChange> table("a settle",
                                        {settling("quintic", Change::quintic), settling("half_life", Change::half_life),
                                         settling("dead_blend", Change::dead_blend)});
  return table;
}

const Form* settle_form(FormStore& store, const ValueForms& values) {
  Form form = settle_table().choosing_form(store, values);
  form.what += ", in seconds";
  form.on_one_line = true;
  return store.add(std::move(form));
}

// From where to where

const Form* states_form(FormStore& store, const ValueForms& values) {
  return store.add(
      choice_of("a state, or a list of them", {values.name, store.add(list_of(values.name, "a list of states"))}));
}

const Table<GraphTransition>& transition_table() {
  using Transition = GraphTransition;
  const auto from = [](const json::Value& value, Transition& transition, Building&) {
    transition.from = names_of(value);
  };
  const auto fade = [](const json::Value& value, Transition& transition, Building& building) {
    fields::take(value, transition.change.seconds, building);
  };
  const auto ease = [](const json::Value& value, Transition& transition, Building&) {
    transition.change.ease = Ease::named(value.text());
  };
  const auto settle = [](const json::Value& value, Transition& transition, Building& building) {
    settle_table().read(value, transition.change, building);
  };
  static const Table<Transition> table(
      "a transition",
      {{"from", states_form, "a state or several; absent: any but the one it leads to", {from}},
       {"to", &ValueForms::name, "a state", fields::member<Transition>(&Transition::to), true},
       {"when", transition_when_form, "absent: at once", {read_when}},
       {"fade", &ValueForms::not_negative, "s; 0 is a cut", {fade, "0.2"}},
       {"ease", &ValueForms::ease, "of a fade: a shape; absent: smooth, starting and ending without a jerk", {ease}},
       {"settle", settle_form, "instead of a fade: how the difference to what was shown dies away", {settle}}});
  return table;
}

const Form* transitions_form(FormStore& store, const ValueForms& values) {
  Form transition = transition_table().listing_form(store, values);
  transition.together = {at_most_one({"fade", "settle"}), at_most_one({"ease", "settle"})};
  transition.definition = "transition";
  Form list = list_of(store.add(std::move(transition)), "a list of transitions", 0);
  list.one_per_line = true;
  return store.add(std::move(list));
}

void read_states(const json::Value& value, MachinePose& machine, Building&) {
  for (const json::Member& state : value.members())
    if (!is_free_name(state.name)) machine.states.push_back({std::string(state.name), std::string(state.value.text())});
}

void read_transitions(const json::Value& value, MachinePose& machine, Building& building) {
  for (const json::Value& transition : value.items())
    transition_table().read(transition, machine.transitions.emplace_back(), building);
}

const Form* named_states_form(FormStore& store, const ValueForms& values) {
  return store.add(map_of(values.name, "an object with the pose of each state by the state's name"));
}

const Table<MachinePose>& machine_table() {
  static const Table<MachinePose> table(
      "a machine",
      {{"start", &ValueForms::name, "the first state", fields::member<MachinePose>(&MachinePose::start), true},
       {"states", named_states_form, "the pose of each", {read_states}, true},
       {"transitions", transitions_form, "the first one that may be taken is taken", {read_transitions, "[]"}}});
  return table;
}

const Form* machine_form(FormStore& store, const ValueForms& values) {
  Form machine = machine_table().listing_form(store, values);
  machine.one_per_line = true;
  machine.definition = "machine";
  return store.add(std::move(machine));
}

void read_machine(const json::Value& value, GraphPose& pose, Building& building) {
  machine_table().read(value, pose.operation.emplace<MachinePose>(), building);
}

}  // namespace

OperationWord machine_word() {
  return {{{"machine", machine_form, "states, one of which shows, and how one becomes another", {read_machine}}}};
}

}  // namespace tweenfall::document::graphs
