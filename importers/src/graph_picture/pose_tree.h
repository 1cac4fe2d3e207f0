#pragma once

// How the poses of a graph depend on each other: clips on the left, the output on the right. Poses that only change one
// another stand in a stack, the first at the top.

#include <tweenfall/anim/graph.h>

#include "graph_picture/graph_boxes.h"
#include "graph_picture/layers.h"

#include <optional>
#include <string>
#include <vector>

namespace tweenfall::plotting {

class PoseTree {
 public:
  explicit PoseTree(const GraphDescription& graph);

  [[nodiscard]] double width() const noexcept { return width_; }
  [[nodiscard]] double height() const noexcept { return height_; }
  void draw(SvgWriter& svg, double left, double top) const;

 private:
  struct Column {
    double left, width;  // px
  };
  struct Thing {
    std::string name, words;
    std::vector<GraphOperand> operands;
    bool is_clip = false;
    std::size_t head = 0;    // the first thing of its stack
    std::size_t depth = 0;   // how many things stand above it there
    std::size_t above = 0;   // the one right above it, if there is one
    std::size_t cell = 0;    // the number of its stack
    std::size_t column = 0;  // how many stacks lie one in another below it
    double height = 0;       // of its box, px
    double drop = 0;         // of its top below that of its stack, px
    bool placed = false;
  };
  struct Wire {
    std::size_t from, to;
    std::string role;  // empty for what needs no words
  };
  void stack_up();
  std::size_t place(std::size_t thing);
  [[nodiscard]] std::size_t thing_of(const GraphOperand& operand) const;
  [[nodiscard]] Rectangle box(std::size_t thing, double left, double top) const;
  void draw_wire(SvgWriter& svg, std::size_t wire, double end_y, double left, double top) const;

  std::vector<Column> columns_;
  std::vector<Thing> things_;
  std::size_t output_ = 0;
  std::vector<Wire> wires_;
  std::vector<double> stack_heights_;  // px
  std::optional<Layers> layers_;
  double width_ = 0, height_ = 0;
};

}  // namespace tweenfall::plotting
