#include "graph_picture/pose_tree.h"

#include "plot/label_rows.h"

#include <algorithm>

namespace tweenfall::plotting {

namespace {

/// Boxes of a column are as wide as the longest of their words needs, between these; px.
constexpr double narrowest_box = 150, widest_box = 340;
constexpr double tree_box_height = 40, between_columns = 160, tree_gap = 12;  // px
/// Of a wire before the box to which it comes, where its words stand on it; and from one such wire to the next, px.
constexpr double port_length = 92, port_spacing = 14;
constexpr double between_stacked = 14;  // px

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
  stack_up();
  place(output_);
  for (std::size_t i = 0; i < things_.size(); ++i)
    if (!things_[i].placed) place(i);
  for (std::size_t i = 0; i < things_.size(); ++i) {
    std::size_t ports = 0;
    for (const GraphOperand& operand : things_[i].operands) {
      const std::size_t part = thing_of(operand);
      if (part == things_.size() || things_[part].column >= things_[i].column) continue;
      wires_.push_back({part, i, operand.clip ? "" : operand.role});
      ++ports;
    }
    things_[i].height = std::max(tree_box_height, port_spacing * static_cast<double>(ports + 1));
  }
  std::vector<std::size_t> columns;
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (things_[i].head != i) continue;
    things_[i].cell = columns.size();
    columns.push_back(things_[i].column);
  }
  stack_heights_.assign(columns.size(), 0);
  // In the order of each stack, which need not be that of the poses.
  std::vector<std::size_t> order(things_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return things_[i].depth; });
  for (const std::size_t i : order) {
    Thing& thing = things_[i];
    thing.cell = things_[thing.head].cell;
    double& height = stack_heights_[thing.cell];
    thing.drop = height > 0 ? height + between_stacked : 0;
    height = thing.drop + thing.height;
  }
  std::vector<double> heights = stack_heights_;
  for (double& height : heights) height += tree_gap;
  std::vector<Layers::Wire> wires;
  for (const Wire& wire : wires_) wires.push_back({things_[wire.from].cell, things_[wire.to].cell});
  layers_.emplace(columns, heights, std::move(wires));
  height_ = layers_->height();
  things_[output_].words += ", shows";
  for (const Thing& thing : things_) {
    if (columns_.size() <= thing.column) columns_.resize(thing.column + 1, {0, narrowest_box});
    double& width = columns_[thing.column].width;
    width = std::max(width, std::min(box_width_of(thing.name, thing.words), widest_box));
  }
  for (Column& column : columns_) {
    column.left = width_ > 0 ? width_ + between_columns : 0;
    width_ = column.left + column.width;
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

// A pose of one other, which only it uses and which is not made of several, stands below that.
void PoseTree::stack_up() {
  std::vector<std::size_t> uses(things_.size(), 0), above(things_.size(), things_.size());
  for (std::size_t i = 0; i < things_.size(); ++i)
    for (const GraphOperand& operand : things_[i].operands)
      if (const std::size_t part = thing_of(operand); part < things_.size()) {
        ++uses[part];
        const bool alone =
            operand.role == "base" && things_[i].operands.size() == 1 && things_[part].operands.size() <= 1;
        if (alone && !things_[part].is_clip) above[i] = part;
      }
  for (std::size_t i = 0; i < things_.size(); ++i) {
    Thing& thing = things_[i];
    thing.head = i;
    while (above[thing.head] < things_.size() && uses[above[thing.head]] == 1 && thing.depth < things_.size()) {
      thing.head = above[thing.head];
      ++thing.depth;
    }
    thing.above = above[i];
  }
}

// What it is made of comes first.
std::size_t PoseTree::place(std::size_t index) {
  things_[index].placed = true;
  if (const std::size_t head = things_[index].head; head != index)
    return things_[index].column = things_[head].placed ? things_[head].column : place(head);
  std::size_t column = 0;
  for (const GraphOperand& operand : std::vector<GraphOperand>(things_[index].operands)) {
    const std::size_t part = thing_of(operand);
    if (part == things_.size()) continue;
    column = std::max(column, (things_[part].placed ? things_[part].column : place(part)) + 1);
  }
  return things_[index].column = column;
}

Rectangle PoseTree::box(std::size_t thing, double left, double top) const {
  const Column& column = columns_[things_[thing].column];
  const Thing& one = things_[thing];
  const double stack_top = layers_->middle_of(one.cell) - stack_heights_[one.cell] / 2;
  return around({left + column.left + column.width / 2, top + stack_top + one.drop + one.height / 2}, column.width,
                one.height);
}

// Straight through the columns that it skips, bent between them, and straight again where its words stand on it.
void PoseTree::draw_wire(SvgWriter& svg, std::size_t wire, double end_y, double left, double top) const {
  const auto [from, to, role] = wires_[wire];
  const Rectangle start = box(from, left, top), end = box(to, left, top);
  Vec2 at(start.right, start.center().y());
  std::string path = "M" + px(at.x(), at.y());
  const auto bend_to = [&](const Vec2& next) {
    const double bend = (next.x() - at.x()) / 2;
    path += " C" + px(at.x() + bend, at.y()) + " " + px(next.x() - bend, next.y()) + " " + px(next.x(), next.y());
    at = next;
  };
  std::size_t column = things_[from].column;
  for (const double lane : layers_->lanes_of(wire)) {
    const Column& skipped = columns_[++column];
    bend_to({left + skipped.left - port_length, top + lane});
    at.x() = left + skipped.left + skipped.width;
    path += " L" + px(at.x(), at.y());
  }
  bend_to({end.left - port_length, end_y});
  path += " L" + px(end.left, end_y);
  svg.leaf("path", {{"d", path}, {"fill", "none"}, {"stroke", "#afb8c1"}, {"stroke-width", "1.4"}});
  if (role.empty()) return;
  svg.text(
      "text",
      {{"x", px(end.left - 5)}, {"y", px(end_y - 3)}, {"text-anchor", "end"}, {"font-size", "10"}, {"fill", "#57606a"}},
      shortened(role, port_length - 10));
}

void PoseTree::draw(SvgWriter& svg, double left, double top) const {
  for (std::size_t i = 0; i < things_.size(); ++i) {
    if (things_[i].head != i) {
      const Rectangle from = box(things_[i].above, left, top), to = box(i, left, top);
      svg.leaf("path", {{"d", "M" + px(from.center().x(), from.bottom) + " L" + px(to.center().x(), to.top)},
                        {"stroke", "#afb8c1"},
                        {"stroke-width", "1.4"}});
      continue;
    }
    const std::vector<std::size_t> wires = layers_->wires_to(things_[i].cell);
    const double first = box(i, left, top).center().y() - port_spacing * (static_cast<double>(wires.size()) - 1) / 2;
    for (std::size_t port = 0; port < wires.size(); ++port)
      draw_wire(svg, wires[port], first + port_spacing * static_cast<double>(port), left, top);
  }
  for (std::size_t i = 0; i < things_.size(); ++i) {
    const Thing& thing = things_[i];
    const bool shows = i == output_;
    const BoxStyle style = thing.is_clip
                               ? BoxStyle{"#ddf4ff", "#54aeff", 6, false}
                               : BoxStyle{shows ? "#fff8c5" : "#f6f8fa", shows ? "#bf8700" : "#8c959f", 6, shows};
    draw_box(svg, box(i, left, top), thing.name, thing.words, style);
  }
}

}  // namespace tweenfall::plotting
