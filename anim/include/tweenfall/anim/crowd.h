#pragma once

/// Clips for crowds: compiled once into a compact form, then sampled at any time at the same small cost.
///
/// `compile` measures its error against the exact path, in the space of the whole figure, and refines until the
/// tolerance is met; `error` is the bound that holds. A compiled clip holds the tracks that move joints; events and
/// other tracks stay with the clip that it was made from. Sampling works at every time, allocates nothing, and gives
/// the same bits on every processor.

#include <tweenfall/anim/clip.h>
#include <tweenfall/anim/crowd_pose.h>
#include <tweenfall/anim/hierarchy.h>
#include <tweenfall/anim/play.h>

#include <cstddef>
#include <memory>
#include <span>
#include <utility>
#include <vector>

namespace tweenfall {

struct CrowdSettings {
  /// How far a point may be from its place on the exact path, in the space of the figure, m; > 0.
  double tolerance = 1e-4;
  /// The points measured lie this far from each joint along each axis, both ways, m; >= 0. Choose the size of attached
  /// things.
  double arm = 0.1;
  /// So many rounds of a loop with offset keep the tolerance, forwards or backwards; 1 to 100 million. What moves on
  /// from round to round makes the figure larger, or gets so far away that floats are coarse; then errors grow, as
  /// `CrowdClip::error` tells.
  int rounds = 1;
  /// Use the least memory; sampling then takes half as long again.
  bool smallest = false;
};

namespace crowd {
struct CompiledClip;
}

class CrowdClip {
 public:
  // Moving copies: it is as cheap, and what was moved from stays what it was.
  CrowdClip(const CrowdClip&) noexcept = default;
  CrowdClip& operator=(const CrowdClip&) noexcept = default;

  [[nodiscard]] std::size_t joints() const noexcept;
  [[nodiscard]] std::size_t groups() const noexcept { return crowd_groups(joints()); }
  [[nodiscard]] double duration() const noexcept;  ///< s
  [[nodiscard]] const Loop& loop() const noexcept;
  /// Bound on the distance from the exact path at any time, m, of the points that the settings define. It is measured
  /// at all knots, several times between two of them, and more often where it is large; 3 % and the roundings of floats
  /// are added for what lies between, which random clips have not exceeded. What a formula does and undoes between two
  /// measured times is not seen.
  /// @param round  the `cycle` of a clock. In loops with offset the bound grows by the same amount from each round to
  ///               the next, forwards and backwards, and holds for 100 million rounds; else all rounds are alike.
  [[nodiscard]] double error(int round = 0) const noexcept;
  [[nodiscard]] std::size_t byte_count() const noexcept;  ///< the size of what `to_bytes` returns

  /// The state of a play of the clip: one clock for all its tracks, as from `clock_at`.
  [[nodiscard]] ClipClock clock(double at, double speed, double stage_time, Side side = Side::out) const noexcept;

  /// The pose at a clock of the whole clip, looping as the clip does. @param pose  written; `groups()` of them
  void sample(const ClipClock& clock, std::span<CrowdGroup> pose) const noexcept;
  /// The same and its rates: the derivatives, with respect to stage time, of what is written to `pose`.
  /// @param rates  written; `groups()` of them
  void sample(const ClipClock& clock, std::span<CrowdGroup> pose, std::span<CrowdRates> rates) const noexcept;
  /// The poses of many figures at their clocks, each as above; for figures with few joints this is faster per figure.
  /// @param poses  written; `groups()` of them for each clock, figure after figure
  void sample(std::span<const ClipClock> clocks, std::span<CrowdGroup> poses) const noexcept;
  /// The pose at a clip time; before the start and after the end, that of the start or the end.
  void sample(double clip_time, std::span<CrowdGroup> pose) const noexcept;

  /// Bytes to be kept: a version, a checksum and the clip; the same on every machine.
  [[nodiscard]] std::vector<std::byte> to_bytes() const;
  /// @throws std::invalid_argument for bytes that `to_bytes` of this version did not write, saying what is wrong
  [[nodiscard]] static CrowdClip from_bytes(std::span<const std::byte> bytes);

  [[nodiscard]] const crowd::CompiledClip& compiled() const noexcept { return *compiled_; }  ///< for our own kernels

 private:
  friend CrowdClip compile(const Clip& clip, const Hierarchy& nodes, const CrowdSettings& settings);
  explicit CrowdClip(std::shared_ptr<const crowd::CompiledClip> compiled) : compiled_(std::move(compiled)) {}
  std::shared_ptr<const crowd::CompiledClip> compiled_;  // copies share it
};

/// The clip as the joints of `nodes` play it, one joint for each node; those without a track rest.
///
/// Formulas are looked at every 10 ms, and where they change as often as it takes; what one does and undoes in less may
/// go unseen. Where one jumps between two numbers, what arrives at the later is what was at the earlier.
/// @throws std::invalid_argument for a clip that does not fit the nodes or has no end, settings that are out of their
///         ranges, a tolerance that float cannot keep: it names how near it comes and where, and for curves so fast
///         that eight joints would take more than 16 knots for each of theirs and 20,000 more: it names the joint and
///         when.
[[nodiscard]] CrowdClip compile(const Clip& clip, const Hierarchy& nodes, const CrowdSettings& settings = {});

}  // namespace tweenfall
