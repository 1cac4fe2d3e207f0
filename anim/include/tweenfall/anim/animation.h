#pragma once

/// Clips bound to nodes: names are looked up once, then the whole pose is a function of time, value and rate.
///
/// Every clip is bound to the nodes once, however many plays it has. A play is a clock and a weight; running it by
/// another clock (`ClockOverride`) binds nothing.
///
/// The plays are layers, in order. The first lies over the rest poses, each further one is mixed
/// over what is below with its weight; a weight that changes contributes its own rate, so a
/// cross-fade's velocity is exact.
///
/// Asking is for any number of threads at once, takes no lock and never fails. Plays keep nothing; graphs remember how
/// far they have come, and ask for memory where a machine passes to another state, or a second thread asks meanwhile.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/node_look.h>
#include <tweenfall/anim/play.h>
#include <tweenfall/anim/player.h>

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tweenfall {

struct GraphDescription;
struct GraphEvent;
struct GraphInput;
class GraphPlayer;
namespace graphs {
class GraphStack;
}

class Animation {
 public:
  // Moving copies: what was moved from stays what it was.
  Animation(const Animation&) noexcept = default;
  Animation& operator=(const Animation&) noexcept = default;

  /// Binds every track of every clip. A track of a property that is not ours is bound to nothing.
  /// @throws std::invalid_argument naming all tracks whose node does not exist or whose curve has the wrong type.
  Animation(std::shared_ptr<const Hierarchy> nodes, std::vector<Clip> clips, std::vector<Play> plays);

  /// The same clips and plays over other nodes. @throws as the constructor.
  [[nodiscard]] Animation with_nodes(std::shared_ptr<const Hierarchy> nodes) const;

  /// The same after a play was asked for something: what the poses were before its time, they still are. A play that is
  /// started by a name which none has lies over all others; it may be that of a clip.
  /// @throws std::invalid_argument for what cannot be, unknown names with the nearest
  [[nodiscard]] Animation with_change(const PlayChange& change) const;

  /// The same over the same nodes and more after them, none of which has a track: binds nothing, and takes no longer
  /// for more nodes.
  [[nodiscard]] Animation with_more_nodes(std::shared_ptr<const Hierarchy> nodes) const;

  /// The same with graphs over its plays, each over the one before; they run by the same clock, from time 0.
  /// @throws std::invalid_argument listing all faults of the first that has any.
  [[nodiscard]] Animation with_graphs(std::vector<GraphDescription> graphs) const;

  /// The same after something came in to a graph: what the poses were before its time, they still are.
  /// @throws std::invalid_argument for what cannot be, unknown names with the nearest
  [[nodiscard]] Animation with_input(std::string_view graph, const GraphInput& input) const;

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return *nodes_; }
  [[nodiscard]] std::span<const Clip> clips() const noexcept { return *clips_; }
  [[nodiscard]] std::span<const Player> players() const noexcept { return *players_; }
  /// The player of that name. @throws std::invalid_argument with the nearest name, and where several have it
  [[nodiscard]] std::size_t player_named(std::string_view name) const;

  // Whole poses
  /// Local motion of every node at a stage time, or of the first so many. @param local  written, in their order
  void sample(double stage_time, std::span<Motion> local, Side side = Side::out,
              const ClockOverride& clock = {}) const noexcept;

  // Single nodes: the same bits
  /// Local motion of one node.
  [[nodiscard]] Motion sample_node(std::size_t node, double stage_time, Side side = Side::out,
                                   const ClockOverride& clock = {}) const noexcept;

  /// World motion of one node through its chain of parents; the path that a hand-off follows.
  [[nodiscard]] WorldMotion world(std::size_t node, double stage_time, Side side = Side::out,
                                  const ClockOverride& clock = {}) const noexcept;

  /// Color and morph weights of one node, where a playing clip drives them, or one of a graph; the first play fades
  /// from the node's own.
  [[nodiscard]] NodeLook look(std::size_t node, double stage_time, Side side = Side::out,
                              const ClockOverride& clock = {}) const;

  // Graphs
  [[nodiscard]] std::span<const GraphDescription> graphs() const noexcept;
  /// Events of their clips that show, in (from, to], in order, as `GraphPlayer::events` has them.
  [[nodiscard]] std::vector<GraphEvent> graph_events(double from, double to) const;
  /// The first of a name, ends of intervals left out. @param node  only of graphs that move this node; `no_node`: all
  [[nodiscard]] std::optional<double> first_graph_event(std::string_view name, std::size_t node, double from,
                                                        double to) const;
  /// A graph as it is at a time, to look into: what is set on it comes to nobody else.
  /// @throws std::invalid_argument with the nearest name
  [[nodiscard]] GraphPlayer graph(std::string_view name, double time) const;
  /// The first time in (from, to] at which something came in to a graph, a machine passed to another state, or what a
  /// graph shows jumps.
  [[nodiscard]] std::optional<double> first_graph_instant(double from, double to) const;

  // Plays
  /// Whether some play or graph has a track for the node's position, rotation or scale, or an ancestor's.
  [[nodiscard]] bool animates(std::size_t node) const noexcept;

  /// Whether some clip, played or not, has a track for the node itself.
  [[nodiscard]] bool has_tracks(std::size_t node) const noexcept;

  /// Calls `visit(const RunningPlay&)` for each play that runs under `clock`, told on the stage's time.
  /// @param node  only those that move this node or an ancestor; `no_node`: all
  template <class Visit>
  void for_each_play(const ClockOverride& clock, std::size_t node, Visit&& visit) const {
    const bool alone = clock.clip != ClockOverride::every_clip;
    const std::size_t count = running_count(clock);
    for (std::size_t i = 0; i < count; ++i) {
      const std::optional<RunningPlay> play = running(clock, i);
      if (play && (node == no_node || moved_by(node, i, play->play().clip, alone))) visit(*play);
    }
  }

 private:
  [[nodiscard]] std::size_t graph_named(std::string_view name) const;
  void bind_clips(std::string problems);
  void bind_plays();
  /// How many places there are for players that run under a clock: those of the stage, or of one clip those that play
  /// it, and one more where there is none.
  [[nodiscard]] std::size_t running_count(const ClockOverride& clock) const noexcept {
    return players_->size() + (clock.clip != ClockOverride::every_clip ? 1 : 0);
  }
  /// Nothing where the player at this place does not run under the clock.
  [[nodiscard]] std::optional<RunningPlay> running(const ClockOverride& clock, std::size_t place) const noexcept;
  [[nodiscard]] bool moved_by(std::size_t node, std::size_t place, std::size_t clip, bool unmasked) const noexcept;
  template <class Counts, class Visit>
  void for_each_running(double stage_time, Side side, const ClockOverride& clock, const Counts& counts,
                        const Visit& visit) const;

  std::shared_ptr<const Hierarchy> nodes_;
  std::shared_ptr<const std::vector<Clip>> clips_;
  std::shared_ptr<const std::vector<Player>> players_;
  std::shared_ptr<const std::vector<Player>> alone_;  ///< of each clip one that begins it at 0
  struct BoundClips;                                  ///< every clip, bound to the nodes
  struct BoundPlays;                                  ///< which of the nodes each play drives
  std::shared_ptr<const BoundClips> bound_clips_;
  std::shared_ptr<const BoundPlays> bound_plays_;
  std::shared_ptr<graphs::GraphStack> graphs_;  ///< null for none
};

/// Whether `name` matches `pattern`, in which `*` stands for any run of characters.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name) noexcept;

}  // namespace tweenfall
