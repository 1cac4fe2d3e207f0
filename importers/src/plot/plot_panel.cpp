#include "plot/plot_panel.h"

#include <tweenfall/importers/number_text.h>

namespace tweenfall {

const std::vector<double>& numbers(const TrackPoint& point, Shows shows) {
  return shows == Shows::values ? point.values : point.rates;
}

const char* component_color(const std::string& name) {
  if (name == "x" || name == "r") return "#c8323c";
  if (name == "y" || name == "g") return "#2f8f3a";
  if (name == "z" || name == "b") return "#2f62d0";
  if (name == "w" || name == "a") return "#8a5bb0";
  return "#23262b";
}

void draw_frame(SvgWriter& svg, const Panel& panel, bool time_labels) {
  const double left = panel.time.from, right = panel.time.to, bottom = panel.value.from, top = panel.value.to;
  svg.leaf("rect", {{"x", px(left)},
                    {"y", px(top)},
                    {"width", px(right - left)},
                    {"height", px(bottom - top)},
                    {"fill", "#ffffff"},
                    {"stroke", "#dddcd8"}});
  const std::vector<double> levels = ticks(panel.value, static_cast<int>((bottom - top) / 28));
  for (const double level : levels) {
    const double y = panel.value.place(level);
    svg.leaf("path",
             {{"d", "M" + px(left) + " " + px(y) + "H" + px(right)}, {"stroke", level == 0 ? "#b5b5b0" : "#e9e8e5"}});
    svg.text(
        "text",
        {{"x", px(left - 6)}, {"y", px(y + 3.5)}, {"font-size", "10"}, {"text-anchor", "end"}, {"fill", "#6d7178"}},
        short_text(level, tick_decimals(levels)));
  }
  const std::vector<double> moments = ticks(panel.time, static_cast<int>((right - left) / 70));
  for (const double moment : moments) {
    const double x = panel.time.place(moment);
    svg.leaf("path", {{"d", "M" + px(x) + " " + px(bottom) + "V" + px(bottom - 4)}, {"stroke", "#b5b5b0"}});
    if (time_labels)
      svg.text(
          "text",
          {{"x", px(x)}, {"y", px(bottom + 14)}, {"font-size", "10"}, {"text-anchor", "middle"}, {"fill", "#6d7178"}},
          short_text(moment, tick_decimals(moments)) + " s");
  }
  svg.text("text", {{"x", px(left)}, {"y", px(top - 6)}, {"font-weight", "600"}, {"fill", "#23262b"}}, panel.title);
  double x = right;
  for (std::size_t i = panel.names.size(); i-- > 0;) {
    svg.text("text",
             {{"x", px(x)},
              {"y", px(top - 6)},
              {"font-weight", "600"},
              {"text-anchor", "end"},
              {"fill", component_color(panel.names[i])}},
             panel.names[i]);
    x -= 8 + 7 * static_cast<double>(panel.names[i].size());
  }
}

void draw_curves(SvgWriter& svg, const Panel& panel, const std::vector<TrackPoint>& points, bool dashed) {
  for (std::size_t i = 0; i < panel.names.size(); ++i) {
    std::string path;
    bool pen_up = true;
    for (const TrackPoint& point : points) {
      const std::vector<double>& row = numbers(point, panel.shows);
      if (i >= row.size()) continue;
      path += pen_up || point.starts ? 'M' : 'L';
      path += px(panel.time.place(point.time)) + " " + px(panel.value.place(row[i]));
      pen_up = false;
    }
    if (path.empty()) continue;
    svg.leaf("path", {{"class", dashed ? "simulated" : "curve"},
                      {"d", path},
                      {"fill", "none"},
                      {"stroke", component_color(panel.names[i])},
                      {"stroke-width", dashed ? "1.4" : "1.8"},
                      {"stroke-linejoin", "round"},
                      {"stroke-dasharray", dashed ? "5 3" : "none"}});
  }
}

}  // namespace tweenfall
