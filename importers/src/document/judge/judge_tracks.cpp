#include <tweenfall/anim/component.h>

#include "document/form.h"
#include "document/judge/judge.h"
#include "document/read/values.h"
#include "document/report/foreign_words.h"
#include "document/report/suggestion.h"

#include <algorithm>
#include <iterator>
#include <map>
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

const char* word_of(std::size_t kind) {
  constexpr const char* words[] = {"number",   "vector of 2",     "vector of 3", "vector of 4", "color",
                                   "rotation", "list of weights", "switch",      "text"};
  static_assert(std::size(words) == std::variant_size_v<TrackCurve>);
  return words[kind];
}

// The kinds of user tracks: curves' indices.
class Kinds {
 public:
  explicit Kinds(const Building& building) {
    for (const Clip& clip : building.stage.clips)
      for (const Track& track : clip.tracks)
        if (property_named(track.property) == Property::user) {
          const std::string name = track.name();
          of_clip_[clip.name].emplace(name, track.curve.index());
          first_.emplace(name, First{clip.name, track.curve.index()});
        }
  }

  // Of a track that is of another kind in an earlier clip, what follows; else empty.
  [[nodiscard]] std::string said_of(std::string_view clip, std::string_view track) const {
    const auto tracks = of_clip_.find(clip);
    const auto first = first_.find(track);
    if (tracks == of_clip_.end() || first == first_.end()) return {};
    const auto own = tracks->second.find(track);
    if (own == tracks->second.end() || own->second == first->second.kind) return {};
    return json::in_quotes(track) + " is a " + word_of(own->second) + " here and a " + word_of(first->second.kind) +
           " in the clip " + json::in_quotes(first->second.clip) +
           ": where clips are mixed, this one counts as without it";
  }

 private:
  struct First {
    std::string clip;
    std::size_t kind;
  };
  template <class T>
  using ByName = std::map<std::string, T, std::less<>>;

  ByName<ByName<std::size_t>> of_clip_;
  ByName<First> first_;  // by the first clip that has each
};

}  // namespace

// User tracks with names close to ours or to those of other programs; they are valid, but perhaps not
// intended.
void judge_tracks(Building& building) {
  const std::set<std::string> followed = followed_tracks(building.root);
  const json::Value clips = usable(building.root, "clips");
  if (!clips) return;
  const Kinds kinds(building);
  for (const json::Member& clip : clips.members()) {
    const json::Value tracks = is_free_name(clip.name) ? json::Value() : usable(clip.value, "tracks");
    if (!tracks) continue;
    for (const json::Member& track : tracks.members()) {
      // If its value is faulty, that message says what was meant, too.
      if (is_free_name(track.name) || track.value.is(json::Value::Kind::faulty)) continue;
      if (const std::string differs = kinds.said_of(clip.name, track.name); !differs.empty())
        building.problems.note_name(track, differs);
      if (followed.contains(std::string(track.name))) continue;
      if (const std::string meant = meant_by(track.name); !meant.empty())
        building.problems.note_name(
            track, json::in_quotes(track.name) + " is a property of your own, which moves nothing; " + meant);
    }
  }
}

}  // namespace tweenfall::document::judging
