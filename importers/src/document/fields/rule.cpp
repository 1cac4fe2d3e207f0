#include "document/fields/rule.h"

#include "document/fields/things.h"
#include "document/report/suggestion.h"

#include <algorithm>

namespace tweenfall::document::fields {

namespace {

using Kind = json::Value::Kind;
using Read = RuleBeingRead;

// The bodies of a rule

const Form* rule_bodies_form(FormStore& store, const ValueForms& values) {
  return store.add(choice_of("a node's name, a pattern (\"tower/*\"), or a list of them",
                             {values.name, store.add(list_of(values.name, "a list of names or patterns"))}));
}

// A name of several nodes selects only those that can move.
void note_left_out(const json::Value& name, const std::vector<std::string>& left_out, Building& building) {
  if (left_out.empty()) return;
  building.problems.note(name, json::in_quotes(name.text()) + " leaves out " + listed(left_out) +
                                   ": what is static has one owner for good, and the rule takes the others");
}

void read_rule_body(const json::Value& name, Read& rule, Building& building) {
  if (!name.is(Kind::text)) return;
  const std::vector<NodeDescription>& nodes = building.stage.nodes;
  rule.rule.bodies.emplace_back(name.text());
  const std::vector<std::size_t> named = building.nodes_named(name.text());
  const bool pattern = name.text().find('*') != std::string::npos;
  std::size_t movable = 0;
  std::vector<std::string> left_out;
  for (const std::size_t i : named) {
    if (!nodes[i].body) continue;
    if (nodes[i].body->fixed) {
      left_out.push_back(nodes[i].name);
      continue;
    }
    ++movable;
    rule.bodies.push_back(i);
  }
  Problems& problems = building.problems;
  if (movable > 0) note_left_out(name, left_out, building);
  if (movable > 0 || building.excused(name.text())) return;
  if (pattern)
    problems.add(name, "no node with a body that can move matches " + json::in_quotes(name.text()));
  else if (named.empty())
    problems.add(name, "there is no node " + json::in_quotes(name.text()) +
                           suggestion_or_import(name.text(), building.body_names()));
  else if (!nodes[named.front()].body)
    problems.add(name, "the node " + json::in_quotes(name.text()) + " has no body, so there is nothing to hand over");
  else
    problems.add(name, "the body of " + json::in_quotes(name.text()) + " is static and has one owner for good");
}

void read_rule_bodies(const json::Value& value, Read& rule, Building& building) {
  read_rule_body(value, rule, building);
  for (const json::Value& item : value.items()) read_rule_body(item, rule, building);
}

void read_rule_group(const json::Value& value, Read& rule, Building& building) {
  const std::vector<NodeDescription>& nodes = building.stage.nodes;
  std::vector<std::string> groups, left_out;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!nodes[i].group.empty()) groups.push_back(nodes[i].group);
    if (nodes[i].group != value.text() || !nodes[i].body) continue;
    if (nodes[i].body->fixed) {
      left_out.push_back(nodes[i].name);
      continue;
    }
    rule.bodies.push_back(i);
    rule.rule.bodies.push_back(nodes[i].name);
  }
  std::sort(groups.begin(), groups.end());
  groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  if (rule.bodies.empty())
    building.problems.add(value, "no node with a body that can move is in a group " + json::in_quotes(value.text()) +
                                     suggestion(value.text(), groups));
  else
    note_left_out(value, left_out, building);
}

const Table<Read>& rule_table() {
  static const Table<Read> table("a rule of the hand-off", [] {
    std::vector<Row<Read>> rows{{"body", rule_bodies_form, "whom it is about", {read_rule_bodies}},
                                {"group", &ValueForms::name, "all nodes of a group", {read_rule_group}},
                                {"when", when_form, "", {read_when}, true}};
    for (Row<Read>& row : rows_of_part<Read>(change_rows(next_change_form), &Read::change))
      rows.push_back(std::move(row));
    rows.push_back({"once", &ValueForms::boolean, "false: armed again after it was false",
                    member<Read>([](Read& rule) -> bool& { return rule.rule.once; })});
    return rows;
  }());
  return table;
}

}  // namespace

const Form* rule_form(FormStore& store, const ValueForms& values) {
  Form rule = rule_table().form(store, values);
  rule.together = {exactly_one({"body", "group"})};
  for (const Together& beside : lasting()) rule.together.push_back(beside);
  rule.definition = "rule";
  return store.add(std::move(rule));
}

RuleBeingRead read_rule(const json::Value& value, const std::vector<std::string>& events, Building& building) {
  RuleBeingRead read;
  read.events = &events;
  rule_table().read(value, read, building);
  std::sort(read.bodies.begin(), read.bodies.end());
  read.bodies.erase(std::unique(read.bodies.begin(), read.bodies.end()), read.bodies.end());
  Rule& rule = read.rule;
  const OwnerChange& first = read.change.change;
  rule.to = first.to;
  rule.take_over = first.take_over;
  rule.hand_back = first.hand_back;
  rule.ramp = first.ramp;
  for (const ChangeBeingRead* change = &read.change; change->lasts && !change->then.empty();
       change = &change->then.front())
    rule.then.push_back({*change->lasts, change->then.front().change});
  return read;
}

}  // namespace tweenfall::document::fields
