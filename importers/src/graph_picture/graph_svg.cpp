#include <tweenfall/importers/graph_plot.h>

#include "graph_picture/machine_picture.h"
#include "graph_picture/pose_tree.h"

#include <algorithm>

namespace tweenfall {

namespace plotting {
namespace {

constexpr double graph_margin = 24, graph_heading = 34;

void draw_heading(SvgWriter& svg, double y, const char* size, const std::string& text) {
  svg.text("text",
           {{"x", px(graph_margin)}, {"y", px(y)}, {"font-size", size}, {"font-weight", "600"}, {"fill", "#24292f"}},
           text);
}

}  // namespace
}  // namespace plotting

std::string graph_svg(std::span<const GraphDescription> graphs) {
  using namespace plotting;
  double width = 640, height = graph_margin;
  const auto add = [&](const auto& picture) {
    width = std::max(width, picture.width() + 2 * graph_margin);
    height += graph_heading + picture.height();
  };
  for (const GraphDescription& graph : graphs) {
    add(PoseTree(graph));
    for (const GraphPose& pose : graph.poses)
      if (const auto* machine = std::get_if<MachinePose>(&pose.operation)) add(MachinePicture(*machine));
    height += graph_margin;
  }
  SvgWriter svg(width, height);
  svg.leaf("rect", {{"width", px(width)}, {"height", px(height)}, {"fill", "#ffffff"}});
  double top = graph_margin;
  for (const GraphDescription& graph : graphs) {
    const PoseTree tree(graph);
    draw_heading(svg, top + 14, "16", "graph " + graph.name);
    tree.draw(svg, graph_margin, top + graph_heading);
    top += graph_heading + tree.height();
    for (const GraphPose& pose : graph.poses)
      if (const auto* machine = std::get_if<MachinePose>(&pose.operation)) {
        const MachinePicture picture(*machine);
        draw_heading(svg, top + 30, "14", "machine " + pose.name);
        picture.draw(svg, graph_margin, top + graph_heading);
        top += graph_heading + picture.height();
      }
    top += graph_margin;
  }
  return svg.finish();
}

}  // namespace tweenfall
