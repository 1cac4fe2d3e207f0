#pragma once

// The user tracks of a recording, as they are played.

#include <tweenfall/physics/stage/recording.h>

#include <vector>

namespace tweenfall::staging {

/// A play may start at any time: a track takes part from the first frame in which something plays it, and until then
/// takes no memory.
class UserTrackRecorder {
 public:
  explicit UserTrackRecorder(const Stage& stage);

  /// Records the stage's time, the recording's last frame. @param room  what is left, bytes
  /// @throws std::invalid_argument where it is not enough
  void take(const Stage& stage, double& room);
  /// The tracks that were played, in the order of the clips.
  [[nodiscard]] std::vector<UserTrackRecord> records() &&;

 private:
  void find_played(const Stage& stage);
  void push(std::size_t track, UserValue value, double& room);

  std::vector<UserTrackRecord> tracks_;
  std::vector<UserValue> at_first_;  // by track: what it is while nothing plays it
  std::vector<char> is_played_;      // by track: whether anything has played it
  std::size_t frames_ = 0;
};

}  // namespace tweenfall::staging
