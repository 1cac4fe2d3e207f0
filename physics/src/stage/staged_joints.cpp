#include <tweenfall/curves/nearest_name.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

BodyId end_of(const StageState& state, const JointDescription& described, std::size_t node) {
  if (node >= state.nodes->size())
    throw std::invalid_argument("there is no node number " + std::to_string(node) + " to hold");
  const StagedBody* body = state.body(node);
  if (!body) throw std::invalid_argument("\"" + (*state.nodes)[node].name + "\" has no body to hold");
  if (described.a == described.b)
    throw std::invalid_argument("it needs two bodies, but both ends are \"" + (*state.nodes)[node].name + "\"");
  return body->id;
}

JointId add_joint(StageState& state, const JointDescription& described) {
  if (described.b == no_node)
    throw std::invalid_argument("its second end needs a body: only the first may be the world");
  if (const auto* at = std::get_if<when::At>(&described.until); at && std::isnan(at->time))
    throw std::invalid_argument("the time until which it holds must be a number");
  return state.world.add_joint({.a = described.a == no_node ? BodyId{} : end_of(state, described, described.a),
                                .b = end_of(state, described, described.b),
                                .frame_a = described.frame_a,
                                .frame_b = described.frame_b,
                                .kind = described.kind,
                                .break_force = described.break_force,
                                .break_torque = described.break_torque,
                                .collide = described.collide});
}

/// When a joint ends, in (from, to]; infinity when it does not.
double end_time_of(const StageState& state, const StagedJoint& joint, double from, double to) {
  if (!state.world.contains(joint.id)) return infinity;
  double time = infinity;
  if (const auto* at = std::get_if<when::At>(&joint.until)) time = at->time;
  if (const auto* event = std::get_if<when::Event>(&joint.until))
    time = event_time(*state.animation, {}, event->name, no_node, from, to);
  return time > from && time <= to ? time : infinity;
}

void report_end(const StagedJoint& joint, const char* name, double time, std::vector<Happening>& happenings) {
  StageEvent event;
  event.time = time;
  event.name = name;
  if (joint.a != no_node) event.nodes.push_back(joint.a);
  event.nodes.push_back(joint.b);
  event.joint = joint.name;
  Happening& happening = happenings.emplace_back();
  happening.time = time;
  happening.what = std::move(event);
}

}  // namespace

void add_joints(StageState& state, const StageDescription& description, std::vector<StageFault>& faults) {
  auto joints = std::make_shared<StagedJoints>();
  const auto refuse = [&](std::size_t index, const std::string& why) {
    faults.push_back({StageFault::Part::joint, index, "the joint \"" + description.joints[index].name + "\": " + why});
  };
  joints->list.reserve(description.joints.size());
  for (std::size_t i = 0; i < description.joints.size(); ++i) {
    const JointDescription& described = description.joints[i];
    StagedJoint joint{.name = described.name, .a = described.a, .b = described.b, .until = described.until};
    try {
      joint.id = add_joint(state, described);
    } catch (const std::invalid_argument& fault) {
      refuse(i, fault.what());
    }
    if (described.until.index() != 0) joints->ending.push_back(i);
    joints->by_name.push_back(i);
    if (joint.id != JointId{}) {
      if (joints->by_index.size() <= joint.id.index) joints->by_index.resize(joint.id.index + 1);
      joints->by_index[joint.id.index] = i;
    }
    joints->list.push_back(std::move(joint));
  }
  const auto name_of = [&](std::size_t i) -> const std::string& { return joints->list[i].name; };
  std::ranges::stable_sort(joints->by_name, {}, name_of);
  for (std::size_t i = 1; i < joints->by_name.size(); ++i)
    if (name_of(joints->by_name[i]) == name_of(joints->by_name[i - 1]))
      refuse(joints->by_name[i], "another joint has this name");
  state.joints = std::move(joints);
}

double next_joint_end(const StageState& state, double from, double to) {
  double next = infinity;
  for (const std::size_t i : state.joints->ending)
    next = std::min(next, end_time_of(state, state.joints->list[i], from, to));
  return next;
}

void end_joints(StageState& state, double from, std::vector<Happening>& happenings) {
  for (const std::size_t i : state.joints->ending) {
    const StagedJoint& joint = state.joints->list[i];
    const double time = end_time_of(state, joint, from, state.handled);
    if (!std::isfinite(time)) continue;
    state.world.remove_joint(joint.id);
    report_end(joint, "joint_ended", std::max(0.0, time), happenings);
  }
}

void report_broken_joints(const StageState& state, std::vector<Happening>& happenings) {
  for (const JointId& id : state.world.broken_joints())
    report_end(state.joints->list[state.joints->by_index[id.index]], "joint_broke", state.time, happenings);
}

std::optional<JointReading> joint_reading(const StageState& state, std::string_view name) {
  const std::vector<StagedJoint>& list = state.joints->list;
  const auto name_of = [&](std::size_t i) { return std::string_view(list[i].name); };
  const auto found = std::ranges::lower_bound(state.joints->by_name, name, {}, name_of);
  if (found == state.joints->by_name.end() || name_of(*found) != name) {
    std::vector<std::string> names;
    names.reserve(list.size());
    for (const StagedJoint& joint : list) names.push_back(joint.name);
    const std::string nearest = nearest_name(name, names);
    throw std::invalid_argument("there is no joint \"" + std::string(name) + "\"" +
                                (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  }
  const StagedJoint& joint = list[*found];
  if (!state.world.contains(joint.id)) return std::nullopt;
  return state.world.reading(joint.id);
}

}  // namespace tweenfall::staging
