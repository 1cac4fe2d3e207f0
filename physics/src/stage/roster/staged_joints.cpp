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

JointId held(StageState& state, const JointDescription& described) {
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

auto by_name_in(const StagedJoints& joints) {
  return [&joints](std::size_t i) { return std::string_view(joints.list[i].name); };
}

/// Where the name is in `by_name`, or would be.
std::size_t place_of(const StagedJoints& joints, std::string_view name) {
  return static_cast<std::size_t>(std::ranges::lower_bound(joints.by_name, name, {}, by_name_in(joints)) -
                                  joints.by_name.begin());
}

bool has(const StagedJoints& joints, std::string_view name, std::size_t place) {
  return place < joints.by_name.size() && joints.list[joints.by_name[place]].name == name;
}

const StagedJoint& joint_called(const StageState& state, std::string_view name) {
  const StagedJoints& joints = *state.joints;
  if (const std::size_t place = place_of(joints, name); has(joints, name, place))
    return joints.list[joints.by_name[place]];
  std::vector<std::string> names;
  names.reserve(joints.list.size());
  for (const StagedJoint& joint : joints.list) names.push_back(joint.name);
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument("there is no joint \"" + std::string(name) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

/// When a joint ends, in (from, to]; infinity if it does not.
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

void enter_joint(StagedJoints& joints, StagedJoint joint) {
  const std::size_t place = place_of(joints, joint.name);
  const bool again = has(joints, joint.name, place);
  const std::size_t i = again ? joints.by_name[place] : joints.list.size();
  if (again) {
    std::erase(joints.ending, i);
  } else {
    joints.by_name.insert(joints.by_name.begin() + static_cast<std::ptrdiff_t>(place), i);
    joints.list.emplace_back();
  }
  if (joint.until.index() != 0) joints.ending.push_back(i);
  if (joint.id != JointId{}) {
    if (joints.by_index.size() <= joint.id.index) joints.by_index.resize(joint.id.index + 1);
    joints.by_index[joint.id.index] = i;
  }
  joints.list[i] = std::move(joint);
}

void add_joints(StageState& state, const StageDescription& description, std::vector<StageFault>& faults) {
  auto joints = std::make_shared<StagedJoints>();
  joints->list.reserve(description.joints.size());
  for (std::size_t i = 0; i < description.joints.size(); ++i) {
    const JointDescription& described = description.joints[i];
    const auto refuse = [&](const std::string& why) {
      faults.push_back({StageFault::Part::joint, i, "the joint \"" + described.name + "\": " + why});
    };
    StagedJoint joint{.name = described.name, .a = described.a, .b = described.b, .until = described.until};
    if (has(*joints, joint.name, place_of(*joints, joint.name))) refuse("another joint has this name");
    try {
      joint.id = held(state, described);
    } catch (const std::invalid_argument& fault) {
      refuse(fault.what());
    }
    enter_joint(*joints, std::move(joint));
  }
  state.joints = std::move(joints);
}

std::shared_ptr<StagedJoints> own_joints(StageState& state) {
  if (state.joints.use_count() > 1) state.joints = std::make_shared<StagedJoints>(*state.joints);
  return std::const_pointer_cast<StagedJoints>(state.joints);
}

void add_joint(StageState& state, const JointDescription& described) {
  const std::size_t place = place_of(*state.joints, described.name);
  if (has(*state.joints, described.name, place) &&
      state.world.contains(state.joints->list[state.joints->by_name[place]].id))
    throw std::invalid_argument("the joint \"" + described.name + "\": another joint has this name");
  StagedJoint joint{.name = described.name, .a = described.a, .b = described.b, .until = described.until};
  try {
    joint.id = held(state, described);
  } catch (const std::invalid_argument& fault) {
    throw std::invalid_argument("the joint \"" + described.name + "\": " + fault.what());
  }
  enter_joint(*own_joints(state), std::move(joint));
}

void remove_joint(StageState& state, const std::string& name) {
  const StagedJoint& joint = joint_called(state, name);
  if (state.world.contains(joint.id)) state.world.remove_joint(joint.id);
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
  const StagedJoint& joint = joint_called(state, name);
  if (!state.world.contains(joint.id)) return std::nullopt;
  return state.world.reading(joint.id);
}

}  // namespace tweenfall::staging
