#pragma once

/// A graph of poses: it makes the pose of a character from clips, by operations that refer to each other by name, and
/// by state machines that pass from one pose to another as parameters and events say.
///
/// `GraphDescription` consists of plain values, read from a document or filled in by a program; `Graph` is its fast
/// form, bound to nodes and clips once. Neither has state: what happened is kept in a log (`graph_player.h`), which
/// determines the pose at any time, value and rate.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/graph_figure.h>
#include <tweenfall/anim/graph_number.h>
#include <tweenfall/anim/graph_reach.h>
#include <tweenfall/anim/graph_swing.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/joint_mask.h>
#include <tweenfall/curves/curve.h>
#include <tweenfall/curves/ease.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace tweenfall {

/// A parameter: a number from outside. Conditions test the value set; poses see a value that follows it by `half_life`.
struct GraphParameter {
  std::string name;
  double start = 0;      ///< its value until it is set
  double half_life = 0;  ///< of the `SpringDecay` by which poses follow a newly set value, s; 0: at once
  std::optional<Curve<double>> curve{};  ///< its value over the graph's time; then it cannot be set
};

/// A user track as the curve of a parameter: as its clip plays it from the graph's start on, loops included.
/// @param track "node.property", of numbers, or a switch, which counts as 0 or 1
/// @param clip   empty: the only one that has the track
/// @throws std::invalid_argument for an unknown track or clip, with the nearest name, or a track of another kind
[[nodiscard]] Curve<double> track_curve(std::span<const Clip> clips, std::string_view track,
                                        std::string_view clip = {});

// The operations. Poses are given by name: that of another pose of the graph, or of a clip.

/// A clip, played from when the state that shows it was entered, or the graph began; other nodes are as below.
struct ClipPose {
  std::string clip;
  double at = 0;               ///< seconds until it starts
  double speed = 1;            ///< clip seconds per second; negative runs backwards from the end
  std::optional<Loop> loop{};  ///< absent: the clip's own
};

/// The pose below the graph: that of the plays, and where they drive nothing the rest pose of the nodes.
struct RestPose {};

/// Several poses mixed by weights of which only the ratios matter, as by `blend`: where they sum to less than
/// `least_weight`, the pose below the graph shows through.
struct BlendPose {
  struct Part {
    std::string pose;
    GraphNumber weight = 1.0;  ///< below 0 counts as 0
  };
  std::vector<Part> parts;  ///< `most_blended` at most
};

/// Poses over each other, the first at the bottom.
struct LayersPose {
  struct Layer {
    std::string pose;
    bool adds = false;                ///< adds its difference from `reference` to the pose below; else replaces that
    std::string reference = {};       ///< a pose; empty: the pose below the graph
    GraphNumber weight = 1.0;         ///< 0 to 1; values beyond are clamped
    std::vector<MaskPart> mask = {};  ///< none: all nodes
  };
  std::string base;  ///< empty: the pose below the graph
  std::vector<Layer> layers;
};

/// Poses at places along a line or on a plane, weighted by the position of one or two numbers among them, as by
/// `BlendLine`, `BlendPlane` or `BlendBands`.
struct SpacePose {
  struct Entry {
    std::string pose;
    Vec2 place{0, 0};  ///< along a line only x
  };
  std::vector<GraphNumber> by;  ///< one or two
  std::vector<Entry> entries;   ///< `most_blended` at most
  /// If all entries are clips, makes them loop in phase, as by `MarkerSync`: a pattern for the events that are markers;
  /// empty: those whose names all clips with events share and, without any, in phase by the shares of their loops.
  std::optional<std::string> sync{};
  bool bands = false;  ///< on a plane: weights by gradient bands, not by triangles
};

/// When a transition may be taken.
struct GraphCondition {
  enum class Kind {
    above,          ///< a parameter is greater than `value`
    below,          ///< ... or less
    equals,         ///< ... or exactly it
    event,          ///< an event was sent, or happened in a clip of the state
    time_in_state,  ///< `value` seconds have passed since the state was entered
    clip_end,       ///< all clips of the state have ended
  };
  Kind kind = Kind::above;
  std::string name{};  ///< of the parameter or event
  double value = 0;
};

/// How one state becomes another. Fades and settles may be interrupted at any time: the pose continues without a jump
/// in position or velocity, except for a cut and for eases that start abruptly.
struct GraphChange {
  enum class Kind {
    fade,        ///< both run, one fading into the other over `seconds`; 0: a cut
    quintic,     ///< the old one stops; the difference decays within `seconds`, as `QuinticDecay`
    half_life,   ///< ... as `SpringDecay` of that half-life
    dead_blend,  ///< the old one continues at its last velocity while it fades into the new one
  };
  Kind kind = Kind::fade;
  double seconds = 0.2;
  std::optional<Ease> ease{};  ///< for a fade, a shape; none: one that starts and ends smoothly
};

struct GraphTransition {
  std::vector<std::string> from{};  ///< states; none: any but `to`
  std::string to;
  std::vector<GraphCondition> when{};  ///< all must hold; none: at once
  GraphChange change = {};
};

/// A state machine: states, one of which shows at a time, and the transitions between them. Every machine runs from the
/// graph's start, whether it is shown or not.
struct MachinePose {
  struct State {
    std::string name;
    std::string pose;
  };
  std::string start;  ///< a state
  std::vector<State> states;
  std::vector<GraphTransition> transitions;  ///< the first whose conditions hold is taken
};

/// Operations that change one pose, which they name as their `base`, are in headers of their own.
using PoseOperation =
    std::variant<ClipPose, RestPose, BlendPose, LayersPose, SpacePose, MachinePose, TwoBonePose, LookAtPose, ReachPose,
                 FeetPose, MirrorPose, RetargetPose, RootMotionPose, SpringPose, JigglePose>;

struct GraphPose {
  std::string name;
  PoseOperation operation;
};

/// An input from outside: a parameter is set or, without a value, an event is sent.
struct GraphInput {
  double time = 0;  ///< s, since the graph began
  std::string name;
  std::optional<double> value{};

  bool operator==(const GraphInput&) const = default;
};

/// A reaction to an event of a clip, whether the clip shows in the graph or lies below it: sets a parameter or, without
/// a value, sends another event, at its exact instant. If the event repeats at one instant, it reacts once.
struct GraphReaction {
  std::string event;
  std::string name;
  std::optional<double> value{};

  bool operator==(const GraphReaction&) const = default;
};

struct GraphDescription {
  std::string name;
  std::vector<GraphParameter> parameters;
  std::vector<GraphPose> poses;
  std::string output;                   ///< the pose that shows; empty: the last
  std::vector<GraphInput> inputs = {};  ///< the inputs known in advance
  std::vector<GraphReaction> reactions = {};
};

/// A pose or clip that an operation names, and its role, in a word or two.
struct GraphOperand {
  std::string pose;
  std::string role;
  bool clip = false;  ///< only clips are meant
};
[[nodiscard]] std::vector<GraphOperand> operands_of(const PoseOperation& operation);

/// All names of clips used as poses, each once.
[[nodiscard]] std::vector<std::string> clips_named_in(const GraphDescription& description);

/// The events for which its machines wait, each once.
[[nodiscard]] std::vector<std::string> events_awaited(const GraphDescription& description);

/// Texts for tools: `speed > 0.1 and event "jump"`, "at once"; "fade 0.2 s", "settle quintic 0.3 s", "cut"; "machine".
[[nodiscard]] std::string words_of(std::span<const GraphCondition> when);
[[nodiscard]] std::string words_of(const GraphChange& change);
[[nodiscard]] std::string words_of(const PoseOperation& operation);

/// A number that changes with any part of the description.
[[nodiscard]] std::uint64_t fingerprint(const GraphDescription& description) noexcept;

/// A reason why no graph can be made from a description.
struct GraphFault {
  std::vector<std::string> place;  ///< "poses", "body", "machine", "transitions", "2", ...: names, and numbers from 0
  std::string message;
};

/// Checks a description against nodes and clips. @returns all faults with their places; empty where `Graph` accepts it
[[nodiscard]] std::vector<GraphFault> inspect(const GraphDescription& description, const Hierarchy& nodes,
                                              std::span<const Clip> clips);

/// No more than this many transitions of a machine are taken at one instant; then it stays where it is until the next
/// instant, which is reported (`GraphPlayer::stops`).
inline constexpr std::size_t most_transitions_at_once = 32;

/// No more than this many poses of a machine fade into each other; a further change settles instead.
inline constexpr std::size_t most_fades_at_once = 8;

inline constexpr std::size_t most_blended = 32;

class Graph {
 public:
  /// @throws std::invalid_argument listing all faults.
  Graph(std::shared_ptr<const Hierarchy> nodes, std::shared_ptr<const std::vector<Clip>> clips,
        GraphDescription description);
  ~Graph();
  Graph(const Graph&) = delete;
  Graph& operator=(const Graph&) = delete;

  [[nodiscard]] const GraphDescription& description() const noexcept { return description_; }
  [[nodiscard]] const Hierarchy& nodes() const noexcept { return *nodes_; }
  [[nodiscard]] std::span<const Clip> clips() const noexcept { return *clips_; }

  /// Whether some clip of the graph has a track for the node's position, rotation or scale, or an operation moves it.
  [[nodiscard]] bool moves(std::size_t node) const noexcept;

  struct Compiled;  ///< private to the library
  [[nodiscard]] const Compiled& compiled() const noexcept { return *compiled_; }

 private:
  std::shared_ptr<const Hierarchy> nodes_;
  std::shared_ptr<const std::vector<Clip>> clips_;
  GraphDescription description_;
  std::unique_ptr<const Compiled> compiled_;
};

}  // namespace tweenfall
