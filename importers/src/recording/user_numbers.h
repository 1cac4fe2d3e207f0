#pragma once

// User tracks of a recording as rows of numbers.

#include <tweenfall/physics/stage/recording.h>

#include <string>
#include <vector>

namespace tweenfall::recordings {

/// Names of the numbers of a track: empty text for a number or a switch, "x", "y", "z", "w", "r", "g", "b", "a", or
/// "0", "1", ... for a list. None for texts.
[[nodiscard]] std::vector<std::string> number_names(const UserTrackRecord& track);

/// The numbers at a frame, in that order; switches as 0 or 1.
/// @param width  how many names the track has: shorter lists are filled up with 0
[[nodiscard]] std::vector<double> numbers_at(const UserTrackRecord& track, std::size_t frame, std::size_t width);
/// Their rates, per second; of a rotation its angular velocity, rad/s. None for switches and texts.
[[nodiscard]] std::vector<double> rates_at(const UserTrackRecord& track, std::size_t frame, std::size_t width);

}  // namespace tweenfall::recordings
