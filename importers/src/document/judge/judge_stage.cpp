#include <tweenfall/curves/number_text.h>
#include <tweenfall/physics/stage/inspection.h>
#include <tweenfall/physics/strategies.h>

#include "document/fields/things.h"
#include "document/forces/forces.h"
#include "document/judge/judge.h"
#include "document/read/values.h"

#include <cmath>

namespace tweenfall::document::judging {

namespace {

json::Value item_of(const json::Value& list, std::size_t index) {
  return list.is(json::Value::Kind::list) && index < list.items().size() ? list.items()[index] : list;
}

// Of a node without a body it is its rest pose that may be too far for a stage.
json::Value place_in_node(const Building& building, std::size_t index) {
  const NodeDescription& node = building.stage.nodes[index];
  if (node.body) return below(place_of_node(building, index), {"body"});
  const bool is_far = !(node.rest.position.cwiseAbs().maxCoeff() <= 1e30);
  return below(place_of_node(building, index), {is_far ? "position" : "scale"});
}

json::Value place_of_part(const Building& building, StageFault::Part part, std::size_t index) {
  const json::Value world = place_of_world(building);
  switch (part) {
    case StageFault::Part::world:
      return fields::place_of_gravity(world);
    case StageFault::Part::step:
      return fields::place_of_step(world);
    case StageFault::Part::clips:
      return below(building.root, {"clips"});
    case StageFault::Part::node:
      return place_in_node(building, index);
    case StageFault::Part::force:
      return fields::place_of_force(world, index);
    case StageFault::Part::joint:
      return place_of_joint(building, index);
    case StageFault::Part::soft:
      return fields::place_of_soft(world, building.stage.softs[index].name);
    case StageFault::Part::vehicle:
      return fields::place_of_vehicle(world, building.stage.vehicles[index].name);
    case StageFault::Part::particles:
      return fields::place_of_particles(world, building.stage.particles[index].name);
    case StageFault::Part::ignored:
      return fields::place_of_ignored(world);
    case StageFault::Part::rule:
      return item_of(below(building.root, {"handoff"}), index);
  }
  return building.root;
}

// "1/500": the step in the words of the document.
std::string step_text(double seconds) {
  const double parts = std::ceil(1 / seconds);
  return parts > 1 && parts < 1e6 ? "1/" + number_text(parts) : brief_text(seconds);
}

// "-120 to 0 degrees"
std::string span_text(const PassedLimit& passed) {
  const auto told = [&](double value) { return brief_text(passed.length ? value : degrees(value)); };
  const char* const unit = passed.length ? " m" : " degrees";
  if (passed.low == passed.high) return told(passed.low) + unit;
  if (std::isinf(passed.high)) return "at least " + told(passed.low) + unit;
  return told(passed.low) + " to " + told(passed.high) + unit;
}

void note_joint_starts(Building& building, const StageInspection& found) {
  const auto place = [&](std::size_t joint) { return place_of_joint(building, joint); };
  for (const OpenJoint& open : found.open_joints) {
    const std::string gap = open.gap > 0 ? brief_text(open.gap) + " m apart" : "";
    const std::string turn = open.turn > 0 ? "turned by " + brief_text(degrees(open.turn)) + " degrees" : "";
    building.problems.note(place(open.joint), "the ends of this joint start " + gap +
                                                  (gap.empty() || turn.empty() ? "" : " and ") + turn +
                                                  "; they are brought together at once");
  }
  for (const PassedLimit& passed : found.passed_limits) {
    const double position = passed.length ? passed.position : degrees(passed.position);
    building.problems.note(place(passed.joint), "starts at " + brief_text(position) +
                                                    (passed.length ? " m" : " degrees") + ", beyond its limits, " +
                                                    span_text(passed) + "; it is brought back at once");
  }
}

std::string way_apart(const WorldSettings& world) {
  if (world.separation == Parting::soft)
    return "; they are pushed apart, at " + brief_text(world.push_out_speed) + " m/s at most";
  return world.separation == Parting::closest_point ? "; one of them is moved out at once"
                                                    : "; they are moved apart at once";
}

}  // namespace

void judge_stage(Building& building) {
  const StageInspection found = inspect(building.stage, building.reading.options.try_steps);
  for (const StageFault& fault : found.faults)
    building.problems.add(place_of_part(building, fault.part, fault.index), fault.message);
  const std::vector<NodeDescription>& nodes = building.stage.nodes;
  for (const StartOverlap& overlap : found.overlaps)
    building.problems.note(below(place_of_node(building, overlap.a), {"position"}),
                           json::in_quotes(nodes[overlap.a].name) + " starts " + brief_text(overlap.depth) +
                               " m deep in " + json::in_quotes(nodes[overlap.b].name) +
                               way_apart(building.stage.world));
  note_joint_starts(building, found);
  const json::Value world = place_of_world(building);
  for (const StiffSpring& stiff : found.stiff_springs)
    building.problems.note(forces::place_of_stiffness(fields::place_of_force(world, stiff.force)),
                           "this spring is too fast for the bodies on it and steps of " +
                               step_text(building.stage.step) +
                               " s; it holds, but its swing is damped away. Steps of " + step_text(stiff.longest_step) +
                               " s or less show it");
  for (const Extreme& extreme : found.extremes)
    building.problems.note(place_of_part(building, extreme.part, extreme.index), extreme.message);
}

}  // namespace tweenfall::document::judging
