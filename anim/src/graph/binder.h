#pragma once

// Used while operations are made: finds the poses, clips, parameters and joints that they name, or reports them as
// missing.

#include "chains/problems.h"
#include "clip/formula_jumps.h"
#include "operations/number.h"
#include "operations/operation.h"
#include "pose/bound_clip.h"

#include <map>
#include <string>
#include <vector>

namespace tweenfall {

namespace graphs {

/// A clip as it is played: with a loop that may not be its own.
struct LoopedClip {
  std::size_t number;
  Clip clip;
  std::optional<pose::BoundClip> bound{};
  Clip jumps{};  // no tracks; its events mark the times at which the clip and its loop jump
  std::shared_ptr<const clips::FormulaJumps> formulas{};  // of an endless clip; null for none
};

}  // namespace graphs

struct Graph::Compiled {
  std::vector<std::unique_ptr<const graphs::Operation>> operations;
  std::vector<std::unique_ptr<graphs::LoopedClip>> clips;
  std::vector<const graphs::Operation*> machines;  // in the order of the poses
  std::vector<std::size_t> machine_poses;          // the pose of each machine
  const graphs::Operation* output = nullptr;
  std::size_t phases = 0;                            // operations whose clips run in phase
  std::size_t swings = 0;                            // operations with springs
  double looks_ahead = 0;                            // s; how far ahead springs look, each at what others make of it
  std::size_t travels = 0;                           // operations that accumulate root motion
  std::size_t recent = 0;                            // operations that remember their recent poses
  std::vector<char> moved;                           // by node: whether an operation moves it
  std::vector<Curve<double>> jumping;                // numbers over the graph's time that jump
  std::vector<std::optional<std::size_t>> reacting;  // by reaction: the parameter that it sets

  struct UserTrack {
    const Track* first;  // of that name in the clips
    std::size_t node;    // `no_node` where it is of no node
    bool shows;          // in a clip of the graph
  };
  std::map<std::string, UserTrack, std::less<>> user_tracks{};

  /// Whether some clip colors a node, or has its morph weights.
  [[nodiscard]] bool looks(std::size_t node) const noexcept {
    return std::ranges::any_of(clips, [&](const auto& clip) {
      const std::uint32_t entry = clip->bound->entry_of(node);
      if (entry == pose::BoundClip::no_entry) return false;
      return clip->bound->entries()[entry].has_color() || clip->bound->entries()[entry].weights;
    });
  }
  [[nodiscard]] graphs::LogSizes sizes() const noexcept {
    return {moved.size(), machines.size(), phases, swings, travels, recent};
  }
};

}  // namespace tweenfall

namespace tweenfall::graphs {

using Place = std::vector<std::string>;

class Binder {
 public:
  Binder(const GraphDescription& description, const Hierarchy& nodes, std::span<const Clip> clips);

  [[nodiscard]] const GraphDescription& description() const noexcept { return description_; }
  [[nodiscard]] const Hierarchy& nodes() const noexcept { return nodes_; }

  /// Makes everything.
  void bind_all();
  [[nodiscard]] std::vector<GraphFault> take_faults() { return std::move(faults_); }
  [[nodiscard]] std::unique_ptr<Graph::Compiled> take_compiled() { return std::move(compiled_); }

  // For operations; `place` is relative to the pose being made
  /// Null where there is none, or where poses refer to each other in a circle; both are reported.
  [[nodiscard]] const Operation* pose(const std::string& name, const Place& place);
  [[nodiscard]] const LoopedClip* clip(const std::string& name, const std::optional<Loop>& loop, const Place& place);
  [[nodiscard]] std::optional<std::size_t> parameter(const std::string& name, const Place& place);
  [[nodiscard]] Number number(const GraphNumber& number, const Place& place);
  /// `no_node` where there is none, which is reported.
  [[nodiscard]] std::size_t node(const std::string& name, const Place& place);
  /// Marks a node as moved by an operation.
  void moves(std::size_t node) { compiled_->moved[node] = 1; }
  [[nodiscard]] JointMask mask(const std::vector<MaskPart>& parts, const Place& place);
  [[nodiscard]] std::size_t machine_number() const noexcept;
  [[nodiscard]] std::size_t new_phase() noexcept { return compiled_->phases++; }
  /// @param step  of the grid of its springs, s: they look ahead by as much
  [[nodiscard]] std::size_t new_swing(double step) noexcept {
    compiled_->looks_ahead += step;
    return compiled_->swings++;
  }
  [[nodiscard]] std::size_t new_travel() noexcept { return compiled_->travels++; }
  void fault(const Place& place, std::string message);
  /// Calls `make`, which may throw. @returns whether it did not; each problem that the exception lists is reported
  template <class Make>
  bool attempt(const Place& place, const Make& make) {
    try {
      make();
      return true;
    } catch (const chains::Unfit& unfit) {
      for (const chains::Problem& problem : unfit.problems()) fault(inside(place, problem.member), problem.text);
      return false;
    } catch (const std::invalid_argument& problems) {
      fault_each(place, problems.what());
      return false;
    }
  }

 private:
  [[nodiscard]] static Place inside(Place place, const Place& member) {
    place.insert(place.end(), member.begin(), member.end());
    return place;
  }
  void fault_each(const Place& place, const std::string& lines);
  void bind_parameters();
  void bind_inputs();
  void bind_reactions();
  void keep_jumps_of(const Curve<double>& curve);
  const Operation* bind_pose(std::size_t index);
  const Operation* bind_clip(std::size_t index);
  void count_askers();
  /// The operation as used by others: remembered where several use it.
  [[nodiscard]] const Operation* seen(const Operation* operation, const std::string& name);
  const Operation* add(std::unique_ptr<Operation> operation);

  const GraphDescription& description_;
  const Hierarchy& nodes_;
  std::span<const Clip> clips_;
  std::unique_ptr<Graph::Compiled> compiled_;
  std::vector<GraphFault> faults_;

  struct Made {
    enum class Stage { waiting, making, made } stage = Stage::waiting;
    const Operation* operation = nullptr;
    double size = 0;        // operations in one evaluation
    std::size_t depth = 0;  // operations one in another
    std::size_t rooms = 0;  // scratch poses that its operands need
  };
  std::vector<Made> made_;                          // by pose
  std::map<std::size_t, const Operation*> played_;  // clips used as poses by their names
  std::map<std::string, int> askers_;               // by name: how many users it has; springs count as several
  std::map<const Operation*, const Operation*> remembered_;
  std::vector<std::size_t> making_;  // the poses being made, the outermost first
};

}  // namespace tweenfall::graphs
