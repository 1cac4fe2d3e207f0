#include <tweenfall/anim/graph.h>

#include "graph/binder.h"
#include "pose/clip_values.h"

#include <algorithm>

namespace tweenfall {

std::vector<GraphFault> inspect(const GraphDescription& description, const Hierarchy& nodes,
                                std::span<const Clip> clips) {
  graphs::Binder binder(description, nodes, clips);
  binder.bind_all();
  return binder.take_faults();
}

namespace graphs {
namespace {

void resolve_user_tracks(Graph::Compiled& compiled, const Hierarchy& nodes, std::span<const Clip> clips) {
  for (const Clip& clip : clips)
    for (const Track& track : clip.tracks) {
      if (!pose::is_user_track(track)) continue;
      const std::string name = track.name();
      const auto has_it = [&](const auto& shown) { return shown->bound->user_track(name) != nullptr; };
      const Graph::Compiled::UserTrack entry{&track, nodes.find(track.node).value_or(no_node),
                                             std::ranges::any_of(compiled.clips, has_it)};
      compiled.user_tracks.emplace(name, entry);
    }
}

}  // namespace
}  // namespace graphs

Graph::Graph(std::shared_ptr<const Hierarchy> nodes, std::shared_ptr<const std::vector<Clip>> clips,
             GraphDescription description)
    : nodes_(std::move(nodes)), clips_(std::move(clips)), description_(std::move(description)) {
  graphs::Binder binder(description_, *nodes_, *clips_);
  binder.bind_all();
  std::string problems;
  for (const GraphFault& fault : binder.take_faults()) {
    problems += "\n  ";
    for (const std::string& part : fault.place) problems += "/" + part;
    problems += ": " + fault.message;
  }
  if (!problems.empty()) throw std::invalid_argument("a graph does not hold together:" + problems);
  std::unique_ptr<Compiled> compiled = binder.take_compiled();
  graphs::resolve_user_tracks(*compiled, *nodes_, *clips_);
  compiled_ = std::move(compiled);
}

Graph::~Graph() = default;

bool Graph::moves(std::size_t node) const noexcept {
  if (node < compiled_->moved.size() && compiled_->moved[node]) return true;
  return std::ranges::any_of(compiled_->clips, [&](const auto& clip) {
    const std::uint32_t entry = clip->bound->entry_of(node);
    return entry != pose::BoundClip::no_entry && clip->bound->entries()[entry].parts != 0;
  });
}

}  // namespace tweenfall
