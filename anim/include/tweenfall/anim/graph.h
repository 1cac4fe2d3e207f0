#pragma once

/// A graph of poses: what a character shows, made from clips by operations that name each other, and by machines that
/// pass from one pose to another as parameters and events say.
///
/// `GraphDescription` is plain values, as a document says them or a program fills them in; `Graph` is the same made
/// fast, held against nodes and clips once. Neither has a state: what happened is a log (`graph_player.h`), from which
/// the pose at any time follows, value and rate.

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

/// A parameter: a number that comes from outside. Conditions look at what was set; poses see what follows it.
struct GraphParameter {
  std::string name;
  double start = 0;                      ///< until it is set
  double half_life = 0;                  ///< s; in which poses come half way to a value that was set; 0: at once
  std::optional<Curve<double>> curve{};  ///< its value over the graph's time; nobody then sets it
};

/// A track of the user's as a parameter's curve: from the graph's start on as its clip plays it, loops included.
/// @param track  "node.property", of numbers, or a switch, whose on is 1
/// @param clip   empty: the only one that has the track
/// @throws std::invalid_argument for a track or clip that is not there, with the nearest, or of another kind
[[nodiscard]] Curve<double> track_curve(std::span<const Clip> clips, std::string_view track,
                                        std::string_view clip = {});

// The operations. Where one asks for a pose, it is told the name of another of the graph, or of a clip.

/// A clip, from when the state that shows it was entered, or the graph began. What it does not drive is as below.
struct ClipPose {
  std::string clip;
  double at = 0;               ///< seconds until it starts
  double speed = 1;            ///< clip seconds per second; negative runs backwards from the end
  std::optional<Loop> loop{};  ///< absent: the clip's own
};

/// What lies below the graph: the plays, and where they do nothing the nodes at rest.
struct RestPose {};

/// Several poses at once, by weights of which only the ratios matter, as `blend` mixes them: where they sum to less
/// than `least_weight`, what lies below the graph shows through.
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
    bool adds = false;                ///< adds its difference to `reference` to what it lies on; else replaces that
    std::string reference = {};       ///< a pose; empty: what lies below the graph
    GraphNumber weight = 1.0;         ///< 0 to 1; what is beyond is taken as the nearer end
    std::vector<MaskPart> mask = {};  ///< none: all nodes
  };
  std::string base;  ///< empty: what lies below the graph
  std::vector<Layer> layers;
};

/// Poses at places along a line or on a plane, weighed by where one or two numbers are among them, as `BlendLine` and
/// `BlendPlane`, or `BlendBands`, do it.
struct SpacePose {
  struct Entry {
    std::string pose;
    Vec2 place{0, 0};  ///< along a line x alone
  };
  std::vector<GraphNumber> by;  ///< one or two
  std::vector<Entry> entries;   ///< `most_blended` at most
  /// For clips alone, which then loop in phase, as `MarkerSync` has it: a pattern of the events that are markers. None
  /// with these names: by the shares of their loops that lie behind.
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

/// How one state becomes another. Fades and settles may be interrupted at any time: what is shown goes on without a
/// jump in place or velocity, but for a cut and for eases that begin with a jerk.
struct GraphChange {
  enum class Kind {
    fade,        ///< both run, one fading into the other over `seconds`; 0: a cut
    quintic,     ///< the old one stops; the difference dies away within `seconds`, as `QuinticDecay`
    half_life,   ///< ... as `SpringDecay`, half of it gone after `seconds` from rest
    dead_blend,  ///< the old one goes straight on while it fades into the new one
  };
  Kind kind = Kind::fade;
  double seconds = 0.2;
  std::optional<Ease> ease{};  ///< of a fade, a shape; none: smooth, starting and ending without a jerk
};

struct GraphTransition {
  std::vector<std::string> from{};  ///< states; none: any but `to`
  std::string to;
  std::vector<GraphCondition> when{};  ///< all of them; none: at once
  GraphChange change = {};
};

/// States, one of which shows at a time, and how one becomes another. Every machine runs from the graph's start,
/// whether it is shown or not.
struct MachinePose {
  struct State {
    std::string name;
    std::string pose;
  };
  std::string start;  ///< a state
  std::vector<State> states;
  std::vector<GraphTransition> transitions;  ///< the first that may be taken is
};

/// Those that change a pose, which is the one that they name as their `base`, stand in headers of their own.
using PoseOperation =
    std::variant<ClipPose, RestPose, BlendPose, LayersPose, SpacePose, MachinePose, TwoBonePose, LookAtPose, ReachPose,
                 FeetPose, MirrorPose, RetargetPose, RootMotionPose, SpringPose, JigglePose>;

struct GraphPose {
  std::string name;
  PoseOperation operation;
};

/// What comes from outside: a parameter is set, or, without a value, an event is sent.
struct GraphInput {
  double time = 0;  ///< s, since the graph began
  std::string name;
  std::optional<double> value{};

  bool operator==(const GraphInput&) const = default;
};

/// What an event of a clip does, whether the clip shows in the graph or lies below it: it sets a parameter or, without
/// a value, sends another event, at its exact instant. However often it happens at one instant, it does so once.
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
  std::vector<GraphInput> inputs = {};  ///< those that are known beforehand
  std::vector<GraphReaction> reactions = {};
};

/// A pose or clip that an operation names, and for what, in a word or two.
struct GraphOperand {
  std::string pose;
  std::string role;
  bool clip = false;  ///< only clips are meant
};
[[nodiscard]] std::vector<GraphOperand> operands_of(const PoseOperation& operation);

/// All names by which poses mean clips, each once.
[[nodiscard]] std::vector<std::string> clips_named_in(const GraphDescription& description);

/// The events for which its machines wait, each once.
[[nodiscard]] std::vector<std::string> events_awaited(const GraphDescription& description);

/// For tools: `speed > 0.1 and event "jump"`, "at once"; "fade 0.2 s", "settle quintic 0.3 s", "cut"; "machine".
[[nodiscard]] std::string words_of(std::span<const GraphCondition> when);
[[nodiscard]] std::string words_of(const GraphChange& change);
[[nodiscard]] std::string words_of(const PoseOperation& operation);

/// A number that changes with anything that the description says.
[[nodiscard]] std::uint64_t fingerprint(const GraphDescription& description) noexcept;

/// Something for which a description makes no graph.
struct GraphFault {
  std::vector<std::string> place;  ///< "poses", "body", "machine", "transitions", "2", ...: names, and numbers from 0
  std::string message;
};

/// Holds a description against nodes and clips. @returns all that is wrong, by place; nothing where `Graph` takes it
[[nodiscard]] std::vector<GraphFault> inspect(const GraphDescription& description, const Hierarchy& nodes,
                                              std::span<const Clip> clips);

/// No more than this many transitions of a machine are taken at one instant; then it stays where it is until the next,
/// which is told (`GraphPlayer::stops`).
inline constexpr std::size_t most_transitions_at_once = 32;

/// No more than this many poses of a machine fade into each other; the change after that settles, over the same time.
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
