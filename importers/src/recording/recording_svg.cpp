#include <tweenfall/importers/recording_file.h>

#include <tweenfall/curves/number_text.h>

#include "document/read/values.h"
#include "figures/figures.h"
#include "plot/svg_writer.h"
#include "recording/dots_svg.h"
#include "recording/figure_jumps.h"
#include "recording/keyframes.h"
#include "recording/words.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tweenfall {

namespace recordings {
namespace {

using figures::Figure;
using figures::SideView;

constexpr double picture_width = 760, margin = 12, picture_head = 34, most_height = 400;
constexpr double lane_height = 18, lane_left = 110;
constexpr double rest = 0.8;                    // s; how long the last frame stays before the animation restarts
constexpr std::size_t most_bytes = 280 * 1000;  // project pages load it at each visit
constexpr std::size_t most_lanes = 6;

const char* const style =
    ".paper{fill:#f7f7f5}.ink{fill:#23262b}.quiet{fill:#6d7178}.ground{fill:#e4e5e6}.line{stroke:#c9cbce}"
    "@media(prefers-color-scheme:dark){.paper{fill:#17191d}.ink{fill:#e4e6e9}.quiet{fill:#969ba3}.ground{fill:#24282e}"
    ".line{stroke:#3a3f47}}";

// Visible on light and dark backgrounds, and distinguishable for color-blind people.
const char* owner_color(Owner owner) {
  return owner == Owner::keyed ? "#4274dd" : owner == Owner::driven ? "#d2408a" : "#ec9614";
}

struct Drawing {
  const Recording& recording;
  SideView view;
  double tolerance;
  double start, length;  // s
  plotting::SvgWriter svg;

  [[nodiscard]] double share(double time) const { return (time - start) / (length + rest); }
  /// Coordinates are as exact as the keyframes are.
  [[nodiscard]] int decimals() const { return tolerance < 1 ? 1 : 0; }
  [[nodiscard]] std::string number(double value) const { return short_text(value, decimals()); }
  [[nodiscard]] std::string place(const Vec2& at) const { return number(at.x()) + " " + number(at.y()); }
  [[nodiscard]] std::string duration() const { return short_text(length + rest, 4) + "s"; }
  [[nodiscard]] double lane_x(double time) const {
    return lane_left + (length > 0 ? (time - start) / length : 0) * (picture_width - margin - lane_left);
  }
};

/// The path of one frame of a figure; the commands are the same in each frame, so that paths can be interpolated.
std::string path_text(const Drawing& drawing, const Figure& figure, const std::vector<Vec2>& points) {
  static constexpr int box_order[] = {0, 1, 3, 2, 0, 4, 5, 1, 5, 7, 3, 7, 6, 2, 6, 4};
  std::string text;
  if (figure.kind == Figure::Kind::box) {
    for (const int corner : box_order)
      text += (text.empty() ? "M" : "L") + drawing.place(points[static_cast<std::size_t>(corner)]);
    return text;
  }
  if (figure.kind == Figure::Kind::lines) {
    for (std::size_t i = 0, line = 0; i < points.size(); ++i) {
      const bool starts = line < figure.starts.size() && figure.starts[line] == i;
      text += (starts ? "M" : "L") + drawing.place(points[i]);
      if (starts) ++line;
    }
    return text;
  }
  std::size_t first = 0;
  if (figure.kind == Figure::Kind::hull) {
    first = 1 + figures::hull_outline;
    for (std::size_t i = 1; i < first; ++i) text += (i == 1 ? "M" : "L") + drawing.place(points[i]);
    text += "Z";
  }
  for (std::size_t i = first; i < points.size(); ++i)
    text += ((i - first) % 2 == 0 ? "M" : "L") + drawing.place(points[i]);
  return text;
}

struct Series {
  std::string values, times;
};

/// Values of kept frames and their times as shares of the duration; the last value stays to the end, and what jumps
/// stays until then.
template <class ToText>
Series series(const Drawing& drawing, const std::vector<std::size_t>& kept, ToText to_text,
              const std::vector<FigureJump>& jumps = {}) {
  Series result;
  auto jump = jumps.begin();
  for (const std::size_t frame : kept) {
    for (; jump != jumps.end() && jump->frame == frame; ++jump) {
      const std::string then = short_text(drawing.share(jump->time), 5) + ";";
      result.values += to_text(frame - 1) + ";" + to_text(frame) + ";";
      result.times += then + then;
    }
    result.values += to_text(frame) + ";";
    result.times += short_text(drawing.share(drawing.recording.times[frame]), 5) + ";";
  }
  result.values += to_text(kept.back());
  result.times += "1";
  return result;
}

void animate(Drawing& drawing, const char* attribute, const Series& series, bool steps = false) {
  if (steps) {
    drawing.svg.leaf("animate", {{"attributeName", attribute},
                                 {"calcMode", "discrete"},
                                 {"dur", drawing.duration()},
                                 {"repeatCount", "indefinite"},
                                 {"keyTimes", series.times},
                                 {"values", series.values}});
  } else {
    drawing.svg.leaf("animate", {{"attributeName", attribute},
                                 {"dur", drawing.duration()},
                                 {"repeatCount", "indefinite"},
                                 {"keyTimes", series.times},
                                 {"values", series.values}});
  }
}

/// Frames at which the owner changes, the first among them.
std::vector<std::size_t> changes_of_owner(const NodeRecord& node) {
  std::vector<std::size_t> frames{0};
  for (std::size_t frame = 1; frame < node.owner.size(); ++frame)
    if (node.owner[frame] != node.owner[frame - 1]) frames.push_back(frame);
  return frames;
}

/// @return whether there is any
bool draw_ground(Drawing& drawing, const StageDescription& stage) {
  bool any = false;
  const SideView& view = drawing.view;
  const auto described = figures::descriptions(drawing.recording, stage);
  for (std::size_t i = 0; i < described.size(); ++i) {
    if (!described[i] || !described[i]->body) continue;
    const auto* plane = std::get_if<Plane>(&described[i]->body->shape.solid);
    if (!plane) continue;
    const WorldMotion& world = drawing.recording.nodes[i].world.front();
    const Vec3 normal = world.motion.pose.rotation * (described[i]->body->shape.offset.rotation * plane->normal);
    const Vec2 up = figures::flattened(normal, view.facing);
    if (up.squaredNorm() < 0.5) continue;  // a wall that faces us
    const Vec2 out = up.normalized(), along(-out.y(), out.x());
    const Vec2 on = view.place(world.point(described[i]->body->shape.offset.position + plane->normal * plane->offset));
    // Large enough to reach beyond every corner of the picture.
    const double far = 4 * (view.width + view.height);
    const Vec2 a = on - far * along, b = on + far * along, c = b - far * out, d = a - far * out;
    drawing.svg.leaf("path", {{"class", "ground"},
                              {"d", "M" + drawing.place(a) + "L" + drawing.place(b) + "L" + drawing.place(c) + "L" +
                                        drawing.place(d) + "Z"}});
    any = true;
  }
  return any;
}

void draw_trail(Drawing& drawing, const Figure& figure) {
  if (figure.fixed || figure.kind == Figure::Kind::bones || !figure.name.empty()) return;
  const NodeRecord& node = drawing.recording.nodes[figure.node];
  std::vector<std::vector<Vec2>> middles;
  for (const std::vector<Vec2>& points : figure.points) {
    Vec2 middle = points.front();
    if (figure.kind != Figure::Kind::ball && figure.kind != Figure::Kind::hull) {
      middle.setZero();
      for (const Vec2& point : points) middle += point / static_cast<double>(points.size());
    }
    middles.push_back({middle});
  }
  const std::vector<std::size_t> starts = frames_of(jumps_of(figure, drawing.recording));
  const std::vector<std::size_t> kept = key_frames(drawing.recording.times, middles, drawing.tolerance, starts);
  if (kept.size() == 2 && (middles[kept[0]][0] - middles[kept[1]][0]).norm() < 1) return;
  const std::vector<std::size_t> changes = changes_of_owner(node);
  for (std::size_t run = 0; run < changes.size(); ++run) {
    const std::size_t first = changes[run];
    const std::size_t last = run + 1 < changes.size() ? changes[run + 1] : drawing.recording.times.size() - 1;
    std::string path = "M" + drawing.place(middles[first][0]);
    const auto go_to = [&](std::size_t frame) {
      path += (std::ranges::binary_search(starts, frame) ? "M" : "L") + drawing.place(middles[frame][0]);
    };
    for (const std::size_t frame : kept)
      if (frame > first && frame < last) go_to(frame);
    if (last > first) go_to(last);
    drawing.svg.leaf("path", {{"fill", "none"},
                              {"stroke", owner_color(node.owner[first])},
                              {"stroke-width", "1.5"},
                              {"stroke-opacity", "0.4"},
                              {"d", path}});
  }
}

void draw_lines(Drawing& drawing, const Figure& figure) {
  const std::vector<std::size_t> kept = key_frames(drawing.recording.times, figure.points, drawing.tolerance);
  const bool still = kept.size() == 2 && figure.points[kept[0]] == figure.points[kept[1]];
  drawing.svg.open("g", {{"fill", "none"},
                         {"stroke", figure.color ? document::color_text(*figure.color).substr(0, 7) : "#a5713c"},
                         {"stroke-width", plotting::px(std::max(1.2, 2 * figure.radius))},
                         {"stroke-linejoin", "round"},
                         {"stroke-linecap", "round"}});
  drawing.svg.text("title", {}, figure.name);
  const auto path = [&](std::size_t frame) { return path_text(drawing, figure, figure.points[frame]); };
  drawing.svg.open("path", {{"d", path(0)}});
  if (!still) animate(drawing, "d", series(drawing, kept, path));
  drawing.svg.close();
  drawing.svg.close();
}

void draw_figure(Drawing& drawing, const Figure& figure) {
  if (figure.kind == Figure::Kind::lines) {
    draw_lines(drawing, figure);
    return;
  }
  const NodeRecord& node = drawing.recording.nodes[figure.node];
  const std::vector<FigureJump> jumps = jumps_of(figure, drawing.recording);
  const std::vector<std::size_t> kept =
      key_frames(drawing.recording.times, figure.points, drawing.tolerance, frames_of(jumps));
  const bool still = kept.size() == 2 && figure.points[kept[0]] == figure.points[kept[1]];
  const bool stick = figure.kind == Figure::Kind::stick;
  const std::string color = figure.fixed ? "#8f959d" : owner_color(node.owner.front());
  drawing.svg.open("g", {{"stroke", color},
                         {"fill", color},
                         {"fill-opacity", "0.3"},
                         {"stroke-width", stick                                ? plotting::px(2 * figure.radius)
                                          : figure.kind == Figure::Kind::bones ? "3"
                                                                               : "2"},
                         {"stroke-opacity", stick ? "0.7" : "1"},
                         {"stroke-linejoin", "round"},
                         {"stroke-linecap", "round"}});
  drawing.svg.text("title", {}, figure.name.empty() ? node.name : figure.name);
  if (const auto changes = changes_of_owner(node); changes.size() > 1 && !figure.fixed) {
    const Series colors =
        series(drawing, changes, [&](std::size_t frame) { return std::string(owner_color(node.owner[frame])); });
    animate(drawing, "stroke", colors, true);
    animate(drawing, "fill", colors, true);
  }
  const auto path = [&](std::size_t frame) { return path_text(drawing, figure, figure.points[frame]); };
  if (figure.kind == Figure::Kind::ball) {
    const auto x = [&](std::size_t frame) { return drawing.number(figure.points[frame][0].x()); };
    const auto y = [&](std::size_t frame) { return drawing.number(figure.points[frame][0].y()); };
    drawing.svg.open("circle", {{"r", plotting::px(figure.radius)}, {"cx", x(0)}, {"cy", y(0)}});
    if (!still) animate(drawing, "cx", series(drawing, kept, x, jumps));
    if (!still) animate(drawing, "cy", series(drawing, kept, y, jumps));
    drawing.svg.close();
  }
  drawing.svg.open("path", {{"d", path(0)}});
  if (!still) animate(drawing, "d", series(drawing, kept, path, jumps));
  drawing.svg.close();
  drawing.svg.close();
}

/// Bodies that change their owner, in order of the recording.
std::vector<std::size_t> lane_nodes(const Recording& recording) {
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < recording.nodes.size() && nodes.size() < most_lanes; ++i)
    if (changes_of_owner(recording.nodes[i]).size() > 1) nodes.push_back(i);
  return nodes;
}

void draw_lane(Drawing& drawing, std::size_t index, double top) {
  const NodeRecord& node = drawing.recording.nodes[index];
  drawing.svg.text(
      "text", {{"class", "quiet"}, {"x", plotting::px(margin)}, {"y", plotting::px(top + 12)}, {"font-size", "11"}},
      node.name.size() > 16 ? node.name.substr(0, 15) + "." : node.name);
  // Hand-offs have exact times, while frames only bracket them.
  const auto exact = [&](std::size_t frame) {
    for (const HandOff& handoff : drawing.recording.handoffs)
      if (handoff.node == index && handoff.time <= drawing.recording.times[frame] &&
          handoff.time > drawing.recording.times[frame - 1])
        return handoff.time;
    return drawing.recording.times[frame];
  };
  const std::vector<std::size_t> changes = changes_of_owner(node);
  for (std::size_t run = 0; run < changes.size(); ++run) {
    const double from = drawing.lane_x(run == 0 ? drawing.start : exact(changes[run]));
    const double to =
        drawing.lane_x(run + 1 < changes.size() ? exact(changes[run + 1]) : drawing.start + drawing.length);
    drawing.svg.leaf("rect", {{"x", plotting::px(from)},
                              {"y", plotting::px(top + 3)},
                              {"width", plotting::px(std::max(0.5, to - from))},
                              {"height", plotting::px(lane_height - 7)},
                              {"fill", owner_color(node.owner[changes[run]])}});
    if (run > 0)
      drawing.svg.leaf(
          "path",
          {{"class", "ink"}, {"d", "M" + plotting::px(from) + " " + plotting::px(top + lane_height - 1) + "l-4 5h8Z"}});
  }
}

void draw_time_bar(Drawing& drawing, const std::vector<std::size_t>& lanes, double top) {
  for (std::size_t i = 0; i < lanes.size(); ++i)
    draw_lane(drawing, lanes[i], top + static_cast<double>(i) * (lane_height + 4));
  const double bottom = top + static_cast<double>(lanes.size()) * (lane_height + 4) + 4;
  drawing.svg.leaf("path", {{"class", "line"},
                            {"fill", "none"},
                            {"d", "M" + plotting::px(drawing.lane_x(drawing.start)) + " " + plotting::px(bottom) + "H" +
                                      plotting::px(drawing.lane_x(drawing.start + drawing.length))}});
  // A name that would overlap the one before is left out.
  constexpr double letter_width = 5.4;
  double taken = -1e300;
  for (const StageEvent& event : drawing.recording.events) {
    const double middle = drawing.lane_x(event.time), half = letter_width * static_cast<double>(event.name.size()) / 2;
    if (!event.nodes.empty() || middle - half < taken + letter_width) continue;
    taken = middle + half;
    drawing.svg.text("text",
                     {{"class", "quiet"},
                      {"x", plotting::px(middle)},
                      {"y", plotting::px(bottom + 13)},
                      {"font-size", "10"},
                      {"text-anchor", "middle"}},
                     event.name);
  }
  const std::string from = plotting::px(drawing.lane_x(drawing.start)),
                    to = plotting::px(drawing.lane_x(drawing.start + drawing.length));
  drawing.svg.open("rect", {{"class", "ink"},
                            {"x", from},
                            {"y", plotting::px(top - 2)},
                            {"width", "1.5"},
                            {"height", plotting::px(bottom - top + 5)}});
  const std::string end = short_text(drawing.length / (drawing.length + rest), 5);
  animate(drawing, "x", {from + ";" + to + ";" + to, "0;" + end + ";1"});
  drawing.svg.close();
}

void draw_head(Drawing& drawing, const std::string& name) {
  drawing.svg.text(
      "text", {{"class", "ink"}, {"x", plotting::px(margin)}, {"y", "22"}, {"font-size", "14"}, {"font-weight", "600"}},
      name);
  double x = picture_width - margin;
  for (const Owner owner : {Owner::free, Owner::driven, Owner::keyed}) {
    const bool shown =
        std::any_of(drawing.recording.nodes.begin(), drawing.recording.nodes.end(), [&](const NodeRecord& node) {
          return std::find(node.owner.begin(), node.owner.end(), owner) != node.owner.end();
        });
    if (!shown) continue;
    x -= 64;
    drawing.svg.leaf("rect", {{"x", plotting::px(x)},
                              {"y", "12"},
                              {"width", "11"},
                              {"height", "11"},
                              {"rx", "2"},
                              {"fill", owner_color(owner)}});
    drawing.svg.text("text", {{"class", "quiet"}, {"x", plotting::px(x + 16)}, {"y", "22"}}, owner_word(owner));
  }
}

std::string draw(const Recording& recording, const StageDescription& stage, const figures::SideScene& scene,
                 double tolerance) {
  const std::vector<std::size_t> lanes = lane_nodes(recording);
  const auto& [view, list] = scene;
  const double bar = picture_head + view.height + 10;
  const double height = bar + static_cast<double>(lanes.size()) * (lane_height + 4) + 28;
  Drawing drawing{recording,
                  view,
                  tolerance,
                  recording.times.front(),
                  recording.times.back() - recording.times.front(),
                  plotting::SvgWriter(picture_width, height)};
  plotting::SvgWriter& svg = drawing.svg;
  svg.comment("tweenfall: keyframes within " + short_text(tolerance, 2) + " px of the recording");
  svg.text("style", {}, style);
  svg.leaf("rect", {{"class", "paper"}, {"width", "100%"}, {"height", "100%"}, {"rx", "8"}});
  draw_head(drawing, recording.name.empty() ? stage.name : recording.name);
  svg.open("clipPath", {{"id", "view"}});
  svg.leaf("rect", {{"x", plotting::px(view.left)},
                    {"y", plotting::px(view.top)},
                    {"width", plotting::px(view.width)},
                    {"height", plotting::px(view.height)},
                    {"rx", "4"}});
  svg.close();
  svg.open("g", {{"clip-path", "url(#view)"}});
  const bool grounded = draw_ground(drawing, stage);
  for (const Figure& figure : list) draw_trail(drawing, figure);
  for (const Figure& figure : list) draw_figure(drawing, figure);
  const DotsPicture dots{recording, view, drawing.start, drawing.length, rest};
  for (std::size_t i = 0; i < recording.particles.size(); ++i) {
    const bool told = i < stage.particles.size() && stage.particles[i].color.has_value();
    const std::string color = told ? document::color_text(*stage.particles[i].color).substr(0, 7) : "#3d9bd9";
    draw_dots(svg, dots, recording.particles[i], color);
  }
  svg.close();
  if (!grounded && list.empty() && recording.particles.empty())
    svg.text("text",
             {{"class", "quiet"},
              {"x", plotting::px(picture_width / 2)},
              {"y", plotting::px(view.top + view.height / 2)},
              {"text-anchor", "middle"}},
             "nothing here has a shape or a mesh: tweenfall plot draws the curves");
  draw_time_bar(drawing, lanes, bar);
  return svg.finish();
}

}  // namespace
}  // namespace recordings

std::string recording_svg(const Recording& recording, const StageDescription& stage) {
  check_recording(recording);
  if (recording.times.empty())
    throw std::invalid_argument("recording \"" + recording.name + "\" has no frames to show");
  const figures::SideScene scene =
      figures::side_scene(recording, stage, recordings::margin, recordings::picture_head,
                          recordings::picture_width - 2 * recordings::margin, recordings::most_height);
  // As exact as the size allows.
  for (double tolerance = 0.4;; tolerance *= 2) {
    std::string text = recordings::draw(recording, stage, scene, tolerance);
    if (text.size() <= recordings::most_bytes || tolerance > 20) return text;
  }
}

}  // namespace tweenfall
