#include "document/ragdolls/ragdolls.h"

#include <tweenfall/physics/ragdoll/staged_ragdoll.h>

#include "document/fields/table.h"
#include "document/report/suggestion.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>

namespace tweenfall::document::ragdolls {

namespace {

struct Read {
  RagdollSettings settings;
  RagdollBody body;
};

using Limit = SwingTwistJoint;

const fields::Table<Limit>& limit_table() {
  const fields::Meaning<Limit> swing = {[](const json::Value& value, Limit& limit, Building&) {
    limit.swing_y = limit.swing_z = radians(value.number());
  }};
  const fields::Meaning<Limit> twist = {[](const json::Value& value, Limit& limit, Building&) {
    limit.twist = {-radians(value.number()), radians(value.number())};
  }};
  static const fields::Table<Limit> table(
      "limits of a joint",
      {{"swing", bounded("degrees from 0 to 180", 0, false, 180), "half angle of the cone", swing, true},
       {"twist", bounded("degrees from 0 to 180", 0, false, 180), "each way", twist, true}});
  return table;
}

const Form* limits_form(FormStore& store, const ValueForms& values) {
  return store.add(map_of(store.add(limit_table().form(store, values)), "an object with limits by names of nodes"));
}

void read_limits(const json::Value& value, Read& read, Building& building) {
  for (const json::Member& member : value.members()) {
    if (is_free_name(member.name) || !member.value.is(json::Value::Kind::object)) continue;
    if (building.nodes.count(member.name) == 0)
      building.problems.add_name(member, "there is no node " + json::in_quotes(member.name) +
                                             suggestion_or_import(member.name, building.node_names()));
    Limit limit;
    limit_table().read(member.value, limit, building);
    read.settings.limits.emplace_back(member.name, limit);
  }
}

const fields::Table<Read>& table() {
  const auto of_settings = [](auto RagdollSettings::*part) {
    return [part](Read & read) -> auto& {
      return read.settings.*part;
    };
  };
  const auto of_body = [](auto RagdollBody::*part) {
    return [part](Read & read) -> auto& {
      return read.body.*part;
    };
  };
  static const fields::Table<Read> table(
      "a ragdoll",
      {{"mass", bounded("a mass in kg, above 0", 0, true), "of the whole figure, kg",
        fields::member<Read>(of_settings(&RagdollSettings::mass))},
       {"smallest", bounded("a part of the figure from 0 to 1", 0, false, 1), "smaller parts have no body of their own",
        fields::member<Read>(of_settings(&RagdollSettings::smallest))},
       {"swing",
        bounded("degrees from 0 to 180", 0, false, 180),
        "half angle of the joints' cones",
        {[](const json::Value& value, Read& read, Building&) { read.settings.swing = radians(value.number()); }}},
       {"twist",
        bounded("degrees from 0 to 180", 0, false, 180),
        "how far they twist each way",
        {[](const json::Value& value, Read& read, Building&) { read.settings.twist = radians(value.number()); }}},
       {"limits", limits_form, "of single joints, by the node that moves", {read_limits, "{}"}},
       {"friction", &ValueForms::not_negative, "", fields::member<Read>(of_body(&RagdollBody::friction))},
       {"restitution", bounded("a restitution from 0 to 1", 0, false, 1), "",
        fields::member<Read>(of_body(&RagdollBody::restitution))},
       {"linear_damping", &ValueForms::not_negative, "1/s",
        fields::member<Read>(of_body(&RagdollBody::linear_damping))},
       {"angular_damping", &ValueForms::not_negative, "1/s",
        fields::member<Read>(of_body(&RagdollBody::angular_damping))}});
  return table;
}

// A group of bodies without a name in the document.
std::optional<std::uint64_t> own_group(Building& building) {
  constexpr std::size_t most = 64;
  std::vector<std::string>& groups = building.reading.groups;
  if (groups.size() == most) return {};
  groups.emplace_back();
  building.reading.given_groups |= std::uint64_t{1} << (groups.size() - 1);
  return std::uint64_t{1} << (groups.size() - 1);
}

}  // namespace

const Form* form(FormStore& store, const ValueForms& values) {
  Form ragdoll = table().form(store, values);
  ragdoll.definition = "ragdoll";
  return store.add(map_of(store.add(std::move(ragdoll)), "an object with ragdolls by the names of imports"));
}

void read(const json::Value& value, Building& building) {
  for (const json::Member& member : value.members()) {
    if (is_free_name(member.name) || !member.value.is(json::Value::Kind::object)) continue;
    if (building.failed_imports.count(member.name) > 0) continue;
    if (building.imports.count(member.name) == 0) {
      building.problems.add_name(member,
                                 "there is no import " + json::in_quotes(member.name) +
                                     suggestion(member.name, {building.imports.begin(), building.imports.end()}));
      continue;
    }
    Read read;
    const std::size_t before = building.problems.size();
    table().read(member.value, read, building);
    if (building.problems.size() > before) continue;
    const std::optional<std::uint64_t> group = own_group(building);
    if (!group) {
      building.problems.add_name(member, "there can be 64 groups of bodies, and this ragdoll needs one more");
      continue;
    }
    read.body.groups = *group;
    const std::string name(member.name);
    try {
      static_cast<void>(add_ragdoll(building.stage, read.settings, read.body, name, name + "/*"));
    } catch (const std::invalid_argument& fault) {
      building.problems.add_name(member, fault.what());
    }
  }
}

}  // namespace tweenfall::document::ragdolls
