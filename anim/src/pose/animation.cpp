#include <tweenfall/anim/animation.h>
#include <tweenfall/anim/graph.h>
#include <tweenfall/curves/nearest_name.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "graph/graph_stack.h"
#include "pose/bound_clip.h"
#include "pose/clip_look.h"
#include "pose/clip_values.h"

namespace tweenfall {

using pose::BoundClip;
using pose::Parts;

struct Animation::BoundClips {
  std::vector<BoundClip> clips;
  std::map<std::string, const Track*, std::less<>> user_tracks;  // the first of each name
};

struct Animation::BoundPlays {
  struct OfPlay {
    std::vector<char> masked;  // by entry of the clip: whether the mask excludes it; empty for no mask
    std::vector<Parts> below;  // by entry of the clip: the parts of the node that plays below drive
  };
  std::vector<OfPlay> plays;
  std::map<const Track*, std::vector<std::size_t>> by_user_track;  // by the first of its name: the plays that drive it
  std::vector<char> animated;                                      // by node: it or an ancestor is moved by some play
};

namespace pose {
namespace {

bool is_whole(const Sample<double>& weight) noexcept {
  return weight.value == 1 && weight.rate == 0;
}

bool is_nothing(const Sample<double>& weight) noexcept {
  return weight.value == 0 && weight.rate == 0;
}

/// Copies these parts of `from`; everything else keeps its bits.
void take(Parts parts, const Motion& from, Motion& motion) noexcept {
  if (parts & rotation_part) {
    motion.pose.rotation = from.pose.rotation;
    motion.twist.angular = from.twist.angular;
  }
  for (int i = 0; i < 3; ++i) {
    if (parts & (1 << i)) {
      motion.pose.position[i] = from.pose.position[i];
      motion.twist.linear[i] = from.twist.linear[i];
    }
    if (parts & (16 << i)) {
      motion.pose.scale[i] = from.pose.scale[i];
      motion.scale_rate[i] = from.scale_rate[i];
    }
  }
}

bool passes(const std::vector<std::string>& mask, std::string_view node) {
  return mask.empty() || std::ranges::any_of(mask, [&](const std::string& pattern) { return matches(pattern, node); });
}

// A running play with one of its clocks, and what it drives.
struct Running {
  const BoundClip* clip;
  ClipClock clock{};
  Sample<double> weight{1, 0, 0};
  const std::vector<char>* masked = nullptr;  // null: the whole clip
  const std::vector<Parts>* below = nullptr;  // null: all or nothing, by the next member
  bool covered = false;
  bool yields = false;  // it has not begun, and what is below comes first

  [[nodiscard]] bool drives(std::uint32_t entry) const noexcept {
    return entry != BoundClip::no_entry && (!masked || masked->empty() || !(*masked)[entry]);
  }
  /// One that yields has no say, save where nothing below it drives the part: there its first frame holds.
  [[nodiscard]] Parts parts(std::uint32_t entry) const noexcept {
    const Parts all = clip->entries()[entry].parts;
    if (!yields) return all;
    if (!below) return covered ? Parts{0} : all;
    return static_cast<Parts>(all & ~(*below)[entry]);
  }
};

void lay_over(const Running& running, std::uint32_t entry, const Hierarchy& nodes, Motion& motion) noexcept {
  const Sample<double>& weight = running.weight;
  const Parts parts = running.parts(entry);
  if (parts == 0 || is_nothing(weight)) return;
  Motion over = motion;
  running.clip->sample_entry(entry, nodes, running.clock, over);
  take(parts, is_whole(weight) ? over : mix(motion, over, weight.value, weight.rate), motion);
}

/// A user track as plays lie over each other. What has rates is mixed one by one, as poses are; of switches and texts
/// one shows, so that all of them are kept with what is left of their weights.
class Laid {
 public:
  explicit Laid(UserValue nothing)
      : one_shows_(std::holds_alternative<bool>(nothing) || std::holds_alternative<std::string>(nothing)),
        values_{std::move(nothing)},
        weights_{{1, 0, 0}} {}

  void lay_over(UserValue over, const Sample<double>& weight) {
    if (is_whole(weight)) {
      values_.clear();
      weights_.clear();
    } else if (!one_shows_) {
      values_ = {value()};
      weights_ = {{1, 0, 0}};
    }
    for (Sample<double>& below : weights_)
      below = {below.value * (1 - weight.value), below.rate * (1 - weight.value) - below.value * weight.rate, 0};
    // Of equal ones the upper shows, so it comes first.
    values_.insert(values_.begin(), std::move(over));
    weights_.insert(weights_.begin(), weight);
  }
  [[nodiscard]] UserValue value() const { return values_.size() == 1 ? values_.front() : mean_of(values_, weights_); }

 private:
  bool one_shows_;
  std::vector<UserValue> values_;
  std::vector<Sample<double>> weights_;
};

Motion at_rest_on(const Node& node) noexcept {
  Motion motion;
  motion.pose = node.rest;
  return motion;
}

std::string name_of(const Player& player, std::span<const Clip> clips) {
  return player.play().name.empty() ? clips[player.play().clip].name : player.play().name;
}

}  // namespace
}  // namespace pose

Animation::Animation(std::shared_ptr<const Hierarchy> nodes, std::vector<Clip> clips, std::vector<Play> plays)
    : nodes_(std::move(nodes)), clips_(std::make_shared<const std::vector<Clip>>(std::move(clips))) {
  if (!nodes_) throw std::invalid_argument("an animation needs nodes");
  std::string problems;
  std::vector<Player> players, alone;
  players.reserve(plays.size());
  alone.reserve(clips_->size());
  for (std::size_t p = 0; p < plays.size(); ++p) {
    if (plays[p].clip >= clips_->size()) {
      problems += "\n  play " + std::to_string(p) + " names clip number " + std::to_string(plays[p].clip) + " of " +
                  std::to_string(clips_->size());
      continue;
    }
    const Clip& clip = (*clips_)[plays[p].clip];
    const std::vector<std::string> wrong = problems_of(plays[p], clip);
    for (const std::string& problem : wrong)
      problems += "\n  play " + std::to_string(p) + " of clip \"" + clip.name + "\": " + problem;
    if (wrong.empty()) players.emplace_back(plays[p], clip);
  }
  for (std::size_t c = 0; c < clips_->size(); ++c) alone.emplace_back(Play{.clip = c}, (*clips_)[c]);
  players_ = std::make_shared<const std::vector<Player>>(std::move(players));
  alone_ = std::make_shared<const std::vector<Player>>(std::move(alone));
  bind_clips(std::move(problems));
  bind_plays();
}

std::size_t Animation::player_named(std::string_view name) const {
  std::optional<std::size_t> found;
  std::vector<std::string> names;
  for (std::size_t p = 0; p < players_->size(); ++p) {
    names.push_back(pose::name_of((*players_)[p], *clips_));
    if (names.back() != name) continue;
    if (found) throw std::invalid_argument("several plays are called \"" + std::string(name) + "\"; give them names");
    found = p;
  }
  if (found) return *found;
  const std::string nearest = nearest_name(name, names);
  throw std::invalid_argument("there is no play \"" + std::string(name) + "\"" +
                              (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
}

Animation Animation::with_change(const PlayChange& change) const {
  Animation other = *this;
  std::vector<Player> players = *players_;
  const auto* start = std::get_if<playing::Start>(&change.action);
  const auto has_name = [&](const Player& player) { return pose::name_of(player, *clips_) == change.play; };
  const auto clip_named = [&](const std::string& name) {
    std::vector<std::string> names;
    for (std::size_t c = 0; c < clips_->size(); ++c) {
      if ((*clips_)[c].name == name) return c;
      names.push_back((*clips_)[c].name);
    }
    const std::string nearest = nearest_name(name, names);
    throw std::invalid_argument("there is no clip \"" + name + "\"" +
                                (nearest.empty() ? "" : "; did you mean \"" + nearest + "\"?"));
  };
  if (start && std::ranges::none_of(players, has_name)) {
    // The name may also be that of a clip that no play has yet.
    const std::size_t clip = clip_named(start->clip.empty() ? change.play : start->clip);
    Play play = play_of(*start, clip);
    play.name = change.play;
    play.at = change.time;
    players.emplace_back(play, (*clips_)[clip]);
  } else {
    Player& player = players[player_named(change.play)];
    const std::string& own = (*clips_)[player.play().clip].name;
    if (start && !start->clip.empty() && clip_named(start->clip) != player.play().clip)
      throw std::invalid_argument("the play \"" + change.play + "\" is of clip \"" + own +
                                  "\"; start another by a name of its own");
    player = player.changed((*clips_)[player.play().clip], change.time, change.action);
  }
  other.players_ = std::make_shared<const std::vector<Player>>(std::move(players));
  // The graphs lie over the plays.
  other.graphs_ = nullptr;
  if (start) other.bind_plays();
  if (!graphs_) return other;
  other.graphs_ = std::make_shared<graphs::GraphStack>(*graphs_, other, change.time);
  if (start) other.bind_plays();
  return other;
}

Animation Animation::with_nodes(std::shared_ptr<const Hierarchy> nodes) const {
  Animation other = *this;
  other.nodes_ = std::move(nodes);
  other.graphs_ = nullptr;
  other.bind_clips({});
  other.bind_plays();
  if (!graphs_) return other;
  other.graphs_ = std::make_shared<graphs::GraphStack>(*graphs_, other.nodes_, other.clips_, other);
  other.bind_plays();
  return other;
}

Animation Animation::with_more_nodes(std::shared_ptr<const Hierarchy> nodes) const {
  Animation other = *this;
  other.nodes_ = std::move(nodes);
  return other;
}

void Animation::bind_clips(std::string problems) {
  auto bound = std::make_shared<BoundClips>();
  bound->clips.reserve(clips_->size());
  for (const Clip& clip : *clips_) {
    bound->clips.emplace_back(clip, *nodes_, problems);
    for (const Track& track : clip.tracks)
      if (pose::is_user_track(track)) bound->user_tracks.emplace(track.name(), &track);
  }
  if (!problems.empty()) throw std::invalid_argument("clips do not fit their nodes:" + problems);
  bound_clips_ = std::move(bound);
}

void Animation::bind_plays() {
  auto bound = std::make_shared<BoundPlays>();
  bound->animated.assign(nodes_->size(), 0);
  std::vector<Parts> below(nodes_->size(), 0);
  for (const Player& player : *players_) {
    const Play& play = player.play();
    BoundPlays::OfPlay& of_play = bound->plays.emplace_back();
    for (const BoundClip::Entry& entry : bound_clips_->clips[play.clip].entries()) {
      const bool driven = pose::passes(play.mask, (*nodes_)[entry.node].name);
      if (!play.mask.empty()) of_play.masked.push_back(!driven);
      of_play.below.push_back(below[entry.node]);
      if (!driven) continue;
      below[entry.node] |= entry.parts;
      if (entry.parts) bound->animated[entry.node] = 1;
    }
    for (const Track& track : (*clips_)[play.clip].tracks) {
      if (!pose::is_user_track(track) || !pose::passes(play.mask, track.node)) continue;
      const std::string name = track.name();
      if (bound_clips_->clips[play.clip].user_track(name) != &track) continue;
      const Track* first = bound_clips_->user_tracks.find(name)->second;
      if (track.curve.index() == first->curve.index()) bound->by_user_track[first].push_back(bound->plays.size() - 1);
    }
  }
  for (std::size_t node = 0; node < nodes_->size(); ++node) {
    if (graphs_ && graphs_->moves(node)) bound->animated[node] = 1;
    const std::size_t parent = (*nodes_)[node].parent;
    if (parent != no_node && bound->animated[parent]) bound->animated[node] = 1;
  }
  bound_plays_ = std::move(bound);
}

std::optional<RunningPlay> Animation::running(const ClockOverride& clock, std::size_t place) const noexcept {
  if (clock.clip == ClockOverride::every_clip) {
    const Player& player = (*players_)[place];
    return RunningPlay{&player, &(*clips_)[player.play().clip], clock};
  }
  RunningPlay running{nullptr, &(*clips_)[clock.clip], clock, 0, true};
  const auto follows = [&](const Player& player) {
    return player.play().clip == clock.clip && !player.is_gone(clock.starts_by);
  };
  if (place < players_->size()) {
    running.player = &(*players_)[place];
    if (!follows(*running.player)) return std::nullopt;
    running.lead = std::max(0.0, running.player->at() - clock.starts_by);
    return running;
  }
  if (std::ranges::any_of(*players_, follows)) return std::nullopt;
  running.player = &(*alone_)[clock.clip];
  running.lead = -clock.starts_by;
  return running;
}

// Calls `visit` with each clock of each play that has a weight, in order. @param counts decides by play, before its
// clocks are computed
template <class Counts, class Visit>
void Animation::for_each_running(double stage_time, Side side, const ClockOverride& clock, const Counts& counts,
                                 const Visit& visit) const {
  const bool alone = clock.clip != ClockOverride::every_clip;
  bool covered = false;
  const std::size_t count = running_count(clock);
  for (std::size_t p = 0; p < count; ++p) {
    const std::optional<RunningPlay> play = running(clock, p);
    if (!play || (!alone && play->is_gone(stage_time, side))) continue;
    pose::Running running{.clip = &bound_clips_->clips[play->play().clip]};
    if (!alone) {
      running.masked = &bound_plays_->plays[p].masked;
      running.below = &bound_plays_->plays[p].below;
    }
    running.covered = covered;
    covered = true;
    if (!counts(running)) continue;
    const PlayVoices voices = play->voices(stage_time, side);
    for (std::size_t i = 0; i < voices.count; ++i) {
      running.clock = voices.list[i].clock;
      running.yields = !running.clock.started && !fills_before(play->play().fill);
      running.weight = voices.list[i].weight;
      visit(running);
    }
  }
}

void Animation::sample(double stage_time, std::span<Motion> local, Side side,
                       const ClockOverride& own_clock) const noexcept {
  const bool by_graphs = graphs_ && own_clock.clip == ClockOverride::every_clip;
  // Graphs know only the nodes that they were made for, and sample the plays only for these.
  const std::size_t asked = std::min(nodes_->size(), local.size());
  for (std::size_t node = by_graphs ? graphs_->nodes() : 0; node < asked; ++node)
    local[node] = pose::at_rest_on((*nodes_)[node]);
  if (by_graphs) {
    graphs_->sample(own_clock.timeline_at(stage_time), side, local.first(graphs_->nodes()));
    return;
  }
  const auto all = [](const pose::Running&) { return true; };
  for_each_running(stage_time, side, own_clock, all, [&](const pose::Running& running) {
    const bool unmasked = !running.masked || running.masked->empty();
    if (unmasked && !running.yields && pose::is_whole(running.weight)) {
      running.clip->sample(*nodes_, running.clock, local);
      return;
    }
    const auto& entries = running.clip->entries();
    for (std::uint32_t entry = 0; entry < entries.size(); ++entry)
      if (running.drives(entry)) pose::lay_over(running, entry, *nodes_, local[entries[entry].node]);
  });
}

Motion Animation::sample_node(std::size_t node, double stage_time, Side side,
                              const ClockOverride& own_clock) const noexcept {
  if (graphs_ && own_clock.clip == ClockOverride::every_clip && node < graphs_->nodes())
    return graphs_->sample_node(node, own_clock.timeline_at(stage_time), side);
  Motion motion = pose::at_rest_on((*nodes_)[node]);
  const auto drives = [&](const pose::Running& running) {
    const std::uint32_t entry = running.clip->entry_of(node);
    return running.drives(entry) && running.clip->entries()[entry].parts;
  };
  for_each_running(stage_time, side, own_clock, drives, [&](const pose::Running& running) {
    pose::lay_over(running, running.clip->entry_of(node), *nodes_, motion);
  });
  return motion;
}

WorldMotion Animation::world(std::size_t node, double stage_time, Side side,
                             const ClockOverride& clock) const noexcept {
  return nodes_->world_motion(node, [&](std::size_t index) { return sample_node(index, stage_time, side, clock); });
}

NodeLook Animation::look(std::size_t node, double stage_time, Side side, const ClockOverride& own_clock) const {
  if (graphs_ && own_clock.clip == ClockOverride::every_clip && node < graphs_->nodes())
    return graphs_->look(node, own_clock.timeline_at(stage_time), side);
  NodeLook look;
  const auto shows = [&](const pose::Running& running) {
    const std::uint32_t index = running.clip->entry_of(node);
    if (!running.drives(index)) return false;
    const BoundClip::Entry& entry = running.clip->entries()[index];
    return entry.has_color() || entry.weights;
  };
  for_each_running(stage_time, side, own_clock, shows, [&](const pose::Running& running) {
    const BoundClip::Entry& entry = running.clip->entries()[running.clip->entry_of(node)];
    pose::lay_look_over(entry, running.clock, running.yields, running.weight, (*nodes_)[node], look);
  });
  return look;
}

std::vector<std::string> Animation::user_tracks() const {
  std::vector<char> used(clips_->size(), 0);
  for (const Player& player : *players_) used[player.play().clip] = 1;
  for (const GraphDescription& graph : graphs())
    for (const std::string& name : clips_named_in(graph)) {
      const auto found = std::ranges::find(*clips_, name, &Clip::name);
      if (found != clips_->end()) used[static_cast<std::size_t>(found - clips_->begin())] = 1;
    }
  std::vector<std::string> names;
  std::set<std::string> known;
  for (std::size_t clip = 0; clip < used.size(); ++clip)
    for (const Track& track : (*clips_)[clip].tracks)
      if (used[clip] && pose::is_user_track(track) && known.insert(track.name()).second) names.push_back(track.name());
  return names;
}

UserValue Animation::user_value(std::string_view track, double stage_time, Side side) const {
  const auto named = bound_clips_->user_tracks.find(track);
  if (named == bound_clips_->user_tracks.end()) static_cast<void>(pose::user_track_named(*clips_, track));  // throws
  if (graphs_) return graphs_->user_value(track, stage_time, side);
  pose::Laid laid(pose::nothing_of(named->second->curve));
  const auto places = bound_plays_->by_user_track.find(named->second);
  if (places == bound_plays_->by_user_track.end()) return laid.value();
  bool found = false;
  for (const std::size_t place : places->second) {
    const std::optional<RunningPlay> play = running({}, place);
    if (!play || play->is_gone(stage_time, side)) continue;
    const TrackCurve& curve = bound_clips_->clips[play->play().clip].user_track(track)->curve;
    const PlayVoices voices = play->voices(stage_time, side);
    for (std::size_t i = 0; i < voices.count; ++i) {
      const auto& [clock, weight] = voices.list[i];
      const bool yields = found && !clock.started && !fills_before(play->play().fill);
      found = true;
      if (!yields && !pose::is_nothing(weight)) laid.lay_over(pose::user_value_of(curve, clock), weight);
    }
  }
  return laid.value();
}

bool Animation::animates(std::size_t node) const noexcept {
  const std::vector<char>& animated = bound_plays_->animated;
  while (node >= animated.size()) {
    node = (*nodes_)[node].parent;
    if (node == no_node) return false;
  }
  return animated[node] != 0;
}

bool Animation::moved_by(std::size_t node, std::size_t place, std::size_t of_clip, bool unmasked) const noexcept {
  static const std::vector<char> all;
  const BoundClip& clip = bound_clips_->clips[of_clip];
  const std::vector<char>& masked = unmasked ? all : bound_plays_->plays[place].masked;
  for (std::size_t i = node; i != no_node; i = (*nodes_)[i].parent) {
    const std::uint32_t entry = clip.entry_of(i);
    if (entry == BoundClip::no_entry || !clip.entries()[entry].parts) continue;
    if (masked.empty() || !masked[entry]) return true;
  }
  return false;
}

bool Animation::has_tracks(std::size_t node) const noexcept {
  return std::ranges::any_of(bound_clips_->clips,
                             [&](const BoundClip& clip) { return clip.entry_of(node) != BoundClip::no_entry; });
}

bool matches(std::string_view pattern, std::string_view name) noexcept {
  std::size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = n;
    } else if (p < pattern.size() && pattern[p] == name[n]) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace tweenfall
