#pragma once

// How the poses of a graph depend on each other: clips on the left, the output on the right.

#include <tweenfall/anim/graph.h>

#include "graph_picture/graph_boxes.h"

namespace tweenfall::plotting {

class PoseTree {
 public:
  explicit PoseTree(const GraphDescription& graph);

  [[nodiscard]] double width() const noexcept { return width_; }
  [[nodiscard]] double height() const noexcept { return height_; }
  void draw(SvgWriter& svg, double left, double top) const;

 private:
  struct Thing {
    std::string name, words;
    std::vector<GraphOperand> operands;
    bool is_clip = false;
    std::size_t level = 0;  // nesting depth below it
    double row = 0;
    bool placed = false;
  };
  [[nodiscard]] std::size_t place(std::size_t thing);
  [[nodiscard]] std::size_t thing_of(const GraphOperand& operand) const;
  [[nodiscard]] Rectangle box(const Thing& thing, double left, double top) const;

  std::vector<Thing> things_;
  std::size_t output_ = 0;
  std::vector<double> next_row_;  // by level: the first free row
  double width_ = 0, height_ = 0;
};

}  // namespace tweenfall::plotting
