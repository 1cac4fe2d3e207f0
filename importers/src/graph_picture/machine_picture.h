#pragma once

// A machine: its states around an ellipse, its transitions as arrows with words.

#include <tweenfall/anim/graph.h>

#include "graph_picture/graph_boxes.h"

namespace tweenfall::plotting {

class MachinePicture {
 public:
  explicit MachinePicture(const MachinePose& machine);

  [[nodiscard]] double width() const noexcept { return 2 * reach_.x() + 300; }
  [[nodiscard]] double height() const noexcept { return 2 * reach_.y() + (self_or_any_ ? 200 : 84); }
  void draw(SvgWriter& svg, double left, double top) const;

 private:
  [[nodiscard]] std::size_t state(const std::string& name) const;
  [[nodiscard]] Vec2 direction(std::size_t state) const;  // from the middle
  [[nodiscard]] Rectangle box(std::size_t state, const Vec2& middle) const;

  const MachinePose& machine_;
  bool self_or_any_ = false;  // some arrow is outside the ellipse
  Vec2 reach_;                // half axes of the ellipse, px
};

}  // namespace tweenfall::plotting
