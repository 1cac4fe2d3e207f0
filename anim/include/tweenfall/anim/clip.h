#pragma once

/// A clip: tracks that play together, with events, a duration and a way to loop.

#include <tweenfall/anim/track.h>

#include <string>
#include <vector>

namespace tweenfall {

/// Something that happens at a moment of a clip, or holds for a while (`to` > `from`).
struct ClipEvent {
  double from = 0;  ///< clip time, s
  double to = 0;    ///< clip time, s; equals `from` for a moment
  std::string name;
  std::string data;  ///< JSON text given with the event; empty for none

  [[nodiscard]] bool is_interval() const noexcept { return to > from; }
};

/// What is reported about an event: that it happened or, for an interval, that it begins or ends.
enum class EventKind { moment, begin, end };

enum class LoopMode { once, repeat, repeat_offset, pingpong };

struct Loop {
  LoopMode mode = LoopMode::once;
  double count = 0;  ///< number of plays, fractions allowed; 0 means without end (ignored for `once`)

  bool operator==(const Loop&) const = default;
};

struct Clip {
  std::string name;
  double duration = 0;  ///< s; infinity for a clip of endless functions
  Loop loop = {};
  std::vector<Track> tracks;
  std::vector<ClipEvent> events;  ///< in order of `from`
};

/// Largest finite knot or event over all tracks and events, s; infinity where there is neither, but an endless
/// formula.
[[nodiscard]] double natural_duration(const Clip& clip) noexcept;

}  // namespace tweenfall
