#pragma once

// The keys of the plays on a stage, at the stage times at which they are passed.

#include <tweenfall/physics/stage/description.h>

#include <cstdint>
#include <string>
#include <vector>

namespace tweenfall::recordings {

/// One animated track.
struct KeyLane {
  /// A key in words, as written by its author.
  struct Key {
    std::string value, ease;
  };

  std::string node, property;
  std::vector<double> times;          ///< stage time of each key passed, s, increasing; empty for a formula
  std::vector<std::uint32_t> key_of;  ///< index in `keys` for each of `times`
  std::vector<Key> keys;              ///< each key once, in order of the plays and of time
  bool is_thinned = false;            ///< only some rounds of a short loop are included
};

/// A lane for each track that a play drives, in order of the plays; a track in two plays has one lane with the keys of
/// both. Keys of loops are listed once for each round, between `from` and `until`; a lane holds 20,000 at most, and for
/// a loop with more rounds only some of them, evenly chosen.
[[nodiscard]] std::vector<KeyLane> key_lanes(const StageDescription& stage, double from, double until);

/// Times of a track's keys in clip time, s.
[[nodiscard]] std::vector<double> key_times(const TrackCurve& curve);

}  // namespace tweenfall::recordings
