#pragma once

// A clip bound to a skeleton: names are looked up once, then the clip moves nodes by their indices.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/play.h>
#include <tweenfall/curves/motion_curves.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace tweenfall::pose {

/// Parts of a node's motion, as a set of bits. Positions and scales have one bit for each number, with x the
/// lowest.
using Parts = std::uint8_t;
inline constexpr Parts position_part = 7, rotation_part = 8, scale_part = 112;

class BoundClip {
 public:
  /// The parts of one node that the clip drives.
  struct Entry {
    std::size_t node;
    Parts parts = 0;     ///< of its motion
    Parts relative = 0;  ///< those that compose with the node's rest pose instead of replacing it
    const Curve<Color>* color = nullptr;
    std::array<const Curve<double>*, 4> tints{};  ///< single numbers of the color
    const WeightCurves* weights = nullptr;
    std::uint32_t first_number = 0, numbers = 0;  ///< its part of `numbers_`
    Vec3 gain{0, 0, 0};                           ///< gain of the position after one round of a loop with offset
    Vec3 turn{0, 0, 0};                           ///< the same for the rotation, as a rotation vector

    [[nodiscard]] bool has_color() const noexcept { return color || tints[0] || tints[1] || tints[2] || tints[3]; }
  };
  static constexpr std::uint32_t no_entry = static_cast<std::uint32_t>(-1);

  /// @param clip      must outlive this
  /// @param problems  written: one line for each track without a node or with values of the wrong type
  BoundClip(const Clip& clip, const Hierarchy& nodes, std::string& problems);

  [[nodiscard]] const Clip& clip() const noexcept { return *clip_; }
  [[nodiscard]] bool lands() const noexcept { return lands_; }  ///< as from `lands_on_last_key`
  [[nodiscard]] const std::vector<Entry>& entries() const noexcept { return entries_; }
  /// Index of a node's entry; `no_entry` where the clip does not drive the node.
  [[nodiscard]] std::uint32_t entry_of(std::size_t node) const noexcept {
    return node < entry_of_.size() ? entry_of_[node] : no_entry;
  }

  /// The user track of that name, "node.property"; null where the clip has none.
  [[nodiscard]] const Track* user_track(std::string_view name) const noexcept {
    const auto found = user_tracks_.find(name);
    return found == user_tracks_.end() ? nullptr : found->second;
  }

  /// Writes the driven parts into the motions of all nodes.
  void sample(const Hierarchy& nodes, const ClipClock& clock, std::span<Motion> local) const noexcept;

  /// The same for one entry's node.
  void sample_entry(std::uint32_t entry, const Hierarchy& nodes, const ClipClock& clock, Motion& motion) const noexcept;

 private:
  /// One number of a position or a scale.
  struct Number {
    const Curve<double>* curve;
    bool of_scale;
    int index;
    bool relative;
  };
  class Binding;

  void set_numbers(const Entry& entry, const Pose& rest, const ClipClock& clock, Motion& motion) const noexcept;
  void finish(std::uint32_t entry, const Pose& rest, const ClipClock& clock, Motion& motion) const noexcept;
  void climb(std::uint32_t entry, const Pose& rest, const ClipClock& clock, Motion& motion) const noexcept;

  const Clip* clip_;
  std::vector<Entry> entries_;           // in order of the nodes
  std::vector<std::uint32_t> entry_of_;  // by node
  MotionCurves curves_;                  // one thing for each entry
  std::vector<Number> numbers_;          // by entry
  std::map<std::string, const Track*, std::less<>> user_tracks_;
  bool finished_ = true;  // no entry is relative or has numbers
  bool lands_;
};

}  // namespace tweenfall::pose
