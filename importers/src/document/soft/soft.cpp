#include "document/soft/soft.h"

#include "document/fields/things.h"
#include "document/read/clip_times.h"
#include "document/report/spellings.h"
#include "document/report/suggestion.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace tweenfall::document::soft {

namespace {

using Kind = json::Value::Kind;
using Read = SoftBeingRead;

struct PinsBeingRead {
  std::vector<std::uint32_t> nodes;
  SoftPinDescription pin;
  const Sides* sides = nullptr;
  std::size_t count = 0;  // of the soft body's nodes
};

const fields::Table<SoftPinDescription>& until_table() {
  using Pin = SoftPinDescription;
  const auto at = [](const json::Value& value, Pin& pin, Building& building) {
    const ClipTimes times(building.fps, {}, "stage time has none");
    if (const std::optional<double> seconds = times.seconds(value, {}, building.problems))
      pin.until = when::At{*seconds};
  };
  const auto event = [](const json::Value& value, Pin& pin, Building& building) {
    pin.until = when::Event{std::string(value.text())};
    std::vector<std::string> events;
    for (const Clip& clip : building.stage.clips)
      for (const ClipEvent& each : clip.events) events.push_back(each.name);
    if (!building.failed_imports.empty() || std::ranges::find(events, value.text()) != events.end()) return;
    building.problems.add(value,
                          "no clip has an event " + json::in_quotes(value.text()) + suggestion(value.text(), events));
  };
  static const fields::Table<Pin> table("an end of a pin",
                                        {{"at", &ValueForms::stage_time, "stage time", {at}},
                                         {"event", &ValueForms::name, "an event of any playing clip", {event}}});
  return table;
}

const Form* until_form(FormStore& store, const ValueForms& values) {
  return store.add(until_table().choosing_form(store, values));
}

const Form* nodes_form(FormStore& store, const ValueForms&) {
  const Form* const one = store.add(bounded("a whole number of at least 0", 0, false, 999'999, true));
  const Form* const several = store.add(list_of(one, "a list of whole numbers"));
  const Form* const side = store.add(words_of("", {"start", "end"}));
  return store.add(choice_of("nodes of the soft body: \"start\", \"end\", a number or a list of numbers from 0",
                             {side, one, several}));
}

void read_nodes_of_pin(const json::Value& value, PinsBeingRead& out, Building& building) {
  if (value.is(Kind::text)) {
    out.nodes = value.text() == "start" ? out.sides->start : out.sides->end;
    return;
  }
  const auto take = [&](const json::Value& number) {
    if (!number.is(Kind::number)) return;
    const auto node = static_cast<std::uint32_t>(number.number());
    if (node < out.count)
      out.nodes.push_back(node);
    else
      building.problems.add(
          number, "there is no node " + std::to_string(node) + "; the last one is " + std::to_string(out.count - 1));
  };
  take(value);
  for (const json::Value& item : value.items()) take(item);
}

void read_holder(const json::Value& value, PinsBeingRead& out, Building& building) {
  const auto found = building.nodes.find(value.text());
  if (found != building.nodes.end())
    out.pin.to = found->second;
  else if (!building.excused(value.text()))
    building.problems.add(
        value, "there is no node " + json::in_quotes(value.text()) + suggestion(value.text(), building.node_names()));
}

const fields::Table<PinsBeingRead>& pin_table() {
  using Pins = PinsBeingRead;
  const auto point = [](const json::Value& value, Pins& out, Building&) { out.pin.point = vector_of(value); };
  const auto until = [](const json::Value& value, Pins& out, Building& building) {
    until_table().read(value, out.pin, building);
  };
  static const fields::Table<Pins> table(
      "a pin",
      {{"nodes", nodes_form, "of the soft body; of a cloth \"start\" is its first row", {read_nodes_of_pin}, true},
       {"to", &ValueForms::name, "a node, which they follow; absent: they stay in the world", {read_holder}},
       {"point", &ValueForms::vector, "on that node; absent: where they are", {point}},
       {"until", until_form, "when it lets go", {until}}});
  return table;
}

const Form* pins_form(FormStore& store, const ValueForms& values) {
  const Form* const pin = store.add(pin_table().listing_form(store, values));
  Form pins = list_of(pin, "a list of pins", 0);
  pins.one_per_line = true;
  return store.add(std::move(pins));
}

void read_pins(const json::Value& value, Read& read, Building& building) {
  if (read.described.soft.positions.empty()) return;
  for (const json::Value& item : value.items()) {
    PinsBeingRead pins{.nodes = {}, .pin = {}, .sides = &read.sides, .count = read.described.soft.positions.size()};
    if (!item.is(Kind::object)) continue;
    pin_table().read(item, pins, building);
    if (pins.pin.point && pins.nodes.size() > 1)
      building.problems.add(usable(item, "point"),
                            "\"point\" is for one node, and these are " + std::to_string(pins.nodes.size()));
    for (const std::uint32_t node : pins.nodes) {
      pins.pin.node = node;
      const auto same = [node](const SoftPinDescription& other) { return other.node == node; };
      if (std::ranges::any_of(read.described.pins, same))
        building.problems.add(item, "another pin holds node " + std::to_string(node) + " already");
      read.described.pins.push_back(pins.pin);
    }
  }
}

const Form* sub_step_form(FormStore& store, const ValueForms& values) {
  Form fraction;
  fraction.kind = Form::Kind::text;
  fraction.pattern = "^1/[1-9][0-9]{0,8}$";
  fraction.fits = [](std::string_view text) {
    return text.size() > 2 && text.size() <= 11 && text.substr(0, 2) == "1/" && text[2] != '0' &&
           text.substr(2).find_first_not_of("0123456789") == std::string_view::npos;
  };
  return store.add(choice_of("seconds above 0, or \"1/N\"", {values.positive, store.add(std::move(fraction))}));
}

void read_sub_step(const json::Value& value, Read& read, Building&) {
  if (value.is(Kind::number)) read.described.soft.sub_step = value.number();
  if (!value.is(Kind::text)) return;
  double parts = 1;
  std::from_chars(value.text().data() + 2, value.text().data() + value.text().size(), parts);
  read.described.soft.sub_step = 1 / parts;
}

void read_iterations(const json::Value& value, Read& read, Building&) {
  if (value.is(Kind::number)) read.described.soft.iterations = static_cast<int>(value.number());
}

// The fields of a soft body beside its kind
std::vector<fields::Row<Read>> own_rows() {
  const auto of_soft = [](auto SoftSettings::*part) {
    return [part](Read & read) -> auto& {
      return read.described.soft.*part;
    };
  };
  const auto member_of = [&](auto SoftSettings::*part) { return fields::member<Read>(of_soft(part)); };
  const auto color = [](Read& read) -> std::optional<Color>& { return read.described.color; };
  const auto groups = [](const json::Value& value, Read& read, Building& building) {
    read.described.soft.groups = fields::read_groups(value, building);
  };
  const auto collides_with = [](const json::Value& value, Read& read, Building& building) {
    read.described.soft.collides_with = fields::read_collides_with(value, building);
  };
  return {fields::one_of<Read, SoftSolver>(
              "solver", "a solver", {{"positions", SoftSolver::positions}, {"springs", SoftSolver::springs}},
              "constraints with compliance, or forces and backward Euler", of_soft(&SoftSettings::solver)),
          {"sub_step", sub_step_form, "longest, s; absent: 1/1920 of positions, 1/240 of springs", {read_sub_step}},
          {"iterations",
           bounded("a whole number from 1 to 1000", 1, false, 1000, true),
           "passes over all constraints in a sub-step; absent: 1 to 4, by the stiffest",
           {read_iterations}},
          {"radius", &ValueForms::positive, "of its nodes where they meet bodies, m", member_of(&SoftSettings::radius)},
          {"friction", &ValueForms::not_negative, "with bodies", member_of(&SoftSettings::friction)},
          {"linear_damping", &ValueForms::not_negative, "1/s", member_of(&SoftSettings::linear_damping)},
          {"collide", &ValueForms::boolean, "whether it meets bodies", member_of(&SoftSettings::collide)},
          {"groups", fields::groups_form, "that it belongs to", {groups, "[\"default\"]"}},
          {"collides_with", fields::groups_form, "groups of bodies; absent: all", {collides_with}},
          {"thickness",
           &ValueForms::not_negative,
           "how near its nodes come to each other, m; 0: they pass through each other",
           member_of(&SoftSettings::thickness),
           false,
           {},
           {"self_collision", "self_collide"}},
          {"air_drag", &ValueForms::not_negative, "of its faces, by which winds that name no bodies press on them",
           member_of(&SoftSettings::air_drag)},
          {"color", &ValueForms::color, "", fields::member<Read>(color)},
          {"pins", pins_form, "what holds it", {read_pins, "[]"}}};
}

const fields::Table<Read>& soft_table() {
  static const fields::Table<Read> table = [] {
    std::vector<fields::Row<Read>> rows = kinds();
    for (fields::Row<Read>& row : own_rows()) rows.push_back(std::move(row));
    return fields::Table<Read>("a soft body", std::move(rows));
  }();
  return table;
}

}  // namespace

const Form* form(FormStore& store, const ValueForms& values) {
  Form soft = soft_table().form(store, values);
  std::vector<std::string> names;
  for (const fields::Row<Read>& row : kinds()) names.push_back(row.name);
  std::vector<std::string> beside;
  for (const fields::Row<Read>& row : own_rows()) beside.push_back(row.name);
  soft.foremost_fault = [names, beside](const json::Value& value) {
    const std::string meant = kind_meant(value, names, beside);
    return meant.empty() ? meant : "a soft body says its kind by the name of a field" + meant;
  };
  soft.together = {exactly_one(std::move(names))};
  soft.definition = "soft";
  return store.add(map_of(store.add(std::move(soft)), "an object with soft bodies by name"));
}

void read(const json::Value& value, Building& building) {
  if (!value.is(Kind::object)) return;
  for (const json::Member& member : value.members()) {
    if (is_free_name(member.name) || !member.value.is(Kind::object)) continue;
    Read read;
    read.described.name = member.name;
    const std::size_t before = building.problems.size();
    soft_table().read(member.value, read, building);
    // If the kind could not be made there is nothing to add.
    if (!read.kind || building.problems.size() > before) continue;
    building.stage.softs.push_back(std::move(read.described));
  }
}

}  // namespace tweenfall::document::soft
