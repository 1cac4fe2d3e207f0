// Calls that change a stage.

#include "attack/stage/calls.h"

namespace tweenfall::attack {

namespace {

void release(Caller& caller) {
  const NodeId node = caller.any_node();
  caller.stage.release(node, made_take_over(caller.arguments));
}

void recover(Caller& caller) {
  const NodeId node = caller.any_node();
  caller.stage.recover(node, made_hand_back(caller.arguments));
}

void hand_over(Caller& caller) {
  const NodeId node = caller.any_node();
  caller.stage.hand_over(node, made_change(caller.arguments));
}

void arm(Caller& caller) {
  caller.stage.arm(made_rule(caller.arguments, caller.stage.time()));
}

void ask(Caller& caller) {
  const std::string play = caller.arguments.name("move");
  caller.stage.ask(play, made_action(caller.arguments));
}

void set(Caller& caller) {
  const std::string parameter = caller.arguments.name(caller.arguments.one_in(2) ? "speed" : "follow");
  caller.stage.set(caller.arguments.name("figure"), parameter, caller.arguments.number(0, 1));
}

void send(Caller& caller) {
  const std::string event = caller.arguments.name("go");
  caller.stage.send(caller.arguments.name("figure"), event);
}

void control(Caller& caller) {
  const std::string vehicle = caller.arguments.name("car");
  caller.stage.control(vehicle, made_control(caller.arguments));
}

/// An input of its own, or one that it was given earlier.
void give(Caller& caller) {
  const std::vector<TimedInput> before = caller.stage.inputs();
  if (!before.empty() && caller.arguments.one_in(3))
    caller.stage.give(before[below(caller.random, before.size())].what);
  else
    caller.stage.give(made_input(caller.arguments));
}

void add(Caller& caller) {
  NodeDescription node = made_node(caller.arguments, caller.arguments.name("new" + std::to_string(caller.added++)));
  if (caller.arguments.one_in(3)) node.parent = caller.any_node();
  (void)caller.stage.add(node);
}

void remove(Caller& caller) {
  if (caller.stage.nodes().size() > 3) caller.stage.remove(caller.any_node());
}

void apply_impulse(Caller& caller) {
  const NodeId node = caller.any_node();
  const Vec3 impulse = caller.arguments.vector(2);
  caller.stage.apply_impulse(node, impulse, caller.arguments.vector(1));
}

void add_joint(Caller& caller) {
  const NodeId a = caller.arguments.one_in(3) ? no_node : caller.any_node(), b = caller.any_node();
  JointDescription joint = made_joint(caller.arguments, a, b);
  joint.name = "joint" + std::to_string(below(caller.random, 5));
  if (caller.arguments.one_in(4)) joint.until = when::At{caller.stage.time() + caller.arguments.number(0, 0.2)};
  caller.stage.add_joint(joint);
}

void remove_joint(Caller& caller) {
  caller.stage.remove_joint(caller.arguments.name("joint" + std::to_string(below(caller.random, 5))));
}

void ignore(Caller& caller) {
  const NodeId a = caller.any_node();
  caller.stage.ignore(a, caller.any_node());
}

void collide(Caller& caller) {
  const NodeId a = caller.any_node();
  caller.stage.collide(a, caller.any_node());
}

}  // namespace

std::span<const Call> calls_that_change() {
  static constexpr Call list[] = {{"release", 3, release},
                                  {"recover", 3, recover},
                                  {"hand_over", 3, hand_over},
                                  {"arm", 2, arm},
                                  {"ask", 3, ask},
                                  {"set", 2, set},
                                  {"send", 2, send},
                                  {"control", 2, control},
                                  {"give", 3, give},
                                  {"add", 2, add},
                                  {"remove", 1, remove},
                                  {"apply_impulse", 3, apply_impulse},
                                  {"add_joint", 2, add_joint},
                                  {"remove_joint", 1, remove_joint},
                                  {"ignore", 1, ignore},
                                  {"collide", 1, collide}};
  return list;
}

}  // namespace tweenfall::attack
