#include "page/content/page_frames.h"

#include <algorithm>

namespace tweenfall::page {

namespace {

constexpr std::size_t least_frames = 60;
constexpr std::size_t most_handoffs = 200;  // hand-offs whose neighboring frames are kept

bool node_moves(const NodeRecord& node) {
  return std::any_of(node.world.begin(), node.world.end(), [&](const WorldMotion& world) {
    return world.motion.pose.position != node.world.front().motion.pose.position ||
           world.linear != node.world.front().linear;
  });
}

}  // namespace

std::vector<std::size_t> page_frames(const Recording& recording) {
  const std::size_t count = recording.times.size();
  const auto moving =
      static_cast<std::size_t>(std::count_if(recording.nodes.begin(), recording.nodes.end(), node_moves));
  const std::size_t most = std::max(least_frames, most_page_places / std::max<std::size_t>(1, moving));
  std::vector<std::size_t> frames;
  if (count <= most) {
    for (std::size_t frame = 0; frame < count; ++frame) frames.push_back(frame);
    return frames;
  }
  for (std::size_t i = 0; i < most; ++i) frames.push_back(i * (count - 1) / (most - 1));
  for (std::size_t i = 0; i < std::min(most_handoffs, recording.handoffs.size()); ++i) {
    const auto after = std::lower_bound(recording.times.begin(), recording.times.end(), recording.handoffs[i].time);
    const auto at = static_cast<std::size_t>(after - recording.times.begin());
    if (at > 0 && at < count) frames.insert(frames.end(), {at - 1, at});
  }
  std::sort(frames.begin(), frames.end());
  frames.erase(std::unique(frames.begin(), frames.end()), frames.end());
  return frames;
}

}  // namespace tweenfall::page
