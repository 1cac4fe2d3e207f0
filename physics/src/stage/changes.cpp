#include "stage/changes.h"

#include <stdexcept>

#include "stage/actors/vehicles.h"
#include "stage/rules/played_tracks.h"
#include "stage/rules/ramps.h"
#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

struct Maker {
  StageState& state;
  double instant;
  double step;
  std::vector<Happening>& happenings;

  void hand_over(NodeId node, const OwnerChange& change) const {
    const std::size_t body = body_index(state, node);
    require_possible(state, state.bodies[body], change);
    static_cast<void>(change_owner(state, body, change, Cause::caller, instant, step, happenings));
  }
  void operator()(const change::None&) const {}
  void operator()(const change::Release& release) const { hand_over(release.node, {.take_over = release.settings}); }
  void operator()(const change::Recover& recover) const {
    hand_over(recover.node, {.to = Drive::keyed(), .hand_back = recover.settings});
  }
  void operator()(const change::HandOver& handed) const { hand_over(handed.node, handed.change); }
  void operator()(const change::Arm& arm) const { arm_rule(state, arm.rule); }
  void operator()(const change::Add& add) const { static_cast<void>(add_node(state, add.node)); }
  void operator()(const change::Remove& remove) const {
    require_node(state, remove.node);
    remove_node(state, remove.node);
  }
  void operator()(const change::Push& push) const {
    state.world.apply_impulse(state.bodies[body_index(state, push.node)].id, push.impulse, push.point);
  }
  void operator()(const change::Join& join) const { add_joint(state, join.joint); }
  void operator()(const change::Part& part) const { remove_joint(state, part.joint); }
  void operator()(const change::Ignore& pair) const {
    const BodyId a = state.bodies[body_index(state, pair.a)].id, b = state.bodies[body_index(state, pair.b)].id;
    if (pair.ignored)
      state.world.ignore(a, b);
    else
      state.world.collide(a, b);
  }
  void operator()(const change::Ask& ask) const {
    change_play(state, {.time = instant, .play = ask.play, .action = ask.action}, step, happenings);
  }
  void operator()(const change::Tell& tell) const {
    tell_graph(state, tell.graph, {.time = instant, .name = tell.name, .value = tell.value}, step, happenings);
  }
  void operator()(const change::Control& told) const { control_vehicle(state, told.vehicle, told.control); }
};

}  // namespace

void require_node(const StageState& state, NodeId node) {
  if (node >= state.present.size() || !state.present[node])
    throw std::invalid_argument("node number " + std::to_string(node) + " is not on the stage");
}

std::size_t body_index(const StageState& state, NodeId node) {
  require_node(state, node);
  const std::size_t body = state.body_of[node];
  if (body == no_body) throw std::invalid_argument("\"" + (*state.nodes)[node].name + "\" has no body");
  return body;
}

void make_change(StageState& state, const Command& command, double step, std::vector<Happening>& happenings) {
  if (std::holds_alternative<change::None>(command.change)) return;
  std::visit(Maker{state, command.time, step, happenings}, command.change);
  // At once, so that whoever makes the change sees what `seek` will find there.
  follow_played_tracks(state, step, happenings);
  follow_ramps(state);
}

bool is_of_cast(const Change& change) {
  return std::holds_alternative<change::Arm>(change) || std::holds_alternative<change::Add>(change) ||
         std::holds_alternative<change::Remove>(change) || std::holds_alternative<change::Ask>(change) ||
         std::holds_alternative<change::Tell>(change);
}

}  // namespace tweenfall::staging
