#pragma once

/// A graph being played: its whole state is the log of its inputs and their times.
///
/// The log alone determines which transitions were taken, and at which exact instants, whatever the steps in which time
/// advanced; and so the pose at any time, value and rate, forwards and backwards, bit for bit.
///
/// At one instant, all parameters are set first; then the events of the instant are handled, those of clips before
/// those that were sent, each in order, and each may lead a machine through one transition. An event that triggers no
/// transition is lost. Reactions to events of clips (`GraphReaction`) come before all of this.
///
/// All inputs and passages are kept, so that time can go back: some 150 bytes each. Transitions that settle keep
/// another 144 bytes per node, for the last 256 to 320 of each machine: going back further takes longer the first time,
/// because everything is computed again from the start, with the same bits.

#include <tweenfall/anim/graph.h>
#include <tweenfall/anim/node_look.h>
#include <tweenfall/anim/user_value.h>
#include <tweenfall/curves/pose.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tweenfall {

/// The passage of a machine to a state.
struct GraphPassage {
  double time = 0;                         ///< s, since the graph began
  std::size_t state = 0;                   ///< by number in the machine
  std::size_t transition = no_transition;  ///< by which it came there; `no_transition` for the start
  bool settles = false;                    ///< the difference from the pose shown before decays; else both fade
  static constexpr std::size_t no_transition = static_cast<std::size_t>(-1);

  bool operator==(const GraphPassage&) const = default;
};

/// A state that shows, and its weight.
struct GraphActivity {
  std::size_t state = 0;
  double since = 0;                ///< s
  Sample<double> weight{1, 0, 0};  ///< those of one machine sum to 1, up to rounding
  double settling = 0;             ///< s since the difference from the pose before began to decay; 0 where none does
};

/// An event of a clip that shows.
struct GraphEvent {
  double time = 0;  ///< s, since the graph began
  std::string name;
  std::string data;
  std::size_t clip = 0;
  using Kind = EventKind;
  Kind kind = Kind::moment;
  double weight = 1;  ///< the weight of its clip then, above 0, from blends and layers
};

/// A machine that was stopped because it took `most_transitions_at_once`.
struct GraphStop {
  double time = 0;
  std::size_t machine = 0;

  bool operator==(const GraphStop&) const = default;
};

/// Writes the pose below a graph at a time: one motion per node, in order. Must not throw.
using PoseBelow = std::function<void(double time, Side side, std::span<Motion> out)>;

/// What lies below a graph.
struct GraphGround {
  PoseBelow pose{};  ///< none: the nodes at rest
  /// The first time in (after, until] at which an event of that name happens below, its beginning for an interval;
  /// none: nothing happens there.
  std::function<std::optional<double>(std::string_view name, double after, double until)> next_event{};
  /// Color and morph weights of a node there; none: nothing is animated.
  std::function<NodeLook(std::size_t node, double time, Side side)> look{};
  /// The value of a user track there; none: nothing has it.
  std::function<UserValue(std::string_view track, double time, Side side)> user_value{};
  /// The first time in (after, until] at which the pose there may jump, or was changed from outside; none: it never
  /// jumps. It may continue a search that began at `since` and found nothing up to `after`.
  std::function<std::optional<double>(double since, double after, double until)> next_jump{};
};

class GraphPlayer {
 public:
  /// Starts at time 0 with the inputs of the description; `set` and `send` add more.
  explicit GraphPlayer(std::shared_ptr<const Graph> graph, GraphGround ground = {});
  /// A copy with the same past, over a ground that may differ from the time `from` on.
  GraphPlayer(const GraphPlayer& other, GraphGround ground, double from);
  ~GraphPlayer();
  GraphPlayer(GraphPlayer&&) noexcept;
  GraphPlayer& operator=(GraphPlayer&&) noexcept;

  // Input, at `time()`: any later input is forgotten, except those of the description.
  /// @throws std::invalid_argument with the nearest name, for a parameter that has a curve, or a value not finite
  void set(std::string_view parameter, double value);
  /// @throws std::invalid_argument with the nearest name, for an event that no machine waits for
  void send(std::string_view event);
  [[nodiscard]] std::vector<GraphInput> inputs() const;  ///< all inputs, in order of time
  /// The inputs that are not from the description.
  [[nodiscard]] std::vector<GraphInput> own_inputs() const;

  // Time
  /// @throws std::invalid_argument when dt is negative or not finite
  void advance(double dt);
  /// Goes to any time >= 0. @throws std::invalid_argument for others
  void seek(double time);
  [[nodiscard]] double time() const noexcept;

  // Reading
  /// Local motion of every node at `time()`. @param local written, one per node, in order. Allocates nothing, except
  /// after going far back.
  void pose(std::span<Motion> local, Side side = Side::out) noexcept;
  /// The same at any time; computes what happens until then.
  void pose_at(double time, std::span<Motion> local, Side side = Side::out);
  /// Color and morph weights of a node, at any time: the mean over the clips that show, by their weights, and what
  /// layers add. Operations do not change them; where a machine settles, they fade.
  [[nodiscard]] NodeLook look_at(std::size_t node, double time, Side side = Side::out);
  /// The value of a user track, "node.property", at any time, mixed in the same way. Layers add numbers, vectors
  /// and colors (these number by number, alpha too), but no rotations, switches and texts.
  /// Clips without the track show what lies below, as at `Animation::user_value`.
  /// @throws std::invalid_argument with the nearest name
  [[nodiscard]] UserValue user_value_at(std::string_view track, double time, Side side = Side::out);
  /// The value of a parameter that poses see. @throws std::invalid_argument with the nearest name
  [[nodiscard]] Sample<double> parameter(std::string_view name) const;
  /// Events of clips that show, in (from, to], in order; an event at 0 is included if `from` is below 0.
  /// @throws std::length_error where a tiny loop makes more than a million events.
  [[nodiscard]] std::vector<GraphEvent> events(double from, double to);

  /// The first event of a name in (from, to], not counting ends of intervals.
  [[nodiscard]] std::optional<double> first_event(std::string_view name, double from, double to);

  /// The first time in (from, to] at which there was an input, a machine passed to another state, or the pose jumps:
  /// where the loop of a clip restarts, its tracks jump, or the keys of a number jump. The seam of a loop does not
  /// count where accumulated root motion carries the pose over it.
  [[nodiscard]] std::optional<double> first_instant(double from, double to);
  /// The same, and every seam counts, without a look at the pose; also what the ground tells.
  /// @param since  when the search began, if it found nothing up to `from`; none: it begins there
  [[nodiscard]] std::optional<double> first_possible_jump(double from, double to,
                                                          std::optional<double> since = std::nullopt);

  // Inspection. Machines are numbered from 0 in the order of the graph's poses.
  [[nodiscard]] std::size_t machines() const noexcept;
  /// Name of the pose that is the machine.
  [[nodiscard]] const std::string& machine_name(std::size_t machine) const;
  /// The states of a machine that show at `time()`, the latest last.
  [[nodiscard]] std::vector<GraphActivity> activity(std::size_t machine) const;
  /// All passages of a machine until `time()`, including its start.
  [[nodiscard]] std::vector<GraphPassage> passages(std::size_t machine) const;
  [[nodiscard]] std::vector<GraphStop> stops() const;  ///< until `time()`

  // Saving
  /// All inputs, and the time, as bytes.
  [[nodiscard]] std::vector<std::byte> save() const;
  /// Restores what was saved. @throws std::invalid_argument saying what is wrong with the bytes, or when they are of
  /// another graph; then nothing has changed
  void load(std::span<const std::byte> saved);
  /// A number that changes with any input or passage until `time()`.
  [[nodiscard]] std::uint64_t hash() const noexcept;

  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }

 private:
  void know(double time);
  void recall();
  void lie_on(GraphGround ground);
  [[nodiscard]] std::optional<double> instant(double since, double from, double to, bool looks);
  void evaluate(double time, std::span<Motion> local, Side side) noexcept;

  struct Run;
  std::shared_ptr<const Graph> graph_;
  std::unique_ptr<Run> run_;
};

}  // namespace tweenfall
