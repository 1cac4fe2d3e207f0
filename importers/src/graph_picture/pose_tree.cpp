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
  place(output_);
  for (std::size_t i = 0; i < things_.size(); ++i)
    if (!things_[i].placed) place(i);
  std::vector<std::size_t> columns;
  std::vector<double> heights;
  std::vector<Layers::Wire> wires;
  for (std::size_t i = 0; i < things_.size(); ++i) {
    std::size_t ports = 0;
    for (const GraphOperand& operand : things_[i].operands) {
      const std::size_t part = thing_of(operand);
      if (part == things_.size() || things_[part].column >= things_[i].column) continue;
      wires_.push_back({part, i, operand.clip ? "" : operand.role});
      wires.push_back({part, i});
      ++ports;
    }
    columns.push_back(things_[i].column);
    things_[i].height = std::max(tree_box_height, port_spacing * static_cast<double>(ports + 1));
    heights.push_back(things_[i].height + tree_gap);
  }
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

// What it is made of comes first.
std::size_t PoseTree::place(std::size_t index) {
  things_[index].placed = true;
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
  return around({left + column.left + column.width / 2, top + layers_->middle_of(thing)}, column.width,
                things_[thing].height);
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
    const std::vector<std::size_t> wires = layers_->wires_to(i);
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
