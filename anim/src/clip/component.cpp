#include <tweenfall/anim/component.h>
#include <tweenfall/curves/functions.h>
#include <tweenfall/curves/leaps.h>

#include <algorithm>
#include <cstdint>
#include <map>

namespace tweenfall {

namespace clips {
namespace {

constexpr std::string_view axes = "xyz", channels = "rgba";

/// The numbers of a property that a track drives, one bit for each.
std::uint32_t numbers_of(std::string_view property) noexcept {
  const auto at = [](Property which, std::uint32_t bits) { return bits << (4 * static_cast<int>(which)); };
  if (const auto component = component_named(property)) return at(component->property, 1u << component->index);
  const Property whole = property_named(property);
  return whole == Property::user ? 0 : at(whole, 15);
}

constexpr std::uint32_t angle_bits = 7u << (4 * static_cast<int>(Property::rotation));

/// A curve made of another, with its knots and its leaps.
Curve<double> like(const Curve<double>& curve, Curve<double>::Formula formula) {
  const std::span<const NumberOverTime> parts = leaping(curve);
  return with_leaping(curve.knots().empty()
                          ? Curve<double>(std::move(formula), curve.start(), curve.end())
                          : Curve<double>(std::move(formula), {curve.knots().begin(), curve.knots().end()}),
                      parts);
}

Curve<double> moved_by(const Curve<double>& curve, double offset) {
  if (offset == 0) return curve;
  const auto sampler = [curve, offset](double time, Side side) {
    Sample<double> sample = curve.sample(time, side);
    sample.value += offset;
    return sample;
  };
  return like(curve, sampler);
}

Curve<double> times(const Curve<double>& curve, double factor) {
  const auto sampler = [curve, factor](double time, Side side) {
    const Sample<double> sample = curve.sample(time, side);
    return Sample<double>{sample.value * factor, sample.rate * factor, sample.acceleration * factor};
  };
  return like(curve, sampler);
}

/// The components of one property of one node.
struct Parts {
  std::array<const Track*, 4> tracks{};
};

const Curve<double>& numbers(const Track& track) {
  return std::get<Curve<double>>(track.curve);
}

Curve<Vec3> vector_of(const Parts& parts, Property property, const Pose& rest) {
  const bool factors = property == Property::scale;
  const Vec3& own = factors ? rest.scale : rest.position;
  std::array<Curve<double>, 3> all{Curve<double>(own[0]), Curve<double>(own[1]), Curve<double>(own[2])};
  for (std::size_t i = 0; i < 3; ++i) {
    const Track* track = parts.tracks[i];
    if (!track) continue;
    const double mine = own[static_cast<Eigen::Index>(i)];
    all[i] = !track->relative ? numbers(*track)
             : factors        ? times(numbers(*track), mine)
                              : moved_by(numbers(*track), mine);
  }
  return parametric(all[0], all[1], all[2]);
}

Curve<Color> color_of(const Parts& parts, const std::optional<Color>& own) {
  const Color below = own.value_or(Color{Vec4(1, 1, 1, 1)});
  std::vector<double> knots;
  for (const Track* track : parts.tracks)
    if (track) knots.insert(knots.end(), numbers(*track).knots().begin(), numbers(*track).knots().end());
  std::ranges::sort(knots);
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  std::array<std::optional<Curve<double>>, 4> curves{};
  std::vector<NumberOverTime> leaps;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!parts.tracks[i]) continue;
    curves[i] = numbers(*parts.tracks[i]);
    const std::span<const NumberOverTime> leaping_parts = leaping(*curves[i]);
    leaps.insert(leaps.end(), leaping_parts.begin(), leaping_parts.end());
  }
  const auto sampler = [curves, below](double time, Side side) {
    Sample<Color> sample{below, Vec4::Zero(), Vec4::Zero()};
    for (std::size_t i = 0; i < 4; ++i) {
      if (!curves[i]) continue;
      const Sample<double> number = curves[i]->sample(time, side);
      const auto place = static_cast<Eigen::Index>(i);
      sample.value.rgba[place] = number.value;
      sample.rate[place] = number.rate;
      sample.acceleration[place] = number.acceleration;
    }
    return sample;
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return with_leaping(
      knots.empty() ? Curve<Color>(sampler, -infinity, infinity) : Curve<Color>(sampler, std::move(knots)), leaps);
}

}  // namespace
}  // namespace clips

std::optional<Component> component_named(std::string_view word) noexcept {
  const std::size_t dot = word.find('.');
  if (dot == std::string_view::npos || dot + 2 != word.size()) return {};
  const Property property = property_named(word.substr(0, dot));
  if (property == Property::user || property == Property::weights) return {};
  const std::size_t index = (property == Property::color ? clips::channels : clips::axes).find(word.back());
  if (index == std::string_view::npos) return {};
  return Component{property, static_cast<int>(index)};
}

std::size_t property_dot(std::string_view track_name) noexcept {
  const std::size_t last = track_name.rfind('.');
  if (last == std::string_view::npos || last == 0) return last;
  const std::size_t before = track_name.rfind('.', last - 1);
  if (before == std::string_view::npos || before == 0) return last;
  return component_named(track_name.substr(before + 1)) ? before : last;
}

bool is_of_three_axes(const EulerOrder& order) noexcept {
  const int* axes = order.axes;
  return axes[0] != axes[1] && axes[1] != axes[2] && axes[0] != axes[2];
}

std::vector<Rivals> rivals(std::span<const Track> tracks) {
  struct OfNode {
    std::vector<std::pair<std::size_t, std::uint32_t>> tracks;
    std::uint32_t numbers = 0;
    std::optional<std::size_t> angle;
  };
  std::map<std::string_view, OfNode> nodes;
  std::vector<Rivals> found;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    const Track& track = tracks[i];
    const std::uint32_t numbers = clips::numbers_of(track.property);
    if (numbers == 0) continue;
    OfNode& node = nodes[track.node];
    const auto named = [&](std::size_t other) {
      return "\"" + tracks[other].name() + "\" and \"" + track.name() + "\"";
    };
    if (node.numbers & numbers) {
      const auto other = std::ranges::find_if(node.tracks, [&](const auto& each) { return each.second & numbers; });
      found.push_back({other->first, i, named(other->first) + " drive the same number"});
    }
    if ((numbers & clips::angle_bits) && component_named(track.property)) {
      if (node.angle && tracks[*node.angle].order != track.order)
        found.push_back({*node.angle, i, named(*node.angle) + " are angles of one rotation in two orders"});
      node.angle = node.angle.value_or(i);
    }
    node.numbers |= numbers;
    node.tracks.emplace_back(i, numbers);
  }
  return found;
}

Curve<Quat> turned_by(const std::array<const Track*, 3>& angles, const Quat& rest) {
  EulerOrder order;
  for (const Track* track : angles)
    if (track) order = track->order;
  const bool at_rest = rest.vec().isZero(0);
  const Vec3 own = at_rest ? Vec3(0, 0, 0) : to_euler(rest, order);
  std::array<Curve<double>, 3> turns{Curve<double>(own[0]), Curve<double>(own[1]), Curve<double>(own[2])};
  int only = -1, count = 0;
  for (std::size_t place = 0; place < 3; ++place) {
    const int axis = order.axes[place];
    const Track* track = angles[static_cast<std::size_t>(axis)];
    if (!track) continue;
    const double offset = track->relative ? own[static_cast<Eigen::Index>(place)] : 0;
    turns[place] = clips::moved_by(clips::numbers(*track), offset);
    only = axis;
    ++count;
  }
  if (count == 1 && at_rest)
    return axis_curve(Vec3::Unit(only), clips::numbers(*angles[static_cast<std::size_t>(only)]));
  return euler_curve(parametric(turns[0], turns[1], turns[2]), order);
}

Clip with_whole_tracks(const Clip& clip, const std::function<const Node*(std::string_view)>& node_named) {
  Clip whole = clip;
  whole.tracks.clear();
  std::map<std::pair<std::string_view, Property>, std::size_t> places;
  std::vector<std::pair<const Node*, clips::Parts>> made;
  std::vector<Property> properties;
  for (const Track& track : clip.tracks) {
    const auto component = component_named(track.property);
    const Node* node = component ? node_named(track.node) : nullptr;
    if (!node || !std::holds_alternative<Curve<double>>(track.curve)) {
      whole.tracks.push_back(track);
      continue;
    }
    const auto [place, is_new] = places.try_emplace({track.node, component->property}, made.size());
    if (is_new) {
      made.emplace_back(node, clips::Parts{});
      properties.push_back(component->property);
    }
    made[place->second].second.tracks[static_cast<std::size_t>(component->index)] = &track;
  }
  for (std::size_t i = 0; i < made.size(); ++i) {
    const auto& [node, parts] = made[i];
    const char* words[] = {"position", "rotation", "scale", "color"};
    const char* word = words[static_cast<int>(properties[i])];
    const auto add = [&, of = node](TrackCurve curve) { whole.tracks.push_back({of->name, word, std::move(curve)}); };
    if (properties[i] == Property::rotation)
      add(turned_by({parts.tracks[0], parts.tracks[1], parts.tracks[2]}, node->rest.rotation));
    else if (properties[i] == Property::color)
      add(clips::color_of(parts, node->color));
    else
      add(clips::vector_of(parts, properties[i], node->rest));
  }
  return whole;
}

}  // namespace tweenfall
