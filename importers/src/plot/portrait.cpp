#include <tweenfall/curves/number_text.h>
#include <tweenfall/importers/portrait_plot.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "plot/axis.h"
#include "plot/svg_writer.h"

namespace tweenfall {

namespace plotting {
namespace {

constexpr double portrait_width = 470, energy_width = 430, portrait_height = 400, portrait_head = 64,
                 portrait_left = 62, portrait_foot = 46;
constexpr const char *own_color = "#d1495b", *other_color = "#3d6fa5", *arrow_color = "#b3b8c0", *ink = "#23262b",
                     *pale_ink = "#6d7178", *portrait_frame = "#d4d6da";
/// Beyond this nothing is drawn: a path that a method blows up leaves the picture.
constexpr double most_drawn = 1e12;

struct PortraitPoint {
  double across, up;
};

using Places = std::vector<PortraitPoint>;

struct Range {
  double low = HUGE_VAL, high = -HUGE_VAL;
  void take(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] Axis axis(double from, double to) const {
    Axis result{low, high, from, to};
    if (!(result.low <= result.high)) result.low = result.high = 0;
    add_room(result.low, result.high);
    return result;
  }
};

double number_of(const FirstOrderPath& path, std::size_t at, std::size_t number) {
  return number == 0 ? path.times[at] : path.states[at][number - 1];
}

bool drawn(const PortraitPoint& place) {
  return std::abs(place.across) <= most_drawn && std::abs(place.up) <= most_drawn;
}

Places portrait_of(const ExpressionSystem& system, const FirstOrderPath& path) {
  Places places;
  for (std::size_t at = 0; at < path.times.size(); ++at) {
    const PortraitPoint place{number_of(path, at, system.across), number_of(path, at, system.up)};
    if (!drawn(place)) break;
    places.push_back(place);
  }
  return places;
}

Places energy_of(const ExpressionSystem& system, const FirstOrderPath& path) {
  Places places;
  for (std::size_t at = 0; at < path.times.size(); ++at) {
    const PortraitPoint place{path.times[at], value_at(*system.energy, path.times[at], path.states[at])};
    if (!std::isfinite(place.up) || !drawn(place)) break;
    places.push_back(place);
  }
  return places;
}

/// The points of a path, without those too close to be visible.
std::string points_text(const Places& places, const Axis& across, const Axis& up) {
  constexpr double seen = 0.6;  // px
  std::string text;
  double last_x = -HUGE_VAL, last_y = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const double x = across.place(places[i].across), y = up.place(places[i].up);
    const double moved = (x - last_x) * (x - last_x) + (y - last_y) * (y - last_y);
    if (i + 1 < places.size() && moved < seen * seen) continue;
    text += (text.empty() ? "" : " ") + px(x, y);
    last_x = x;
    last_y = y;
  }
  return text;
}

void draw_way(SvgWriter& svg, const Places& places, const Axis& across, const Axis& up, const char* color,
              const char* width) {
  svg.leaf("polyline", {{"points", points_text(places, across, up)},
                        {"fill", "none"},
                        {"stroke", color},
                        {"stroke-width", width},
                        {"stroke-linejoin", "round"}});
}

void draw_axes(SvgWriter& svg, const Axis& across, const Axis& up, const std::string& across_name,
               const std::string& up_name) {
  svg.leaf("rect", {{"x", px(across.from)},
                    {"y", px(up.to)},
                    {"width", px(across.to - across.from)},
                    {"height", px(up.from - up.to)},
                    {"fill", "#ffffff"},
                    {"stroke", portrait_frame}});
  const std::vector<double> columns = ticks(across, 6), rows = ticks(up, 6);
  const std::vector<std::string> column_texts = tick_texts(columns), row_texts = tick_texts(rows);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string x = px(across.place(columns[i]));
    svg.leaf("line", {{"x1", x}, {"x2", x}, {"y1", px(up.from)}, {"y2", px(up.to)}, {"stroke", "#eceef0"}});
    svg.text("text", {{"x", x}, {"y", px(up.from + 16)}, {"text-anchor", "middle"}, {"fill", pale_ink}},
             column_texts[i]);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string y = px(up.place(rows[i]));
    svg.leaf("line", {{"x1", px(across.from)}, {"x2", px(across.to)}, {"y1", y}, {"y2", y}, {"stroke", "#eceef0"}});
    svg.text("text",
             {{"x", px(across.from - 6)}, {"y", px(up.place(rows[i]) + 4)}, {"text-anchor", "end"}, {"fill", pale_ink}},
             row_texts[i]);
  }
  svg.text(
      "text",
      {{"x", px(0.5 * (across.from + across.to))}, {"y", px(up.from + 34)}, {"text-anchor", "middle"}, {"fill", ink}},
      across_name);
  svg.text("text", {{"x", px(across.from)}, {"y", px(up.to - 7)}, {"fill", ink}}, up_name);
}

/// Arrows of one length for the direction at each place, in the scale of the picture.
void draw_field(SvgWriter& svg, const ExpressionSystem& system, const Axis& across, const Axis& up) {
  constexpr int columns = 17, rows = 15;
  constexpr double half = 9;  // px
  const FirstOrder rates = rates_of(system);
  std::vector<double> state = system.start, speeds(state.size());
  const auto scale = [](const Axis& axis) { return (axis.to - axis.from) / (axis.high - axis.low); };
  std::string ways;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double x = across.from + (across.to - across.from) * (column + 0.5) / columns;
      const double y = up.from + (up.to - up.from) * (row + 0.5) / rows;
      const double there = across.low + (across.high - across.low) * (column + 0.5) / columns;
      const double time = system.across == 0 ? there : 0;
      if (system.across > 0) state[system.across - 1] = there;
      state[system.up - 1] = up.low + (up.high - up.low) * (row + 0.5) / rows;
      rates(time, state, speeds);
      const double right = scale(across) * (system.across == 0 ? 1 : speeds[system.across - 1]),
                   down = scale(up) * speeds[system.up - 1];
      const double length = std::sqrt(right * right + down * down);
      if (!(length > 0) || !std::isfinite(length)) continue;
      const double dx = half * right / length, dy = half * down / length;
      ways += (ways.empty() ? "M" : " M") + px(x - dx, y - dy) + " L" + px(x + dx, y + dy) + " M" +
              px(x + 0.45 * dx - 0.3 * dy, y + 0.45 * dy + 0.3 * dx) + " L" + px(x + dx, y + dy) + " L" +
              px(x + 0.45 * dx + 0.3 * dy, y + 0.45 * dy - 0.3 * dx);
    }
  svg.leaf("path", {{"d", ways}, {"fill", "none"}, {"stroke", arrow_color}, {"stroke-width", "1.1"}});
}

void draw_portrait(SvgWriter& svg, const ExpressionSystem& system, const FirstOrderPath& own, double left, double top) {
  std::vector<Places> others;
  Range across_range, up_range;
  const Places mine = portrait_of(system, own);
  for (const std::vector<double>& start : system.starts) others.push_back(portrait_of(system, path_of(system, start)));
  const auto take = [&](const Places& places) {
    for (const PortraitPoint& place : places) {
      across_range.take(place.across);
      up_range.take(place.up);
    }
  };
  take(mine);
  for (const Places& places : others) take(places);
  const Axis across = across_range.axis(left + portrait_left, left + portrait_width - 16);
  const Axis up = up_range.axis(top + portrait_height, top);
  draw_axes(svg, across, up, system.across == 0 ? "t, s" : system.variables[system.across - 1],
            system.variables[system.up - 1]);
  draw_field(svg, system, across, up);
  for (const Places& places : others) draw_way(svg, places, across, up, other_color, "1.1");
  draw_way(svg, mine, across, up, own_color, "1.8");
  if (!mine.empty())
    svg.leaf("circle", {{"cx", px(across.place(mine.front().across))},
                        {"cy", px(up.place(mine.front().up))},
                        {"r", "3.5"},
                        {"fill", own_color}});
}

void draw_energy(SvgWriter& svg, const ExpressionSystem& system, const FirstOrderPath& own, double left, double top) {
  const Places places = energy_of(system, own);
  Range times, energies;
  for (const PortraitPoint& place : places) {
    times.take(place.across);
    energies.take(place.up);
  }
  const Axis across = times.axis(left + portrait_left, left + energy_width - 16);
  const double low = energies.low, high = energies.high;
  // An almost constant energy is drawn almost flat, with its small range stated.
  constexpr double least = 0.02;
  const double middle = 0.5 * (low + high), half = 0.5 * least * std::abs(middle);
  if (high - low < 2 * half) {
    energies.take(middle - half);
    energies.take(middle + half);
  }
  const Axis up = energies.axis(top + portrait_height, top);
  draw_axes(svg, across, up, "t, s", places.empty() ? "energy" : "energy, within " + brief_text(high - low));
  draw_way(svg, places, across, up, own_color, "1.8");
}

}  // namespace
}  // namespace plotting

std::string portrait_svg(std::span<const ExpressionSystem> systems) {
  using namespace plotting;
  const bool energies = std::ranges::any_of(systems, [](const ExpressionSystem& system) { return !!system.energy; });
  constexpr double row = portrait_head + portrait_height + portrait_foot;
  SvgWriter svg(portrait_width + (energies ? energy_width : 0), row * static_cast<double>(systems.size()));
  svg.leaf("rect", {{"width", "100%"}, {"height", "100%"}, {"fill", "#f7f7f5"}});
  double top = 0;
  for (const ExpressionSystem& system : systems) {
    const FirstOrderPath own = path_of(system, system.start);
    svg.text("text", {{"x", "14"}, {"y", px(top + 24)}, {"font-size", "14"}, {"font-weight", "600"}, {"fill", ink}},
             system.name);
    const bool ended = own.times.back() + 1.5 * system.step < system.duration;
    svg.text("text", {{"x", "14"}, {"y", px(top + 41)}, {"fill", pale_ink}},
             brief_text(own.times.back()) + " s in steps of " + brief_text(system.step) + " s" +
                 (ended ? ", where it is no longer finite" : ""));
    draw_portrait(svg, system, own, 0, top + portrait_head);
    if (system.energy) draw_energy(svg, system, own, portrait_width, top + portrait_head);
    top += row;
  }
  return svg.finish();
}

}  // namespace tweenfall
