#include "document/judge/judge.h"

#include "document/fields/things.h"
#include "document/read/values.h"

namespace tweenfall::document {

namespace judging {

namespace {

// The member of `own`, or the import that it came from.
json::Value place_of(const json::Value& root, std::string_view own, const std::string& name) {
  if (const json::Value list = usable(root, own))
    if (const json::Value written = usable(list, name)) return written;
  return below(root, {"import", std::string_view(name).substr(0, name.find('/'))});
}

}  // namespace

json::Value place_of_node(const json::Value& root, const std::string& node, bool names_are_free) {
  // A document without nodes has them from its tracks.
  return names_are_free ? below(root, {"clips"}) : place_of(root, "nodes", node);
}

json::Value place_of_node(const Building& building, std::size_t node) {
  return place_of_node(building.root, building.stage.nodes[node].name, building.names_are_free);
}

json::Value place_of_world(const Building& building) {
  return below(building.root, {"world"});
}

json::Value place_of_joint(const Building& building, std::size_t joint) {
  const std::string& name = building.stage.joints[joint].name;
  const json::Value own = fields::place_of_joint(place_of_world(building), name);
  return own ? own : place_of(building.root, "import", name);
}

json::Value place_of_clip(const Building& building, const std::string& clip) {
  return place_of(building.root, "clips", clip);
}

json::Value place_of_track(const Building& building, const Clip& clip, const Track& track) {
  return below(place_of_clip(building, clip.name), {"tracks", track.name()});
}

}  // namespace judging

void judge(Building& building) {
  judging::judge_tracks(building);
  // Nothing more is known about faulty parts than their names.
  if (!building.problems.empty()) return;
  // An import is not judged by itself, because only its nodes and clips are used, in another stage.
  if (!building.reading.is_outermost()) return;
  judging::judge_pace(building);
  judging::judge_angles(building);
  judging::judge_drives(building);
  judging::judge_sizes(building);
  if (building.problems.empty()) judging::judge_stage(building);
  if (building.problems.empty()) judging::judge_frames(building);
  if (building.problems.empty()) judging::judge_actors(building);
}

}  // namespace tweenfall::document
