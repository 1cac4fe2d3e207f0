#pragma once

/// The stage: clips bound to nodes, bodies in a world, hand-offs armed; one timeline for all.
///
/// `advance` takes any frame time. Inside, physics runs in fixed steps that are split at the exact
/// times of triggers; between two steps, values are interpolated by Hermite cubics of the bodies'
/// own positions and velocities, and are exact for keyed nodes. `seek` goes to any time, forward or
/// back, with the same bits as a run from the start.
///
/// How a keyed body becomes free: at the trigger's instant t the step is split, the body takes the
/// pose and twist of its path at t (from the side that was shown), expressed at its center of mass, and
/// from there the world moves it.

#include <tweenfall/physics/handoff/path.h>
#include <tweenfall/physics/handoff/rule.h>
#include <tweenfall/physics/stage/description.h>
#include <tweenfall/physics/stage/input.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

class GraphPlayer;
namespace queries {
class InsideStage;
}

using NodeId = std::size_t;

/// An event of a clip, the start of a contact, a body that entered or left a sensor, the end of a joint, something that
/// physics cannot hold or for which a step is too short, as `on_event` and recordings see it.
struct StageEvent {
  double time = 0;  ///< stage time, s; for a contact, when the two met: it is reported once its impulse is known
  /// The clip event's name, or one of these: "contact"; "entered" and "left"; "joint_broke", and "joint_ended" when its
  /// `until` ends it; "overlap" of two bodies that overlap deeply, and "joint_strained" of a joint that for a twentieth
  /// of a second is open, beyond a limit or short of its motor's speed; "squeezed" of a body that keyed ones press out
  /// between them, more than three times as fast as they move; "vetoed" of a body that overlaps another and
  /// therefore stays on its path, as its rule says; "split limit" of a step with more instants than may split it;
  /// "unpinned" of a pin that lets go, and "torn" of an edge of a soft body.
  std::string name;
  std::string data;  ///< JSON text: what a clip event carries; {"depth": m}; {"speed": m/s}; of a joint {"gap": m},
                     ///< {"beyond_limit": m or rad} or {"missing_speed": m/s or rad/s}; {"splits": count};
                     ///< {"node": of the soft body}; {"edge": of the soft body, "at": [where, m]}; else empty
  std::vector<NodeId> nodes;  ///< of a contact, an overlap or a veto: both; of a sensor: the sensor and the body; of a
                              ///< joint: its bodies
  double impulse = 0;         ///< of a contact: N s
  std::string joint = {};     ///< name of a joint; of a pin that lets go or an edge that tears: of the soft body
  EventKind kind = EventKind::moment;  ///< `begin` or `end` for an interval of a clip
};

/// A joint that the stage has or had, and the nodes whose bodies it holds; `no_node`: the world.
struct JointEnds {
  std::string name;
  NodeId a = no_node, b = no_node;
};

/// A soft body as a stage shows it.
struct SoftNodes {
  std::vector<Vec3> positions;   ///< world, m
  std::vector<Vec3> velocities;  ///< m/s
  std::vector<char> torn;        ///< by edge of its description: 1 once the edge is torn
};

/// A wheel of a vehicle as a stage shows it.
struct StageWheel {
  Pose pose = {};  ///< world: at its hub, with its y along the axle to the left
  WheelReading reading = {};
};

/// Particles as a stage shows them, the oldest first.
struct StageParticles {
  std::vector<Vec3> positions;         ///< world, m
  std::vector<Vec3> velocities;        ///< m/s
  std::vector<std::uint64_t> numbers;  ///< identify each particle for its whole life
};

/// Energies of particles of one kind, J.
struct ParticlesEnergy {
  double kinetic = 0;
  double weight = 0;  ///< against gravity, 0 at the origin
};

/// Energies of a stage, J.
struct StageEnergy {
  double kinetic = 0;                         ///< of all free bodies
  double weight = 0;                          ///< of these, against gravity, 0 at the origin
  std::vector<std::optional<double>> forces;  ///< for each force of the description, if it has a potential energy
  std::vector<SoftEnergy> softs;              ///< for each soft body of the description
  std::vector<ParticlesEnergy> particles;     ///< for each kind of particles of the description

  /// Of all of these. What springs and drives of joints store, and forces on particles, have no part in it.
  [[nodiscard]] double total() const;
};

/// A rule that never fired for one of its bodies.
struct UnfiredRule {
  std::size_t rule = 0;  ///< in the order in which rules were given
  std::size_t node = 0;
  std::string reason;  ///< what is known about each trigger, in words
};

/// Thrown when the position or velocity of a node's body is no longer a number or exceeds what a world can hold;
/// `what()` names the node, the time and the likely cause.
class NodeNotFinite : public NotFinite {
 public:
  NodeNotFinite(NodeId node, const std::string& name, const NotFinite& fault);
  NodeId node;
};

class Stage {
 public:
  /// @throws std::invalid_argument listing everything that does not fit together
  explicit Stage(StageDescription description);
  ~Stage();
  Stage(Stage&&) noexcept;
  Stage& operator=(Stage&&) noexcept;

  // Time
  // All three throw std::invalid_argument when a call would take more than 20 million steps, and NodeNotFinite when the
  // motion of a body is no longer finite; the stage then stays before that step, and throws again when it goes on.
  void advance(double dt);       ///< @throws std::invalid_argument when dt is negative or not finite
  void advance_to(double time);  ///< to exactly `time`. @throws std::invalid_argument when that is in the past
  void seek(double time);        ///< any time >= 0; calls no callbacks
  [[nodiscard]] double time() const noexcept;
  [[nodiscard]] double step() const noexcept;

  // Reading, at `time()`
  [[nodiscard]] NodeId node(std::string_view name) const;      ///< @throws std::invalid_argument with the nearest name
  [[nodiscard]] std::span<const Node> nodes() const noexcept;  ///< valid until the stage is changed, as all spans here
  [[nodiscard]] bool contains(NodeId node) const noexcept;
  [[nodiscard]] bool has_body(NodeId node) const noexcept;
  [[nodiscard]] WorldMotion world(NodeId node) const;  ///< of the node's origin
  void world(std::span<WorldMotion> out) const;        ///< of all nodes, in order
  [[nodiscard]] Twist twist(NodeId node) const;  ///< of a body at its center of mass, else at the origin; world axes
  [[nodiscard]] Owner owner(NodeId node) const;  ///< a node without a body is keyed
  [[nodiscard]] Drive drive(NodeId node) const;  ///< what holds its body to its path; on a ramp, its present value
  [[nodiscard]] NodeLook look(NodeId node) const;
  /// The names of the user tracks that plays and graphs have, "node.property", without those of drives and surfaces;
  /// and the value of one: mixed by their weights, as at `Animation::user_value`.
  /// @throws std::invalid_argument with the nearest name
  [[nodiscard]] std::vector<std::string> user_tracks() const;
  [[nodiscard]] UserValue user_value(std::string_view track) const;
  [[nodiscard]] Vec3 reaction(NodeId node) const;  ///< sum of contact impulses taken by a keyed or fixed body, N s
  /// The state of a joint at the end of the last step before or at `time()`; empty once it is gone: because it broke or
  /// ended, or because one of its bodies left. @throws std::invalid_argument with the nearest name
  [[nodiscard]] std::optional<JointReading> joint(std::string_view name) const;
  /// The joints of the description and those added until `time()`, in that order, including those that are gone; a
  /// joint added under the name of one that is gone takes its place.
  [[nodiscard]] std::vector<JointEnds> joints() const;
  [[nodiscard]] SoftNodes soft(std::string_view name) const;  ///< @throws std::invalid_argument with the nearest name
  /// Its wheels, in the description's order. @throws std::invalid_argument with the nearest name
  [[nodiscard]] std::vector<StageWheel> vehicle(std::string_view name) const;
  [[nodiscard]] StageParticles particles(std::string_view name) const;  ///< @throws the same
  [[nodiscard]] StageEnergy energy() const;                             ///< between two steps: linearly interpolated
  /// The greatest `complementarity_residual` (`detail.h`) of all steps until `time()`, m/s; empty unless the world's
  /// solver is `lcp`.
  [[nodiscard]] std::optional<double> complementarity() const;
  [[nodiscard]] Path path(NodeId node) const;  ///< where the animation wants the node
  [[nodiscard]] const StageDescription& description() const;

  // Hand-off by the caller, at exactly `time()`. @throws NodeNotFinite when the path the body takes over is too fast
  void release(NodeId node, const TakeOver& settings = {});
  void recover(NodeId node, const HandBack& settings = {});
  void hand_over(NodeId node, const OwnerChange& change);  ///< to any owner, at once or along a ramp
  void arm(Rule rule);

  // Plays, at exactly `time()`; `seek` repeats what was asked
  /// Starts, stops, fades, weighs, re-speeds or seeks a play: see `PlayAction`. Keyed bodies follow their paths across.
  /// @param play  name of the play, or else of its clip
  /// @throws std::invalid_argument for an impossible request, or an unknown name; nothing has changed then
  void ask(std::string_view play, PlayAction action);

  // Graphs, likewise
  /// Sets a parameter from now on; a flag to 0 or 1.
  /// @throws std::invalid_argument with the nearest name, for a parameter that has keys, or a value that is not finite
  void set(std::string_view graph, std::string_view parameter, double value);
  /// An event that nothing waits for is lost. @throws std::invalid_argument with the nearest graph
  void send(std::string_view graph, std::string_view event);
  /// A copy of a graph as it is now, to look into: states, transitions, parameters, events. Changes to the copy do not
  /// reach the stage.
  /// @throws std::invalid_argument with the nearest name
  [[nodiscard]] GraphPlayer graph(std::string_view name) const;

  // Vehicles, likewise
  /// Drives it in place of its script from now on.
  /// @throws std::invalid_argument with the nearest name, for numbers that are not finite, and for an empty control
  void control(std::string_view vehicle, const VehicleControl& control);

  // Outside input as values
  /// Everything that was asked of plays, graphs, vehicles and bodies until now, impulses included, each with its time:
  /// a stage of the same description that gets them at these times runs to the same bits. Changes of the cast are no
  /// input: nodes that come or go, joints, `ignore`, `collide` and rules that are armed. `save` keeps those, too.
  [[nodiscard]] std::vector<TimedInput> inputs() const;
  /// Gives one of these inputs, at exactly `time()`. @throws as the function that it stands for
  void give(const Input& input);
  /// Advances to its time, and gives it then. @throws also as `advance_to`
  void give(const TimedInput& input);

  // Changing the cast while it runs
  NodeId add(const NodeDescription& node);
  void remove(NodeId node);  ///< with its descendants, and the joints of their bodies
  void apply_impulse(NodeId node, const Vec3& impulse, const Vec3& point);
  /// @throws std::invalid_argument naming what is wrong, also for the name of a joint that still holds
  void add_joint(const JointDescription& joint);
  void remove_joint(std::string_view name);  ///< does nothing for a joint that is gone already
  void ignore(NodeId a, NodeId b);           ///< their bodies pass through each other
  void collide(NodeId a, NodeId b);          ///< undoes `ignore`
  /// Whether their bodies may meet: their groups allow it, and no joint or `ignore` keeps them apart.
  [[nodiscard]] bool collides(NodeId a, NodeId b) const;

  // What happened
  // A callback may change the stage: this acts at `time()`. What it keeps from happening after all is taken back, and
  // nothing is told twice. A body that is pressed, or struck through others, is freed at the beginning of a step: what
  // the callback changes then comes just before that, so that an impulse on this body is lost.
  /// Called for all events but contacts, in order of time; within the callback, `time()` is the event's.
  void on_event(std::function<void(const StageEvent&)> callback);
  void on_contact(std::function<void(const StageEvent&)> callback);
  void on_handoff(std::function<void(const HandOff&)> callback);
  [[nodiscard]] std::span<const HandOff> handoffs() const noexcept;   ///< up to `time()`
  [[nodiscard]] std::span<const StageEvent> events() const noexcept;  ///< up to `time()`, contacts included

  /// What has not fired until now, by node and then by rule, with the reason: not touched, or not hard enough, no such
  /// marker, time still to come. A pattern counts for each body. What fired but has a change to come says so.
  [[nodiscard]] std::vector<UnfiredRule> unfired_rules() const;

  /// A number that changes when any bit of any body, soft body, wheel or particle does, at the next instant or step
  /// after `time()`.
  [[nodiscard]] std::uint64_t state_hash() const noexcept;

  // Saving
  /// The stage as bytes, from which `load` restores it: at its time, with everything that happened and was changed
  /// until then. It then steps, and seeks back, to the same bits.
  /// @throws std::invalid_argument when a body is not finite
  [[nodiscard]] std::vector<std::byte> save() const;
  /// Becomes the stage that was saved; callbacks stay as they are.
  /// @throws std::invalid_argument saying what is wrong with the bytes, or when they belong to a stage of another
  /// description; nothing has changed then
  void load(std::span<const std::byte> saved);

 private:
  friend class queries::InsideStage;
  struct Implementation;
  [[nodiscard]] Implementation& inside() const;  ///< @throws std::logic_error when moved from

  std::shared_ptr<Implementation> implementation_;  ///< shared with the call from which a callback is called
};

}  // namespace tweenfall
