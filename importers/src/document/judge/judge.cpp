#include "document/judge/judge.h"

#include "document/read/values.h"

namespace tweenfall::document {

namespace judging {

namespace {

// The member of `own`, or the import that brought it.
json::Value place_of(const Building& building, std::string_view own, const std::string& name) {
  if (const json::Value list = usable(building.root, own))
    if (const json::Value written = usable(list, name)) return written;
  return below(building.root, {"import", std::string_view(name).substr(0, name.find('/'))});
}

}  // namespace

json::Value place_of_node(const Building& building, std::size_t node) {
  const std::string& name = building.stage.nodes[node].name;
  // A document without nodes has them from its tracks.
  return building.names_are_free ? below(building.root, {"clips"}) : place_of(building, "nodes", name);
}

json::Value place_of_world(const Building& building) {
  return below(building.root, {"world"});
}

json::Value place_of_clip(const Building& building, const std::string& clip) {
  return place_of(building, "clips", clip);
}

json::Value place_of_track(const Building& building, const Clip& clip, const Track& track) {
  return below(place_of_clip(building, clip.name), {"tracks", track.name()});
}

}  // namespace judging

void judge(Building& building) {
  judging::judge_tracks(building);
  // What an import is on its own does not matter: only its nodes and clips come in, and into another stage.
  if (!building.reading.is_outermost()) return;
  judging::judge_pace(building);
  if (building.problems.empty()) judging::judge_stage(building);
}

}  // namespace tweenfall::document
