#include "document/form.h"
#include "document/judge/judge.h"
#include "document/read/values.h"
#include "document/report/suggestion.h"

#include <algorithm>

namespace tweenfall::document::judging {

// Tracks of the author's own whose names are nearly those of ours; they are right, but perhaps not what was meant.
void judge_tracks(Building& building) {
  const json::Value clips = usable(building.root, "clips");
  if (!clips) return;
  for (const json::Member& clip : clips.members()) {
    const json::Value tracks = is_free_name(clip.name) ? json::Value() : usable(clip.value, "tracks");
    if (!tracks) continue;
    for (const json::Member& track : tracks.members()) {
      if (is_free_name(track.name)) continue;
      const std::string meant = property_meant(track.name);
      if (!meant.empty())
        building.problems.note_name(track, json::in_quotes(track.name) +
                                               " is a property of your own, which moves nothing; did you mean " +
                                               json::in_quotes(meant) + "?");
    }
  }
}

}  // namespace tweenfall::document::judging
