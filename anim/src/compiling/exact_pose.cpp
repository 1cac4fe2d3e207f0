#include "compiling/exact_pose.h"

#include <tweenfall/anim/component.h>

#include <stdexcept>

namespace tweenfall::crowd {

std::optional<Kind> kind_of(const Track& track) {
  const std::optional<Component> component = component_named(track.property);
  switch (component ? component->property : property_named(track.property)) {
    case Property::position:
      return Kind::translation;
    case Property::rotation:
      return Kind::rotation;
    case Property::scale:
      return Kind::scale;
    default:
      return std::nullopt;
  }
}

ExactPose::ExactPose(const Clip& clip, const Hierarchy& nodes)
    : clip_(clip), nodes_(nodes), bound_(clip, nodes, problems_) {
  if (!problems_.empty()) throw std::invalid_argument("a clip does not fit the nodes of its crowd:" + problems_);
  for (Clip& part : clips_) part.duration = clip.duration;
  for (const Track& track : clip.tracks)
    if (const std::optional<Kind> kind = kind_of(track))
      clips_[static_cast<std::size_t>(*kind)].tracks.push_back(track);
  for (const Clip& part : clips_) parts_.emplace_back(part, nodes, problems_);
}

// At the end, the pose on which a play of the clip rests.
ClipClock ExactPose::clock(double time, Side side) const {
  const bool rests = time >= clip_.duration && !bound_.lands();
  return {.time = time, .rate = 1, .started = true, .side = rests ? Side::in : side};
}

Motion ExactPose::joint(std::size_t node, Kind kind, double time, Side side) const {
  Motion motion{.pose = nodes_[node].rest};
  const pose::BoundClip& part = parts_[static_cast<std::size_t>(kind)];
  const std::uint32_t entry = part.entry_of(node);
  if (entry != pose::BoundClip::no_entry) part.sample_entry(entry, nodes_, clock(time, side), motion);
  return motion;
}

void ExactPose::sample(double time, Side side, std::span<Motion> local, int round) const {
  for (std::size_t node = 0; node < nodes_.size(); ++node) local[node] = {.pose = nodes_[node].rest};
  ClipClock at = clock(time, side);
  at.cycle = round;
  at.climbs = clip_.loop.mode == LoopMode::repeat_offset;
  at.to = clip_.duration;
  bound_.sample(nodes_, at, local);
}

}  // namespace tweenfall::crowd
