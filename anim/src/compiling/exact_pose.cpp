#include "compiling/exact_pose.h"

#include <stdexcept>

namespace tweenfall::crowd {

ExactPose::ExactPose(const Clip& clip, const Hierarchy& nodes)
    : clip_(clip), nodes_(nodes), bound_(clip, nodes, problems_) {
  if (!problems_.empty()) throw std::invalid_argument("a clip does not fit the nodes of its crowd:" + problems_);
}

// At the end, the pose on which a play of the clip rests.
ClipClock ExactPose::clock(double time, Side side) const {
  const bool rests = time >= clip_.duration && !bound_.lands();
  return {.time = time, .rate = 1, .started = true, .side = rests ? Side::in : side};
}

Motion ExactPose::joint(std::size_t node, double time, Side side) const {
  Motion motion{.pose = nodes_[node].rest};
  const std::uint32_t entry = bound_.entry_of(node);
  if (entry != pose::BoundClip::no_entry) bound_.sample_entry(entry, nodes_, clock(time, side), motion);
  return motion;
}

void ExactPose::sample(double time, Side side, std::span<Motion> local) const {
  for (std::size_t node = 0; node < nodes_.size(); ++node) local[node] = {.pose = nodes_[node].rest};
  bound_.sample(nodes_, clock(time, side), local);
}

}  // namespace tweenfall::crowd
