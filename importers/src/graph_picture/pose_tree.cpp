#include "graph_picture/pose_tree.h"

#include "plot/label_rows.h"

#include <algorithm>

namespace tweenfall::plotting {

namespace {

constexpr double tree_box_width = 150, tree_box_height = 40, tree_column = 270, tree_row = 52;

}  // namespace

PoseTree::PoseTree(const GraphDescription& graph) {
  for (const std::string& clip : clips_named_in(graph)) {
    Thing& thing = things_.emplace_back();
    thing.name = clip;
    thing.words = "clip";
    thing.is_clip = true;
  }
  for (const GraphPose& pose : graph.poses) {
    if (pose.name == graph.output) output_ = things_.size();
    Thing& thing = things_.emplace_back();
    thing.name = pose.name;
    thing.words = words_of(pose.operation);
    thing.operands = operands_of(pose.operation);
  }
  if (things_.empty()) return;
  if (graph.output.empty()) output_ = things_.size() - 1;
  static_cast<void>(place(output_));
  for (std::size_t i = 0; i < things_.size(); ++i)
    if (!things_[i].placed) static_cast<void>(place(i));
  for (const Thing& thing : things_) {
    width_ = std::max(width_, static_cast<double>(thing.level) * tree_column + tree_box_width);
    height_ = std::max(height_, (thing.row + 1) * tree_row);
  }
}

std::size_t PoseTree::thing_of(const GraphOperand& operand) const {
  const auto is = [&](const Thing& thing) { return thing.name == operand.pose && (thing.is_clip || !operand.clip); };
  // A pose takes precedence over a clip of the same name, unless only clips are meant.
  if (!operand.clip)
    for (std::size_t i = 0; i < things_.size(); ++i)
      if (!things_[i].is_clip && is(things_[i])) return i;
  for (std::size_t i = 0; i < things_.size(); ++i)
    if (things_[i].is_clip && is(things_[i])) return i;
  return things_.size();
}

// Its operands are placed first, and it is placed at their middle.
std::size_t PoseTree::place(std::size_t index) {
  things_[index].placed = true;
  double sum = 0;
  std::size_t level = 0, count = 0;
  for (const GraphOperand& operand : std::vector<GraphOperand>(things_[index].operands)) {
    const std::size_t part = thing_of(operand);
    if (part == things_.size()) continue;
    const std::size_t of = things_[part].placed ? things_[part].level : place(part);
    level = std::max(level, of + 1);
    sum += things_[part].row;
    ++count;
  }
  Thing& thing = things_[index];
  thing.level = level;
  if (next_row_.size() <= level) next_row_.resize(level + 1, 0);
  thing.row = std::max(next_row_[level], count > 0 ? sum / static_cast<double>(count) : 0);
  next_row_[level] = thing.row + 1;
  return level;
}

Rectangle PoseTree::box(const Thing& thing, double left, double top) const {
  const double x = left + static_cast<double>(thing.level) * tree_column, y = top + thing.row * tree_row;
  return {x, y, x + tree_box_width, y + tree_box_height};
}

void PoseTree::draw(SvgWriter& svg, double left, double top) const {
  std::vector<Rectangle> taken;
  for (const Thing& thing : things_) taken.push_back(box(thing, left, top));
  for (const Thing& thing : things_)
    for (const GraphOperand& operand : thing.operands) {
      const std::size_t part = thing_of(operand);
      if (part == things_.size()) continue;
      const Rectangle from = box(things_[part], left, top), to = box(thing, left, top);
      const Vec2 start(from.right, from.center().y()), end(to.left, to.center().y());
      const double bend = std::max(40.0, (end.x() - start.x()) / 2);
      svg.leaf("path", {{"d", "M" + px(start.x(), start.y()) + " C" + px(start.x() + bend, start.y()) + " " +
                                  px(end.x() - bend, end.y()) + " " + px(end.x(), end.y())},
                        {"fill", "none"},
                        {"stroke", "#afb8c1"},
                        {"stroke-width", "1.4"}});
      if (operand.clip) continue;
      const std::string words = shortened(operand.role, tree_column - tree_box_width - 16);
      Rectangle place{start.x() + 6, start.y() - 15, start.x() + 6 + text_width(words), start.y() - 3};
      while (std::ranges::any_of(taken, [&](const Rectangle& other) { return place.overlaps(other); }))
        place = {place.left, place.top + 13, place.right, place.bottom + 13};
      taken.push_back(place);
      svg.text("text", {{"x", px(place.left)}, {"y", px(place.bottom - 2)}, {"font-size", "10"}, {"fill", "#57606a"}},
               words);
    }
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const Thing& thing = things_[i];
    const bool shows = i == output_;
    const BoxStyle style = thing.is_clip
                               ? BoxStyle{"#ddf4ff", "#54aeff", 6, false}
                               : BoxStyle{shows ? "#fff8c5" : "#f6f8fa", shows ? "#bf8700" : "#8c959f", 6, shows};
    draw_box(svg, box(thing, left, top), thing.name, shows ? thing.words + ", shows" : thing.words, style);
  }
}

}  // namespace tweenfall::plotting
