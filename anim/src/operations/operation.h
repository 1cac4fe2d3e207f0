#pragma once

// One operation of a graph: makes a pose from poses.

#include <tweenfall/anim/graph.h>
#include <tweenfall/anim/graph_player.h>

#include "graph/log.h"
#include "pose/bound_clip.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace tweenfall::graphs {

/// The moment of a pose.
struct Moment {
  double time;
  Side side;
  double start;  // when the state around it was entered, or the graph began
};

/// Scratch poses, and the pose below the graph.
struct Scratch {
  std::span<const Motion> below;
  Motion* free;
  const GraphGround* ground;  // what lies below at any time

  [[nodiscard]] std::span<Motion> pose() const noexcept { return {free, below.size()}; }
  [[nodiscard]] Scratch rest() const noexcept { return {below, free + below.size(), ground}; }
};

/// A stretch of time in which a pose shows; what happens at `from` itself counts only if `from` is `start`.
struct Stretch {
  double from, to, start;
};

/// A search for the first time in (after, until] of something. It may continue one that began at `since`, which found
/// nothing up to `after`: then both together find what one would.
struct Search {
  double since, after, until;

  [[nodiscard]] Search up_to(double time) const noexcept { return {since, after, time}; }
  [[nodiscard]] Search from(double time) const noexcept {
    return {std::max(since, time), std::max(after, time), until};
  }
};

class Operation;

/// A clip that shows, with its weight, whose root motion moves a figure.
struct Bearer {
  const Operation* operation;
  std::size_t clip;  // index among the clips of the operation
  double start;      // of the state around it
  Sample<double> weight;
  bool added = false;  // a layer adds it, on top of shares that sum to 1

  [[nodiscard]] bool is(const Bearer& other) const noexcept {
    return operation == other.operation && clip == other.clip && start == other.start;
  }
};
/// Steps that follow weights whose keys come around: fewer would see the same part of each round.
inline constexpr double steps_per_round = 8;

/// The clips that show at a time; the weight missing to 1 stands still.
struct Bearers {
  static constexpr std::size_t most = 64;
  std::array<Bearer, most> list;
  std::size_t count = 0;
  bool flow = false;                                             // their weights may change without an input
  double flow_from = std::numeric_limits<double>::infinity();    // s; when they do later, if they do not now
  double flow_since = -std::numeric_limits<double>::infinity();  // s; when that began last
  double round = std::numeric_limits<double>::infinity();        // s; the shortest after which their keys come around
  bool adds = false;    // layers that add count, too, and their references as much below 0
  bool adding = false;  // what comes now is of such a layer

  /// Adds whether a weight changes without an input.
  /// @param weight  a number, or several at once
  template <class Weight>
  void note(const Log& log, const Weight& weight, const Moment& moment) noexcept {
    flow = flow || weight.flows(log, moment.time, moment.side);
    flow_from = std::min(flow_from, weight.first_change(moment.time));
    flow_since = std::max(flow_since, weight.last_change(log, moment.time));
    round = std::min(round, weight.round());
  }
  [[nodiscard]] const Bearer* find(const Bearer& wanted) const noexcept {
    for (std::size_t i = 0; i < count; ++i)
      if (list[i].is(wanted)) return &list[i];
    return nullptr;
  }
  /// Adds a clip; one that shows in several places is listed once, with all its weight.
  void add(const Bearer& bearer) noexcept {
    for (std::size_t i = 0; i < count; ++i) {
      if (!list[i].is(bearer) || list[i].added != adding) continue;
      list[i].weight.value += bearer.weight.value;
      list[i].weight.rate += bearer.weight.rate;
      return;
    }
    if (count == most) return;
    list[count] = bearer;
    list[count++].added = adding;
  }
};

class Operation {
 public:
  Operation() = default;
  Operation(const Operation&) = delete;
  Operation& operator=(const Operation&) = delete;
  virtual ~Operation() = default;

  /// Writes the motions of all nodes.
  virtual void pose(const Log& log, const Moment& moment, const Scratch& scratch,
                    std::span<Motion> out) const noexcept = 0;

  /// Whether it remembers the pose; if so, writes it.
  [[nodiscard]] virtual bool recall(const Log&, const Moment&, std::span<Motion>) const noexcept { return false; }

  /// The poses that it uses.
  [[nodiscard]] virtual std::span<const Operation* const> operands() const noexcept { return {}; }

  /// The weight of an operand, given by its index among them.
  [[nodiscard]] virtual double share(const Log&, std::size_t, double) const noexcept { return 1; }

  /// Appends the events of the clips that show, in any order.
  virtual void events(const Log& log, const Stretch& stretch, std::vector<GraphEvent>& out) const;

  /// The first time in (after, until] at which an event of that name happens in a clip, shown or not.
  [[nodiscard]] virtual std::optional<double> next_event(const Log& log, std::string_view name, double start,
                                                         double after, double until) const;

  /// The first time at which a clip in it, shown or not, makes its pose jump: where its loop restarts, or its tracks
  /// jump.
  [[nodiscard]] virtual std::optional<double> next_jump(const Log& log, double start, const Search& search) const;

  /// When all clips have ended; 0 where there are none.
  [[nodiscard]] virtual double end(const Log& log, double start) const noexcept;

  /// Adds the clips whose root motion moves a node, by their weights. None: it stands still.
  /// @param weight  of the operation
  virtual void bearers(const Log&, const Moment&, std::size_t /*node*/, const Sample<double>& /*weight*/,
                       Bearers& /*out*/) const noexcept {}
  /// Its own clips, and the clock of each.
  [[nodiscard]] virtual std::vector<const pose::BoundClip*> own_clips() const { return {}; }
  [[nodiscard]] virtual ClipClock clock_of(const Log&, std::size_t /*clip*/, const Moment&) const noexcept {
    return {};
  }
  /// The time in which the clock of a clip goes around once if nothing happens from then on, s; 0 where it stands
  /// still, infinity where it does not go around.
  [[nodiscard]] virtual double round_of(const Log&, std::size_t /*clip*/, const Moment&) const noexcept {
    return std::numeric_limits<double>::infinity();
  }

  /// Number of scratch poses that it needs, including its operands.
  [[nodiscard]] std::size_t rooms() const noexcept { return rooms_; }
  void set_rooms(std::size_t rooms) noexcept { rooms_ = rooms; }

 private:
  std::size_t rooms_ = 0;
};

class Binder;
class Account;

// One file each: makes the operation, and its description.
[[nodiscard]] std::unique_ptr<Operation> bound(const ClipPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const RestPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const BlendPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const LayersPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const SpacePose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const MachinePose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const TwoBonePose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const LookAtPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const ReachPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const FeetPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const MirrorPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const RetargetPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const RootMotionPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const SpringPose& pose, Binder& binder);
[[nodiscard]] std::unique_ptr<Operation> bound(const JigglePose& pose, Binder& binder);
void tell(const ClipPose& pose, Account& account);
void tell(const RestPose& pose, Account& account);
void tell(const BlendPose& pose, Account& account);
void tell(const LayersPose& pose, Account& account);
void tell(const SpacePose& pose, Account& account);
void tell(const MachinePose& pose, Account& account);
void tell(const TwoBonePose& pose, Account& account);
void tell(const LookAtPose& pose, Account& account);
void tell(const ReachPose& pose, Account& account);
void tell(const FeetPose& pose, Account& account);
void tell(const MirrorPose& pose, Account& account);
void tell(const RetargetPose& pose, Account& account);
void tell(const RootMotionPose& pose, Account& account);
void tell(const SpringPose& pose, Account& account);
void tell(const JigglePose& pose, Account& account);

}  // namespace tweenfall::graphs
