#pragma once

// Everything that changes while a stage runs, in one copyable value: a stage goes back by assigning an older one.

#include <tweenfall/anim/jump_search.h>
#include <tweenfall/physics/stage/inspection.h>
#include <tweenfall/physics/stage/stage.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "stage/changes.h"
#include "stage/size_offset.h"

namespace tweenfall::staging {

inline constexpr std::size_t no_body = static_cast<std::size_t>(-1);
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Instants nearer to each other than this are handled together, and those so near to the end of a step at that end, s.
/// A body that leaves its path there leaves from where the path was at its own instant, moved on at its velocity.
inline constexpr double sliver = 1e-9;

/// Where a motion puts the point that is `center` in its own coordinates.
[[nodiscard]] inline Vec3 center_of(const Motion& motion, const Vec3& center) {
  return motion.pose.position + motion.pose.rotation * center;
}

/// A motion without its deformation.
[[nodiscard]] inline Motion rigid(Motion motion) {
  motion.pose.scale = Vec3(1, 1, 1);
  motion.scale_rate.setZero();
  return motion;
}

/// The motion of a node some time later, if nothing acts on it; its twist stays that of the origin.
[[nodiscard]] Motion moved_on(const Motion& motion, const Vec3& center, double seconds);

/// How the nodes without bodies below a body settle after it changed its clock, each in its parent's axes.
struct SettlingNode {
  NodeId node = no_node;
  SettleOffset offset;
  SizeOffset size;
};

/// The ramp of a body's drive from one to another.
struct Ramp {
  Drive from, to;
  double start = 0, seconds = 0;  ///< stage time and length, s
  Settle settle = {};             ///< of the difference to the path, if the ramp ends on it
};

/// A change of a rule that comes after another one.
struct ComingChange {
  std::size_t rule = 0;
  std::size_t place = 0;  ///< index in the rule's `then`
  double due = 0;         ///< stage time, s
};

struct StagedBody {
  NodeId node = no_node;
  BodyId id = {};
  Path path;
  double released_at = 0;  ///< stage time at which it last left its path
  std::shared_ptr<const WorldMotion>
      shown;  ///< never null: the path at that time; the free body keeps its scale and shear
  bool present = true;
  std::shared_ptr<const std::vector<SettlingNode>> below = {};  ///< in order of nodes; null for none
  Drive drive = {};                             ///< the initial drive: tracks of drives are mixed over it
  Vec3 surface{0, 0, 0};                        ///< the same for its surface, m/s
  double saturated_for = 0;                     ///< how long its drive has been at its limit, s
  bool by_track = true;                         ///< no rule and no caller has handed it over: a track may set its drive
  std::shared_ptr<const SizeOffset> size = {};  ///< how its own size settles on its path; null for none
  std::optional<Ramp> ramp = {};                ///< the ramp of its drive
  std::optional<ComingChange> coming = {};      ///< comes unless the body changes hands before

  /// Its path's motion at `time`, with the size that is still settling.
  [[nodiscard]] WorldMotion sized(double time, const WorldMotion& on_path) const noexcept;
};

/// What has happened to a rule so far, for `Stage::unfired_rules`.
struct Attempt {
  bool fired = false;
  bool waited = false;   ///< at some time its body was not yet where the rule takes it
  bool touched = false;  ///< for contacts: by something that the rule names
  double impulse = 0;    ///< greatest of these contacts, N s
  double speed = 0;      ///< greatest of these contacts, m/s
  double still = 0;      ///< longest, s
  double saturated = 0;  ///< longest, s
  double error = 0;      ///< greatest, m
};

/// One rule waiting on one body.
struct ArmedRule {
  std::size_t body = no_body;
  std::size_t rule = 0;
  std::vector<char> latched;  ///< for `all`: by trigger, whether its instant has come
  bool done = false;
  bool was_true = false;             ///< for a rule that fires again: it must have been false in between
  bool gone = false;                 ///< its body has left
  std::optional<Cause> vetoed = {};  ///< it fired but its body could not leave its path: tried again
  Attempt attempt = {};              ///< what has happened to it so far
};

/// A contact that began and is not over: its impulse so far is not yet the whole blow.
struct Blow {
  BodyId a, b;
  double met = 0;      ///< when the bodies met, s
  double began = 0;    ///< end of the piece in which they met, s
  double impulse = 0;  ///< N s
  double speed = 0;    ///< m/s
};

/// Two bodies that overlap deeply.
struct Strain {
  BodyId a, b;
  double since = 0;   ///< s
  bool told = false;  ///< it has lasted too long for a blow, and was reported
};
/// A body that was squeezed out between others.
struct Squeeze {
  BodyId body;
  double last = 0;  ///< when it last was, s
  bool operator==(const Squeeze&) const = default;
};
/// A joint that is far open.
struct Tear {
  std::size_t joint = 0;  ///< index in the stage's list
  double since = 0;       ///< s
  bool told = false;
};

/// Where the plays make bodies jump.
struct Jumps {
  std::vector<char> carriers;  ///< by node, of those there were: whether it or one below it has a body that can move
  JumpSearch search;           ///< of the tracks that carry them
};

/// A track that animates a property of a body's physics.
template <class T>
struct PlayedTrack {
  NodeId node = no_node;
  std::size_t clip = 0;
  const Curve<T>* curve = nullptr;  ///< part of the animation's clips
};
/// Each in order of nodes.
struct PlayedTracks {
  std::vector<PlayedTrack<double>> drives;  ///< Hz
  std::vector<PlayedTrack<Vec3>> surfaces;  ///< m/s
};

/// When fields, strengths of forces and scripts of vehicles leap from one value to another.
struct Leaps {
  std::vector<double> keyed;         ///< in order, s
  std::vector<Expression> formulas;  ///< of the time, that are asked step by step
  std::vector<ForceFormula> fields;  ///< likewise
};

/// One joint that the description or the caller put into the world.
struct StagedJoint {
  std::string name;
  JointId id = {};
  NodeId a = no_node, b = no_node;
  std::variant<std::monostate, when::At, when::Event> until;
};
struct StagedSofts;
struct StagedJoints {
  std::vector<StagedJoint> list;      ///< in the order in which they were described or added
  std::vector<std::size_t> by_name;   ///< indices into the list, in order of names
  std::vector<std::size_t> ending;    ///< indices of those with an `until`
  std::vector<std::size_t> by_index;  ///< index into the list, by index of the world's joint
};

/// Wheels under a body.
struct StagedVehicle {
  std::shared_ptr<const VehicleDescription> described;
  Vehicle vehicle;
  VehicleControl control = {};  ///< overrides of its script
};
struct StagedParticles {
  std::shared_ptr<const ParticlesDescription> described;
  Particles particles;
};

/// Something that happened during a piece, reported when the stage's time gets there.
struct Happening {
  double time = 0;
  std::variant<StageEvent, HandOff> what;
};

struct StageState {
  double time = 0;
  std::int64_t steps = -1;  ///< whole steps taken; -1 before the instant 0 has been handled
  double handled = -1;      ///< all that was due up to here has been done; a sliver after `time`
  double since = -1;        ///< what was due up to here was done before it came to `time`
  int at_once = 0;          ///< blows that fell at `time` since it came there, each in a piece that took no time
  int splits = 0;           ///< of the current step, by rules and jumps
  World world;
  Vec3 gravity{0, 0, 0};
  WorldPlane plane{};
  std::shared_ptr<const Hierarchy> nodes;
  std::shared_ptr<const Animation> animation;
  std::shared_ptr<const Jumps> jumps;
  std::shared_ptr<const PlayedTracks> tracks;
  std::shared_ptr<const StagedJoints> joints;  ///< including those that are gone: the world knows which still hold
  std::shared_ptr<const StagedSofts> softs;
  std::shared_ptr<const Leaps> leaps;        ///< of scripts
  std::vector<std::size_t> forces;           ///< the world's numbers of the description's forces
  std::vector<StagedVehicle> vehicles;       ///< as they were described
  std::vector<StagedParticles> particles;    ///< likewise
  std::vector<char> present;                 ///< by node
  std::vector<std::optional<Color>> colors;  ///< by node, if no color is animated
  std::vector<StagedBody> bodies;
  bool ramps = true;                              ///< whether some body may be on a ramp
  std::vector<std::size_t> unused;                ///< places in `bodies` of those that have left
  std::vector<std::size_t> body_of;               ///< by node; `no_body` for none
  std::vector<NodeId> node_of;                    ///< by index of the world's body
  std::vector<NodeId> first_child, next_sibling;  ///< by node; `no_node` for none
  std::vector<std::uint32_t> presses;  ///< by index of the world's body: with how many it pressed in the last piece
  std::vector<std::shared_ptr<const Rule>> rules;
  std::vector<ArmedRule> armed;                    ///< by body, then by rule
  std::size_t gone_rules = 0;                      ///< of `armed`
  std::vector<Blow> blows;                         ///< by pair
  std::vector<std::pair<BodyId, BodyId>> passing;  ///< pairs that pass through each other until they are apart
  std::vector<Strain> strained;                    ///< by pair
  std::vector<Squeeze> squeezed;                   ///< by body, of the last moments
  std::vector<Tear> torn;                          ///< by joint
  double complementarity = 0;  ///< greatest residual of all steps so far where the solver is `lcp`, m/s
  bool jumped = true;          ///< some path may have jumped at `time`: keyed bodies are put on it before going on

  [[nodiscard]] StagedBody* body(NodeId node) {
    return node < body_of.size() && body_of[node] != no_body ? &bodies[body_of[node]] : nullptr;
  }
  [[nodiscard]] const StagedBody* body(NodeId node) const { return const_cast<StageState*>(this)->body(node); }
  /// The nodes below one that are on the stage, in order. @param enters  whether a node, and what is below it, counts
  template <class Enters>
  [[nodiscard]] std::vector<NodeId> below(NodeId node, Enters&& enters) const {
    std::vector<NodeId> found, left{node};
    while (!left.empty()) {
      NodeId child = first_child[left.back()];
      left.pop_back();
      for (; child != no_node; child = next_sibling[child]) {
        if (!present[child] || !enters(child)) continue;
        found.push_back(child);
        left.push_back(child);
      }
    }
    std::ranges::sort(found);
    return found;
  }
  [[nodiscard]] std::string_view name_of(BodyId body) const { return (*nodes)[node_of[body.index]].name; }
};

// changes.cpp: what the caller does
/// @throws std::invalid_argument for a node that is not on the stage
void require_node(const StageState& state, NodeId node);
/// @throws std::invalid_argument also for a node that has no body
[[nodiscard]] std::size_t body_index(const StageState& state, NodeId node);

// plays.cpp: what is played
/// @throws std::invalid_argument for an impossible change; nothing has changed then
void change_play(StageState& state, const PlayChange& change, double step, std::vector<Happening>& happenings);
/// Sends something to a graph, at the input's time.
/// @throws std::invalid_argument for an impossible input; nothing has changed then
void tell_graph(StageState& state, const std::string& graph, const GraphInput& input, double step,
                std::vector<Happening>& happenings);
/// Reports what plays fire in (from, to], from the start on if `from` is below 0.
void report_events(const StageState& state, double from, double to, std::vector<Happening>& happenings);

// rules/unfired.cpp: rules that waited in vain
[[nodiscard]] std::vector<UnfiredRule> unfired_rules(const StageState& state);

// roster.cpp: who is on the stage
/// @throws std::invalid_argument with everything that does not fit together
[[nodiscard]] StageState initial_state(const StageDescription& description);
/// The same, but collects faults instead of throwing; incomplete if there are any.
[[nodiscard]] StageState described_state(const StageDescription& description, std::vector<StageFault>& faults);
NodeId add_node(StageState& state, const NodeDescription& node);
void remove_node(StageState& state, NodeId node);
void arm_rule(StageState& state, const Rule& rule);
/// @throws std::invalid_argument for a change of owner that this body cannot make
void require_possible(const StageState& state, const StagedBody& body, const OwnerChange& change);

// rules/ownership.cpp: who moves a body
/// @param instant  when it happens; the state's time is at most a sliver away, or later when splits were capped
/// @return whether the body is where it should be: not if its overlap vetoes the change, which is reported
[[nodiscard]] bool change_owner(StageState& state, std::size_t body, const OwnerChange& change, Cause cause,
                                double instant, double step, std::vector<Happening>& happenings);

// rules/triggers.cpp: when that changes
/// The first moment in (state.handled, to] at which something may trigger or jump; infinity if there is none.
[[nodiscard]] double next_instant(const StageState& state, double to);
/// Fires the rules that are due in (from, state.handled], in order of time; contact triggers must have been latched
/// before.
void fire_rules(StageState& state, double from, double step, std::vector<Happening>& happenings);
/// Whether the rule waits for its trigger: its body is not yet where the rule would take it, nor on its way there.
[[nodiscard]] bool waits(const StageState& state, const ArmedRule& armed);
/// Hands the rule's body over.
void fire_rule(StageState& state, ArmedRule& armed, Cause cause, double instant, double step,
               std::vector<Happening>& happenings);

/// First time in (from, to] at which a play that runs by `clock` fires an event of this name; infinity for none.
/// @param node  if given, only plays that move the node count
[[nodiscard]] double event_time(const Animation& animation, const ClockOverride& clock, const std::string& name,
                                NodeId node, double from, double to);

// staged_joints.cpp: what holds bodies to each other
/// Adds the description's joints to the world. Impossible ones are faults.
void add_joints(StageState& state, const StageDescription& description, std::vector<StageFault>& faults);
void enter_joint(StagedJoints& joints, StagedJoint joint);  ///< replaces one of its name that is gone
/// The joints of the state, shared with no other state: they may be changed.
[[nodiscard]] std::shared_ptr<StagedJoints> own_joints(StageState& state);
/// @throws std::invalid_argument, also for the name of a joint that still holds
void add_joint(StageState& state, const JointDescription& joint);
/// @throws std::invalid_argument with the nearest name; does nothing for one that is gone
void remove_joint(StageState& state, const std::string& name);
/// The first moment in (from, to] at which a joint ends; infinity if there is none.
[[nodiscard]] double next_joint_end(const StageState& state, double from, double to);
/// Removes joints whose end is due in (from, state.handled].
void end_joints(StageState& state, double from, std::vector<Happening>& happenings);
/// Reports which joints broke in the world's last step.
void report_broken_joints(const StageState& state, std::vector<Happening>& happenings);
/// Finds joints of the description that do not start as they hold.
void find_joint_starts(const StageState& state, const StageDescription& description, StageInspection& out);
// inspection/extremes.cpp
/// Finds what numbers or steps cannot follow.
void find_extremes(const StageState& state, const StageDescription& description, bool try_steps, StageInspection& out);
/// @throws std::invalid_argument with the nearest name
[[nodiscard]] std::optional<JointReading> joint_reading(const StageState& state, std::string_view name);

// piece.cpp: from one instant to the next
/// Takes `state` to the next instant, or to the end of its step if there is none before. What happens is added in
/// order of time.
/// @param arrived  the state at that instant before the changes of the caller, if there are any: what is read before
/// a change must not know of it
/// @throws what the world throws; `state` is then useless
void take_piece(StageState& state, double step, std::span<const Command> commands, std::vector<Happening>& happenings,
                std::optional<StageState>& arrived);
/// Gives driven and keyed bodies their targets at `end`. @throws NodeNotFinite
void set_targets(StageState& state, double end);
/// `motion`, if the world can bear it. @throws NodeNotFinite saying what is too much about it, with what led the body
/// there, such as "its path"
[[nodiscard]] const Motion& bearable(const StageState& state, const StagedBody& body, const Motion& motion,
                                     const char* leader);

// rules/blows.cpp: what contacts trigger
/// Moves the world to `end`, or to the first impact before it that pulls a trigger.
void move_world(StageState& state, double end, double step, std::vector<Happening>& happenings);

// rules/jumps.cpp: where paths are not continuous
[[nodiscard]] std::shared_ptr<const Jumps> find_jumps(const StageState& state);
/// The same jumps after the plays have changed.
[[nodiscard]] std::shared_ptr<const Jumps> jumps_of_plays(const StageState& state);
/// Whether tracks that moved no body before move a body that is added at this node.
[[nodiscard]] bool carries_more(const StageState& state, NodeId node);
/// First stage time in (from, to] at which some path may make its body jump; infinity for none.
[[nodiscard]] double first_jump(const StageState& state, double from, double to);

// interpolation.cpp: what a stage shows, between two consecutive states, or near one if it is given twice
[[nodiscard]] WorldMotion body_world(const StageState& from, const StageState& to, std::size_t body, double time);
/// The pose at which the world has its shape, or would have it.
[[nodiscard]] Pose body_pose(const StageState& from, const StageState& to, std::size_t body, double time);
[[nodiscard]] Twist body_twist(const StageState& from, const StageState& to, std::size_t body, double time);
void stage_world(const StageState& from, const StageState& to, double time, std::span<WorldMotion> out);
/// Local motion of a node without a body. @param above  the nearest body above it; null for none
[[nodiscard]] Motion local_motion(const StageState& state, const StagedBody* above, NodeId node, double time,
                                  Side side = Side::out);
[[nodiscard]] WorldMotion node_world(const StageState& from, const StageState& to, NodeId node, double time);

}  // namespace tweenfall::staging
