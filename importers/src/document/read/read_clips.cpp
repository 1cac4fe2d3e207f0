#include <tweenfall/anim/component.h>

#include "document/content.h"
#include "document/fields/things.h"
#include "document/form.h"
#include "document/read/values.h"
#include "document/report/suggestion.h"
#include "document/tracks/read_track.h"

#include <utility>

namespace tweenfall::document {

namespace {

using Kind = json::Value::Kind;

// If a document has no nodes, its tracks make them, in order of appearance, so that it can be played.
void make_nodes(Building& building, const json::Value& tracks) {
  for (const json::Member& track : tracks.members()) {
    const std::size_t dot = property_dot(track.name);
    if (is_free_name(track.name) || dot == std::string::npos || track.value.is(Kind::faulty)) continue;
    NodeDescription node;
    node.name = track.name.substr(0, dot);
    if (!building.nodes.emplace(node.name, building.stage.nodes.size()).second) continue;
    building.stage.nodes.push_back(std::move(node));
  }
}

void check_nodes(Building& building, const json::Value& tracks) {
  for (const json::Member& track : tracks.members()) {
    const std::size_t dot = property_dot(track.name);
    if (is_free_name(track.name) || dot == std::string::npos || track.value.is(Kind::faulty)) continue;
    const std::string node(track.name.substr(0, dot));
    if (building.nodes.count(node) > 0 || building.excused(node)) continue;
    const std::string meant = component_meant(track.name);
    building.problems.add_name(track, "there is no node " + json::in_quotes(node) +
                                          (meant.empty() ? suggestion_or_import(node, building.node_names()) : meant));
  }
}

}  // namespace

void read_clips(Building& building) {
  if (const json::Value clips = usable(building.root, "clips")) {
    for (const json::Member& member : clips.members()) {
      if (is_free_name(member.name)) continue;
      if (const json::Value tracks = usable(member.value, "tracks")) {
        if (building.names_are_free)
          make_nodes(building, tracks);
        else
          check_nodes(building, tracks);
      }
      if (!building.clips.emplace(member.name, building.stage.clips.size()).second) {
        building.problems.add_name(member, "an import has brought a clip " + json::in_quotes(member.name) +
                                               " already; give this one another name");
        continue;
      }
      building.stage.clips.push_back(read_clip(member, building.fps, building.problems));
    }
  }
  // Clips of files without nodes drive nodes of this one.
  const json::Value imports = usable(building.root, "import");
  for (const std::string& name : building.clips_of_others) {
    const std::string alias = name.substr(0, name.find('/'));
    const json::Value place = imports ? usable(imports, alias) : json::Value();
    for (const Track& track : building.stage.clips[building.clips.at(name)].tracks)
      if (place && building.nodes.count(track.node) == 0 && !building.excused(track.node))
        building.problems.add(place, "its clip " + json::in_quotes(name) + " has the track " +
                                         json::in_quotes(track.name()) + ", but there is no node " +
                                         json::in_quotes(track.node) +
                                         suggestion_or_import(track.node, building.node_names()));
  }
}

void read_plays(Building& building) {
  const json::Value list = usable(building.root, "play");
  if (!list) {
    if (building.stage.clips.size() == 1 && !usable(building.root, "graphs")) building.stage.plays.push_back({});
    return;
  }
  for (const json::Value& value : list.items())
    if (value.is(Kind::object))
      if (std::optional<Play> play = fields::read_play(value, building))
        building.stage.plays.push_back(std::move(*play));
}

}  // namespace tweenfall::document
