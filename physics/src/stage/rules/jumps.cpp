#include <algorithm>

#include "stage/stage_data.h"

namespace tweenfall::staging {

namespace {

/// Whether a track moves a body: others may jump as they like, since physics need not know.
TrackFilter carrying(const StageState& state, const std::vector<char>& carriers) {
  return [&nodes = *state.nodes, &carriers](const Track& track) {
    const auto node = nodes.find(track.node);
    return node && *node < carriers.size() && carriers[*node] && moves_its_node(track);
  };
}

/// By node: whether it or something below it has a body that can move.
std::vector<char> carriers(const StageState& state) {
  std::vector<char> carries(state.nodes->size(), 0);
  for (NodeId node = carries.size(); node-- > 0;) {
    const StagedBody* body = state.body(node);
    if (body && !state.world.is_fixed(body->id)) carries[node] = 1;
    const std::size_t parent = (*state.nodes)[node].parent;
    if (carries[node] && parent != no_node) carries[parent] = 1;
  }
  return carries;
}

}  // namespace

std::shared_ptr<const Jumps> find_jumps(const StageState& state) {
  auto jumps = std::make_shared<Jumps>();
  jumps->carriers = carriers(state);
  jumps->search = JumpSearch(*state.animation, carrying(state, jumps->carriers));
  return jumps;
}

std::shared_ptr<const Jumps> jumps_of_plays(const StageState& state) {
  auto jumps = std::make_shared<Jumps>(*state.jumps);
  jumps->search = jumps->search.with_plays_of(*state.animation, carrying(state, jumps->carriers));
  return jumps;
}

bool carries_more(const StageState& state, NodeId node) {
  const std::vector<char>& known = state.jumps->carriers;
  for (NodeId i = node; i != no_node && !(i < known.size() && known[i]); i = (*state.nodes)[i].parent)
    if (state.animation->has_tracks(i)) return true;
  return false;
}

double first_jump(const StageState& state, double from, double to) {
  const auto first_by = [&](const ClockOverride& clock) {
    return state.jumps->search.first(*state.animation, from, to, clock);
  };
  double first = first_by({});
  ClockOverride asked;  // bodies that come back together run by the same clock
  for (const StagedBody& body : state.bodies)
    if (body.present && body.path.clock() != asked && body.path.clock() != ClockOverride{}) {
      asked = body.path.clock();
      first = std::min(first, first_by(asked));
    }
  return first;
}

}  // namespace tweenfall::staging
