#pragma once

// What happened to a graph: its inputs, and what followed from them.

#include <tweenfall/anim/graph.h>
#include <tweenfall/anim/graph_player.h>
#include <tweenfall/anim/jiggle.h>
#include <tweenfall/curves/pose.h>

#include "graph/recent_poses.h"
#include "graph/record.h"
#include "graph/trail.h"
#include "limbs/reach_state.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace tweenfall::graphs {

/// Bound on parameters: beyond it, the values and rates that follow them might not be finite.
inline constexpr double largest_parameter = 1e15;

/// Changes that take less than this, s, happen at once: they would be invisible, with rates too large.
inline constexpr double shortest_change = 1e-9;

/// Where an input came from.
enum class Origin {
  description,  // known in advance
  outside,
  event,  // a reaction to an event of a clip: it follows from the others
};

/// A parameter was set. Poses see `value` plus an offset that decays.
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

/// The difference of a node's motion from that of the new state, when the state was entered.
struct Offset {
  Vec3 position{0, 0, 0}, velocity{0, 0, 0};  // of a dead blend: of the node itself
  Vec3 turn{0, 0, 0}, turn_rate{0, 0, 0};     // rotation vector
  Vec3 scale{0, 0, 0}, scale_rate{0, 0, 0};   // of a dead blend: of the node itself
};

struct Passage : GraphPassage {
  GraphChange change = {};
  // One per node for recent passages that settle; else null. Discarded ones can be computed again from the inputs.
  std::shared_ptr<const std::vector<Offset>> offsets = {};
  std::uint64_t trace = 0;  // a hash of the offsets, whether they are kept or not
};

/// How far phases have come; see `Phase`.
struct PhasePlace {
  double phase = 0;
  double haste = 0;  // how much faster it advances than its weights say, as a share of that
};
using PhaseTrails = Trails<PhasePlace, 256>;

/// The last phases asked for: the clips of a space share them.
class KnownPhases {
 public:
  struct Question {
    double time = -1;  // below 0: none
    double start = 0;
    double seen = 0;  // what happens later is hidden
    Side side = Side::out;

    bool operator==(const Question&) const = default;
  };
  [[nodiscard]] const Sample<double>* recall(const Question& question) const noexcept {
    const auto found = std::ranges::find(known_, question, &Known::question);
    return found == known_.end() ? nullptr : &found->phase;
  }
  const Sample<double>& remember(const Question& question, const Sample<double>& phase) noexcept {
    Known& known = known_[next_];
    next_ = (next_ + 1) % known_.size();
    known = {question, phase};
    return known.phase;
  }
  void forget_from(double time) noexcept {
    for (Known& known : known_)
      if (known.question.time >= time) known.question.time = -1;
  }

 private:
  struct Known {
    Question question;
    Sample<double> phase{};
  };
  std::array<Known, 8> known_{};
  std::size_t next_ = 0;
};

/// How far springs have come on the clock that began at an instant; see `Swing`.
using SwingState = std::variant<NodeSpringState, JiggleState, ReachState>;
struct SwingMark {
  double instant = -1, time = -1;  // s; below 0: nothing is marked
  SwingState state{};
};
/// How far the base of springs was searched for its first jump after an instant.
struct JumpMark {
  double instant = -1;                                    // s; below 0: none
  double searched = 0;                                    // s
  double jump = std::numeric_limits<double>::infinity();  // up to there; infinity for none
};
/// The springs of one operation since the state around it was entered.
struct SwingCourse {
  double start = -1;
  std::size_t asked = 0;  // when it was used last: the least recently used one is replaced
  std::array<SwingMark, 4> latest{};
  std::size_t oldest = 0;               // index of the oldest of `latest`
  std::array<SwingMark, 16> markers{};  // each `gap` seconds or more after the one before, the first `marked` of them
  std::size_t marked = 0;
  double gap = 0.5;
  std::array<JumpMark, 8> jumps{};
  std::size_t next_jump = 0;  // index of the one replaced next
};
struct SwingMemory {
  std::array<SwingCourse, 4> courses{};
  std::size_t asked = 0;
  bool prepared = false;  // the states of all marks have their size
};

/// How far a figure has travelled; see `Travel`.
struct TravelPlace {
  Pose pose;
  Twist haste;  // how much faster it moves than the clips, in its own axes
  // While weights are constant, the way repeats itself: since when, s (below 0: not now), after how long, and from
  // where.
  double since = -1, lap = 0;
  Pose base;
};
using TravelTrails = Trails<TravelPlace, 64>;

/// The sizes of what a log remembers.
struct LogSizes {
  std::size_t nodes = 0, machines = 0, phases = 0, swings = 0, travels = 0, recent = 0;
};

struct Log {
  std::vector<Record<Setting>> settings;  // by parameter, in order of time
  Record<Sending> sent;                   // in order of time
  std::vector<Record<Passage>> passages;  // by machine, in order of time
  std::vector<GraphStop> stops;
  Record<double> instants;  // s; times at which something may have happened without an input, in order
  /// By phase of the graph: points to continue from, so that not everything is computed again. A cache only.
  mutable std::vector<PhaseTrails> phases;
  mutable std::vector<KnownPhases> known_phases;  // by phase of the graph. A cache only.
  /// By operation with springs: points to continue from. A cache only.
  mutable std::vector<SwingMemory> swings;
  /// By operation that accumulates root motion: points to continue from. A cache only.
  mutable std::vector<TravelTrails> travels;
  /// By operation that is used several times: its recent poses. A cache only.
  mutable std::vector<RecentPoses> recent;
  /// Later inputs are not seen: poses continue as if nothing happened. Springs look a little ahead in this way.
  mutable double until = std::numeric_limits<double>::infinity();
  bool keeps_all = false;      // offsets of all passages, not only of the latest
  mutable bool lacks = false;  // a pose was requested whose offsets were discarded
  double known = -1;           // everything up to and including this time is computed; below 0: nothing is
};

/// Hides everything after an instant while looking ahead; what is hidden already stays so.
class Blinkers {
 public:
  Blinkers(const Log& log, double until) noexcept : log_(log), before_(log.until) {
    log.until = std::min(before_, until);
  }
  ~Blinkers() { log_.until = before_; }
  Blinkers(const Blinkers&) = delete;
  Blinkers& operator=(const Blinkers&) = delete;

 private:
  const Log& log_;
  double before_;
};

/// The time at which the log is read for a pose at a time.
struct Sight {
  double time;
  Side side;
};
[[nodiscard]] inline Sight seen(const Log& log, double time, Side side) noexcept {
  return time > log.until ? Sight{log.until, Side::out} : Sight{time, side};
}

/// The latest instant after `start` and before `time` (or at it, for `Side::out`) at which there was an input or a
/// machine passed to another state; `start` where there is none.
[[nodiscard]] double last_instant(const Log& log, double start, double time, Side side) noexcept;
/// The first such instant after a time, hidden or not; infinity where there is none.
[[nodiscard]] double next_instant(const Log& log, double after) noexcept;
/// The last time before the first one that is hidden: up to there, everything is as it will be.
[[nodiscard]] double last_sure(const Log& log) noexcept;

/// A log with only the inputs of the description.
[[nodiscard]] Log fresh_log(const GraphDescription& description, const LogSizes& sizes);

/// Discards the offsets of all but the last few hundred passages. @param all also those discarded before
void let_go(Record<Passage>& passages, bool all);

/// Adds an input in order of time, after existing ones of the same time.
void set(Log& log, const GraphDescription& description, std::size_t parameter, double time, double value,
         Origin origin);
void send(Log& log, double time, std::string_view event, Origin origin);

/// Forgets cached progress beyond `time`, at which something happens: it is computed again.
void forget_marks(const Log& log, double time) noexcept;

/// Forgets the consequences of everything at `time` or later.
void forget_course(Log& log, const GraphDescription& description, double time);
/// The same, and also the outside inputs after `time`.
void forget_after(Log& log, const GraphDescription& description, double time);

/// The value that a parameter was set to.
[[nodiscard]] double value_of(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
                              Side side) noexcept;
/// The value that poses see.
[[nodiscard]] Sample<double> sample_of(const Log& log, const GraphDescription& description, std::size_t parameter,
                                       double time, Side side) noexcept;
/// Whether a curve may change its value from a time on, before `first_change`: not before the first key that it waits
/// for, nor after the last one that it holds.
[[nodiscard]] bool changes(const Curve<double>& curve, double time) noexcept;
/// After how many seconds a curve comes around, again and again; infinity where it does not.
[[nodiscard]] double round_of(const Curve<double>& curve) noexcept;
/// When a curve that waits for its first key after a time begins to change; infinity for none.
[[nodiscard]] double first_change(const Curve<double>& curve, double after) noexcept;

/// Whether that may change from a time until the next setting: its keys do, or it has not come to what was set.
[[nodiscard]] bool flows(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
                         Side side) noexcept;

}  // namespace tweenfall::graphs
