#pragma once

/// Clips of different lengths played in phase, so that their footsteps coincide while they are blended.
///
/// Each clip has markers, for example footfalls. A phase, common to all, counts markers: at phase 3 every clip is at
/// its marker number 3, counted around its loop. Between markers a clip's time is a smooth, monotone function of the
/// phase (a cubic through the markers with continuous rate), so that no clip's speed jumps. Clips without markers are
/// spread evenly over one round of the others' markers; without any markers, the phase counts loops.
///
/// The phase advances so that the clip times advance, averaged by the weights, at one second per second: a clip that
/// has all the weight runs at exactly its own speed.

#include <tweenfall/anim/clip.h>
#include <tweenfall/curves/values.h>

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall {

namespace blending {
struct PiecePace;
}

struct SyncMarker {
  double time = 0;   ///< clip time, s; 0 to the clip's duration, whose end is its start
  std::string name;  ///< "left", "right"; all clips have the same names in the same order
};

/// The loop of a clip and its markers.
struct SyncClip {
  double duration = 1;  ///< s; > 0
  std::vector<SyncMarker> markers{};
};

/// The events of a clip whose names match the pattern ("foot *"), at the times at which they begin.
[[nodiscard]] SyncClip sync_clip(const Clip& clip, std::string_view markers);

/// The time of a clip.
struct SyncedTime {
  Sample<double> time;  ///< clip time, 0 to the duration, s; its rate in clip seconds per second, and acceleration
  double cycle = 0;     ///< which of its loops: time + cycle * duration is continuous
};

class MarkerSync {
 public:
  /// The markers of one round are those of the first clip that has any, up to where its names repeat; each other clip
  /// with markers has the same, once or several times around, starting at any of them.
  /// @throws std::invalid_argument listing all problems: no clips, a duration that is not finite and above 0, a marker
  /// outside its clip, two at one time, markers in another order than the first clip's.
  explicit MarkerSync(std::vector<SyncClip> clips);

  [[nodiscard]] std::size_t size() const noexcept { return clips_.size(); }
  /// The phase after which every clip is at the same time again.
  [[nodiscard]] double period() const noexcept { return period_; }

  /// The phase, from 0, at which a clip is at a time, wrapped to its loop.
  [[nodiscard]] double phase_at(std::size_t clip, double time) const noexcept;

  /// The phase with its rate under these weights, and its second derivative, which includes the weights' rates.
  /// @param weights  one for each clip; negative ones count as 0, and where all are 0 all count the same
  [[nodiscard]] Sample<double> running(double phase, std::span<const Sample<double>> weights) const noexcept;

  /// The rate of `running` alone, phases per second, for long computations.
  [[nodiscard]] double rate(double phase, std::span<const double> weights) const noexcept;

  /// The phase some seconds later (or earlier, if negative) under constant weights: exact over any number of loops,
  /// because the advance of the clips, averaged by the weights, is the number of seconds.
  [[nodiscard]] double advanced(double phase, double seconds, std::span<const double> weights) const noexcept;

  /// How long one period takes under constant weights, s.
  [[nodiscard]] double seconds(std::span<const double> weights) const noexcept;

  /// The phase some seconds later while the shares of the weights change linearly from those of `from` to those of
  /// `to`: within 1e-11 of a phase, in one step as in many, for clips whose speeds are up to a thousand times apart.
  /// Takes time for each marker passed, up to those of one period.
  [[nodiscard]] double advanced(double phase, double seconds, std::span<const double> from,
                                std::span<const double> to) const noexcept;

  /// The time of a clip at a phase, and how fast it runs there.
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
  /// The first derivative alone, seconds per phase.
  [[nodiscard]] static double slope(const Track& track, double phase) noexcept;
  /// The first derivative from a phase to the next marker, or to the one before where `way` is below 0.
  [[nodiscard]] static blending::PiecePace pace(const Track& track, double phase, double way) noexcept;
  /// The part that a clip has of the weights, whose sum is `sum`.
  [[nodiscard]] double share(std::span<const double> weights, double sum, std::size_t clip) const noexcept;
  /// How far a clip comes in one period, s.
  [[nodiscard]] double in_period(std::size_t clip) const noexcept;

  std::vector<Track> clips_;
  double period_ = 1;
};

}  // namespace tweenfall
