#pragma once

// Boxes with a name, curves between them, and labels that do not overlap anything.

#include <tweenfall/curves/values.h>

#include "plot/svg_writer.h"

#include <string>
#include <vector>

namespace tweenfall::plotting {

struct Rectangle {
  double left, top, right, bottom;  // px

  [[nodiscard]] bool overlaps(const Rectangle& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
  [[nodiscard]] Vec2 center() const { return {(left + right) / 2, (top + bottom) / 2}; }
  /// The point where the line from its center toward a point leaves it.
  [[nodiscard]] Vec2 border_toward(const Vec2& point) const;
};

[[nodiscard]] Rectangle around(const Vec2& center, double width, double height);

/// How wide a box has to be to hold all of its words, px.
[[nodiscard]] double box_width_of(const std::string& name, const std::string& words);

struct BoxStyle {
  std::string fill, stroke;
  double round = 6;
  bool strong = false;  // a thicker border
};
void draw_box(SvgWriter& svg, const Rectangle& box, const std::string& name, const std::string& words,
              const BoxStyle& style);

/// From `from` by way of `control` to `to`.
struct Arrow {
  Vec2 from, control, to;

  [[nodiscard]] Vec2 at(double t) const;  ///< 0 to 1
};
/// With a head where it ends.
void draw_arrow(SvgWriter& svg, const Arrow& arrow);

/// Texts that stand in each other's way nowhere, each on an arrow of its own and, where there is room, on no other's.
class Labels {
 public:
  /// @param left, right  between which they stay, px
  Labels(std::vector<Rectangle> taken, std::vector<Arrow> arrows, double left, double right);

  /// Two lines near the middle of an arrow, the second paler.
  void draw(SvgWriter& svg, std::size_t arrow, const std::string& first, const std::string& second);

 private:
  [[nodiscard]] std::size_t crossed(const Rectangle& place, std::size_t own) const;

  std::vector<Rectangle> taken_;
  std::vector<Arrow> arrows_;
  std::vector<std::vector<Vec2>> points_;  // on each arrow
  double left_, right_;
};

}  // namespace tweenfall::plotting
