#pragma once

// What happened to a graph: what came in from outside, and what followed from it.

#include <tweenfall/anim/graph.h>
#include <tweenfall/anim/graph_player.h>
#include <tweenfall/curves/pose.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::graphs {

/// A parameter was set. Poses see `value`, and an offset to it that dies away.
struct Setting {
  double time, value;
  bool given = false;           // by the description
  double offset = 0, rate = 0;  // at `time`
};

struct Sending {
  double time;
  std::string event;
  bool given = false;
};

/// How far a node's motion was from where the new state has it, when that was entered.
struct Offset {
  Vec3 position{0, 0, 0}, velocity{0, 0, 0};  // of a dead blend: of the node itself
  Vec3 turn{0, 0, 0}, turn_rate{0, 0, 0};     // rotation vector
  Vec3 scale{0, 0, 0}, scale_rate{0, 0, 0};   // of a dead blend: of the node itself
};

struct Passage : GraphPassage {
  GraphChange change = {};
  std::vector<Offset> offsets = {};  // one per node, where the difference settles
};

/// How far a phase has come; see `Phase`.
struct PhaseMark {
  static constexpr std::size_t kept = 4;
  double start = -1, time = -1, phase = 0;
};

struct Log {
  std::vector<std::vector<Setting>> settings;  // by parameter, in order of time
  std::vector<Sending> sent;                   // in order of time
  std::vector<std::vector<Passage>> passages;  // by machine, in order of time
  std::vector<GraphStop> stops;
  /// By phase of the graph: where to go on from, so that not all its way is gone again. Says nothing new.
  mutable std::vector<std::array<PhaseMark, PhaseMark::kept>> marks;
  double known = -1;  // all that happens until then, and at that time, is known; below 0: nothing is
};

/// A log in which nothing has happened yet but what the description gives.
[[nodiscard]] Log fresh_log(const GraphDescription& description, std::size_t machines, std::size_t phases);

/// Puts it in, in order; of equal times behind those that are there.
void set(Log& log, const GraphDescription& description, std::size_t parameter, double time, double value, bool given);
void send(Log& log, double time, std::string_view event, bool given);

/// Forgets what came in after `time` but was not given, and what follows from anything at `time` or later.
void forget_after(Log& log, const GraphDescription& description, double time);

/// What a parameter was set to.
[[nodiscard]] double value_of(const Log& log, const GraphDescription& description, std::size_t parameter, double time,
                              Side side) noexcept;
/// What poses see of it.
[[nodiscard]] Sample<double> sample_of(const Log& log, const GraphDescription& description, std::size_t parameter,
                                       double time, Side side) noexcept;

}  // namespace tweenfall::graphs
