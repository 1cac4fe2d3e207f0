#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "saving/envelope.h"
#include "stage/roster/staged_softs.h"
#include "stage/saving/fingerprint.h"
#include "stage/saving/stage_fields.h"
#include "stage/time/timeline.h"
#include "state/checks.h"
#include "state/countable.h"

namespace tweenfall::staging {

namespace {

constexpr saving::Envelope stage_envelope{"stage", 9};

void require(bool holds, const std::string& what) {
  if (!holds) throw std::invalid_argument("a saved stage has a bad " + what);
}

/// The part of a state that does not follow from who is on the stage.
/// @param visit  of a writer, or of a reader into a state with the same cast
template <class State, class Visit>
void each_moving_field(State& state, const Visit& visit) {
  visit(state.time, state.steps, state.splits, state.jumped);
  for (auto& body : state.bodies) visit(body);
  if constexpr (!std::is_const_v<State>) state.ramps = true;
  for (auto& armed : state.armed) visit(armed);
  visit(state.blows, state.presses, state.passing, state.strained, state.torn);
  visit.rarely(state.squeezed);
  visit(state.complementarity);
  for (auto& staged : state.vehicles) visit(staged);
  for (auto& staged : state.particles) visit(staged);
}

/// Throws for values that are not numbers.
class Numbers : public saving::Teller<Numbers> {
 public:
  template <class T>
  void number(const T& value) {
    if constexpr (std::is_floating_point_v<T>) require(!std::isnan(value), "number: it is not a number");
  }
  void text(const std::string&) {}
  void hull(const ConvexHull&) {}
  void field(const Field&) {}
};

void require_unit(const Quat& rotation) {
  require(std::abs(rotation.norm() - 1) <= 1e-9, "rotation: it must be a unit quaternion");
}

/// @param now  the stage's time
void check_time(const StageState& state, double now, bool between, double step) {
  constexpr std::int64_t most_steps = 1'000'000'000'000;
  require(state.steps >= 0 && state.steps <= most_steps, "number of steps");
  const double start = static_cast<double>(state.steps) * step, end = static_cast<double>(state.steps + 1) * step;
  require(state.time >= start - sliver && state.time <= end && end > start, "time: it does not match its steps");
  require(now <= (between ? end : state.time + sliver) && now >= state.time - sliver,
          "time: it is not near that of its state");
  require(state.splits >= 0 && state.splits <= 1024, "number of splits");
  require(state.complementarity >= 0, "residual of complementarity");
}

void check_ramp(const Ramp& ramp) {
  state::validate(ramp.from);
  state::validate(ramp.to);
  require(std::isfinite(ramp.start) && ramp.seconds > 0 && std::isfinite(ramp.seconds) && ramp.settle.seconds > 0,
          "ramp: it has no length");
}

void check_bodies(const StageState& state) {
  const std::size_t nodes = state.nodes->size(), clips = state.animation->clips().size();
  std::size_t here = 0;
  for (const StagedBody& body : state.bodies) {
    if (!body.present) continue;
    ++here;
    require(state.world.contains(body.id), "world: a body is not in it");
    require_unit(body.shown->motion.pose.rotation);
    for (const Path* path = &body.path; path; path = path->above()) {
      const std::size_t clip = path->clock().clip;
      require(clip == ClockOverride::every_clip || clip < clips, "clock: there is no such clip");
    }
    if (const auto& coming = body.coming)
      require(coming->rule < state.rules.size() && coming->place < state.rules[coming->rule]->then.size(),
              "change to come: there is no such rule");
    if (const auto& ramp = body.ramp) check_ramp(*ramp);
    if (!body.below) continue;
    for (const SettlingNode& settling : *body.below) require(settling.node < nodes, "settling node");
    require(std::ranges::is_sorted(*body.below, {}, &SettlingNode::node), "list of settling nodes");
  }
  require(state.world.bodies().size() == here, "world: it has more bodies than the stage");
  const std::vector<SoftId> softs = soft_bodies(state.world);
  require(softs.size() == state.softs->list.size(), "world: it does not have the stage's soft bodies");
  for (std::size_t i = 0; i < softs.size(); ++i)
    require(softs[i] == state.softs->list[i].second &&
                soft_positions(state.world, softs[i]).size() == state.softs->nodes[i],
            "world: a soft body is not the stage's");
}

void check_particles(const StageState& state) {
  for (const StagedParticles& staged : state.particles) {
    const Particles& particles = staged.particles;
    require(std::abs(particles.time() - state.time) <= 1e-6 * std::max(1.0, state.time), "time of particles");
    for (std::size_t i = 0; i < particles.size(); ++i)
      require(state::countable(particles.position(i)) && state::countable(particles.velocity(i)), "particle");
  }
}

void check_blows(const StageState& state) {
  const auto pair = [](const Blow& blow) { return std::pair(blow.a.index, blow.b.index); };
  require(std::ranges::is_sorted(state.blows, {}, pair), "list of blows");
  for (const Blow& blow : state.blows)
    require(blow.a.index < state.node_of.size() && blow.b.index < state.node_of.size(), "blow: there is no such body");
  require(state.presses.size() <= state.node_of.size(), "list of what presses");
  const auto by_index = [](const Strain& strain) { return std::pair(strain.a.index, strain.b.index); };
  require(std::ranges::is_sorted(state.strained, {}, by_index), "list of overlaps");
  require(std::ranges::is_sorted(state.squeezed, {}, [](const Squeeze& one) { return one.body.index; }),
          "list of what is squeezed");
  require(std::ranges::is_sorted(state.torn, {}, &Tear::joint), "list of torn joints");
}

void check_happenings(const std::vector<StageEvent>& events, const std::vector<HandOff>& handoffs, std::size_t nodes) {
  for (const StageEvent& event : events)
    for (const NodeId node : event.nodes) require(node < nodes, "event: there is no such node");
  for (const HandOff& handoff : handoffs) require(handoff.node < nodes, "hand-off: there is no such node");
}

/// Joints as they were saved, matched with those of the world.
std::shared_ptr<const StagedJoints> joints_of(const std::vector<StagedJoint>& list, const StageState& state) {
  auto joints = std::make_shared<StagedJoints>();
  for (const StagedJoint& joint : list) {
    require(joint.b < state.nodes->size() && (joint.a == no_node || joint.a < state.nodes->size()),
            "joint: there is no such node");
    StagedJoint entered = joint;
    if (!state.world.contains(joint.id)) entered.id = {};
    enter_joint(*joints, std::move(entered));
  }
  require(joints->list.size() == list.size(), "list of joints: two have one name");
  std::size_t held = 0;
  for (const StagedJoint& joint : joints->list)
    if (joint.id != JointId{}) ++held;
  for (const JointId& id : state.world.joints()) {
    require(id.index < joints->by_index.size() && joints->list[joints->by_index[id.index]].id == id,
            "world: one of its joints is not the stage's");
  }
  require(state.world.joints().size() == held, "list of joints: two share one of the world's");
  return joints;
}

/// When a state was saved.
struct SavedInstant {
  double time = 0, since = 0;
  int at_once = 0;
};

/// The state at the start, with all changes of its cast up to an instant.
StageState cast_at(const StageState& initial, const std::vector<Command>& commands, const SavedInstant& saved,
                   double step) {
  StageState state = initial;
  std::vector<Happening> unheard;
  for (const Command& command : commands) {
    if (command.time > saved.time + sliver) break;
    if (command.time > saved.since && command.at_once > saved.at_once) continue;
    if (!is_of_cast(command.change)) continue;
    state.time = std::max(0.0, command.time);
    make_change(state, command, step, unheard);
  }
  return state;
}

}  // namespace

std::vector<std::byte> Timeline::save() const {
  const auto [from, to] = around();
  const bool between = from != to;
  // What lies ahead of a state is recomputed from it.
  const StageState& state = between ? from_ : to_;
  saving::ByteWriter out;
  const saving::Walk<saving::ByteWriter> visit(out);
  const std::uint64_t described = fingerprint(description);
  visit(described, now_, between, commands_, happenings_, to_come_again_);
  visit.places(told_, of_piece_);
  visit(events, handoffs, state.time, state.since, state.at_once);
  each_moving_field(state, visit);
  const std::vector<std::byte> world = state.world.save();
  std::vector<StagedJoint> joints = state.joints->list;
  for (StagedJoint& joint : joints)
    if (!state.world.contains(joint.id)) joint.id = {};
  visit(joints, world);
  return saving::sealed(stage_envelope, out.bytes);
}

void Timeline::load(std::span<const std::byte> saved) {
  require_not_telling("load");
  saving::ByteReader in(saving::opened(stage_envelope, saved), "stage");
  const saving::Walk<saving::ByteReader> visit(in);
  std::uint64_t described = 0;
  double now = 0;
  SavedInstant instant;
  bool between = false;
  std::vector<Command> commands;
  std::vector<Happening> happenings, to_come_again;
  std::size_t told = 0, of_piece = 0;
  std::vector<StageEvent> past_events;
  std::vector<HandOff> past_handoffs;
  visit(described);
  if (described != fingerprint(description))
    throw std::invalid_argument("this saved stage has another description than the stage that would load it");
  visit(now, between, commands, happenings, to_come_again);
  visit.places(told, of_piece);
  visit(past_events, past_handoffs, instant.time, instant.since, instant.at_once);
  require(std::isfinite(now) && std::isfinite(instant.time) && now >= 0 && instant.time >= 0, "time");
  require(instant.since < instant.time + sliver && instant.at_once >= 0, "time: it is not near that of its state");
  require(told <= happenings.size() && of_piece <= happenings.size(), "list of what happened");
  require(std::ranges::is_sorted(commands, {}, &Command::time), "list of changes");
  for (const Command& command : commands)
    require(std::isfinite(command.time) && command.at_once >= 0, "time of a change");

  StageState state = cast_at(initial_, commands, instant, description.step);
  each_moving_field(state, visit);
  state.since = instant.since;
  state.at_once = instant.at_once;
  state.handled = state.time + sliver;
  std::vector<StagedJoint> joints;
  std::vector<std::byte> world;
  visit(joints, world);
  in.require(in.at_end(), "there is more data than a stage");
  state.world.load(world);
  Numbers numbers;
  each_moving_field(std::as_const(state), saving::Walk<Numbers>(numbers));
  check_time(state, now, between, description.step);
  check_bodies(state);
  check_blows(state);
  check_particles(state);
  state.joints = joints_of(joints, state);
  const std::size_t nodes = state.nodes->size();
  check_happenings(past_events, past_handoffs, nodes);
  for (const auto* list : {&happenings, &to_come_again})
    for (const Happening& happening : *list) {
      if (const auto* event = std::get_if<StageEvent>(&happening.what)) check_happenings({*event}, {}, nodes);
      if (const auto* handoff = std::get_if<HandOff>(&happening.what)) check_happenings({}, {*handoff}, nodes);
    }

  StageState ahead = state;
  std::optional<StageState> arrived;
  if (between) {
    std::vector<Happening> told_again;
    try {
      take(ahead, commands, told_again, arrived);
    } catch (const std::exception& fault) {
      throw std::invalid_argument(std::string("a saved stage cannot go on: ") + fault.what());
    }
    require(now < ahead.time, "time: it is not near that of its state");
  }
  scene.forget();
  from_ = std::move(state);
  to_ = std::move(ahead);
  arrived_ = std::move(arrived);
  commands_ = std::move(commands);
  happenings_ = std::move(happenings);
  to_come_again_ = std::move(to_come_again);
  told_ = told;
  of_piece_ = of_piece;
  events = std::move(past_events);
  handoffs = std::move(past_handoffs);
  now_ = now;
}

}  // namespace tweenfall::staging
