#include "document/fields/rule.h"
#include "document/read/clip_times.h"
#include "document/report/suggestion.h"

#include <algorithm>

namespace tweenfall::document::fields {

namespace {

const Table<when::ContactHit>& contact_table() {
  using Hit = when::ContactHit;
  Meaning<Hit> with = member<Hit>(&Hit::with);
  with.read = [](const json::Value& value, Hit& hit, Building& building) {
    take(value, hit.with, building);
    const std::vector<std::size_t> named = building.nodes_named(hit.with);
    const auto has_body = [&](std::size_t i) { return building.stage.nodes[i].body.has_value(); };
    if (!building.excused(hit.with) && std::none_of(named.begin(), named.end(), has_body))
      building.problems.add(value, "no node with a body is called " + json::in_quotes(hit.with) +
                                       suggestion_or_import(hit.with, building.body_names()));
  };
  static const Table<Hit> table(
      "a contact", {{"impulse", &ValueForms::not_negative, "N s, at least", member<Hit>(&Hit::impulse)},
                    {"speed", &ValueForms::not_negative, "of approach, m/s, at least", member<Hit>(&Hit::speed)},
                    {"with", &ValueForms::name, "name or pattern of the other node; absent: any", with}});
  return table;
}

std::string known_event(const json::Value& name, const RuleBeingRead& rule, Building& building) {
  if (building.failed_imports.empty() &&
      std::find(rule.events->begin(), rule.events->end(), name.text()) == rule.events->end())
    building.problems.add(
        name, "no clip has an event " + json::in_quotes(name.text()) + suggestion(name.text(), *rule.events));
  return std::string(name.text());
}

// What a value that is not an object may be meant for.
std::string trigger_instead_of(const json::Value& value) {
  if (value.is(json::Value::Kind::number)) return "; say {\"at\": " + json::on_one_line(value) + "}";
  if (value.is(json::Value::Kind::list))
    return "; say {\"all\": [...]} for this and that, {\"any\": [...]} for this or that";
  if (!value.is(json::Value::Kind::text)) return {};
  for (const auto& [word, written] :
       {std::pair("contact", "{\"contact\": {}}"), std::pair("clip_end", "{\"clip_end\": true}"),
        std::pair("asleep", "{\"asleep\": 0.5}"), std::pair("saturated", "{\"saturated\": 0.1}"),
        std::pair("speed_peak", "{\"speed_peak\": true}")})
    if (value.text() == word) return std::string("; say ") + written;
  const std::string name = json::on_one_line(value);
  return "; say {\"marker\": " + name + "} for an event of a clip that animates the body, or {\"event\": " + name +
         "} for one of any clip";
}

Form only_yes() {
  Form yes;
  yes.kind = Form::Kind::boolean;
  yes.what = "true";
  yes.only_true = true;
  yes.instead = [](const json::Value&) { return std::string("; say true"); };
  return yes;
}

// A kind of trigger, which is added to those read before.
template <class Read>
Meaning<RuleBeingRead> adds(Read read) {
  return {[read](const json::Value& value, RuleBeingRead& rule, Building& building) {
    rule.rule.when.triggers.emplace_back(read(value, rule, building));
  }};
}

void read_instant(const json::Value& value, RuleBeingRead& rule, Building& building) {
  const ClipTimes times(building.fps, {}, "stage time has none");
  const std::optional<double> seconds = times.seconds(value, {}, building.problems);
  if (!seconds) return;
  rule.rule.when.triggers.emplace_back(when::At{*seconds});
  rule.instants.push_back({value, *seconds});
}

// A name or pattern of nodes, at least one of which must satisfy `fits`.
// @param what_lacks  says it of nodes that there are, of which none satisfies it
template <class Thing, class Fits, class WhatLacks>
Meaning<Thing> name_of_nodes(std::string Thing::*member_of, const std::string& lacks, Fits fits, WhatLacks what_lacks) {
  Meaning<Thing> meaning = member<Thing>(member_of);
  meaning.read = [member_of, lacks, fits, what_lacks](const json::Value& value, Thing& thing, Building& building) {
    take(value, thing.*member_of, building);
    const std::vector<std::size_t> named = building.nodes_named(thing.*member_of);
    const auto right = [&](std::size_t i) { return fits(building.stage.nodes[i]); };
    if (building.excused(thing.*member_of) || std::any_of(named.begin(), named.end(), right)) return;
    if (std::string lacking = what_lacks(thing.*member_of, named, building); !lacking.empty()) {
      building.problems.add(value, std::move(lacking));
      return;
    }
    std::vector<std::string> names;
    for (const NodeDescription& node : building.stage.nodes)
      if (fits(node)) names.push_back(node.name);
    building.problems.add(value,
                          lacks + json::in_quotes(thing.*member_of) + suggestion_or_import(thing.*member_of, names));
  };
  return meaning;
}

bool has_body(const NodeDescription& node) {
  return node.body.has_value();
}
bool is_sensor(const NodeDescription& node) {
  return node.body && node.body->sensor;
}

std::string no_sensor(const std::string& name, const std::vector<std::size_t>& named, const Building& building) {
  if (named.empty()) return {};
  const std::string which = named.size() == 1 ? "the node " + json::in_quotes(building.stage.nodes[named[0]].name)
                                              : "none of the nodes called " + json::in_quotes(name);
  const bool any_body =
      std::any_of(named.begin(), named.end(), [&](std::size_t i) { return has_body(building.stage.nodes[i]); });
  if (named.size() > 1) return which + " is a sensor; give one \"sensor\": true in its \"body\"";
  return any_body ? "the body of " + which + " is no sensor; add \"sensor\": true to its \"body\""
                  : which + " has no body; give it a \"body\" with \"sensor\": true";
}

std::string no_body(const std::string& name, const std::vector<std::size_t>& named, const Building&) {
  if (named.empty()) return {};
  return named.size() == 1 ? "the node " + json::in_quotes(name) + " has no body; give it a \"body\""
                           : "none of the nodes called " + json::in_quotes(name) + " has a body";
}

template <class Passage>
const Table<Passage>& passage_table() {
  static const Table<Passage> table(
      "a way in or out",
      {{"region", &ValueForms::name, "name or pattern of a node whose body is a sensor",
        name_of_nodes(&Passage::region, "no node whose body is a \"sensor\" is called ", is_sensor, no_sensor), true},
       {"who", &ValueForms::name, "name or pattern; absent: the rule's own body",
        name_of_nodes(&Passage::who, "no node with a body is called ", has_body, no_body)}});
  return table;
}

template <class Passage>
Passage read_passage(const json::Value& value, Building& building) {
  Passage passage;
  passage_table<Passage>().read(value, passage, building);
  return passage;
}

const Table<RuleBeingRead>& trigger_table() {
  using Rule = RuleBeingRead;
  const auto marker = adds([](const json::Value& value, Rule& rule, Building& building) {
    return when::Marker{known_event(value, rule, building)};
  });
  const auto event = adds([](const json::Value& value, Rule& rule, Building& building) {
    return when::Event{known_event(value, rule, building)};
  });
  const auto end = adds([](const json::Value&, Rule&, Building&) { return when::ClipEnd{}; });
  const auto asleep = adds([](const json::Value& value, Rule&, Building&) { return when::Asleep{value.number()}; });
  const auto contact = adds([](const json::Value& value, Rule&, Building& building) {
    when::ContactHit hit;
    contact_table().read(value, hit, building);
    return hit;
  });
  const auto enter = adds(
      [](const json::Value& value, Rule&, Building& building) { return read_passage<when::Enter>(value, building); });
  const auto leave = adds(
      [](const json::Value& value, Rule&, Building& building) { return read_passage<when::Leave>(value, building); });
  const auto saturated =
      adds([](const json::Value& value, Rule&, Building&) { return when::Saturated{value.number()}; });
  const auto error = adds([](const json::Value& value, Rule&, Building&) { return when::Error{value.number()}; });
  const auto peak = adds([](const json::Value&, Rule&, Building&) { return when::SpeedPeak{}; });
  static const Table<Rule> table(
      "a trigger",
      {{"at", &ValueForms::stage_time, "stage time", {read_instant}, false, {}, {"time"}},
       {"marker", &ValueForms::name, "an event of a clip that animates the body", marker},
       {"event", &ValueForms::name, "an event of any playing clip", event},
       {"clip_end", only_yes(), "the last play that animates the body is over", end},
       {"contact", form_of(contact_table()), "", contact, false, {}, {"oncollisionenter", "hit", "touch"}},
       {"asleep", bounded("a number of seconds of stillness above 0", 0, true), "seconds of stillness", asleep},
       {"enter", form_of(passage_table<when::Enter>()), "into a sensor", enter},
       {"leave", form_of(passage_table<when::Leave>()), "out of a sensor", leave},
       {"saturated", bounded("a number of seconds above 0", 0, true),
        "seconds for which a drive has been at its greatest force or torque", saturated},
       {"error", &ValueForms::positive, "m from the path, of a driven body", error},
       {"speed_peak", only_yes(), "the path of the body is as fast as it gets", peak}});
  return table;
}

}  // namespace

const Form* when_form(FormStore& store, const ValueForms& values) {
  std::vector<std::string> names = trigger_table().names();
  Form trigger = trigger_table().form(store, values);
  Form when = trigger;
  trigger.together = {exactly_one(names)};
  trigger.definition = "trigger";
  const Form* list = store.add(list_of(store.add(std::move(trigger)), "a list of triggers"));
  when.what = "a trigger, or \"all\" or \"any\" of a list";
  when.fields.push_back({"all", list, "every one: instants latch, conditions must hold", false, "", {"and", "every"}});
  when.fields.push_back({"any", list, "whichever comes first", false, "", {"or", "either"}});
  when.together = {exactly_one(when.field_names())};
  when.together.front().otherwise =
      ", or a list: {\"all\": [...]} for this and that, {\"any\": [...]} for this or that";
  when.definition = "when";
  when.instead = trigger_instead_of;
  return store.add(std::move(when));
}

void read_when(const json::Value& value, RuleBeingRead& rule, Building& building) {
  rule.rule.when.all = static_cast<bool>(value.find("all"));
  const json::Value list = usable(value, rule.rule.when.all ? "all" : "any");
  if (!list) trigger_table().read(value, rule, building);
  for (const json::Value& trigger : list.items()) trigger_table().read(trigger, rule, building);
}

}  // namespace tweenfall::document::fields
