// Queries to a stage.

#include "attack/stage/calls.h"

#include <tweenfall/anim/graph_player.h>
#include <tweenfall/physics/stage/detail.h>
#include <tweenfall/physics/stage/query.h>

#include <cmath>
#include <variant>

namespace tweenfall::attack {

namespace {

void read_node(Caller& caller) {
  const Stage& stage = caller.stage;
  const std::string name = caller.arguments.name("body" + std::to_string(below(caller.random, 4)));
  const NodeId node = stage.node(name);
  caller.require(stage.contains(node), "a node that is found is not there");
  caller.require(stage.nodes()[node].name == name, "another node is found");
  (void)stage.owner(node), (void)stage.drive(node), (void)stage.look(node);
  if (stage.has_body(node)) caller.require(stage.reaction(node).allFinite(), "a reaction is not finite");
}

void read_user_tracks(Caller& caller) {
  for (const std::string& name : caller.stage.user_tracks()) {
    const UserValue value = caller.stage.user_value(name);
    if (const auto* number = std::get_if<Sample<double>>(&value))
      caller.require(std::isfinite(number->value) && std::isfinite(number->rate), "a user track reads no number");
  }
  (void)caller.stage.user_value(caller.arguments.name("body0.effort"));
}

void read_any_node(Caller& caller) {
  const NodeId node = caller.any_node();
  (void)caller.stage.has_body(node), (void)caller.stage.contains(node);
  (void)caller.stage.twist(node), (void)caller.stage.owner(node), (void)caller.stage.drive(node);
  (void)caller.stage.look(node), (void)caller.stage.reaction(node);
}

void read_path(Caller& caller) {
  const Path path = caller.stage.path(caller.any_node());
  const double time = caller.arguments.number(0, 2);
  // A graph that waits for events of loops goes through a million of them, which takes seconds.
  if (std::abs(time) < 100) (void)path.at(time);
}

void read_joints(Caller& caller) {
  for (const JointEnds& joint : caller.stage.joints())
    if (const auto reading = caller.stage.joint(joint.name))
      caller.require(reading->force.allFinite() && std::isfinite(reading->position[0]), "a joint reads no number");
  (void)caller.stage.joint(caller.arguments.name("joint1"));
}

void read_collides(Caller& caller) {
  const NodeId a = caller.any_node();
  (void)caller.stage.collides(a, caller.any_node());
}

void read_soft(Caller& caller) {
  (void)caller.stage.soft(caller.arguments.name("soft"));
}

void read_vehicle(Caller& caller) {
  (void)caller.stage.vehicle(caller.arguments.name("car"));
}

void read_particles(Caller& caller) {
  (void)caller.stage.particles(caller.arguments.name("sparks"));
}

void read_energy(Caller& caller) {
  (void)caller.stage.energy().total();
  (void)caller.stage.complementarity();
}

/// Looks into a graph, and plays it by itself.
void read_graph(Caller& caller) {
  GraphPlayer graph = caller.stage.graph(caller.arguments.name("figure"));
  (void)graph.activity(0), (void)graph.passages(0), (void)graph.parameter("follow");
  graph.set("speed", caller.arguments.number(0, 1));
  graph.advance(caller.random.between(0, 0.2));
  graph.load(graph.save());
}

void read_history(Caller& caller) {
  const Stage& stage = caller.stage;
  for (const StageEvent& event : stage.events())
    caller.require(event.time <= stage.time() + 1e-9, "an event that is to come is told");
  for (const HandOff& handoff : stage.handoffs())
    caller.require(handoff.after.pose.position.allFinite(), "a hand-off is nowhere");
  for (const UnfiredRule& rule : stage.unfired_rules())
    caller.require(!rule.reason.empty(), "a rule waits for nothing");
  caller.require(stage.step() > 0 && stage.description().nodes.size() == caller.description.nodes.size(),
                 "the description is another");
  (void)stage.inputs();
}

void read_detail(Caller& caller) {
  for (const NodeDetail& node : detail_of(caller.stage).nodes)
    caller.require(caller.stage.has_body(node.node), "a detail of a body that is not there");
}

void cast_a_ray(Caller& caller) {
  const Vec3 from = caller.arguments.vector(3), direction = caller.arguments.vector(1);
  const double length = caller.arguments.number(0, 10);
  (void)cast_ray_through(caller.stage, from, direction, length, {.sensors = true});
  if (const auto hit = cast_ray(caller.stage, from, direction, length))
    caller.require(hit->point.allFinite() && caller.stage.has_body(hit->node), "a ray meets nothing, nowhere");
}

void cast_a_shape(Caller& caller) {
  const Vec3 from = caller.arguments.vector(3);
  if (const auto hit =
          cast_shape(caller.stage, made_shape(caller.random), {.position = from}, caller.arguments.vector(2)))
    caller.require(hit->fraction >= 0 && hit->fraction <= 1, "a shape goes less than no way, or more than its own");
}

void ask_for_neighbors(Caller& caller) {
  const Vec3 at = caller.arguments.vector(3);
  (void)overlapping(caller.stage, made_shape(caller.random), {.position = at});
  const auto nearest = nearest_body(caller.stage, at, caller.arguments.number(0, 5));
  if (nearest) caller.require(nearest->distance >= 0 && nearest->point.allFinite(), "a body is nearer than near");
  const NodeId a = caller.any_node();
  caller.require(distance(caller.stage, a, caller.any_node()).distance >= 0, "bodies are nearer than near");
}

}  // namespace

std::span<const Call> calls_that_read() {
  static constexpr Call list[] = {{"node", 1, read_node},
                                  {"any node", 1, read_any_node},
                                  {"user tracks", 1, read_user_tracks},
                                  {"path", 1, read_path},
                                  {"joints", 1, read_joints},
                                  {"collides", 1, read_collides},
                                  {"soft", 1, read_soft},
                                  {"vehicle", 1, read_vehicle},
                                  {"particles", 1, read_particles},
                                  {"energy", 1, read_energy},
                                  {"graph", 1, read_graph},
                                  {"events, hand-offs, unfired rules", 1, read_history},
                                  {"detail", 1, read_detail},
                                  {"cast_ray", 1, cast_a_ray},
                                  {"cast_shape", 1, cast_a_shape},
                                  {"overlapping, nearest_body, distance", 1, ask_for_neighbors}};
  return list;
}

}  // namespace tweenfall::attack
