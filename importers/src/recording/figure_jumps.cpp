#include "recording/figure_jumps.h"

#include <algorithm>

namespace tweenfall::recordings {

namespace {

bool carries(const Recording& recording, std::size_t above, std::size_t node) {
  while (node != no_node && node != above) node = recording.nodes[node].parent;
  return node == above;
}

}  // namespace

std::vector<FigureJump> jumps_of(const figures::Figure& figure, const Recording& recording) {
  std::vector<FigureJump> found;
  if (figure.node == no_node || figure.fixed || !figure.name.empty()) return found;
  const bool whole = figure.kind == figures::Figure::Kind::bones;
  const std::vector<double>& times = recording.times;
  for (const JumpRecord& jump : recording.jumps) {
    if (jump.kind != JumpRecord::Kind::motion) continue;
    if (!carries(recording, jump.node, figure.node) && !(whole && carries(recording, figure.node, jump.node))) continue;
    const auto frame = static_cast<std::size_t>(std::ranges::lower_bound(times, jump.time) - times.begin());
    if (frame == 0 || frame == times.size()) continue;
    // What is on its own by then is not carried along.
    if (recording.nodes[figure.node].owner[frame] == Owner::free) continue;
    if (found.empty() || found.back().frame != frame) found.push_back({frame, jump.time});
  }
  return found;
}

std::vector<std::size_t> frames_of(const std::vector<FigureJump>& jumps) {
  std::vector<std::size_t> frames;
  frames.reserve(jumps.size());
  for (const FigureJump& jump : jumps) frames.push_back(jump.frame);
  return frames;
}

}  // namespace tweenfall::recordings
