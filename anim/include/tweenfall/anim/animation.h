#pragma once

/// Clips bound to nodes: names are looked up once, then every node's motion is a function of time.
///
/// The plays are layers, in order. The first lies over the rest poses, each further one is mixed
/// over what is below with its weight; a weight that changes contributes its own rate, so a
/// cross-fade's velocity is exact.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/play.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tweenfall {

/// The animated values of one node at one time, beside its motion.
struct NodeLook {
  std::optional<Sample<Color>> color;
  std::vector<Sample<double>> weights;  ///< morph weights; empty when not animated
};

class Animation {
 public:
  /// Binds every track of every clip. A track of a property that is not ours is bound to nothing.
  /// @throws std::invalid_argument naming all tracks whose node does not exist or whose curve has the wrong type.
  Animation(std::shared_ptr<const Hierarchy> nodes, std::vector<Clip> clips, std::vector<Play> plays);

  /// The same nodes and clips, played otherwise; clips are shared, not copied.
  [[nodiscard]] Animation with_plays(std::vector<Play> plays) const;

  /// The same clips and plays over other nodes. @throws as the constructor.
  [[nodiscard]] Animation with_nodes(std::shared_ptr<const Hierarchy> nodes) const;

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return *nodes_; }
  [[nodiscard]] std::span<const Clip> clips() const noexcept { return *clips_; }
  [[nodiscard]] std::span<const Play> plays() const noexcept { return plays_; }

  /// Local motion of every node at a stage time. @param local  written, one per node, in order
  void sample(double stage_time, std::span<Motion> local, Side side = Side::out) const noexcept;

  /// Local motion of one node.
  [[nodiscard]] Motion sample_node(std::size_t node, double stage_time, Side side = Side::out) const noexcept;

  /// World motion of one node through its chain of parents; the path that a hand-off follows.
  [[nodiscard]] WorldMotion world(std::size_t node, double stage_time, Side side = Side::out) const noexcept;

  /// Color and morph weights of one node.
  [[nodiscard]] NodeLook look(std::size_t node, double stage_time, Side side = Side::out) const;

  /// Whether some playing clip has a track for the node's position, rotation or scale, or an ancestor's.
  [[nodiscard]] bool animates(std::size_t node) const noexcept;

  /// The same question of one play.
  [[nodiscard]] bool moved_by(std::size_t node, std::size_t play) const noexcept;

 private:
  void bind(std::vector<Play> plays);

  std::shared_ptr<const Hierarchy> nodes_;
  std::shared_ptr<const std::vector<Clip>> clips_;
  std::vector<Play> plays_;
  struct Binding;  ///< for each node, the tracks of each play that drive it
  std::shared_ptr<const Binding> binding_;
};

/// Whether `name` matches `pattern`, in which `*` stands for any run of characters.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name) noexcept;

}  // namespace tweenfall
