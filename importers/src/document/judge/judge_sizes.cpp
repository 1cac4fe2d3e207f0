#include <tweenfall/anim/component.h>

#include "document/judge/instants.h"
#include "document/judge/judge.h"

#include <optional>
#include <variant>
#include <vector>

namespace tweenfall::document::judging {

namespace {

constexpr double least_change = 1e-6;  // of a scale: files hold them as floats

// Whether a track of sizes ever differs from the size of the node at rest.
bool changes_size(const Track& track, const Vec3& rest, double duration) {
  double most = 0;
  if (const auto* whole = std::get_if<Curve<Vec3>>(&track.curve); whole && track.property == "scale") {
    const Vec3 usual = track.relative ? Vec3(1, 1, 1) : rest;
    look_along(*whole, duration, [&](double time, Side side) {
      most = std::max(most, (whole->value(time, side) - usual).cwiseAbs().maxCoeff());
    });
  }
  const std::optional<Component> part = component_named(track.property);
  if (const auto* one = std::get_if<Curve<double>>(&track.curve); one && part && part->property == Property::scale) {
    const double usual = track.relative ? 1 : rest[part->index];
    look_along(*one, duration,
               [&](double time, Side side) { most = std::max(most, std::abs(one->value(time, side) - usual)); });
  }
  return most > least_change;
}

// Whether others can collide with it.
bool collides(const std::optional<BodyDescription>& body) {
  return body && !body->sensor && body->collides_with != 0;
}

struct Resized {
  std::size_t first = no_node;  // node with a body
  std::size_t count = 0;
};

// The colliders at or below the node of each track of a clip that changes sizes; of several on one path to the root,
// the lowest.
std::vector<Resized> resized_by(const Building& building, const Clip& clip) {
  const std::vector<NodeDescription>& nodes = building.stage.nodes;
  const std::size_t none = clip.tracks.size();
  std::vector<std::size_t> by(nodes.size(), none);
  std::vector<Resized> resized(clip.tracks.size());
  bool any = false;
  for (std::size_t i = 0; i < clip.tracks.size(); ++i) {
    const Track& track = clip.tracks[i];
    if (!track.property.starts_with("scale")) continue;
    const auto node = building.nodes.find(track.node);
    if (node == building.nodes.end() || !changes_size(track, nodes[node->second].rest.scale, clip.duration)) continue;
    by[node->second] = std::min(by[node->second], i);
    any = true;
  }
  for (std::size_t i = 0; any && i < nodes.size(); ++i) {
    if (by[i] == none && nodes[i].parent != no_node) by[i] = by[nodes[i].parent];
    if (by[i] == none || !collides(nodes[i].body)) continue;
    if (resized[by[i]].count++ == 0) resized[by[i]].first = i;
  }
  return resized;
}

std::string said_of(const Track& track, const std::string& body, std::size_t others) {
  const std::string name = json::in_quotes(track.name()) + " scales only what is drawn: the ";
  if (others == 0) return name + "body of " + json::in_quotes(body) + " collides in the size that it has at rest";
  return name + "bodies of " + json::in_quotes(body) + " and " + std::to_string(others) +
         (others == 1 ? " other" : " others") + " collide in the sizes that they have at rest";
}

}  // namespace

void judge_sizes(Building& building) {
  for (const Clip& clip : building.stage.clips) {
    const std::vector<Resized> resized = resized_by(building, clip);
    json::Value last;
    for (std::size_t i = 0; i < resized.size(); ++i) {
      const auto& [first, count] = resized[i];
      if (count == 0) continue;
      // All tracks of an import have the same place, so only the first is reported.
      const json::Value place = place_of_track(building, clip, clip.tracks[i]);
      if (last && place == last) continue;
      last = place;
      building.problems.note(place, said_of(clip.tracks[i], building.stage.nodes[first].name, count - 1));
    }
  }
}

}  // namespace tweenfall::document::judging
