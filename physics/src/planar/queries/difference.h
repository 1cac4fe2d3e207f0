#pragma once

#include <array>
#include <optional>

#include "planar/contacts/manifold.h"

namespace tweenfall::planar::inner {

/// All displacements from a point of one plate to a point of another: a convex polygon, or a half-plane, without the
/// skins. Two plates have a point in common if 0 is one of these displacements.
class Difference {
 public:
  /// Not for two half-planes.
  Difference(const Placed& a, const Placed& b);

  /// The nearest point to 0.
  struct Nearest {
    Vec2 normal{0, 1};             ///< unit, out of b: the shortest way for a to leave it
    double gap = 0;                ///< between the skins, m; negative if they overlap
    Vec2 on_a{0, 0}, on_b{0, 0};   ///< of the cores, world
    std::optional<Vec2> common{};  ///< a point of both cores
  };
  [[nodiscard]] Nearest nearest() const;

  struct Met {
    double way = 0;  ///< how far a has moved until it meets b, m
    Vec2 point{0, 0};
    Vec2 normal{0, 1};  ///< unit, out of b
  };
  /// Where a first meets b, from which it is apart; empty if it passes by.
  [[nodiscard]] std::optional<Met> met(const Vec2& direction, double length) const;

 private:
  struct Tip {
    Vec2 at;          ///< on_b - on_a
    Vec2 on_a, on_b;  ///< world
  };
  [[nodiscard]] const Tip& after(std::size_t i) const { return tips_[i + 1 == count_ ? 0 : i + 1]; }
  /// Unit, out of the side that leads on from a tip.
  [[nodiscard]] Vec2 out_of(std::size_t side) const;
  [[nodiscard]] bool holds_none() const;
  [[nodiscard]] Nearest overlapping() const;
  void lean(const Placed& line, const Placed& other, bool of_b);
  void go_around(const Placed& a, const Placed& b);
  [[nodiscard]] std::optional<Met> met_sharp(const Vec2& direction, double length) const;
  [[nodiscard]] std::optional<Met> met_round(const Vec2& direction, double length) const;

  static constexpr std::size_t most = 2 * Polygon::most_corners;
  std::array<Tip, most> tips_;
  std::size_t count_ = 0;
  double skin_a_ = 0, skin_b_ = 0;
  bool endless_ = false;
  Vec2 normal_{0, 1};  ///< of a half-plane
};

}  // namespace tweenfall::planar::inner
