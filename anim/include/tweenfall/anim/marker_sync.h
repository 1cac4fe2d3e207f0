#pragma once

/// Clips of different lengths played in phase, so that feet that step together stay together while they are blended.
///
/// Each clip has markers, as where its feet touch the ground. A phase, common to all, counts markers: at phase 3 every
/// clip is at its marker number 3, counted around its loop. Between markers a clip's time is a smooth function of the
/// phase that never turns (a cubic through the markers with continuous rate), so that no clip's speed jumps. Clips
/// without markers are spread evenly over one round of the others' markers; where none has any, the phase counts loops.
///
/// The phase runs so that the seconds in which each clip would go on by a little, averaged by the weights, are the
/// seconds that pass: a clip that has all the weight runs at its own speed, exactly.

#include <tweenfall/anim/clip.h>
#include <tweenfall/curves/values.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

struct SyncMarker {
  double time = 0;   ///< clip time, s; 0 to the clip's duration, whose end is its start
  std::string name;  ///< "left", "right"; the same names follow each other in all clips
};

/// What a clip's loop is to the others.
struct SyncClip {
  double duration = 1;  ///< s; > 0
  std::vector<SyncMarker> markers{};
};

/// The events of a clip whose names match the pattern ("foot *"), at the times at which they begin.
[[nodiscard]] SyncClip sync_clip(const Clip& clip, std::string_view markers);

/// Where a clip stands.
struct SyncedTime {
  Sample<double> time;  ///< clip time, 0 to the duration, s; its rate in clip seconds per second, and that one's rate
  double cycle = 0;     ///< which of its loops: time + cycle * duration goes on without a jump
};

class MarkerSync {
 public:
  /// The markers of one round are those of the first clip that has any, up to where its names repeat; each other clip
  /// has them too, once or several times around, from whichever on.
  /// @throws std::invalid_argument listing all problems: no clips, a duration that is not finite and above 0, a marker
  /// outside its clip, two at one time, markers that do not follow each other as the first clip's.
  explicit MarkerSync(std::vector<SyncClip> clips);

  [[nodiscard]] std::size_t size() const noexcept { return clips_.size(); }
  /// After this phase every clip is at the time at which it was.
  [[nodiscard]] double period() const noexcept { return period_; }

  /// The phase, from 0, in which a clip is at a time, taken around its loop.
  [[nodiscard]] double phase_at(std::size_t clip, double time) const noexcept;

  /// The phase as it runs under these weights: its rate, and the rate of that, to which the weights' rates belong.
  /// @param weights  one for each clip; negative ones count as 0, and where all are 0 each counts alike
  [[nodiscard]] Sample<double> running(double phase, std::span<const Sample<double>> weights) const noexcept;

  /// The phase some seconds later (or earlier, where negative) under weights that stay as they are: exact however many
  /// loops lie between, for what the clips go on by, averaged by the weights, is the seconds.
  [[nodiscard]] double advanced(double phase, double seconds, std::span<const double> weights) const noexcept;

  /// The same while the weights' shares go evenly from one to another: within 1e-7 of phase in a second of fading by
  /// steps of 1/30 s, and less the shorter they are.
  [[nodiscard]] double advanced(double phase, double seconds, std::span<const double> from,
                                std::span<const double> to) const noexcept;

  /// Where a clip stands at a phase, and how fast it runs there.
  [[nodiscard]] SyncedTime time(std::size_t clip, const Sample<double>& phase) const noexcept;

 private:
  struct Stretch {
    double time = 0;                  ///< of its first marker, s
    double length = 0;                ///< to the next one, s
    double slope = 0, slope_end = 0;  ///< seconds per phase at both ends
  };
  struct Track {
    double duration = 0;
    double first = 0;  ///< phase of the first marker
    std::vector<Stretch> stretches;
  };
  struct Place;
  [[nodiscard]] static Place place(const Stretch& stretch, double part) noexcept;
  [[nodiscard]] static Place place(const Track& track, double phase) noexcept;
  template <class Share>
  [[nodiscard]] double advanced_by(double phase, double seconds, const Share& share) const noexcept;

  std::vector<Track> clips_;
  double period_ = 1;
};

}  // namespace tweenfall
