#include "document/fields/rule.h"

#include <tweenfall/curves/number_text.h>

#include "document/fields/things.h"
#include "document/report/suggestion.h"

#include <algorithm>

namespace tweenfall::document::fields {

namespace {

using Kind = json::Value::Kind;
using Read = RuleBeingRead;

// Whom it is about

const Form* rule_bodies_form(FormStore& store, const ValueForms& values) {
  return store.add(choice_of("a node's name, a pattern (\"tower/*\"), or a list of them",
                             {values.name, store.add(list_of(values.name, "a list of names or patterns"))}));
}

// What a name of several nodes takes is only what can move.
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

// Where a body that is taken back goes on

void read_followed_clip(const json::Value& value, HandBack& out, Building& building) {
  take(value, out.clip, building);
  if (building.clips.count(out.clip) == 0 && !building.excused(out.clip))
    building.problems.add(
        value, "there is no clip " + json::in_quotes(out.clip) + suggestion_or_import(out.clip, building.clip_names()));
}

const Table<HandBack>& path_table() {
  using Clock = HandBack::Clock;
  using Anchor = HandBack::Anchor;
  static const Table<HandBack> table(
      "a path", {{"clip", &ValueForms::name, "absent: what played before", {read_followed_clip}},
                 one_of<HandBack, Clock>("time", "a clock",
                                         {{"run", Clock::run}, {"hold", Clock::hold}, {"restart", Clock::restart}},
                                         "where the clip's clock stands", &HandBack::clock),
                 one_of<HandBack, Anchor>("anchor", "an anchor",
                                          {{"keep", Anchor::keep}, {"here", Anchor::here}, {"ground", Anchor::ground}},
                                          "where the path lies", &HandBack::anchor)});
  return table;
}

const Table<Settle>& settle_table() {
  const auto kind = [](std::string word, Settle::Kind meant) {
    const auto read = [meant](const json::Value& value, Settle& settle, Building&) {
      settle = {meant, value.number()};
    };
    return Row<Settle>{std::move(word), &ValueForms::positive, "s", {read}};
  };
  static const Table<Settle> table("a settle",
                                   {kind("quintic", Settle::Kind::quintic), kind("half_life", Settle::Kind::half_life),
                                    kind("dead_blend", Settle::Kind::dead_blend)});
  return table;
}

// Why a field means nothing for a rule that gives to an owner, if it names one.
auto useless_to(Owner owner, const std::string& why) {
  return [owner, why](const Read& rule) { return rule.to && rule.rule.to.owner() == owner ? why : std::string(); };
}

const Table<Read>& rule_table() {
  const Meaning<Read> to = {[](const json::Value& value, Read& rule, Building& building) {
    rule.to = value;
    rule.rule.to = read_owner(value, building);
  }};
  const Meaning<Read> velocity = {[](const json::Value& value, Read& rule, Building& building) {
                                    read_take_over(value, rule.rule.take_over, building);
                                  },
                                  "\"curve\""};
  const Meaning<Read> settle = {[](const json::Value& value, Read& rule, Building& building) {
                                  settle_table().read(value, rule.rule.hand_back.settle, building);
                                },
                                "{\"quintic\": " + number_text(Settle{}.seconds) + "}"};
  Row<Read> path = part<Read>("path", path_table(), "of a body that is taken back",
                              [](Read& rule) -> HandBack& { return rule.rule.hand_back; });
  path.useless = useless_to(Owner::free, "for a body that is let go; it follows none");
  Row<Read> overlap = overlap_row<Read>([](Read& rule) -> TakeOver& { return rule.rule.take_over; });
  overlap.useless = useless_to(Owner::keyed, "for a keyed body; it has its path's place");
  static const Table<Read> table("a rule of the hand-off",
                                 {{"body", rule_bodies_form, "whom it is about", {read_rule_bodies}},
                                  {"group", &ValueForms::name, "all nodes of a group", {read_rule_group}},
                                  {"when", when_form, "", {read_when}, true},
                                  {"to", owner_form, "the new owner", to, true},
                                  {"velocity", take_over_form, "of a released body", velocity, false,
                                   useless_to(Owner::keyed, "for a keyed body; it has its path's")},
                                  overlap,
                                  path,
                                  {"settle", settle_form, "how the difference dies away", settle, false,
                                   useless_to(Owner::free, "for a body that is let go; nothing settles")},
                                  {"once", &ValueForms::boolean, "false: armed again after it was false",
                                   member<Read>([](Read& rule) -> bool& { return rule.rule.once; })}});
  return table;
}

}  // namespace

const Form* path_form(FormStore& store, const ValueForms& values) {
  return store.add(path_table().listing_form(store, values));
}

void read_path(const json::Value& value, HandBack& out, Building& building) {
  path_table().read(value, out, building);
}

const Form* settle_form(FormStore& store, const ValueForms& values) {
  Form form = settle_table().choosing_form(store, values);
  form.what += ", in seconds";
  return store.add(std::move(form));
}

void read_settle(const json::Value& value, Settle& settle, Building& building) {
  settle_table().read(value, settle, building);
}

const Form* rule_form(FormStore& store, const ValueForms& values) {
  Form rule = rule_table().form(store, values);
  rule.together = {exactly_one({"body", "group"})};
  rule.definition = "rule";
  return store.add(std::move(rule));
}

RuleBeingRead read_rule(const json::Value& value, const std::vector<std::string>& events, Building& building) {
  RuleBeingRead rule;
  rule.events = &events;
  rule_table().read(value, rule, building);
  const json::Value path = usable(value, "path");
  rule.follows = path && path.find("clip");
  std::sort(rule.bodies.begin(), rule.bodies.end());
  rule.bodies.erase(std::unique(rule.bodies.begin(), rule.bodies.end()), rule.bodies.end());
  return rule;
}

}  // namespace tweenfall::document::fields
