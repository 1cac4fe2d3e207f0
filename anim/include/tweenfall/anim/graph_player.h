#pragma once

/// A graph being played: what came from outside, and when, is its whole state.
///
/// Which transitions were taken, and at which exact instants, follows from that log alone, whatever the steps in which
/// time went on; so does the pose at any time, value and rate, forwards and back, bit for bit.
///
/// At one instant all parameters that are set hold first; then the events of the instant are told, those of clips
/// before those that were sent, each in order, and each may lead a machine through one transition. An event that leads
/// nowhere is lost. What the description has the graph do on events of clips is done before either.
///
/// All that came in and was passed is kept, so that it can go back: some 150 bytes each. Transitions that settle keep
/// 144 bytes for each node besides, the last 256 to 320 of each machine: whoever goes back further waits, the first
/// time, until all has been passed again from the start, with the same bits.

#include <tweenfall/anim/graph.h>
#include <tweenfall/anim/node_look.h>
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

/// A state that a machine came to.
struct GraphPassage {
  double time = 0;                         ///< s, since the graph began
  std::size_t state = 0;                   ///< by number in the machine
  std::size_t transition = no_transition;  ///< by which it came there
  bool settles = false;                    ///< the difference to what was shown dies away; else both fade
  static constexpr std::size_t no_transition = static_cast<std::size_t>(-1);

  bool operator==(const GraphPassage&) const = default;
};

/// A state that shows, and how much of it.
struct GraphActivity {
  std::size_t state = 0;
  double since = 0;                ///< s
  Sample<double> weight{1, 0, 0};  ///< of all in the machine together 1, but for rounding
  double settling = 0;             ///< s since what was before began to die away; 0 where nothing does
};

/// An event of a clip that shows.
struct GraphEvent {
  double time = 0;  ///< s, since the graph began
  std::string name;
  std::string data;
  std::size_t clip = 0;
  using Kind = EventKind;
  Kind kind = Kind::moment;
  double weight = 1;  ///< how much of its clip shows then, above 0, as far as blends and layers say
};

/// A machine that was stopped for taking `most_transitions_at_once`.
struct GraphStop {
  double time = 0;
  std::size_t machine = 0;

  bool operator==(const GraphStop&) const = default;
};

/// Writes what lies below a graph at a time: one motion per node, in order. Must not throw.
using PoseBelow = std::function<void(double time, Side side, std::span<Motion> out)>;

/// What a graph lies on.
struct GraphGround {
  PoseBelow pose{};  ///< none: the nodes at rest
  /// The first time in (after, until] at which an event of that name happens below, its beginning for an interval;
  /// none: nothing happens there.
  std::function<std::optional<double>(std::string_view name, double after, double until)> next_event{};
  /// What a node looks like there; none: nothing is animated.
  std::function<NodeLook(std::size_t node, double time, Side side)> look{};
};

class GraphPlayer {
 public:
  /// Stands at 0. The description's inputs are given; further ones come by `set` and `send`.
  explicit GraphPlayer(std::shared_ptr<const Graph> graph, GraphGround ground = {});
  /// Another with the same past, on a ground that may be another one from a time on.
  GraphPlayer(const GraphPlayer& other, GraphGround ground, double from);
  ~GraphPlayer();
  GraphPlayer(GraphPlayer&&) noexcept;
  GraphPlayer& operator=(GraphPlayer&&) noexcept;

  // Input, at `time()`: whatever was put in for later times is forgotten, but for what the description gives.
  /// @throws std::invalid_argument with the nearest name, for a parameter that has a curve, or a value not finite
  void set(std::string_view parameter, double value);
  /// @throws std::invalid_argument with the nearest name, for an event for which no machine waits
  void send(std::string_view event);
  [[nodiscard]] std::vector<GraphInput> inputs() const;  ///< all that came in, in order of time
  /// Those of them that the description did not give.
  [[nodiscard]] std::vector<GraphInput> own_inputs() const;

  // Time
  /// @throws std::invalid_argument when dt is negative or not finite
  void advance(double dt);
  /// Any time >= 0. @throws std::invalid_argument for others
  void seek(double time);
  [[nodiscard]] double time() const noexcept;

  // Reading
  /// Local motion of every node at `time()`. @param local  written, one per node, in order. Allocates nothing,
  /// but where it was gone far back.
  void pose(std::span<Motion> local, Side side = Side::out) noexcept;
  /// The same at any time, which makes it known what happens until then.
  void pose_at(double time, std::span<Motion> local, Side side = Side::out);
  /// Color and morph weights of a node, at any time: the mean of what the clips that show have, by how much of each
  /// there is. Operations do not change them; where a machine settles, they fade.
  [[nodiscard]] NodeLook look_at(std::size_t node, double time, Side side = Side::out);
  /// What poses see of a parameter. @throws std::invalid_argument with the nearest name
  [[nodiscard]] Sample<double> parameter(std::string_view name) const;
  /// Events of clips that show, in (from, to], in order; with an event at 0 where `from` is below 0.
  /// @throws std::length_error where a tiny loop makes more than a million of them.
  [[nodiscard]] std::vector<GraphEvent> events(double from, double to);

  /// The first of a name in (from, to], ends of intervals left out.
  [[nodiscard]] std::optional<double> first_event(std::string_view name, double from, double to);

  /// The first time in (from, to] at which something came in, a machine passed to another state, or what shows jumps: a
  /// clip where its loop begins anew or its tracks jump, a number where its keys do. Not where a way that accumulates
  /// takes the pose over the seam of a loop.
  [[nodiscard]] std::optional<double> first_instant(double from, double to);

  // Looking inside. Machines are counted as they stand among the graph's poses, from 0.
  [[nodiscard]] std::size_t machines() const noexcept;
  /// Name of the pose that a machine is.
  [[nodiscard]] const std::string& machine_name(std::size_t machine) const;
  /// What shows of a machine at `time()`, the latest last.
  [[nodiscard]] std::vector<GraphActivity> activity(std::size_t machine) const;
  /// All it passed until `time()`, its start included.
  [[nodiscard]] std::vector<GraphPassage> passages(std::size_t machine) const;
  [[nodiscard]] std::vector<GraphStop> stops() const;  ///< until `time()`

  // Keeping it
  /// All that came in, and the time, as bytes.
  [[nodiscard]] std::vector<std::byte> save() const;
  /// Becomes what was saved. @throws std::invalid_argument telling what is wrong with the bytes, or when they are of
  /// another graph; nothing has changed then
  void load(std::span<const std::byte> saved);
  /// A number that changes with anything that came in or was passed until `time()`.
  [[nodiscard]] std::uint64_t hash() const noexcept;

  [[nodiscard]] const Graph& graph() const noexcept { return *graph_; }

 private:
  void know(double time);
  void recall();
  void lie_on(GraphGround ground);
  void evaluate(double time, std::span<Motion> local, Side side) noexcept;

  struct Run;
  std::shared_ptr<const Graph> graph_;
  std::unique_ptr<Run> run_;
};

}  // namespace tweenfall
