#pragma once

// Everything that changes while a stage runs, in one copyable value: a stage goes back by assigning an older one.

#include <tweenfall/physics/stage/stage.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <variant>
#include <vector>

namespace tweenfall {

inline constexpr std::size_t no_body = static_cast<std::size_t>(-1);
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where a motion has the point that is `center` in its own coordinates.
[[nodiscard]] inline Vec3 center_of(const Motion& motion, const Vec3& center) {
  return motion.pose.position + motion.pose.rotation * center;
}

struct StagedBody {
  NodeId node = no_node;
  BodyId id = {};
  Path path;
  double released_at = 0;  ///< stage time at which it last left its path
  WorldMotion shown = {};  ///< the path at that time; its scale and shear stay on the free body
  bool present = true;
};

/// One rule waiting on one body.
struct ArmedRule {
  std::size_t body = no_body;
  std::size_t rule = 0;
  std::vector<char> latched;  ///< for `all`: by trigger, whether its instant has come
  bool done = false;
  bool was_true = false;  ///< for a rule that fires again: it must have been false in between
};

/// What happened during a step, to be told when the stage's time gets there.
struct Happening {
  double time = 0;
  std::variant<StageEvent, HandOff> what;
};

struct StageState {
  double time = 0;
  std::int64_t steps = -1;  ///< whole steps taken; -1 before the instant 0 has been handled
  World world;
  std::shared_ptr<const Hierarchy> nodes;
  std::shared_ptr<const Animation> animation;
  std::shared_ptr<const std::vector<Clip>> jumps;  ///< see clip_jumps
  std::vector<char> present;                       ///< by node
  std::vector<std::optional<Color>> colors;        ///< by node, where none is animated
  std::vector<StagedBody> bodies;
  std::vector<std::size_t> body_of;  ///< by node; `no_body` for none
  std::vector<NodeId> node_of;       ///< by index of the world's body
  std::vector<Rule> rules;
  std::vector<ArmedRule> armed;  ///< by body, then by rule
  bool jumped = true;            ///< some path may have jumped at `time`: keyed bodies are put on it before going on

  [[nodiscard]] StagedBody* body(NodeId node) {
    return node < body_of.size() && body_of[node] != no_body ? &bodies[body_of[node]] : nullptr;
  }
  [[nodiscard]] const StagedBody* body(NodeId node) const { return const_cast<StageState*>(this)->body(node); }
};

/// A change made by the caller, at an exact time.
struct Command {
  double time = 0;
  std::function<void(StageState&, std::vector<Happening>&)> run;
};

// cast.cpp: who is on the stage
[[nodiscard]] StageState initial_state(const StageDescription& description);
NodeId add_node(StageState& state, const NodeDescription& node);
void remove_node(StageState& state, NodeId node);
void arm_rule(StageState& state, const Rule& rule);

// ownership.cpp: who moves a body
void change_owner(StageState& state, std::size_t body, const Drive& to, Cause cause, const TakeOver& take_over,
                  const HandBack& hand_back, double step, std::vector<Happening>& happenings);

// triggers.cpp: when that changes
/// The first moment in (from, to] at which something may trigger or jump; `to` when there is none.
[[nodiscard]] double next_instant(const StageState& state, double from, double to);
/// Fires the rules whose triggers lie in (from, state.time]; contact triggers are pulled by latching them before.
void fire_rules(StageState& state, double from, double step, std::vector<Happening>& happenings);
/// Whether an impulse of this size and approach speed from `other` pulls the trigger.
[[nodiscard]] bool struck(const when::ContactHit& hit, double impulse, double speed, std::string_view other);

// step.cpp: one fixed step
/// Takes `state` to the end of its next step, split where it must be; every state at a split goes to `splits`.
void take_step(StageState& state, double step, std::span<const Command> commands, std::vector<StageState>& splits,
               std::vector<Happening>& happenings);

// jumps.cpp: where paths are not continuous
/// For each clip one without tracks, whose events are the moments at which its poses jump.
[[nodiscard]] std::shared_ptr<const std::vector<Clip>> clip_jumps(std::span<const Clip> clips);
/// First stage time in (from, to] at which `animation` may jump; infinity for none.
[[nodiscard]] double next_jump(const StageState& state, const Animation& animation, double from, double to);

// reading.cpp: what a stage shows
/// World motion of a body between two states that follow each other without a split.
[[nodiscard]] WorldMotion body_world(const StageState& from, const StageState& to, std::size_t body, double time);
[[nodiscard]] Twist body_twist(const StageState& from, const StageState& to, std::size_t body, double time);
void stage_world(const StageState& from, const StageState& to, double time, std::span<WorldMotion> out);
[[nodiscard]] WorldMotion node_world(const StageState& from, const StageState& to, NodeId node, double time);

}  // namespace tweenfall
