#include "graph/look.h"

#include <tweenfall/curves/barycentric.h>

#include "pose/clip_look.h"
#include "pose/clip_values.h"

#include <algorithm>
#include <utility>

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

Sample<double> less(const Sample<double>& a, const Sample<double>& b) noexcept {
  return {a.value - b.value, a.rate - b.rate, a.acceleration - b.acceleration};
}

/// Calls `visit(clip, clock, share, added)` for each clip that shows, and with a null clip for what shows of the pose
/// below. The shares sum to 1; those of what layers add, less what they add it to, sum to 0.
/// @param adds  layers that add count, too
template <class Visit>
void each_share(const Log& log, const Graph& graph, std::size_t node, const Moment& moment, bool adds,
                const Visit& visit) {
  Bearers bearers;
  bearers.adds = adds;
  graph.compiled().output->bearers(log, moment, node, {1, 0, 0}, bearers);
  Sample<double> left{1, 0, 0}, taken{0, 0, 0};
  bool alone = true;
  for (std::size_t i = 0; i < bearers.count; ++i) {
    const Bearer& each = bearers.list[i];
    visit(each.operation->own_clips()[each.clip],
          each.operation->clock_of(log, each.clip, {moment.time, moment.side, each.start}), each.weight, each.added);
    Sample<double>& rest = each.added ? taken : left;
    rest = less(rest, each.weight);
    alone = alone && each.added;
  }
  left.value = std::max(left.value, 0.0);
  if (alone || !is_nothing(left)) visit(nullptr, ClipClock(), left, false);
  if (!is_nothing(taken)) visit(nullptr, ClipClock(), taken, true);
}

/// Values with their shares.
template <class T>
struct Shared {
  std::vector<T> values;
  std::vector<Sample<double>> shares;

  void add(T value, const Sample<double>& share) {
    values.push_back(std::move(value));
    shares.push_back(share);
  }
};

/// Colors of looks, in which layers that add have had no say yet.
std::optional<Sample<Color>> mean_color(const Shared<NodeLook>& looks, const Node& node) {
  if (looks.values.size() == 1) return looks.values.front().color;
  std::vector<Sample<Color>> colors;
  colors.reserve(looks.values.size());
  for (const NodeLook& look : looks.values) colors.push_back(color_or_own(look.color, node));
  return barycentric(colors, looks.shares, ColorSpace::linear);
}

}  // namespace

NodeLook look_of(const Log& log, const Graph& graph, std::size_t node, const Moment& moment, const NodeLook& below) {
  const Node& described = graph.nodes()[node];
  Shared<NodeLook> mixed, added;
  const auto visit = [&](const pose::BoundClip* clip, const ClipClock& clock, const Sample<double>& share, bool adds) {
    NodeLook look = below;
    const std::uint32_t entry = clip ? clip->entry_of(node) : pose::BoundClip::no_entry;
    if (entry != pose::BoundClip::no_entry)
      pose::lay_look_over(clip->entries()[entry], clock, false, {1, 0, 0}, described, look);
    (adds ? added : mixed).add(std::move(look), share);
  };
  each_share(log, graph, node, moment, true, visit);
  if (mixed.values.size() == 1 && added.values.empty()) return mixed.values.front();
  NodeLook result;
  const auto has_color = [](const NodeLook& look) { return look.color.has_value(); };
  if (std::ranges::any_of(mixed.values, has_color) || std::ranges::any_of(added.values, has_color)) {
    result.color = color_or_own(mean_color(mixed, described), described);
    for (std::size_t i = 0; i < added.values.size(); ++i)
      pose::add_share(*result.color, color_or_own(added.values[i].color, described), added.shares[i]);
  }
  std::size_t morphs = 0;
  for (const auto* looks : {&mixed, &added})
    for (const NodeLook& look : looks->values) morphs = std::max(morphs, look.weights.size());
  for (std::size_t m = 0; m < morphs; ++m) {
    std::vector<Sample<double>> weights;
    weights.reserve(mixed.values.size());
    for (const NodeLook& look : mixed.values) weights.push_back(weight_or_own(look, m, described));
    Sample<double> weight = barycentric<double>(weights, mixed.shares);
    for (std::size_t i = 0; i < added.values.size(); ++i)
      pose::add_share(weight, weight_or_own(added.values[i], m, described), added.shares[i]);
    result.weights.push_back(weight);
  }
  return result;
}

UserValue user_value_of(const Log& log, const Graph& graph, std::string_view track, std::size_t node,
                        const Moment& moment, const UserValue& below) {
  const bool adds = pose::has_sums(below);
  Shared<UserValue> mixed, added;
  const auto visit = [&](const pose::BoundClip* clip, const ClipClock& clock, const Sample<double>& share, bool over) {
    const Track* own = clip ? clip->user_track(track) : nullptr;
    const bool has = own && own->curve.index() == below.index();
    (over ? added : mixed).add(has ? pose::user_value_of(own->curve, clock) : below, share);
  };
  each_share(log, graph, node, moment, adds, visit);
  UserValue value = mixed.values.size() == 1 ? mixed.values.front() : pose::mean_of(mixed.values, mixed.shares);
  for (std::size_t i = 0; i < added.values.size(); ++i) pose::add_share(value, added.values[i], added.shares[i]);
  return value;
}

}  // namespace tweenfall::graphs
