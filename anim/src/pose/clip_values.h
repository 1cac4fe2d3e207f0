#pragma once

// Values of user tracks: at a clock, and mixed.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/play.h>
#include <tweenfall/anim/user_value.h>

#include <span>
#include <string_view>
#include <type_traits>

namespace tweenfall::pose {

/// The first track of that name among the user tracks of the clips. @throws std::invalid_argument with the nearest name
[[nodiscard]] const Track& user_track_named(std::span<const Clip> clips, std::string_view name);
[[nodiscard]] bool is_user_track(const Track& track) noexcept;

/// What shows where no clip has the track: a value of the same kind.
[[nodiscard]] UserValue nothing_of(const TrackCurve& kind);

/// A track at a clock, with the gains of a loop with offset and rates in stage time.
[[nodiscard]] UserValue user_value_of(const TrackCurve& curve, const ClipClock& clock);

/// The mean of values of one kind; of switches and texts the one whose weights sum to the most, of several the first.
/// @param weights  one for each value; their sum is not 0
[[nodiscard]] UserValue mean_of(std::span<const UserValue> values, std::span<const Sample<double>> weights);

/// Whether values of that kind can be added: numbers, vectors and colors, but no rotations, switches and texts.
[[nodiscard]] bool has_sums(const UserValue& value) noexcept;

/// The numbers of a value that is added number by number.
template <class T>
[[nodiscard]] auto& numbers_of(T& value) noexcept {
  if constexpr (std::is_same_v<std::remove_const_t<T>, Color>)
    return value.rgba;
  else
    return value;
}

/// Adds `share * value` to a sum of the same kind, number by number: alphas are added as well, and may leave 0 to 1.
template <class T>
void add_share(Sample<T>& sum, const Sample<T>& value, const Sample<double>& share) noexcept {
  sum.acceleration +=
      share.value * value.acceleration + 2 * share.rate * value.rate + share.acceleration * numbers_of(value.value);
  sum.rate += share.value * value.rate + share.rate * numbers_of(value.value);
  numbers_of(sum.value) += share.value * numbers_of(value.value);
}
/// @param sum  of a kind that `has_sums`
void add_share(UserValue& sum, const UserValue& value, const Sample<double>& share);

}  // namespace tweenfall::pose
