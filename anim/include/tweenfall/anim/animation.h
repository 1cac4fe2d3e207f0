#pragma once

/// Clips bound to nodes: names are looked up once, then the whole pose is a function of time, value and rate.
///
/// Every clip is bound to the nodes once, however many plays it has. A play is a clock and a weight; running it by
/// another clock (`ClockOverride`) needs no further binding.
///
/// The plays are layers, in order. The first lies over the rest poses, each further one is mixed
/// over what is below with its weight; a weight that changes contributes its own rate, so a
/// cross-fade's velocity is exact.
///
/// Any number of threads may sample at once, without locks and without failing. Plays store nothing; graphs remember
/// how far they were evaluated, and allocate when a machine changes its state or a second thread samples meanwhile.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/node_look.h>
#include <tweenfall/anim/play.h>
#include <tweenfall/anim/player.h>
#include <tweenfall/anim/user_value.h>

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
  // A move is a copy: the object moved from stays valid.
  Animation(const Animation&) noexcept = default;
  Animation& operator=(const Animation&) noexcept = default;

  /// Binds every track of every clip. A track of a property that is not ours is bound to nothing.
  /// @throws std::invalid_argument without nodes, or naming all tracks whose node does not exist or whose curve has the
  /// wrong type.
  Animation(std::shared_ptr<const Hierarchy> nodes, std::vector<Clip> clips, std::vector<Play> plays);

  /// The same clips and plays over other nodes. @throws as the constructor.
  [[nodiscard]] Animation with_nodes(std::shared_ptr<const Hierarchy> nodes) const;

  /// The same with a change to a play: poses before the time of the change stay as they were. Starting a name that no
  /// play has adds a play on top of all others; the name may be that of a clip.
  /// @throws std::invalid_argument for what cannot be, unknown names with the nearest
  [[nodiscard]] Animation with_change(const PlayChange& change) const;

  /// The same over the same nodes followed by new ones without tracks: nothing is bound again, and the time does not
  /// depend on the number of nodes.
  [[nodiscard]] Animation with_more_nodes(std::shared_ptr<const Hierarchy> nodes) const;

  /// The same with graphs layered over its plays, each over the one before; they run by the same clock, from time 0.
  /// @throws std::invalid_argument listing all faults of the first that has any.
  [[nodiscard]] Animation with_graphs(std::vector<GraphDescription> graphs) const;

  /// The same with an input to a graph: poses before the time of the input stay as they were.
  /// @throws std::invalid_argument for what cannot be, unknown names with the nearest
  [[nodiscard]] Animation with_input(std::string_view graph, const GraphInput& input) const;

  [[nodiscard]] const Hierarchy& nodes() const noexcept { return *nodes_; }
  [[nodiscard]] std::span<const Clip> clips() const noexcept { return *clips_; }
  [[nodiscard]] std::span<const Player> players() const noexcept { return *players_; }
  /// The player of that name. @throws std::invalid_argument with the nearest name, or if several have the name
  [[nodiscard]] std::size_t player_named(std::string_view name) const;

  // Whole poses
  /// Local motion of every node, or of the first ones, at a stage time. @param local written, in order of the nodes
  void sample(double stage_time, std::span<Motion> local, Side side = Side::out,
              const ClockOverride& clock = {}) const noexcept;

  // Single nodes: the same bits
  /// Local motion of one node.
  [[nodiscard]] Motion sample_node(std::size_t node, double stage_time, Side side = Side::out,
                                   const ClockOverride& clock = {}) const noexcept;

  /// World motion of one node through its chain of parents; the path that a hand-off follows.
  [[nodiscard]] WorldMotion world(std::size_t node, double stage_time, Side side = Side::out,
                                  const ClockOverride& clock = {}) const noexcept;

  /// Color and morph weights of one node, where a playing clip or a clip of a graph drives them; the first play fades
  /// from the node's own.
  [[nodiscard]] NodeLook look(std::size_t node, double stage_time, Side side = Side::out,
                              const ClockOverride& clock = {}) const;

  // User tracks
  /// The names of those that plays and graphs have, each once: "node.property", in the order of the clips.
  [[nodiscard]] std::vector<std::string> user_tracks() const;
  /// The value of one, mixed as poses are. Clips that lack it show what lies below; where nothing does, it is zero,
  /// transparent, not turned, off or empty. Of switches and texts the one with the largest weight shows, of equal ones
  /// the upper. If clips have the track in several kinds, that of the first counts, and others lack it.
  /// @throws std::invalid_argument with the nearest name
  [[nodiscard]] UserValue user_value(std::string_view track, double stage_time, Side side = Side::out) const;

  // Graphs
  [[nodiscard]] std::span<const GraphDescription> graphs() const noexcept;
  /// Events of the clips that show in graphs, in (from, to], in order, as from `GraphPlayer::events`.
  [[nodiscard]] std::vector<GraphEvent> graph_events(double from, double to) const;
  /// The first event of a name, without ends of intervals. @param node only graphs that move this node; `no_node`: all
  [[nodiscard]] std::optional<double> first_graph_event(std::string_view name, std::size_t node, double from,
                                                        double to) const;
  /// A copy of a graph at a time, for inspection: setting something on it affects nothing else.
  /// @throws std::invalid_argument with the nearest name
  [[nodiscard]] GraphPlayer graph(std::string_view name, double time) const;
  /// The first time in (from, to] at which a graph had an input, a machine passed to another state, or the pose that a
  /// graph shows jumps.
  [[nodiscard]] std::optional<double> first_graph_instant(double from, double to) const;

  // Plays
  /// Whether some play or graph has a track for the node's position, rotation or scale, or an ancestor's.
  [[nodiscard]] bool animates(std::size_t node) const noexcept;

  /// Whether some clip, played or not, has a track for the node itself.
  [[nodiscard]] bool has_tracks(std::size_t node) const noexcept;

  /// Calls `visit(const RunningPlay&)` for each play that runs under `clock`, with times in stage time.
  /// @param node only plays that move this node or an ancestor; `no_node`: all
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
  /// The number of places for players that may run under a clock: all players, and with a clock of one clip one more,
  /// for a clip that no player plays.
  [[nodiscard]] std::size_t running_count(const ClockOverride& clock) const noexcept {
    return players_->size() + (clock.clip != ClockOverride::every_clip ? 1 : 0);
  }
  /// Empty where the player at this place does not run under the clock.
  [[nodiscard]] std::optional<RunningPlay> running(const ClockOverride& clock, std::size_t place) const noexcept;
  [[nodiscard]] bool moved_by(std::size_t node, std::size_t place, std::size_t clip, bool unmasked) const noexcept;
  template <class Counts, class Visit>
  void for_each_running(double stage_time, Side side, const ClockOverride& clock, const Counts& counts,
                        const Visit& visit) const;

  std::shared_ptr<const Hierarchy> nodes_;
  std::shared_ptr<const std::vector<Clip>> clips_;
  std::shared_ptr<const std::vector<Player>> players_;
  std::shared_ptr<const std::vector<Player>> alone_;  ///< one for each clip, which starts it at 0
  struct BoundClips;                                  ///< every clip, bound to the nodes
  struct BoundPlays;                                  ///< which of the nodes each play drives
  std::shared_ptr<const BoundClips> bound_clips_;
  std::shared_ptr<const BoundPlays> bound_plays_;
  std::shared_ptr<graphs::GraphStack> graphs_;  ///< null for none
};

/// Whether `name` matches `pattern`, in which `*` stands for any run of characters.
[[nodiscard]] bool matches(std::string_view pattern, std::string_view name) noexcept;

}  // namespace tweenfall
