#include <tweenfall/anim/component.h>

#include "document/form.h"
#include "document/judge/judge.h"
#include "document/read/values.h"
#include "document/report/foreign_words.h"
#include "document/report/suggestion.h"

#include <set>

namespace tweenfall::document::judging {

namespace {

// Tracks that parameters of graphs follow.
std::set<std::string> followed_tracks(const json::Value& root) {
  std::set<std::string> names;
  const json::Value graphs = usable(root, "graphs");
  if (!graphs) return names;
  for (const json::Member& graph : graphs.members())
    if (const json::Value parameters = is_free_name(graph.name) ? json::Value() : usable(graph.value, "parameters"))
      for (const json::Member& parameter : parameters.members())
        if (parameter.value.is(json::Value::Kind::object)) names.insert(text_in(parameter.value, "track", ""));
  return names;
}

// What such a track may have been meant for, or empty.
std::string meant_by(std::string_view track) {
  const std::string meant = property_meant(track);
  if (!meant.empty()) return "did you mean " + json::in_quotes(meant) + "?";
  const std::size_t dot = property_dot(track);
  return dot == std::string_view::npos ? std::string() : said_of_property(track.substr(dot + 1), track.substr(0, dot));
}

}  // namespace

// User tracks with names close to ours or to those of other programs; they are valid, but perhaps not
// intended.
void judge_tracks(Building& building) {
  const std::set<std::string> followed = followed_tracks(building.root);
  const json::Value clips = usable(building.root, "clips");
  if (!clips) return;
  for (const json::Member& clip : clips.members()) {
    const json::Value tracks = is_free_name(clip.name) ? json::Value() : usable(clip.value, "tracks");
    if (!tracks) continue;
    for (const json::Member& track : tracks.members()) {
      // If its value is faulty, that message says what was meant, too.
      if (is_free_name(track.name) || track.value.is(json::Value::Kind::faulty)) continue;
      if (followed.contains(std::string(track.name))) continue;
      if (const std::string meant = meant_by(track.name); !meant.empty())
        building.problems.note_name(
            track, json::in_quotes(track.name) + " is a property of your own, which moves nothing; " + meant);
    }
  }
}

}  // namespace tweenfall::document::judging
