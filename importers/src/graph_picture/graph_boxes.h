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

struct BoxStyle {
  std::string fill, stroke;
  double round = 6;
  bool strong = false;  // a thicker border
};
void draw_box(SvgWriter& svg, const Rectangle& box, const std::string& name, const std::string& words,
              const BoxStyle& style);

/// From `from` by way of `control` to `to`, with a head there.
void draw_arrow(SvgWriter& svg, const Vec2& from, const Vec2& control, const Vec2& to);

/// Places texts so that they do not overlap.
class Labels {
 public:
  explicit Labels(std::vector<Rectangle> taken) : taken_(std::move(taken)) {}

  /// Two lines near the middle of a curve, the second paler.
  void draw(SvgWriter& svg, const Vec2& from, const Vec2& control, const Vec2& to, const std::string& first,
            const std::string& second);

 private:
  std::vector<Rectangle> taken_;
};

}  // namespace tweenfall::plotting
