#include "document/content.h"
#include "document/form.h"
#include "document/read/values.h"
#include "document/report/suggestion.h"
#include "document/tracks/read_track.h"

#include <cmath>
#include <utility>

namespace tweenfall::document {

namespace {

using Kind = JsonValue::Kind;

// Without nodes of its own a document's tracks make them, in order of appearance, so that it can be played.
void make_nodes(Building& building, const JsonValue& tracks) {
  for (const JsonMember& track : tracks.members()) {
    const std::size_t dot = track.name.rfind('.');
    if (is_free_name(track.name) || dot == std::string::npos || track.value.is(Kind::faulty)) continue;
    NodeDescription node;
    node.name = track.name.substr(0, dot);
    if (!building.nodes.emplace(node.name, building.stage.nodes.size()).second) continue;
    building.stage.nodes.push_back(std::move(node));
  }
}

void check_nodes(Building& building, const JsonValue& tracks) {
  for (const JsonMember& track : tracks.members()) {
    const std::size_t dot = track.name.rfind('.');
    if (is_free_name(track.name) || dot == std::string::npos || track.value.is(Kind::faulty)) continue;
    const std::string node(track.name.substr(0, dot));
    if (building.nodes.count(node) == 0 && !building.excused(node))
      building.problems.add_name(track,
                                 "there is no node " + in_quotes(node) + suggestion(node, building.node_names()));
  }
}

JsonValue clip_in(const JsonValue& root, std::string_view name) {
  const JsonValue clips = usable(root, "clips");
  return clips ? usable(clips, name) : JsonValue();
}

}  // namespace

void read_clips(Building& building) {
  if (const JsonValue clips = usable(building.root, "clips")) {
    for (const JsonMember& member : clips.members()) {
      if (is_free_name(member.name)) continue;
      if (const JsonValue tracks = usable(member.value, "tracks")) {
        if (building.names_are_free)
          make_nodes(building, tracks);
        else
          check_nodes(building, tracks);
      }
      if (!building.clips.emplace(member.name, building.stage.clips.size()).second) {
        building.problems.add_name(
            member, "an import has brought a clip " + in_quotes(member.name) + " already; give this one another name");
        continue;
      }
      building.stage.clips.push_back(read_clip(member, building.fps, building.problems));
    }
  }
  // Clips of files without nodes drive nodes of this one.
  const JsonValue imports = usable(building.root, "import");
  for (const std::string& name : building.clips_of_others) {
    const std::string alias = name.substr(0, name.find('/'));
    const JsonValue place = imports ? usable(imports, alias) : JsonValue();
    for (const Track& track : building.stage.clips[building.clips.at(name)].tracks)
      if (place && building.nodes.count(track.node) == 0 && !building.excused(track.node))
        building.problems.add(place, "its clip " + in_quotes(name) + " has the track " + in_quotes(track.name()) +
                                         ", but there is no node " + in_quotes(track.node) +
                                         suggestion(track.node, building.node_names()));
  }
}

void read_plays(Building& building) {
  const JsonValue list = usable(building.root, "play");
  if (!list) {
    if (building.stage.clips.size() == 1) building.stage.plays.push_back({});
    return;
  }
  const ClipTimes stage_times(building.fps, {}, "stage time has none");
  for (const JsonValue& value : list.items()) {
    if (!value.is(Kind::object)) continue;
    Play play;
    if (const JsonValue clip = usable(value, "clip")) {
      const auto found = building.clips.find(clip.text());
      if (found == building.clips.end()) {
        // A clip with faults of its own is there all the same.
        if (!clip_in(building.root, clip.text()) && !building.excused(clip.text()))
          building.problems.add(
              clip, "there is no clip " + in_quotes(clip.text()) + suggestion(clip.text(), building.clip_names()));
        continue;
      }
      play.clip = found->second;
    }
    if (const JsonValue at = usable(value, "at")) play.at = stage_times.seconds(at, {}, building.problems).value_or(0);
    play.speed = number_in(value, "speed", 1);
    if (play.speed < 0 && play.clip < building.stage.clips.size() &&
        std::isinf(building.stage.clips[play.clip].duration))
      building.problems.add(usable(value, "speed"),
                            "an endless clip has no end from which to run backwards; give it a \"duration\"");
    if (const JsonValue weight = usable(value, "weight")) {
      if (weight.is(Kind::number)) play.weight = Curve<double>(weight.number());
      if (weight.is(Kind::list))
        if (const auto curve = read_weight(weight, building.fps, building.problems)) play.weight = *curve;
    }
    play.mask = names_in(value, "mask");
    if (const JsonValue mask = usable(value, "mask"))
      for (const std::string& name : play.mask)
        if (building.nodes_named(name).empty() && !building.excused(name))
          building.problems.add(mask, "no node is called " + in_quotes(name) + suggestion(name, building.node_names()));
    building.stage.plays.push_back(std::move(play));
  }
}

}  // namespace tweenfall::document
