#include "pose/bound_clip.h"

#include <tweenfall/curves/rotation.h>

#include <algorithm>
#include <cmath>

namespace tweenfall::pose {
namespace {

template <class T>
const T* required(const Track& track, const Clip& clip, const char* expected, std::string& problems) {
  if (const T* curve = std::get_if<T>(&track.curve)) return curve;
  problems += "\n  clip \"" + clip.name + "\": track \"" + track.name() + "\" must carry " + expected;
  return nullptr;
}

// The tracks of one node.
struct NodeTracks {
  BoundClip::Entry entry;
  MotionCurves::Parts curves;
};

void set_part(BoundClip::Entry& entry, Parts part, bool present, bool relative) {
  entry.parts = static_cast<Parts>(present ? entry.parts | part : entry.parts & ~part);
  entry.relative = static_cast<Parts>(present && relative ? entry.relative | part : entry.relative & ~part);
}

void bind_track(const Track& track, Property property, const Clip& clip, NodeTracks& node, std::string& problems) {
  switch (property) {
    case Property::position:
      node.curves.position = required<Curve<Vec3>>(track, clip, "vectors", problems);
      set_part(node.entry, position_part, node.curves.position != nullptr, track.relative);
      break;
    case Property::rotation:
      node.curves.rotation = required<Curve<Quat>>(track, clip, "rotations", problems);
      set_part(node.entry, rotation_part, node.curves.rotation != nullptr, track.relative);
      break;
    case Property::scale:
      node.curves.scale = required<Curve<Vec3>>(track, clip, "vectors", problems);
      set_part(node.entry, scale_part, node.curves.scale != nullptr, track.relative);
      break;
    case Property::color:
      node.entry.color = required<Curve<Color>>(track, clip, "colors", problems);
      break;
    case Property::weights:
      node.entry.weights = required<WeightCurves>(track, clip, "weights", problems);
      break;
    case Property::user:
      break;
  }
}

void set_gains(NodeTracks& node, const Clip& clip) {
  if (const Curve<Vec3>* curve = node.curves.position)
    node.entry.gain = curve->value(clip.duration, Side::in) - curve->value(0.0);
  if (const Curve<Quat>* curve = node.curves.rotation)
    node.entry.turn = log_map(curve->value(clip.duration, Side::in) * curve->value(0.0).conjugate());
}

}  // namespace

BoundClip::BoundClip(const Clip& clip, const Hierarchy& nodes, std::string& problems) : clip_(&clip) {
  entry_of_.assign(nodes.size(), no_entry);
  std::vector<NodeTracks> driven;
  for (const Track& track : clip.tracks) {
    const Property property = property_named(track.property);
    if (property == Property::user) continue;
    const std::optional<std::size_t> node = nodes.find(track.node);
    if (!node) {
      problems += "\n  clip \"" + clip.name + "\": there is no node \"" + track.node + "\"";
      continue;
    }
    std::uint32_t& index = entry_of_[*node];
    if (index == no_entry) {
      index = static_cast<std::uint32_t>(driven.size());
      driven.push_back({{.node = *node}, {}});
    }
    bind_track(track, property, clip, driven[index], problems);
  }
  if (!problems.empty()) return;
  std::ranges::sort(driven, {}, [](const NodeTracks& node) { return node.entry.node; });
  const bool climbs = clip.loop.mode == LoopMode::repeat_offset;
  finished_ = !climbs;
  for (NodeTracks& node : driven) {
    if (climbs && std::isfinite(clip.duration)) set_gains(node, clip);
    if (node.entry.relative) finished_ = false;
    entry_of_[node.entry.node] = static_cast<std::uint32_t>(entries_.size());
    entries_.push_back(node.entry);
    curves_.add(node.entry.node, node.curves);
  }
}

void BoundClip::sample(const Hierarchy& nodes, const ClipClock& clock, std::span<Motion> local) const noexcept {
  curves_.sample(clock.time, clock.side, clock.rate, local);
  if (finished_) return;
  for (const Entry& entry : entries_) finish(entry, nodes[entry.node].rest, clock, local[entry.node]);
}

void BoundClip::sample_entry(std::uint32_t index, const Hierarchy& nodes, const ClipClock& clock,
                             Motion& motion) const noexcept {
  curves_.sample_one(index, clock.time, clock.side, clock.rate, motion);
  if (!finished_) finish(entries_[index], nodes[entries_[index].node].rest, clock, motion);
}

// From what the curves say to the motion: a loop with offset goes on from where it was, and relative tracks compose
// with the rest pose.
void BoundClip::finish(const Entry& entry, const Pose& rest, const ClipClock& clock, Motion& motion) const noexcept {
  if (clip_->loop.mode == LoopMode::repeat_offset && clock.cycle != 0) {
    if (entry.parts & position_part) motion.pose.position += clock.cycle * entry.gain;
    if (entry.parts & rotation_part) {
      const Quat turned = exp_map(clock.cycle * entry.turn);
      motion.pose.rotation = turned * motion.pose.rotation;
      motion.twist.angular = turned * motion.twist.angular;
    }
  }
  if (entry.relative & position_part) {
    motion.pose.position = rest.position + rest.rotation * Vec3(rest.scale.cwiseProduct(motion.pose.position));
    motion.twist.linear = rest.rotation * Vec3(rest.scale.cwiseProduct(motion.twist.linear));
  }
  if (entry.relative & rotation_part) {
    motion.pose.rotation = rest.rotation * motion.pose.rotation;
    motion.twist.angular = rest.rotation * motion.twist.angular;
  }
  if (entry.relative & scale_part) {
    motion.pose.scale = rest.scale.cwiseProduct(motion.pose.scale);
    motion.scale_rate = rest.scale.cwiseProduct(motion.scale_rate);
  }
}

}  // namespace tweenfall::pose
