#include <tweenfall/anim/animation.h>

#include <algorithm>
#include <stdexcept>

#include "graph/graph_stack.h"
#include "pose/bound_clip.h"

namespace tweenfall {

using pose::BoundClip;
using pose::Parts;

struct Animation::BoundClips {
  std::vector<BoundClip> clips;
};

struct Animation::BoundPlays {
  struct OfPlay {
    std::vector<char> masked;  // by entry of the clip: whether the mask keeps the play off; empty for no mask
    std::vector<Parts> below;  // by entry of the clip: what plays below drive of the node
  };
  std::vector<OfPlay> plays;
  std::vector<char> animated;  // by node: it or an ancestor is moved by some play
};

namespace pose {
namespace {

bool is_whole(const Sample<double>& weight) noexcept {
  return weight.value == 1 && weight.rate == 0;
}

bool is_nothing(const Sample<double>& weight) noexcept {
  return weight.value == 0 && weight.rate == 0;
}

/// Takes these parts of `from`, so that everything else keeps its bits.
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

// A play as it runs by a clock that may not be the stage's.
struct Running {
  const BoundClip* clip;
  const std::vector<char>* masked = nullptr;  // null: the whole clip
  const std::vector<Parts>* below = nullptr;  // null: all of it or nothing, as the next says
  bool covered = false;
  double at = 0, speed = 1;
  const Curve<double>* weight = nullptr;  // null: 1
  double weight_time = 0;

  [[nodiscard]] bool drives(std::uint32_t entry) const noexcept {
    return entry != BoundClip::no_entry && (!masked || masked->empty() || !(*masked)[entry]);
  }
  [[nodiscard]] ClipClock clock(double stage_time, Side side) const noexcept {
    return clock_at(at, speed, clip->clip(), stage_time, side);
  }
  [[nodiscard]] Sample<double> weight_at(Side side) const noexcept {
    return weight ? weight->sample(weight_time, side) : Sample<double>{1, 0, 0};
  }
  /// Before a play starts it has no say, save where nothing below it drives the part: there its first frame holds.
  [[nodiscard]] Parts parts(std::uint32_t entry, bool started) const noexcept {
    const Parts all = clip->entries()[entry].parts;
    if (started) return all;
    if (!below) return covered ? Parts{0} : all;
    return static_cast<Parts>(all & ~(*below)[entry]);
  }
};

void lay_over(const Running& play, std::uint32_t entry, const Hierarchy& nodes, const ClipClock& clock,
              const Sample<double>& weight, Motion& motion) noexcept {
  const Parts parts = play.parts(entry, clock.started);
  if (parts == 0 || is_nothing(weight)) return;
  Motion over = motion;
  play.clip->sample_entry(entry, nodes, clock, over);
  take(parts, is_whole(weight) ? over : mix(motion, over, weight.value, weight.rate), motion);
}

Motion at_rest_on(const Node& node) noexcept {
  Motion motion;
  motion.pose = node.rest;
  return motion;
}

template <class T>
Sample<T> per_stage_second(Sample<T> sample, double clock_rate) noexcept {
  sample.rate *= clock_rate;
  sample.acceleration *= clock_rate * clock_rate;
  return sample;
}

// The plain numbers of a value that is mixed by its parts.
double& numbers(double& value) noexcept {
  return value;
}
Vec4& numbers(Color& value) noexcept {
  return value.rgba;
}

template <class T>
void fade(Sample<T>& under, Sample<T> over, const Sample<double>& weight) noexcept {
  if (is_whole(weight)) {
    under = over;
    return;
  }
  using Numbers = Rate<T>;
  const Numbers difference = numbers(over.value) - numbers(under.value), rate_difference = over.rate - under.rate;
  under.acceleration += weight.value * (over.acceleration - under.acceleration) + 2 * weight.rate * rate_difference +
                        weight.acceleration * difference;
  under.rate += weight.value * rate_difference + weight.rate * difference;
  if (weight.value == 1)
    under.value = over.value;
  else
    numbers(under.value) += weight.value * difference;
}

/// What a clip has for a node's color; single numbers lie over what is below, or over white.
Sample<Color> color_over(const BoundClip::Entry& entry, const ClipClock& clock, const Node& node,
                         const std::optional<Sample<Color>>& look) {
  if (entry.color) return per_stage_second(entry.color->sample(clock.time, clock.side), clock.rate);
  Sample<Color> over =
      look.value_or(Sample<Color>{node.color.value_or(Color{Vec4(1, 1, 1, 1)}), Vec4(0, 0, 0, 0), Vec4(0, 0, 0, 0)});
  for (int i = 0; i < 4; ++i) {
    const Curve<double>* curve = entry.tints[static_cast<std::size_t>(i)];
    if (!curve) continue;
    const Sample<double> number = per_stage_second(curve->sample(clock.time, clock.side), clock.rate);
    over.value.rgba[i] = number.value;
    over.rate[i] = number.rate;
    over.acceleration[i] = number.acceleration;
  }
  return over;
}

void fade_color(const BoundClip::Entry& entry, const ClipClock& clock, const Sample<double>& weight, const Node& node,
                std::optional<Sample<Color>>& look) {
  const Sample<Color> over = color_over(entry, clock, node, look);
  if (!look && !node.color) {
    look = over;  // there is nothing to fade from
    return;
  }
  if (!look) look = Sample<Color>{*node.color, Vec4::Zero(), Vec4::Zero()};
  fade(*look, over, weight);
}

void fade_weights(const WeightCurves& curves, const ClipClock& clock, const Sample<double>& weight, const Node& node,
                  std::vector<Sample<double>>& look) {
  for (std::size_t i = look.size(); i < curves.size(); ++i)
    look.push_back({i < node.weights.size() ? node.weights[i] : 0, 0, 0});
  for (std::size_t i = 0; i < curves.size(); ++i)
    fade(look[i], per_stage_second(curves[i].sample(clock.time, clock.side), clock.rate), weight);
}

// Calls `visit` with each play that runs, in order.
template <class Clips, class Plays, class Visit>
void for_each_running(std::span<const Play> plays, const Clips& clips, const Plays& bound, double stage_time,
                      const ClockOverride& clock, const Visit& visit) {
  if (clock.clip == ClockOverride::every_clip) {
    const double weight_time = clock.timeline_at(stage_time);
    for (std::size_t p = 0; p < plays.size(); ++p)
      visit(Running{.clip = &clips[plays[p].clip],
                    .masked = &bound[p].masked,
                    .below = &bound[p].below,
                    .at = clock.stage_at(plays[p].at),
                    .speed = plays[p].speed,
                    .weight = &plays[p].weight,
                    .weight_time = weight_time});
    return;
  }
  Running running{.clip = &clips[clock.clip]};
  for (const Play& play : plays) {
    if (play.clip != clock.clip) continue;
    running.at = clock.stage_at(std::min(play.at, clock.starts_by));
    running.speed = play.speed;
    visit(running);
    running.covered = true;
  }
  if (running.covered) return;
  running.at = clock.stage_at(clock.starts_by);
  visit(running);
}

}  // namespace
}  // namespace pose

Animation::Animation(std::shared_ptr<const Hierarchy> nodes, std::vector<Clip> clips, std::vector<Play> plays)
    : nodes_(std::move(nodes)),
      clips_(std::make_shared<const std::vector<Clip>>(std::move(clips))),
      plays_(std::make_shared<const std::vector<Play>>(std::move(plays))) {
  std::string problems;
  for (std::size_t p = 0; p < plays_->size(); ++p)
    if ((*plays_)[p].clip >= clips_->size())
      problems += "\n  play " + std::to_string(p) + " names clip number " + std::to_string((*plays_)[p].clip) + " of " +
                  std::to_string(clips_->size());
  bind_clips(std::move(problems));
  bind_plays();
}

Animation Animation::with_nodes(std::shared_ptr<const Hierarchy> nodes) const {
  Animation other = *this;
  other.nodes_ = std::move(nodes);
  other.graphs_ = nullptr;
  other.bind_clips({});
  other.bind_plays();
  return graphs_ ? other.with_graphs({graphs().begin(), graphs().end()}) : other;
}

Animation Animation::with_more_nodes(std::shared_ptr<const Hierarchy> nodes) const {
  Animation other = *this;
  other.nodes_ = std::move(nodes);
  return other;
}

Animation Animation::with_graphs(std::vector<GraphDescription> graphs) const {
  Animation other = *this;
  other.graphs_ = nullptr;
  if (!graphs.empty())
    other.graphs_ = std::make_shared<graphs::GraphStack>(
        nodes_, clips_, std::move(graphs),
        [plays = other](double time, Side side, std::span<Motion> out) { plays.sample(time, out, side); });
  other.bind_plays();
  return other;
}

std::span<const GraphDescription> Animation::graphs() const noexcept {
  if (!graphs_) return {};
  return graphs_->descriptions();
}

std::vector<GraphEvent> Animation::graph_events(double from, double to) const {
  if (!graphs_) return {};
  return graphs_->events(from, to);
}

std::optional<double> Animation::first_graph_event(std::string_view name, std::size_t node, double from,
                                                   double to) const {
  return graphs_ ? graphs_->first_event(name, node, from, to) : std::nullopt;
}

std::optional<double> Animation::first_graph_instant(double from, double to) const {
  return graphs_ ? graphs_->first_instant(from, to) : std::nullopt;
}

void Animation::bind_clips(std::string problems) {
  auto bound = std::make_shared<BoundClips>();
  bound->clips.reserve(clips_->size());
  for (const Clip& clip : *clips_) bound->clips.emplace_back(clip, *nodes_, problems);
  if (!problems.empty()) throw std::invalid_argument("clips do not fit their nodes:" + problems);
  bound_clips_ = std::move(bound);
}

void Animation::bind_plays() {
  auto bound = std::make_shared<BoundPlays>();
  bound->animated.assign(nodes_->size(), 0);
  std::vector<Parts> below(nodes_->size(), 0);
  for (const Play& play : *plays_) {
    BoundPlays::OfPlay& of_play = bound->plays.emplace_back();
    for (const BoundClip::Entry& entry : bound_clips_->clips[play.clip].entries()) {
      const bool driven = pose::passes(play.mask, (*nodes_)[entry.node].name);
      if (!play.mask.empty()) of_play.masked.push_back(!driven);
      of_play.below.push_back(below[entry.node]);
      if (!driven) continue;
      below[entry.node] |= entry.parts;
      if (entry.parts) bound->animated[entry.node] = 1;
    }
  }
  for (std::size_t node = 0; node < nodes_->size(); ++node) {
    if (graphs_ && graphs_->moves(node)) bound->animated[node] = 1;
    const std::size_t parent = (*nodes_)[node].parent;
    if (parent != no_node && bound->animated[parent]) bound->animated[node] = 1;
  }
  bound_plays_ = std::move(bound);
}

void Animation::sample(double stage_time, std::span<Motion> local, Side side,
                       const ClockOverride& own_clock) const noexcept {
  const bool by_graphs = graphs_ && own_clock.clip == ClockOverride::every_clip;
  for (std::size_t node = by_graphs ? graphs_->nodes() : 0; node < nodes_->size(); ++node)
    local[node] = pose::at_rest_on((*nodes_)[node]);
  if (by_graphs) {
    graphs_->sample(own_clock.timeline_at(stage_time), side, local.first(graphs_->nodes()));
    return;
  }
  pose::for_each_running(*plays_, bound_clips_->clips, bound_plays_->plays, stage_time, own_clock,
                         [&](const pose::Running& play) {
                           const ClipClock clock = play.clock(stage_time, side);
                           const Sample<double> weight = play.weight_at(side);
                           const bool unmasked = !play.masked || play.masked->empty();
                           if (unmasked && clock.started && pose::is_whole(weight)) {
                             play.clip->sample(*nodes_, clock, local);
                             return;
                           }
                           const auto& entries = play.clip->entries();
                           for (std::uint32_t entry = 0; entry < entries.size(); ++entry)
                             if (play.drives(entry))
                               pose::lay_over(play, entry, *nodes_, clock, weight, local[entries[entry].node]);
                         });
}

Motion Animation::sample_node(std::size_t node, double stage_time, Side side,
                              const ClockOverride& own_clock) const noexcept {
  if (graphs_ && own_clock.clip == ClockOverride::every_clip && node < graphs_->nodes())
    return graphs_->sample_node(node, own_clock.timeline_at(stage_time), side);
  Motion motion = pose::at_rest_on((*nodes_)[node]);
  pose::for_each_running(
      *plays_, bound_clips_->clips, bound_plays_->plays, stage_time, own_clock, [&](const pose::Running& play) {
        const std::uint32_t entry = play.clip->entry_of(node);
        if (play.drives(entry) && play.clip->entries()[entry].parts)
          pose::lay_over(play, entry, *nodes_, play.clock(stage_time, side), play.weight_at(side), motion);
      });
  return motion;
}

WorldMotion Animation::world(std::size_t node, double stage_time, Side side,
                             const ClockOverride& clock) const noexcept {
  return nodes_->world_motion(node, [&](std::size_t index) { return sample_node(index, stage_time, side, clock); });
}

NodeLook Animation::look(std::size_t node, double stage_time, Side side, const ClockOverride& own_clock) const {
  NodeLook look;
  pose::for_each_running(*plays_, bound_clips_->clips, bound_plays_->plays, stage_time, own_clock,
                         [&](const pose::Running& play) {
                           const std::uint32_t index = play.clip->entry_of(node);
                           if (!play.drives(index)) return;
                           const BoundClip::Entry& entry = play.clip->entries()[index];
                           if (!entry.has_color() && !entry.weights) return;
                           const ClipClock clock = play.clock(stage_time, side);
                           const Sample<double> weight = play.weight_at(side);
                           if (entry.has_color() && (clock.started || !look.color))
                             pose::fade_color(entry, clock, weight, (*nodes_)[node], look.color);
                           if (entry.weights && (clock.started || look.weights.empty()))
                             pose::fade_weights(*entry.weights, clock, weight, (*nodes_)[node], look.weights);
                         });
  return look;
}

bool Animation::animates(std::size_t node) const noexcept {
  const std::vector<char>& animated = bound_plays_->animated;
  while (node >= animated.size()) {
    node = (*nodes_)[node].parent;
    if (node == no_node) return false;
  }
  return animated[node] != 0;
}

Play Animation::play_under(const ClockOverride& clock, std::size_t index) const {
  Play play = (*plays_)[index];
  if (clock.clip != ClockOverride::every_clip) {
    play.at = std::min(play.at, clock.starts_by);
    play.weight = Curve<double>(1.0);
    play.mask.clear();
  }
  play.at = clock.stage_at(play.at);
  return play;
}

bool Animation::moved_by(std::size_t node, std::size_t play, bool unmasked) const noexcept {
  const BoundClip& clip = bound_clips_->clips[(*plays_)[play].clip];
  const std::vector<char>& masked = bound_plays_->plays[play].masked;
  for (std::size_t i = node; i != no_node; i = (*nodes_)[i].parent) {
    const std::uint32_t entry = clip.entry_of(i);
    if (entry == BoundClip::no_entry || !clip.entries()[entry].parts) continue;
    if (unmasked || masked.empty() || !masked[entry]) return true;
  }
  return false;
}

bool Animation::has_tracks(std::size_t node) const noexcept {
  return std::ranges::any_of(bound_clips_->clips,
                             [&](const BoundClip& clip) { return clip.entry_of(node) != BoundClip::no_entry; });
}

bool Animation::clip_moves(std::size_t clip, std::size_t node) const noexcept {
  const BoundClip& bound = bound_clips_->clips[clip];
  for (std::size_t i = node; i != no_node; i = (*nodes_)[i].parent)
    if (const std::uint32_t entry = bound.entry_of(i); entry != BoundClip::no_entry && bound.entries()[entry].parts)
      return true;
  return false;
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
