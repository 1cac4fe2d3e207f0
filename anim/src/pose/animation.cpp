#include <tweenfall/anim/animation.h>
#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tweenfall {

namespace {

/// The tracks of one play that drive one node.
struct NodeTracks {
  const Track* position = nullptr;
  const Track* rotation = nullptr;
  const Track* scale = nullptr;
  const Track* color = nullptr;
  const Track* weights = nullptr;

  [[nodiscard]] bool moves() const { return position || rotation || scale; }
};

/// A bound play: its index and what it drives.
struct Layer {
  std::size_t play;
  NodeTracks tracks;
};

template <class T>
Sample<T> per_stage_second(Sample<T> sample, double clock_rate) {
  sample.rate *= clock_rate;
  sample.acceleration *= clock_rate * clock_rate;
  return sample;
}

/// What a repeat-offset loop has gained after whole plays.
Vec3 gained(const Curve<Vec3>& curve, const Clip& clip, int cycle) {
  return cycle * (curve.value(clip.duration, Side::in) - curve.value(0.0));
}
Quat gained(const Curve<Quat>& curve, const Clip& clip, int cycle) {
  const Vec3 once = log_map(curve.value(clip.duration, Side::in) * curve.value(0.0).conjugate());
  return exp_map(cycle * once);
}

struct Layered {
  const Clip& clip;
  ClipClock clock;

  [[nodiscard]] bool accumulates() const { return clip.loop.mode == LoopMode::repeat_offset && clock.cycle != 0; }

  Sample<Vec3> position(const Track& track) const {
    const auto& curve = std::get<Curve<Vec3>>(track.curve);
    Sample<Vec3> sample = per_stage_second(curve.sample(clock.time, clock.side), clock.rate);
    if (accumulates()) sample.value += gained(curve, clip, clock.cycle);
    return sample;
  }
  Sample<Quat> rotation(const Track& track) const {
    const auto& curve = std::get<Curve<Quat>>(track.curve);
    Sample<Quat> sample = per_stage_second(curve.sample(clock.time, clock.side), clock.rate);
    if (accumulates()) {
      const Quat turned = gained(curve, clip, clock.cycle);
      sample.value = turned * sample.value;
      sample.rate = turned * sample.rate;
    }
    return sample;
  }
  Sample<Vec3> scale(const Track& track) const {
    return per_stage_second(std::get<Curve<Vec3>>(track.curve).sample(clock.time, clock.side), clock.rate);
  }
};

/// Replaces in `motion` what the tracks drive.
void apply(const NodeTracks& tracks, const Layered& layer, const Pose& rest, Motion& motion) {
  if (tracks.position) {
    const Sample<Vec3> sample = layer.position(*tracks.position);
    if (tracks.position->relative) {
      motion.pose.position = rest.position + rest.rotation * Vec3(rest.scale.cwiseProduct(sample.value));
      motion.twist.linear = rest.rotation * Vec3(rest.scale.cwiseProduct(sample.rate));
    } else {
      motion.pose.position = sample.value;
      motion.twist.linear = sample.rate;
    }
  }
  if (tracks.rotation) {
    const Sample<Quat> sample = layer.rotation(*tracks.rotation);
    if (tracks.rotation->relative) {
      motion.pose.rotation = rest.rotation * sample.value;
      motion.twist.angular = rest.rotation * sample.rate;
    } else {
      motion.pose.rotation = sample.value;
      motion.twist.angular = sample.rate;
    }
  }
  if (tracks.scale) {
    const Sample<Vec3> sample = layer.scale(*tracks.scale);
    const bool relative = tracks.scale->relative;
    motion.pose.scale = relative ? Vec3(rest.scale.cwiseProduct(sample.value)) : sample.value;
    motion.scale_rate = relative ? Vec3(rest.scale.cwiseProduct(sample.rate)) : sample.rate;
  }
}

/// Takes from `mixed` what the tracks drive, so that everything else keeps its bits.
void take_driven(const NodeTracks& tracks, const Motion& mixed, Motion& motion) {
  if (tracks.position) {
    motion.pose.position = mixed.pose.position;
    motion.twist.linear = mixed.twist.linear;
  }
  if (tracks.rotation) {
    motion.pose.rotation = mixed.pose.rotation;
    motion.twist.angular = mixed.twist.angular;
  }
  if (tracks.scale) {
    motion.pose.scale = mixed.pose.scale;
    motion.scale_rate = mixed.scale_rate;
  }
}

/// Before a play starts it has no say, save where nothing below it drives the property: there its first frame holds.
NodeTracks uncovered(NodeTracks tracks, const NodeTracks& below) {
  if (below.position) tracks.position = nullptr;
  if (below.rotation) tracks.rotation = nullptr;
  if (below.scale) tracks.scale = nullptr;
  return tracks;
}

void cover(NodeTracks& below, const NodeTracks& tracks) {
  if (tracks.position) below.position = tracks.position;
  if (tracks.rotation) below.rotation = tracks.rotation;
  if (tracks.scale) below.scale = tracks.scale;
}

bool driven_by(const Play& play, std::string_view node) {
  if (play.mask.empty()) return true;
  for (const std::string& pattern : play.mask)
    if (matches(pattern, node)) return true;
  return false;
}

template <class T>
const Track* require(const Track& track, const Clip& clip, const char* expected, std::string& problems) {
  if (std::holds_alternative<T>(track.curve)) return &track;
  problems += "\n  clip \"" + clip.name + "\": track \"" + track.name() + "\" must carry " + expected;
  return nullptr;
}

}  // namespace

struct Animation::Binding {
  std::vector<std::vector<Layer>> layers;  ///< by node, in order of the plays
  std::vector<char> animated;              ///< by node: it or an ancestor is moved by some play
};

Animation::Animation(std::shared_ptr<const Hierarchy> nodes, std::vector<Clip> clips, std::vector<Play> plays)
    : nodes_(std::move(nodes)), clips_(std::make_shared<const std::vector<Clip>>(std::move(clips))) {
  bind(std::move(plays));
}

Animation Animation::with_plays(std::vector<Play> plays) const {
  Animation other = *this;
  other.bind(std::move(plays));
  return other;
}

Animation Animation::with_nodes(std::shared_ptr<const Hierarchy> nodes) const {
  Animation other = *this;
  other.nodes_ = std::move(nodes);
  other.bind(other.plays_);
  return other;
}

void Animation::bind(std::vector<Play> plays) {
  plays_ = std::move(plays);
  auto binding = std::make_shared<Binding>();
  binding->layers.resize(nodes_->size());
  binding->animated.assign(nodes_->size(), 0);
  std::string problems;

  for (std::size_t p = 0; p < plays_.size(); ++p)
    if (plays_[p].clip >= clips_->size())
      problems += "\n  play " + std::to_string(p) + " names clip number " + std::to_string(plays_[p].clip) + " of " +
                  std::to_string(clips_->size());

  for (std::size_t c = 0; c < clips_->size(); ++c) {
    const Clip& clip = (*clips_)[c];
    std::vector<std::pair<std::size_t, NodeTracks>> driven;
    const auto tracks_of = [&](std::size_t node) -> NodeTracks& {
      for (auto& [index, tracks] : driven)
        if (index == node) return tracks;
      return driven.emplace_back(node, NodeTracks{}).second;
    };
    for (const Track& track : clip.tracks) {
      const Property property = property_named(track.property);
      if (property == Property::user) continue;
      const std::optional<std::size_t> node = nodes_->find(track.node);
      if (!node) {
        problems += "\n  clip \"" + clip.name + "\": there is no node \"" + track.node + "\"";
        continue;
      }
      NodeTracks& tracks = tracks_of(*node);
      switch (property) {
        case Property::position:
          tracks.position = require<Curve<Vec3>>(track, clip, "vectors", problems);
          break;
        case Property::rotation:
          tracks.rotation = require<Curve<Quat>>(track, clip, "rotations", problems);
          break;
        case Property::scale:
          tracks.scale = require<Curve<Vec3>>(track, clip, "vectors", problems);
          break;
        case Property::color:
          tracks.color = require<Curve<Color>>(track, clip, "colors", problems);
          break;
        case Property::weights:
          tracks.weights = require<WeightCurves>(track, clip, "weights", problems);
          break;
        case Property::user:
          break;
      }
    }
    for (std::size_t p = 0; p < plays_.size(); ++p) {
      if (plays_[p].clip != c) continue;
      for (const auto& [node, tracks] : driven) {
        if (!driven_by(plays_[p], (*nodes_)[node].name)) continue;
        binding->layers[node].push_back({p, tracks});
        if (tracks.moves()) binding->animated[node] = 1;
      }
    }
  }
  if (!problems.empty()) throw std::invalid_argument("clips do not fit their nodes:" + problems);

  for (std::size_t node = 0; node < nodes_->size(); ++node) {
    std::ranges::stable_sort(binding->layers[node], {}, &Layer::play);
    const std::size_t parent = (*nodes_)[node].parent;
    if (parent != no_node && binding->animated[parent]) binding->animated[node] = 1;
  }
  binding_ = std::move(binding);
}

Motion Animation::sample_node(std::size_t node, double stage_time, Side side) const noexcept {
  const Pose& rest = (*nodes_)[node].rest;
  Motion motion;
  motion.pose = rest;
  NodeTracks below;
  for (const Layer& layer : binding_->layers[node]) {
    const Play& play = plays_[layer.play];
    const Clip& clip = (*clips_)[play.clip];
    const Layered layered{clip, clock_at(play, clip, stage_time, side)};
    const NodeTracks tracks = layered.clock.started ? layer.tracks : uncovered(layer.tracks, below);
    cover(below, layer.tracks);
    if (!tracks.moves()) continue;
    const Sample<double> weight = play.weight.sample(stage_time, side);
    Motion over = motion;
    apply(tracks, layered, rest, over);
    if (weight.value == 1 && weight.rate == 0)
      motion = over;
    else
      take_driven(tracks, mix(motion, over, weight.value, weight.rate), motion);
  }
  return motion;
}

void Animation::sample(double stage_time, std::span<Motion> local, Side side) const noexcept {
  for (std::size_t node = 0; node < nodes_->size(); ++node) local[node] = sample_node(node, stage_time, side);
}

WorldMotion Animation::world(std::size_t node, double stage_time, Side side) const noexcept {
  return nodes_->world_motion(node, [&](std::size_t index) { return sample_node(index, stage_time, side); });
}

NodeLook Animation::look(std::size_t node, double stage_time, Side side) const {
  NodeLook look;
  for (const Layer& layer : binding_->layers[node]) {
    if (!layer.tracks.color && !layer.tracks.weights) continue;
    const Play& play = plays_[layer.play];
    const Clip& clip = (*clips_)[play.clip];
    const ClipClock clock = clock_at(play, clip, stage_time, side);
    const Sample<double> weight = play.weight.sample(stage_time, side);
    if (const Track* track = layer.tracks.color; track && (clock.started || !look.color)) {
      Sample<Color> over = std::get<Curve<Color>>(track->curve).sample(clock.time, clock.side);
      over.rate *= clock.rate;
      over.acceleration *= clock.rate * clock.rate;
      if (look.color && !(weight.value == 1 && weight.rate == 0)) {
        const Sample<Color> under = *look.color;
        const Vec4 difference = over.value.rgba - under.value.rgba, rate_difference = over.rate - under.rate;
        over.value.rgba = under.value.rgba + weight.value * difference;
        over.rate = under.rate + weight.value * rate_difference + weight.rate * difference;
        over.acceleration = under.acceleration + weight.value * (over.acceleration - under.acceleration) +
                            2 * weight.rate * rate_difference + weight.acceleration * difference;
      }
      look.color = over;
    }
    if (const Track* track = layer.tracks.weights; track && (clock.started || look.weights.empty())) {
      const auto& curves = std::get<WeightCurves>(track->curve);
      look.weights.resize(std::max(look.weights.size(), curves.size()), Sample<double>{0, 0, 0});
      for (std::size_t i = 0; i < curves.size(); ++i) {
        const Sample<double> over = per_stage_second(curves[i].sample(clock.time, clock.side), clock.rate);
        Sample<double>& under = look.weights[i];
        const double difference = over.value - under.value, rate_difference = over.rate - under.rate;
        under.acceleration += weight.value * (over.acceleration - under.acceleration) +
                              2 * weight.rate * rate_difference + weight.acceleration * difference;
        under.rate += weight.value * rate_difference + weight.rate * difference;
        under.value = weight.value == 1 ? over.value : under.value + weight.value * difference;
      }
    }
  }
  return look;
}

bool Animation::animates(std::size_t node) const noexcept {
  return binding_->animated[node] != 0;
}

bool Animation::moved_by(std::size_t node, std::size_t play) const noexcept {
  for (std::size_t i = node; i != no_node; i = (*nodes_)[i].parent)
    for (const Layer& layer : binding_->layers[i])
      if (layer.play == play && layer.tracks.moves()) return true;
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
