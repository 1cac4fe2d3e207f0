#include "graph/look.h"

#include <tweenfall/curves/barycentric.h>

#include "pose/clip_look.h"
#include "pose/clip_values.h"

#include <algorithm>

namespace tweenfall::graphs {

namespace {

Sample<Color> color_or_own(const std::optional<Sample<Color>>& color, const Node& node) {
  if (color) return *color;
  return {node.color.value_or(Color{Vec4(1, 1, 1, 1)}), Vec4(0, 0, 0, 0), Vec4(0, 0, 0, 0)};
}

Sample<double> weight_or_own(const NodeLook& look, std::size_t i, const Node& node) {
  if (i < look.weights.size()) return look.weights[i];
  return {i < node.weights.size() ? node.weights[i] : 0, 0, 0};
}

/// Calls `visit(clip, clock, share)` for each clip that shows, and with a null clip for what shows of the pose below;
/// the shares sum to 1.
/// @param adds  layers that add count, too: then some shares are below 0
template <class Visit>
void each_share(const Log& log, const Graph& graph, std::size_t node, const Moment& moment, bool adds,
                const Visit& visit) {
  Bearers bearers;
  bearers.adds = adds;
  graph.compiled().output->bearers(log, moment, node, {1, 0, 0}, bearers);
  Sample<double> left{1, 0, 0};
  for (std::size_t i = 0; i < bearers.count; ++i) {
    const Bearer& each = bearers.list[i];
    visit(each.operation->own_clips()[each.clip],
          each.operation->clock_of(log, each.clip, {moment.time, moment.side, each.start}), each.weight);
    left = {left.value - each.weight.value, left.rate - each.weight.rate, left.acceleration - each.weight.acceleration};
  }
  if (!adds) left.value = std::max(left.value, 0.0);
  if (bearers.count == 0 || !is_nothing(left)) visit(nullptr, ClipClock(), left);
}

}  // namespace

NodeLook look_of(const Log& log, const Graph& graph, std::size_t node, const Moment& moment, const NodeLook& below) {
  const Node& described = graph.nodes()[node];
  std::vector<NodeLook> looks;
  std::vector<Sample<double>> shares;
  each_share(log, graph, node, moment, true,
             [&](const pose::BoundClip* clip, const ClipClock& clock, const Sample<double>& share) {
               NodeLook& look = looks.emplace_back(below);
               shares.push_back(share);
               const std::uint32_t entry = clip ? clip->entry_of(node) : pose::BoundClip::no_entry;
               if (entry != pose::BoundClip::no_entry)
                 pose::lay_look_over(clip->entries()[entry], clock, false, {1, 0, 0}, described, look);
             });
  if (looks.size() == 1) return looks.front();
  NodeLook mean;
  if (std::ranges::any_of(looks, [](const NodeLook& look) { return look.color.has_value(); })) {
    std::vector<Sample<Color>> colors;
    colors.reserve(looks.size());
    for (const NodeLook& look : looks) colors.push_back(color_or_own(look.color, described));
    mean.color = barycentric(colors, shares, ColorSpace::linear);
  }
  std::size_t morphs = 0;
  for (const NodeLook& look : looks) morphs = std::max(morphs, look.weights.size());
  for (std::size_t m = 0; m < morphs; ++m) {
    std::vector<Sample<double>> weights;
    weights.reserve(looks.size());
    for (const NodeLook& look : looks) weights.push_back(weight_or_own(look, m, described));
    mean.weights.push_back(barycentric<double>(weights, shares));
  }
  return mean;
}

UserValue user_value_of(const Log& log, const Graph& graph, std::string_view track, const Moment& moment,
                        const UserValue& below) {
  const std::size_t dot = track.rfind('.');
  const std::size_t node = graph.nodes().find(track.substr(0, dot)).value_or(no_node);
  std::vector<UserValue> values;
  std::vector<Sample<double>> shares;
  const bool adds = !std::holds_alternative<Sample<Quat>>(below);
  each_share(log, graph, node, moment, adds,
             [&](const pose::BoundClip* clip, const ClipClock& clock, const Sample<double>& share) {
               const Track* own = clip ? clip->user_track(track) : nullptr;
               const bool has = own && own->curve.index() == below.index();
               values.push_back(has ? pose::user_value_of(own->curve, clock) : below);
               shares.push_back(share);
             });
  return values.size() == 1 ? values.front() : pose::mean_of(values, shares);
}

}  // namespace tweenfall::graphs
