#include "plot/plot_panel.h"

#include "plot/label_rows.h"

#include <algorithm>
#include <cmath>

namespace tweenfall::plotting {

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

namespace {

struct LevelLabels {
  std::vector<std::string> texts;
  std::string base;  ///< what they are counted from, if they are
};

/// A curve that hardly changes has levels with more digits than the margin holds: these are counted from the lowest.
LevelLabels labels_of(const std::vector<double>& levels) {
  LevelLabels labels{tick_texts(levels), {}};
  constexpr double gap = 6, hardly = 1e-3;
  const auto fits = [](const std::string& text) { return text_width(text) <= left_margin - gap; };
  if (std::all_of(labels.texts.begin(), labels.texts.end(), fits)) return labels;
  if (levels.back() - levels.front() > hardly * std::abs(levels.front())) return labels;
  labels.base = labels.texts.front();
  std::vector<double> above;
  above.reserve(levels.size());
  for (const double level : levels) above.push_back(level - levels.front());
  labels.texts = tick_texts(above);
  for (std::size_t i = 1; i < above.size(); ++i) labels.texts[i].insert(0, "+");
  return labels;
}

}  // namespace

void draw_frame(SvgWriter& svg, const Panel& panel, bool time_labels) {
  const double left = panel.time.from, right = panel.time.to, bottom = panel.value.from, top = panel.value.to;
  svg.leaf("rect", {{"x", px(left)},
                    {"y", px(top)},
                    {"width", px(right - left)},
                    {"height", px(bottom - top)},
                    {"fill", "#ffffff"},
                    {"stroke", "#dddcd8"}});
  for (const auto& [from, to] : {std::pair(panel.time.low, std::min(panel.first_key, panel.time.high)),
                                 std::pair(std::max(panel.last_key, panel.time.low), panel.time.high)})
    if (from < to)
      svg.leaf("rect", {{"class", "beyond"},
                        {"x", px(panel.time.place(from))},
                        {"y", px(top)},
                        {"width", px(panel.time.place(to) - panel.time.place(from))},
                        {"height", px(bottom - top)},
                        {"fill", "#eeeeea"}});
  std::vector<double> levels;
  if (!panel.names.empty()) levels = ticks(panel.value, static_cast<int>((bottom - top) / 28));
  const LevelLabels labels = labels_of(levels);
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const double level = levels[i];
    const double y = panel.value.place(level);
    svg.leaf("path",
             {{"d", "M" + px(left) + " " + px(y) + "H" + px(right)}, {"stroke", level == 0 ? "#b5b5b0" : "#e9e8e5"}});
    svg.text(
        "text",
        {{"x", px(left - 6)}, {"y", px(y + 3.5)}, {"font-size", "10"}, {"text-anchor", "end"}, {"fill", "#6d7178"}},
        labels.texts[i]);
  }
  const std::vector<double> moments = ticks(panel.time, static_cast<int>((right - left) / 55));
  const std::vector<std::string> moment_texts = tick_texts(moments);
  for (std::size_t i = 0; i < moments.size(); ++i) {
    const double x = panel.time.place(moments[i]);
    svg.leaf("path", {{"d", "M" + px(x) + " " + px(bottom) + "V" + px(bottom - 4)}, {"stroke", "#b5b5b0"}});
    if (time_labels)
      svg.text(
          "text",
          {{"x", px(x)}, {"y", px(bottom + 14)}, {"font-size", "10"}, {"text-anchor", "middle"}, {"fill", "#6d7178"}},
          moment_texts[i] + " s");
  }
  // From the right: the components, as many as fit in half the width; a plain number needs no name.
  double x = right;
  for (std::size_t i = panel.names == std::vector<std::string>{"value"} ? 0 : panel.names.size(); i-- > 0;) {
    const bool is_cut = x < (left + right) / 2;
    svg.text("text",
             {{"x", px(x)},
              {"y", px(top - 6)},
              {"font-weight", "600"},
              {"text-anchor", "end"},
              {"fill", is_cut ? "#6d7178" : component_color(panel.names[i])}},
             is_cut ? "\xe2\x80\xa6" : panel.names[i]);
    x -= 8 + 7 * static_cast<double>(panel.names[i].size());
    if (is_cut) break;
  }
  // Letters of this size are a quarter wider than those measured.
  const std::string title = shortened(panel.title, (x - left) / 1.25);
  svg.text("text", {{"x", px(left)}, {"y", px(top - 6)}, {"font-weight", "600"}, {"fill", "#23262b"}}, title);
  const double after = left + 1.25 * text_width(title) + 6;
  const std::string unit =
      labels.base.empty() ? panel.unit : panel.unit + (panel.unit.empty() ? "" : " ") + "above " + labels.base;
  if (!unit.empty() && after + 1.1 * text_width(unit) < x)
    svg.text("text", {{"x", px(after)}, {"y", px(top - 6)}, {"fill", "#6d7178"}}, unit);
}

namespace {

struct Place {
  double x, y;
};

/// Whether the line from `from` to `to` passes all `between` so closely that no difference is visible.
bool is_straight(const Place& from, const std::vector<Place>& between, const Place& to) {
  constexpr double seen = 0.06;  // px
  const double across = to.x - from.x, up = to.y - from.y, length = std::sqrt(across * across + up * up);
  return std::all_of(between.begin(), between.end(), [&](const Place& place) {
    const double off = across * (place.y - from.y) - up * (place.x - from.x);
    return std::abs(off) <= seen * length;
  });
}

/// A path through places in order of x, without those that a straight line passes anyway.
void append_line(std::string& path, const std::vector<Place>& places) {
  constexpr std::size_t most = 60;
  std::vector<Place> between;
  const auto append = [&](char command, const Place& place) { path += command + px(place.x) + " " + px(place.y); };
  if (places.empty()) return;
  append('M', places.front());
  Place last = places.front();
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (i + 1 < places.size()) {
      between.push_back(places[i]);
      if (between.size() < most && is_straight(last, between, places[i + 1])) continue;
    }
    append('L', places[i]);
    last = places[i];
    between.clear();
  }
}

}  // namespace

void draw_curves(SvgWriter& svg, const Panel& panel, const std::vector<TrackPoint>& points, bool dashed) {
  for (std::size_t i = 0; i < panel.names.size(); ++i) {
    std::string path;
    std::vector<Place> places;
    double time_before = HUGE_VAL, number_before = 0;
    for (const TrackPoint& point : points) {
      const std::vector<double>& row = numbers(point, panel.shows);
      if (i >= row.size()) continue;
      if (std::isnan(row[i])) {
        append_line(path, places);
        places.clear();
        continue;
      }
      const bool jumps =
          point.time == time_before && std::abs(row[i] - number_before) > 1e-9 * std::max(1.0, std::abs(number_before));
      if (point.starts || jumps) {
        append_line(path, places);
        places.clear();
      }
      places.push_back({panel.time.place(point.time), panel.value.place(row[i])});
      time_before = point.time;
      number_before = row[i];
    }
    append_line(path, places);
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

}  // namespace tweenfall::plotting
