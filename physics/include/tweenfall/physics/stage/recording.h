#pragma once

/// What a stage showed, frame by frame: the one source of all pictures and files.

#include <tweenfall/physics/stage/detail.h>
#include <tweenfall/physics/stage/stage.h>

#include <optional>
#include <string>
#include <vector>

namespace tweenfall {

/// One node through all frames.
struct NodeRecord {
  std::string name;
  std::size_t parent = no_node;
  std::vector<WorldMotion> world;            ///< one per frame
  std::vector<Twist> twist;                  ///< at the center of mass, world axes; one per frame
  std::vector<Owner> owner;                  ///< one per frame
  std::vector<Color> color;                  ///< one per frame, or empty
  std::vector<std::vector<double>> weights;  ///< morph weights, one list per frame, or empty
};

/// One joint through all frames.
struct JointRecord {
  std::string name;
  NodeId a = no_node, b = no_node;                   ///< `no_node`: the world
  std::vector<std::optional<JointReading>> reading;  ///< one per frame; empty before the joint exists and after it
};

/// A graph through all frames: its parameters, and the states it passed through.
struct GraphRecord {
  struct Parameter {
    std::string name;
    std::vector<double> value;  ///< as the poses see it; one per frame
  };
  struct Passage {
    double time;
    std::size_t state;
    std::string how;  ///< such as "fade 0.2 s", with "speed > 0.1" as `when`; empty for the state it starts in
    std::string when;
  };
  struct Machine {
    std::string name;
    std::vector<std::string> states;
    std::vector<Passage> passages;  ///< in order of time
    std::vector<double> weight;     ///< of each state in turn, frame by frame; the weights of a frame sum to 1
    std::vector<char> is_settling;  ///< one per frame: whether a difference to the pose before is still dying away
  };
  std::string name;
  std::vector<Parameter> parameters;
  std::vector<Machine> machines;
};

/// A user track through all frames, as plays and graphs mix it.
struct UserTrackRecord {
  std::string name;              ///< "node.property"
  std::vector<UserValue> value;  ///< one per frame, all of one kind
};

/// One soft body of the stage's description through all frames.
struct SoftRecord {
  std::string name;
  std::vector<std::vector<Vec3>> positions;  ///< of its nodes, world, m; one list per frame
  std::vector<std::size_t> torn_at;          ///< by edge: the first frame that shows it torn; times.size() for never
};

/// One vehicle of the stage's description through all frames.
struct VehicleRecord {
  std::string name;
  std::size_t chassis = no_node;               ///< node
  std::vector<std::string> wheels;             ///< their names
  std::vector<std::vector<StageWheel>> frame;  ///< one list of wheels per frame
};

/// Particles of one kind through all frames.
struct ParticlesRecord {
  std::string name;
  double radius = 0;                  ///< m
  std::vector<StageParticles> frame;  ///< one per frame
};

/// Where a script jumps from one value to another, so that nobody draws a movement there. Of a body only while it
/// follows the stage's own clock.
struct JumpRecord {
  enum class Kind { motion, color, weights };
  double time;  ///< s
  NodeId node;
  Kind kind;
};

struct Recording {
  std::string name;
  std::vector<double> times;  ///< s
  std::vector<NodeRecord> nodes;
  std::vector<JointRecord> joints;  ///< in the description's order, then the added ones in theirs
  std::vector<GraphRecord> graphs;  ///< in the description's order
  std::vector<UserTrackRecord> user_tracks;
  std::vector<SoftRecord> softs;           ///< in the description's order
  std::vector<VehicleRecord> vehicles;     ///< likewise
  std::vector<ParticlesRecord> particles;  ///< likewise
  std::vector<StageEnergy> energy;         ///< one per frame, or empty
  std::vector<double> complementarity;     ///< of a stage with the solver `lcp`, one per frame; else empty
  std::vector<HandOff> handoffs;
  std::vector<StageEvent> events;
  std::vector<JumpRecord> jumps;     ///< in order of time, of each node the first of a kind in each frame
  std::vector<UnfiredRule> unfired;  ///< rules that waited to the end in vain
  std::vector<StageDetail> details;  ///< one per frame where they were asked for and there is room, or empty
};

/// Runs `stage` from its current time to `until`, taking a frame at the start, every 1/fps after it, and at `until`.
/// @param details  whether contacts, islands, boxes and sleep are recorded too; if they take more than `most_bytes`,
/// or 256 MiB, all of them are left out
/// @throws std::invalid_argument, saying how much it would be, for more than 20 million steps or `most_bytes`
///         of frames, and as soon as user tracks and particles take what is left of these or there are a million
///         events; NodeNotFinite, as the stage does
[[nodiscard]] Recording record(Stage& stage, double until, double fps, double most_bytes = 1024.0 * 1024 * 1024,
                               bool details = false);

/// The same while inputs are given, each at its time. @param inputs  in order of time
/// @throws std::invalid_argument for an input earlier than the stage's time or than the input before it, and as `give`
[[nodiscard]] Recording record(Stage& stage, double until, double fps, double most_bytes, bool details,
                               std::span<const TimedInput> inputs);

/// Advances a stage to `until`, giving it the inputs that are due by then. @return the inputs that are still to come
/// @throws as `record`
std::span<const TimedInput> advance_with(Stage& stage, std::span<const TimedInput> inputs, double until);

/// A time by which the stage has shown everything: the end of its plays or its last timed hand-off, plus a while for
/// bodies to come to rest; it counts 4 s for anything that has no end or
/// lasts longer than an hour, and is 600 s at most. Plays of clips that do not exist do not count.
[[nodiscard]] double natural_length(const StageDescription& description);

}  // namespace tweenfall
