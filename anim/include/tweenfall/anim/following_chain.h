#pragma once

/// Chains with joint limits that reach from where they were: all that any pose reaches, and no flip that can be
/// avoided.
///
/// A chain whose result depends on nothing but its pose and its target, as that of `reach`, must miss something or
/// flip: an arm of two bones, whose elbow bends from -30 to 150 degrees and whose shoulder turns within 40, reaches the
/// one side with its elbow bent one way and the other side the other way, and what is between with either; somewhere
/// between it has to change. One that remembers where it was changes only where it has to: where its target leaves
/// all that can be reached without a leap.
///
/// From pose to pose the joints go back toward the script, with a time constant of 0.2 s, as far as the target lets
/// them: where that rests, they are as near to the script as they can be nearby, whatever the way there. Where the
/// chain has `leaps` and its target is not reached, it goes to the nearest pose downhill, and from there it searches:
/// of the poses at the target that it finds from near by it leaps to the one that turns its joints least or, if there
/// is none, to the nearest to the target. After a search in vain it searches again a quarter of a second later, for
/// that takes a millisecond or two.

#include <tweenfall/anim/joint_chain.h>

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace tweenfall {

/// The pose that a chain had.
struct ChainMemory {
  std::vector<Quat> turns;  ///< of its joints, from rest; empty: none yet
  /// Since it searched in vain for a pose that reaches its target, s; infinity: it has reached it since, or not
  /// searched.
  double since_search = std::numeric_limits<double>::infinity();

  bool operator==(const ChainMemory& other) const noexcept;
  [[nodiscard]] std::vector<std::byte> bytes() const;
  /// @throws std::invalid_argument for bytes that are not such a memory
  [[nodiscard]] static ChainMemory from_bytes(std::span<const std::byte> bytes);
};

/// As `reach`, from the pose that is remembered, which becomes the new one. Without limits it is `reach`, which never
/// flips. With no memory, or that of another number of joints, the chain begins by `reach`.
///
/// @param seconds  since the pose that is remembered; >= 0
/// @param weight   of what is shown: the chain moves on whatever it is
/// @param pose     what the script gives; the joints in it are changed. Its rates are the exact derivatives by time of
///                 what this function returns, given the memory
void follow(const JointChain& chain, const Sample<Vec3>& target, double seconds, const Sample<double>& weight,
            ChainMemory& memory, std::span<Motion> pose) noexcept;

}  // namespace tweenfall
