#pragma once

// What happened to a graph: what came in from outside, and what followed from it.

#include <tweenfall/anim/graph.h>
#include <tweenfall/anim/graph_player.h>
#include <tweenfall/anim/jiggle.h>
#include <tweenfall/curves/pose.h>

#include "graph/recent_poses.h"
#include "graph/record.h"
#include "graph/trail.h"

#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tweenfall::graphs {

/// What a parameter may be: beyond it, what follows it could be at no finite place or speed.
inline constexpr double largest_parameter = 1e15;

/// What takes less than this, s, is done at once: nothing of it is seen, and nothing could be as fast.
inline constexpr double shortest_change = 1e-9;

/// Where something that came in came from.
enum class Origin {
  description,  // known beforehand
  outside,
  event,  // of a clip, to which the graph reacts: it follows from the others
};

/// A parameter was set. Poses see `value`, and an offset to it that dies away.
struct Setting {
  double time = 0, value = 0;
  Origin origin = Origin::outside;
  double offset = 0, rate = 0;  // at `time`
};

struct Sending {
  double time = 0;
  std::string event;
  Origin origin = Origin::outside;
};

/// How far a node's motion was from where the new state has it, when that was entered.
struct Offset {
  Vec3 position{0, 0, 0}, velocity{0, 0, 0};  // of a dead blend: of the node itself
  Vec3 turn{0, 0, 0}, turn_rate{0, 0, 0};     // rotation vector
  Vec3 scale{0, 0, 0}, scale_rate{0, 0, 0};   // of a dead blend: of the node itself
};

struct Passage : GraphPassage {
  GraphChange change = {};
  // One per node, where the difference settles, and of late; else null. What was let go follows from the inputs again.
  std::shared_ptr<const std::vector<Offset>> offsets = {};
  std::uint64_t trace = 0;  // of the offsets, whether they are there or not
};

/// How far phases have come; see `Phase`.
struct PhasePlace {
  double phase = 0;
  double haste = 0;  // how much faster it goes on than by its weights, as a part of that
};
using PhaseTrails = Trails<PhasePlace, 256>;

/// How far springs have come, on the clock that began at an instant; see `Swing`.
using SwingState = std::variant<NodeSpringState, JiggleState>;
struct SwingMark {
  double instant = -1, time = -1;  // s; below 0: nothing is marked
  SwingState state{};
};
/// The springs of one operation since the state around it was entered.
struct SwingCourse {
  double start = -1;
  std::size_t asked = 0;  // when it was asked for last: the one that was longest ago makes room
  std::array<SwingMark, 4> latest{};
  std::size_t oldest = 0;               // of these
  std::array<SwingMark, 16> markers{};  // each `gap` seconds or more after the one before, the first `marked` of them
  std::size_t marked = 0;
  double gap = 0.5;
};
struct SwingMemory {
  std::array<SwingCourse, 4> courses{};
  std::size_t asked = 0;
  bool prepared = false;  // the states of all marks have their size
};

/// How far figures have come on their way; see `Travel`.
struct TravelPlace {
  Pose pose;
  Twist haste;  // by how much faster it goes on than the clips have it, in its own axes
};
using TravelTrails = Trails<TravelPlace, 64>;

/// How much there is of what a log remembers.
struct LogSizes {
  std::size_t nodes = 0, machines = 0, phases = 0, swings = 0, travels = 0, recent = 0;
};

struct Log {
  std::vector<Record<Setting>> settings;  // by parameter, in order of time
  Record<Sending> sent;                   // in order of time
  std::vector<Record<Passage>> passages;  // by machine, in order of time
  std::vector<GraphStop> stops;
  Record<double> instants;  // s, at which something may have happened of itself, in order
  /// By phase of the graph: where to go on from, so that not all its way is gone again. Says nothing new.
  mutable std::vector<PhaseTrails> phases;
  /// By operation with springs: where to go on from. Says nothing new.
  mutable std::vector<SwingMemory> swings;
  /// By operation that accumulates a way: where to go on from. Says nothing new.
  mutable std::vector<TravelTrails> travels;
  /// By operation that is asked for the same again and again. Says nothing new.
  mutable std::vector<RecentPoses> recent;
  /// What comes later is not seen: poses go on as if nothing happened. Springs look a little ahead so.
  mutable double until = std::numeric_limits<double>::infinity();
  bool keeps_all = false;      // offsets of all passages, not only of the latest
  mutable bool lacks = false;  // a pose was asked for whose offsets were let go
  double known = -1;           // all that happens until then, and at that time, is known; below 0: nothing is
};

/// What comes after an instant is not seen while it is looked ahead.
class Blinkers {
 public:
  Blinkers(const Log& log, double until) noexcept : log_(log), before_(log.until) { log.until = until; }
  ~Blinkers() { log_.until = before_; }
  Blinkers(const Blinkers&) = delete;
  Blinkers& operator=(const Blinkers&) = delete;

 private:
  const Log& log_;
  double before_;
};

/// The time at which what happened is looked up for a pose at a time.
struct Sight {
  double time;
  Side side;
};
[[nodiscard]] inline Sight seen(const Log& log, double time, Side side) noexcept {
  return time > log.until ? Sight{log.until, Side::out} : Sight{time, side};
}

/// The latest instant after `start` and before `time` (at it too, where it leaves) at which something came in or a
/// machine passed to another state; `start` where there is none.
[[nodiscard]] double last_instant(const Log& log, double start, double time, Side side) noexcept;
/// The first one after a time; infinity where there is none.
[[nodiscard]] double next_instant(const Log& log, double after) noexcept;

/// A log in which nothing has happened yet but what the description gives.
[[nodiscard]] Log fresh_log(const GraphDescription& description, const LogSizes& sizes);

/// Lets go of the offsets of passages but the last few hundred. @param all  also of those that had been let go before
void let_go(Record<Passage>& passages, bool all);

/// Puts it in, in order; of equal times behind those that are there.
void set(Log& log, const GraphDescription& description, std::size_t parameter, double time, double value,
         Origin origin);
void send(Log& log, double time, std::string_view event, Origin origin);

/// Forgets how far anything has come beyond `time`, at which something happens: it is found again.
void forget_marks(const Log& log, double time) noexcept;

/// Forgets what follows from anything at `time` or later.
void forget_course(Log& log, const GraphDescription& description, double time);
/// The same, and what came from outside after `time`.
void forget_after(Log& log, const GraphDescription& description, double time);

/// What a parameter was set to.
[[nodiscard]] double value_of(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
                              Side side) noexcept;
/// What poses see of it.
[[nodiscard]] Sample<double> sample_of(const Log& log, const GraphDescription& description, std::size_t parameter,
                                       double time, Side side) noexcept;

}  // namespace tweenfall::graphs
