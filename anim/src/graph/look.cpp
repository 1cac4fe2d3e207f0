#include "graph/look.h"

#include <tweenfall/anim/blend_values.h>

#include "pose/clip_look.h"

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

}  // namespace

NodeLook look_of(const Log& log, const Graph& graph, std::size_t node, const Moment& moment, const NodeLook& below) {
  Bearers bearers;
  graph.compiled().output->bearers(log, moment, node, {1, 0, 0}, bearers);
  const Node& described = graph.nodes()[node];
  std::vector<NodeLook> looks;
  std::vector<Sample<double>> shares;
  Sample<double> left{1, 0, 0};
  bool colored = false;
  std::size_t morphs = 0;
  const auto add = [&](NodeLook look, const Sample<double>& share) {
    colored = colored || look.color;
    morphs = std::max(morphs, look.weights.size());
    looks.push_back(std::move(look));
    shares.push_back(share);
  };
  for (std::size_t i = 0; i < bearers.count; ++i) {
    const Bearer& each = bearers.list[i];
    const pose::BoundClip& clip = *each.operation->own_clips()[each.clip];
    const std::uint32_t entry = clip.entry_of(node);
    NodeLook look = below;
    if (entry != pose::BoundClip::no_entry) {
      const ClipClock clock = each.operation->clock_of(log, each.clip, {moment.time, moment.side, each.start});
      pose::lay_look_over(clip.entries()[entry], clock, false, {1, 0, 0}, described, look);
    }
    if (is_whole(each.weight)) return look;
    add(std::move(look), each.weight);
    left = {left.value - each.weight.value, left.rate - each.weight.rate, left.acceleration - each.weight.acceleration};
  }
  if (!is_nothing(left)) add(below, {std::max(left.value, 0.0), left.rate, left.acceleration});
  NodeLook mean;
  if (colored) {
    std::vector<Sample<Color>> colors;
    colors.reserve(looks.size());
    for (const NodeLook& look : looks) colors.push_back(color_or_own(look.color, described));
    mean.color = blend<Color>(colors, shares, colors.front());
  }
  for (std::size_t m = 0; m < morphs; ++m) {
    std::vector<Sample<double>> weights;
    weights.reserve(looks.size());
    for (const NodeLook& look : looks) weights.push_back(weight_or_own(look, m, described));
    mean.weights.push_back(blend<double>(weights, shares, weights.front()));
  }
  return mean;
}

}  // namespace tweenfall::graphs
