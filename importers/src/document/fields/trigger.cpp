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

// What a value that is no object may be meant for.
std::string trigger_instead_of(const json::Value& value) {
  if (value.is(json::Value::Kind::number)) return "; say {\"at\": " + json::on_one_line(value) + "}";
  if (!value.is(json::Value::Kind::text)) return {};
  const std::string name = json::on_one_line(value);
  return "; say {\"marker\": " + name + "} for an event of a clip that animates the body, or {\"event\": " + name +
         "} for one of any clip";
}

Form only_yes() {
  Form yes;
  yes.kind = Form::Kind::boolean;
  yes.what = "true";
  yes.only_true = true;
  return yes;
}

// A kind of trigger, which is added to those that are there.
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
  static const Table<Rule> table("a trigger",
                                 {{"at", &ValueForms::stage_time, "stage time", {read_instant}},
                                  {"marker", &ValueForms::name, "an event of a clip that animates the body", marker},
                                  {"event", &ValueForms::name, "an event of any playing clip", event},
                                  {"clip_end", only_yes(), "the last play that animates the body is over", end},
                                  {"contact", form_of(contact_table()), "", contact},
                                  {"asleep", &ValueForms::positive, "seconds of stillness", asleep}});
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
  when.fields.push_back({"all", list, "every one: instants latch, conditions must hold"});
  when.fields.push_back({"any", list, "whichever comes first"});
  when.together = {exactly_one(when.field_names())};
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
