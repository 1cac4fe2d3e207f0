#include "document/joints/joints.h"

#include "document/fields/things.h"
#include "document/joints/joint.h"
#include "document/read/clip_times.h"
#include "document/report/spellings.h"
#include "document/report/suggestion.h"

#include <tweenfall/anim/hierarchy.h>

#include <algorithm>
#include <utility>

namespace tweenfall::document::joints {

namespace {

using Read = JointBeingRead;

const Form* between_form(FormStore& store, const ValueForms& values) {
  return store.add(choice_of("the name of a node with a body, to join it to the world, or a list of two",
                             {values.name, store.add(list_of(values.name, "", 1, 2))}));
}

void read_between(const json::Value& value, Read& read, Building& building) {
  JointDescription& joint = read.joint;
  std::vector<json::Value> names;
  if (value.is(json::Value::Kind::text)) names.push_back(value);
  for (const json::Value& item : value.items()) names.push_back(item);
  if (names.empty() || names.size() > 2) return;
  const std::size_t before = building.problems.size();
  for (const json::Value& name : names) {
    joint.a = std::exchange(joint.b, no_node);
    if (name.is(json::Value::Kind::text)) joint.b = fields::body_called(name, building);
  }
  if (building.problems.size() > before || joint.b == no_node) return;
  if (names.size() == 2 && joint.a == joint.b)
    building.problems.add(names[1], "a joint cannot hold a body to itself; leave one out for the world");
  const auto stands = [&](std::size_t node) { return node == no_node || building.stage.nodes[node].body->fixed; };
  if (stands(joint.a) && stands(joint.b))
    building.problems.note(value, "this joint holds nothing: neither end ever moves");
}

bool is_list_of_points(const json::Value& value) {
  return value.is(json::Value::Kind::list) && !value.items().empty() &&
         value.items().front().is(json::Value::Kind::list);
}

const Form* at_form(FormStore& store, const ValueForms& values) {
  const Form* const two = store.add(list_of(values.vector, "a list of two points", 2, 2));
  Form at = choice_of("a point, or a list of two, one on each end", {values.vector, two});
  at.select = [one = values.vector, two](const json::Value& value) { return is_list_of_points(value) ? two : one; };
  return store.add(std::move(at));
}

void read_at(const json::Value& value, Read& read, Building&) {
  read.at = value;
  if (const std::optional<Vec3> point = vector_of(value)) read.points.push_back(*point);
  if (!is_list_of_points(value)) return;
  for (const json::Value& item : value.items())
    if (const std::optional<Vec3> point = vector_of(item)) read.points.push_back(*point);
}

const fields::Table<Read>& until_table() {
  const auto at = [](const json::Value& value, Read& read, Building& building) {
    const ClipTimes times(building.fps, {}, "stage time has none");
    if (const std::optional<double> seconds = times.seconds(value, {}, building.problems))
      read.joint.until = when::At{*seconds};
  };
  const auto event = [](const json::Value& value, Read& read, Building& building) {
    read.joint.until = when::Event{std::string(value.text())};
    std::vector<std::string> events;
    for (const Clip& clip : building.stage.clips)
      for (const ClipEvent& each : clip.events) events.push_back(each.name);
    if (!building.failed_imports.empty() || std::find(events.begin(), events.end(), value.text()) != events.end())
      return;
    std::sort(events.begin(), events.end());
    events.erase(std::unique(events.begin(), events.end()), events.end());
    building.problems.add(value,
                          "no clip has an event " + json::in_quotes(value.text()) + suggestion(value.text(), events));
  };
  static const fields::Table<Read> table("an end of a joint",
                                         {{"at", &ValueForms::stage_time, "stage time", {at}},
                                          {"event", &ValueForms::name, "an event of any playing clip", {event}}});
  return table;
}

const Form* until_form(FormStore& store, const ValueForms& values) {
  return store.add(until_table().choosing_form(store, values));
}

// The fields of a joint beside its kind
std::vector<fields::Row<Read>> own_rows() {
  const auto of_joint = [](auto JointDescription::*part) {
    return fields::member<Read>([part](Read & read) -> auto& { return read.joint.*part; });
  };
  const fields::Meaning<Read> until = {
      [](const json::Value& value, Read& read, Building& building) { until_table().read(value, read, building); }};
  return {{"between",
           between_form,
           "two nodes with bodies, the second moves against the first; one: and the world",
           {read_between},
           true,
           {},
           {"bodies", "bodya", "bodyb", "body_a", "body_b", "connectedbody", "object1", "object2"}},
          {"at",
           at_form,
           "in the world, with all nodes at rest; absent: the origin of the second node, or of both",
           {read_at},
           false,
           {},
           {"anchor", "pivot"}},
          {"break_force", &ValueForms::positive, "N at which it breaks", of_joint(&JointDescription::break_force)},
          {"break_torque", &ValueForms::positive, "N m at which it breaks", of_joint(&JointDescription::break_torque)},
          {"collide", &ValueForms::boolean, "whether what it joins may touch each other",
           of_joint(&JointDescription::collide)},
          {"until", until_form, "when it lets go", until}};
}

const fields::Table<Read>& joint_table() {
  static const fields::Table<Read> table = [] {
    std::vector<fields::Row<Read>> rows = kinds();
    for (fields::Row<Read>& row : own_rows()) rows.push_back(std::move(row));
    return fields::Table<Read>("a joint", std::move(rows));
  }();
  return table;
}

// The rest poses of all nodes, in the world, as bodies have them.
std::vector<Pose> rests_of(const std::vector<NodeDescription>& nodes) {
  std::vector<WorldMotion> world;
  std::vector<Pose> rests;
  world.reserve(nodes.size());
  rests.reserve(nodes.size());
  for (const NodeDescription& node : nodes) {
    Motion local;
    local.pose = node.rest;
    world.push_back(child_of(node.parent == no_node ? WorldMotion{} : world[node.parent], local));
    rests.push_back({world.back().motion.pose.position, world.back().motion.pose.rotation});
  }
  return rests;
}

}  // namespace

const Form* form(FormStore& store, const ValueForms& values) {
  Form joint = joint_table().form(store, values);
  std::vector<std::string> names;
  for (const fields::Row<Read>& row : kinds()) names.push_back(row.name);
  std::vector<std::string> beside;
  for (const fields::Row<Read>& row : own_rows()) beside.push_back(row.name);
  joint.foremost_fault = [names, beside](const json::Value& value) {
    const std::string meant = kind_meant(value, names, beside);
    return meant.empty() ? meant : "a joint says its kind by the name of a field" + meant;
  };
  joint.together = {exactly_one(std::move(names))};
  joint.definition = "joint";
  return store.add(map_of(store.add(std::move(joint)), "an object with joints by name"));
}

void read(const json::Value& value, Building& building) {
  if (!value.is(json::Value::Kind::object)) return;
  const std::vector<Pose> rests = rests_of(building.stage.nodes);
  for (const json::Member& member : value.members()) {
    if (is_free_name(member.name) || !member.value.is(json::Value::Kind::object)) continue;
    Read read;
    read.joint.name = member.name;
    const std::size_t before = building.problems.size();
    joint_table().read(member.value, read, building);
    if (read.joint.b == no_node || !read.kind) continue;
    if (building.problems.size() == before) place(read, rests, building);
    building.stage.joints.push_back(std::move(read.joint));
  }
}

}  // namespace tweenfall::document::joints
