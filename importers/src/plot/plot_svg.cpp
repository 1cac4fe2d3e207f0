#include <tweenfall/importers/plot.h>

#include <tweenfall/importers/number_text.h>
#include "plot/plot_panel.h"
#include "plot/plotted_track.h"
#include "recording/words.h"

#include <algorithm>
#include <cmath>

namespace tweenfall {

namespace {

constexpr double picture_width = 860, left = 58, right = 844;
constexpr double head = 34, title_room = 26, value_height = 150, rate_height = 90, between = 24, below = 28;

bool has_rates(const PlottedTrack& plotted) {
  return !rate_names(plotted.track->curve).empty();
}

double block_height(const PlottedTrack& plotted) {
  return title_room + value_height + (has_rates(plotted) ? between + rate_height : 0) + below;
}

Axis value_axis(const PlottedTrack& plotted, Shows shows, double top, double height) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  const auto take = [&](const std::vector<TrackPoint>& points) {
    for (const TrackPoint& point : points)
      for (const double number : numbers(point, shows)) {
        low = std::min(low, number);
        high = std::max(high, number);
      }
  };
  take(plotted.curve);
  for (const auto& points : plotted.simulated) take(points);
  if (low > high) low = high = 0;
  add_room(low, high);
  return {low, high, top + height, top};
}

/// Dots at the keys, and the slopes with which the curve arrives and leaves.
void draw_keys(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted) {
  constexpr double handle = 20;  // px
  const double across = (panel.time.to - panel.time.from) / (panel.time.high - panel.time.low);
  const double up = (panel.value.to - panel.value.from) / (panel.value.high - panel.value.low);
  const bool slopes = !std::holds_alternative<Curve<Quat>>(plotted.track->curve);
  for (const PlottedKey& key : plotted.keys) {
    for (std::size_t i = 0; i < panel.names.size(); ++i) {
      const double x = panel.time.place(key.time);
      for (const bool arrives : {true, false}) {
        const TrackPoint& side = arrives ? key.in : key.out;
        if (!slopes || i >= side.rates.size() || (arrives ? key.first : key.last)) continue;
        const Vec2 way(across, up * side.rates[i]);
        const Vec2 tip = way * ((arrives ? -handle : handle) / way.norm());
        const double y = panel.value.place(side.values[i]);
        svg.leaf("path", {{"class", "tangent"},
                          {"d", "M" + px(x) + " " + px(y) + "l" + px(tip.x()) + " " + px(tip.y())},
                          {"stroke", "#8b9098"}});
        svg.leaf(
            "circle",
            {{"class", "handle"}, {"cx", px(x + tip.x())}, {"cy", px(y + tip.y())}, {"r", "2"}, {"fill", "#8b9098"}});
      }
      const double y = panel.value.place(key.out.values[i]);
      svg.leaf("path", {{"class", "key"},
                        {"d", "M" + px(x) + " " + px(y - 3.5) + "l3.5 3.5l-3.5 3.5l-3.5 -3.5Z"},
                        {"fill", component_color(panel.names[i])}});
    }
  }
}

void draw_moments(SvgWriter& svg, const Panel& panel, const PlottedTrack& plotted, bool named) {
  for (const PlottedMoment& moment : plotted.moments) {
    const double x = panel.time.place(moment.time);
    svg.leaf("path", {{"class", moment.handoff ? "handoff" : "event"},
                      {"d", "M" + px(x) + " " + px(panel.value.from) + "V" + px(panel.value.to)},
                      {"stroke", moment.handoff ? "#d97a00" : "#8b9098"},
                      {"stroke-width", moment.handoff ? "1.8" : "1"},
                      {"stroke-dasharray", moment.handoff ? "none" : "2 3"}});
    if (named)
      svg.text("text",
               {{"x", px(x + 4)},
                {"y", px(moment.handoff ? panel.value.to + 12 : panel.value.from - 5)},
                {"font-size", "10"},
                {"fill", moment.handoff ? "#a85f00" : "#6d7178"}},
               moment.name);
  }
}

void draw_texts(SvgWriter& svg, const Panel& panel, const StepCurve<std::string>& curve) {
  for (const auto& [time, text] : curve.steps())
    svg.text("text",
             {{"x", px(panel.time.place(time) + 4)},
              {"y", px((panel.value.from + panel.value.to) / 2)},
              {"fill", "#23262b"}},
             text);
}

void draw_block(SvgWriter& svg, const PlottedTrack& plotted, double from, double until, double top) {
  const Axis time{from, until, left, right};
  top += title_room;
  const Panel values{time, value_axis(plotted, Shows::values, top, value_height), Shows::values, plotted.title,
                     component_names(plotted.track->curve)};
  draw_frame(svg, values, !has_rates(plotted));
  draw_moments(svg, values, plotted, true);
  draw_curves(svg, values, plotted.curve, false);
  for (const auto& points : plotted.simulated) draw_curves(svg, values, points, true);
  draw_keys(svg, values, plotted);
  if (const auto* texts = std::get_if<StepCurve<std::string>>(&plotted.track->curve)) draw_texts(svg, values, *texts);
  if (!has_rates(plotted)) return;
  top += value_height + between;
  const bool turns = std::holds_alternative<Curve<Quat>>(plotted.track->curve);
  const Panel rates{time, value_axis(plotted, Shows::rates, top, rate_height), Shows::rates,
                    turns ? "angular velocity, rad/s" : "rate, per second", rate_names(plotted.track->curve)};
  draw_frame(svg, rates, true);
  draw_moments(svg, rates, plotted, false);
  draw_curves(svg, rates, plotted.curve, false);
  for (const auto& points : plotted.simulated) draw_curves(svg, rates, points, true);
}

}  // namespace

std::string plot_svg(const StageDescription& stage, const Recording* recording, const PlotOptions& options) {
  const PlottedStage plotted = plotted_tracks(stage, recording, options);
  double height = head + 8;
  for (const PlottedTrack& track : plotted.tracks) height += block_height(track);
  SvgWriter svg(picture_width, height);
  svg.leaf("rect", {{"width", "100%"}, {"height", "100%"}, {"fill", "#f7f7f5"}});
  svg.text("text", {{"x", "14"}, {"y", "23"}, {"font-size", "14"}, {"font-weight", "600"}, {"fill", "#23262b"}},
           stage.name.empty() ? "tracks" : stage.name);
  double top = head;
  for (const PlottedTrack& track : plotted.tracks) {
    draw_block(svg, track, plotted.from, plotted.until, top);
    top += block_height(track);
  }
  return svg.finish();
}

}  // namespace tweenfall
