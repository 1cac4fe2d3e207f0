#include "plot/plot_marks.h"

#include <tweenfall/curves/color.h>

#include "plot/label_rows.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace tweenfall::plotting {

namespace {

constexpr const char* gray = "#8b9098";
constexpr double row_height = 11;  // px, of labels

/// A handle of a key in the drawing, px.
struct Arm {
  Vec2 key, tip;
  bool whole;  ///< not cut off by the frame
};

/// The share of the line from `place` by `way` that is within the frame, 0 to 1.
double share_within(const Panel& panel, const Vec2& place, const Vec2& way) {
  double share = 1;
  const auto limit = [&](double from, double step, double low, double high) {
    if (step > 0) share = std::min(share, (high - from) / step);
    if (step < 0) share = std::min(share, (low - from) / step);
  };
  limit(place.x(), way.x(), panel.time.from, panel.time.to);
  limit(place.y(), way.y(), panel.value.to, panel.value.from);
  return std::max(0.0, share);
}

std::vector<Arm> arms_of(const Panel& panel, const PlottedKey& key, std::size_t component) {
  const double across = (panel.time.to - panel.time.from) / (panel.time.high - panel.time.low);
  const double up = (panel.value.to - panel.value.from) / (panel.value.high - panel.value.low);
  std::vector<Arm> arms;
  for (const PlottedHandle& handle : key.handles) {
    if (handle.component != component) continue;
    const TrackPoint& side = handle.time < 0 ? key.in : key.out;
    const Vec2 place(panel.time.place(key.time), panel.value.place(side.values[component]));
    const Vec2 way(across * handle.time, up * handle.change);
    if (!place.allFinite() || !way.allFinite()) continue;
    const double share = share_within(panel, place, way);
    arms.push_back({place, place + share * way, share == 1});
  }
  return arms;
}

void draw_arm(SvgWriter& svg, const Arm& arm) {
  svg.leaf("path",
           {{"class", "handle"},
            {"d", "M" + px(arm.key.x()) + " " + px(arm.key.y()) + "L" + px(arm.tip.x()) + " " + px(arm.tip.y())},
            {"stroke", gray}});
  if (arm.whole) svg.leaf("circle", {{"cx", px(arm.tip.x())}, {"cy", px(arm.tip.y())}, {"r", "2"}, {"fill", gray}});
}

/// Whether keys are closer than the width of their marks; then marks are small, and handles are not drawn.
bool are_close(const Panel& panel, const PlottedTrack& plotted) {
  return (panel.time.to - panel.time.from) / static_cast<double>(plotted.keys.size() + 1) < 9;
}

/// For curves whose keys have slopes, but no handles.
void draw_slopes(SvgWriter& svg, const Panel& panel, const PlottedKey& key, std::size_t component) {
  constexpr double length = 14;  // px
  const double across = (panel.time.to - panel.time.from) / (panel.time.high - panel.time.low);
  const double up = (panel.value.to - panel.value.from) / (panel.value.high - panel.value.low);
  for (const bool arrives : {true, false}) {
    const TrackPoint& side = arrives ? key.in : key.out;
    if ((arrives ? key.first : key.last) || component >= side.rates.size()) continue;
    const Vec2 place(panel.time.place(key.time), panel.value.place(side.values[component]));
    const Vec2 way(across, up * side.rates[component]);
    if (!place.allFinite() || !way.allFinite()) continue;
    const Vec2 tip = way.stableNormalized() * (arrives ? -length : length);
    svg.leaf("path", {{"class", "slope"},
                      {"d", "M" + px(place.x()) + " " + px(place.y()) + "l" + px(tip.x()) + " " + px(tip.y())},
                      {"stroke", gray}});
  }
}

}  // namespace

void draw_keys(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted) {
  const bool is_close = are_close(panel, plotted);
  const bool has_handles =
      std::any_of(plotted.keys.begin(), plotted.keys.end(), [](const PlottedKey& key) { return !key.handles.empty(); });
  const bool rotates = std::holds_alternative<Curve<Quat>>(plotted.track->curve);
  std::vector<Vec2> last(panel.names.size(), Vec2(-HUGE_VAL, -HUGE_VAL));  // px
  for (const PlottedKey& key : plotted.keys) {
    for (std::size_t i = 0; i < panel.names.size() && i < key.out.values.size(); ++i) {
      if (std::isnan(key.out.values[i]) || std::isnan(key.in.values[i])) continue;
      const Vec2 place(panel.time.place(key.time), panel.value.place(key.out.values[i]));
      // Marks on top of each other are drawn once.
      if (is_close && (place - last[i]).norm() < 0.25) continue;
      last[i] = place;
      if (!is_close) {
        if (has_handles)
          for (const Arm& arm : arms_of(panel, key, i)) draw_arm(svg, arm);
        else if (!rotates || panel.names.size() == 1)
          draw_slopes(svg, panel, key, i);
      }
      const double x = place.x(), y = place.y();
      const std::string half = is_close ? "1.8" : "3.5";
      svg.leaf("path", {{"class", "key"},
                        {"d", "M" + px(x) + " " + px(y - (is_close ? 1.8 : 3.5)) + "l" + half + " " + half + "l-" +
                                  half + " " + half + "l-" + half + " -" + half + "Z"},
                        {"fill", component_color(panel.names[i])}});
    }
  }
}

void draw_moments(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted) {
  double last[] = {-HUGE_VAL, -HUGE_VAL};  // px, of the last event and the last hand-off
  for (const PlottedMoment& moment : plotted.moments) {
    const double x = panel.time.place(moment.time);
    // Closer lines are drawn once.
    if (std::abs(x - last[moment.handoff]) < 0.5) continue;
    last[moment.handoff] = x;
    svg.leaf("path", {{"class", moment.handoff ? "handoff" : "event"},
                      {"d", "M" + px(x) + " " + px(panel.value.from) + "V" + px(panel.value.to)},
                      {"stroke", moment.handoff ? "#d97a00" : gray},
                      {"stroke-width", moment.handoff ? "1.8" : "1"},
                      {"stroke-dasharray", moment.handoff ? "none" : "2 3"}});
  }
}

namespace {

/// Whether any curve passes through a box of the panel, px.
bool passes_through(const Panel& panel, const std::vector<TrackPoint>& points, double from, double to, double top,
                    double bottom) {
  // The points within the box, and one on each side, from which lines lead into it.
  const auto before = [&](const TrackPoint& point, double x) { return panel.time.place(point.time) < x; };
  auto first = std::lower_bound(points.begin(), points.end(), from, before);
  auto last = std::lower_bound(first, points.end(), to, before);
  if (first != points.begin()) --first;
  if (last != points.end()) ++last;
  for (std::size_t i = 0; i < panel.names.size(); ++i) {
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (auto point = first; point != last; ++point) {
      const std::vector<double>& row = numbers(*point, panel.shows);
      if (i >= row.size() || std::isnan(row[i])) continue;
      low = std::min(low, panel.value.place(row[i]));
      high = std::max(high, panel.value.place(row[i]));
    }
    if (low < bottom && high > top) return true;
  }
  return false;
}

std::vector<Arm> arms_of(const Panel& panel, const PlottedTrack& plotted) {
  std::vector<Arm> all;
  if (are_close(panel, plotted)) return all;
  for (const PlottedKey& key : plotted.keys)
    for (std::size_t i = 0; i < panel.names.size() && i < key.out.values.size(); ++i)
      for (const Arm& arm : arms_of(panel, key, i)) all.push_back(arm);
  return all;
}

/// Whether a part of it lies in a box, px.
bool passes_through(const Arm& arm, double from, double to, double top, double bottom) {
  double enters = 0, leaves = 1;  // as shares of the line
  const auto clip = [&](double start, double way, double low, double high) {
    if (way == 0) {
      if (start <= low || start >= high) leaves = -1;
      return;
    }
    enters = std::max(enters, std::min((low - start) / way, (high - start) / way));
    leaves = std::min(leaves, std::max((low - start) / way, (high - start) / way));
  };
  clip(arm.key.x(), arm.tip.x() - arm.key.x(), from, to);
  clip(arm.key.y(), arm.tip.y() - arm.key.y(), top, bottom);
  return enters <= leaves;
}

/// Moments of one name so close to each other that their names would lie on each other: told once.
struct NamedMoments {
  std::string name;
  double first, last;  ///< px
  int count = 1;
  int others = 0;  ///< of other names at the first of them

  [[nodiscard]] std::string text() const {
    std::string out = name;
    if (count > 1) out += " \xc3\x97" + std::to_string(count);  // a multiplication sign
    if (others > 0) out += " +" + std::to_string(others);
    return out;
  }
};

std::vector<NamedMoments> named_moments(const Panel& panel, const PlottedTrack& plotted, bool handoff) {
  constexpr std::size_t most_at_once = 3;
  std::vector<std::pair<double, const PlottedMoment*>> moments;
  for (const PlottedMoment& moment : plotted.moments)
    if (moment.handoff == handoff) moments.emplace_back(panel.time.place(moment.time), &moment);
  std::ranges::stable_sort(moments, {}, [](const auto& each) { return each.first; });
  std::vector<NamedMoments> groups;
  std::map<std::string, std::size_t> latest;
  for (const auto& [x, moment] : moments) {
    const auto [found, is_new] = latest.try_emplace(moment->name, groups.size());
    if (!is_new && x - groups[found->second].last < text_width(moment->name)) {
      groups[found->second].last = x;
      ++groups[found->second].count;
      continue;
    }
    if (groups.size() >= most_at_once && x - groups[groups.size() - most_at_once].first < 0.5) {
      latest.erase(found);
      ++groups.back().others;
      continue;
    }
    found->second = groups.size();
    groups.push_back({moment->name, x, x});
  }
  return groups;
}

}  // namespace

void draw_moment_names(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted) {
  const auto rows = static_cast<std::size_t>((panel.value.from - panel.value.to) / 2 / row_height);
  const std::vector<Arm> arms = arms_of(panel, plotted);
  for (const bool handoff : {true, false}) {
    LabelRows labels(panel.time.from, panel.time.to, rows);
    const auto baseline = [&](std::size_t row) {
      const double down = row_height * static_cast<double>(row);
      return handoff ? panel.value.to + 12 + down : panel.value.from - 5 - down;
    };
    const auto is_taken = [&](double from, double to, std::size_t row) {
      const double bottom = baseline(row) + 2, top = bottom - row_height;
      return passes_through(panel, plotted.curve, from, to, top, bottom) ||
             std::any_of(plotted.simulated.begin(), plotted.simulated.end(),
                         [&](const auto& points) { return passes_through(panel, points, from, to, top, bottom); }) ||
             std::any_of(arms.begin(), arms.end(),
                         [&](const Arm& arm) { return passes_through(arm, from, to, top, bottom); });
    };
    const auto draw = [&](double x, const std::string& text) {
      const std::optional<LabelRows::Place> place = labels.place(x, text, is_taken);
      if (!place) return false;
      svg.text("text",
               {{"class", "moment"},
                {"x", px(place->x)},
                {"y", px(baseline(place->row))},
                {"font-size", "10"},
                {"fill", handoff ? "#a85f00" : "#6d7178"}},
               text);
      return true;
    };
    int unnamed = 0;
    double last = panel.time.from;
    for (const NamedMoments& moments : named_moments(panel, plotted, handoff)) {
      if (draw(moments.first, shortened(moments.text(), panel.time.to - panel.time.from - 8))) continue;
      unnamed += moments.count;
      last = moments.first;
    }
    if (unnamed > 0) draw(last, "+" + std::to_string(unnamed));
  }
}

void draw_texts(SvgWriter& svg, const Panel& panel, const StepCurve<std::string>& curve) {
  LabelRows rows(panel.time.from, panel.time.to,
                 static_cast<std::size_t>((panel.value.from - panel.value.to - 20) / row_height));
  for (const auto& [time, text] : curve.steps()) {
    if (time < panel.time.low || time > panel.time.high) continue;
    const double x = panel.time.place(time);
    svg.leaf("path", {{"class", "key"},
                      {"d", "M" + px(x) + " " + px(panel.value.from) + "V" + px(panel.value.to)},
                      {"stroke", "#dddcd8"}});
    const std::string shown = shortened(text, (panel.time.to - panel.time.from) / 2);
    const std::optional<LabelRows::Place> place = rows.place(x, shown);
    if (!place) continue;
    svg.text("text",
             {{"x", px(place->x)},
              {"y", px(panel.value.to + 16 + row_height * static_cast<double>(place->row))},
              {"font-size", "10"},
              {"fill", "#23262b"}},
             shown);
  }
}

namespace {

/// "#rrggbb", the nearest color of screens; parts that are not numbers become black.
std::string color_text(const std::vector<double>& linear) {
  const Vec4 parts = to_space(Color{{linear[0], linear[1], linear[2], 1}}, ColorSpace::srgb);
  std::string text = "#";
  for (Eigen::Index i = 0; i < 3; ++i) {
    const int byte = parts[i] > 0 ? static_cast<int>(std::floor(std::min(parts[i], 1.0) * 255 + 0.5)) : 0;
    text += "0123456789abcdef"[byte / 16];
    text += "0123456789abcdef"[byte % 16];
  }
  return text;
}

}  // namespace

void draw_colors(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted) {
  std::string before;
  double from = panel.time.from;
  const auto strip = [&](double to) {
    if (!before.empty() && to > from)
      svg.leaf("rect", {{"class", "color"},
                        {"x", px(from)},
                        {"y", px(panel.value.to + 1)},
                        {"width", px(to - from)},
                        {"height", "8"},
                        {"fill", before},
                        {"shape-rendering", "crispEdges"}});
    from = to;
  };
  for (const TrackPoint& point : plotted.curve) {
    const std::string color = color_text(point.values);
    const double x = panel.time.place(point.time);
    // Strips of three pixels are fine enough; jumps are drawn at their exact place.
    if (color == before || (!before.empty() && x < from + 3 && !point.starts)) continue;
    strip(x);
    before = color;
  }
  strip(panel.time.to);
}

void draw_legend(SvgWriter& svg, const PlottedStage& plotted, double x, double y) {
  const auto any = [&](auto has) { return std::any_of(plotted.tracks.begin(), plotted.tracks.end(), has); };
  const auto any_key = [&](auto has) {
    return any([&](const PlottedTrack& track) { return std::any_of(track.keys.begin(), track.keys.end(), has); });
  };
  const auto any_moment = [&](bool handoff) {
    return any([&](const PlottedTrack& track) {
      return std::any_of(track.moments.begin(), track.moments.end(),
                         [&](const PlottedMoment& moment) { return moment.handoff == handoff; });
    });
  };
  const auto line = [&](const std::string& path, const char* color, const char* width, const char* dashes) {
    svg.leaf("path", {{"d", path}, {"stroke", color}, {"stroke-width", width}, {"stroke-dasharray", dashes}});
  };
  const auto name = [&](const std::string& text, double after) {
    svg.text("text", {{"x", px(x + after)}, {"y", px(y)}, {"font-size", "10"}, {"fill", "#6d7178"}}, text);
    x += after + text_width(text) + 14;
  };
  const std::string flat = "M" + px(x) + " " + px(y - 3.5) + "h16";
  line(flat, "#23262b", "1.8", "none");
  name("curve", 20);
  if (any_key([](const PlottedKey&) { return true; })) {
    svg.leaf("path", {{"d", "M" + px(x + 4) + " " + px(y - 7) + "l3.5 3.5l-3.5 3.5l-3.5 -3.5Z"}, {"fill", "#23262b"}});
    name("key", 11);
  }
  if (any_key([](const PlottedKey& key) { return !key.handles.empty(); })) {
    line("M" + px(x) + " " + px(y - 3.5) + "h14", gray, "1", "none");
    svg.leaf("circle", {{"cx", px(x + 14)}, {"cy", px(y - 3.5)}, {"r", "2"}, {"fill", gray}});
    name("handle", 20);
  }
  if (any([&](const PlottedTrack& track) {
        return track.first_key > plotted.from || track.last_key < plotted.until;
      })) {
    svg.leaf("rect", {{"x", px(x)},
                      {"y", px(y - 9)},
                      {"width", "14"},
                      {"height", "11"},
                      {"fill", "#eeeeea"},
                      {"stroke", "#dddcd8"}});
    name("beyond the keys", 18);
  }
  if (any([](const PlottedTrack& track) { return !track.simulated.empty(); })) {
    line("M" + px(x) + " " + px(y - 3.5) + "h16", "#23262b", "1.4", "5 3");
    name("simulated", 20);
  }
  if (any_moment(false)) {
    line("M" + px(x + 3) + " " + px(y - 9) + "v11", gray, "1", "2 3");
    name("event", 9);
  }
  if (any_moment(true)) {
    line("M" + px(x + 3) + " " + px(y - 9) + "v11", "#d97a00", "1.8", "none");
    name("hand-off", 9);
  }
}

}  // namespace tweenfall::plotting
