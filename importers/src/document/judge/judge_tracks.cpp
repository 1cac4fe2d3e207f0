#include "document/form.h"
#include "document/judge/judge.h"
#include "document/read/values.h"
#include "document/report/suggestion.h"

#include <algorithm>

namespace tweenfall::document::judging {

// Tracks of the author's own whose names are nearly those of ours; they are right, but perhaps not what was meant.
void judge_tracks(Building& building) {
  const JsonValue clips = usable(building.root, "clips");
  if (!clips) return;
  for (const JsonMember& clip : clips.members()) {
    const JsonValue tracks = is_free_name(clip.name) ? JsonValue() : usable(clip.value, "tracks");
    if (!tracks) continue;
    for (const JsonMember& track : tracks.members()) {
      if (is_free_name(track.name)) continue;
      const std::string meant = property_meant(track.name);
      if (!meant.empty())
        building.problems.note_name(track, in_quotes(track.name) +
                                               " is a property of your own, which moves nothing; did you mean " +
                                               in_quotes(meant) + "?");
    }
  }
}

}  // namespace tweenfall::document::judging
