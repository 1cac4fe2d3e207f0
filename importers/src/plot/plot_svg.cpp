#include <tweenfall/importers/plot.h>

#include "plot/plot_marks.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace tweenfall {

namespace plotting {
namespace {

constexpr double right_margin = 16;
constexpr double head = 52, title_room = 26, value_height = 150, rate_height = 90, between = 24, below = 28, foot = 8;

/// Width of a column for a number of columns, px.
double column_width(int columns) {
  return columns == 1 ? 860 : columns == 2 ? 480 : 350;
}

bool has_rates(const PlottedTrack& plotted, const PlotOptions& options) {
  return options.rates && !plotted.rate_names.empty();
}

double block_height(const PlottedTrack& plotted, const PlotOptions& options) {
  return title_room + value_height + (has_rates(plotted, options) ? between + rate_height : 0) + below;
}

Axis value_axis(const PlottedTrack& plotted, Shows shows, double top, double height) {
  double low = HUGE_VAL, high = -HUGE_VAL;
  const auto take = [&](const std::vector<TrackPoint>& points) {
    for (const TrackPoint& point : points)
      for (const double number : numbers(point, shows)) {
        if (std::isnan(number)) continue;
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

std::string unit_text(const std::string& unit, bool lacks_some) {
  const std::string left_out = lacks_some ? "beyond 1e300 not drawn" : "";
  return unit + (unit.empty() || left_out.empty() ? "" : "; ") + left_out;
}

void draw_block(SvgWriter& svg, const PlottedTrack& plotted, const PlotOptions& options, Axis time, double top) {
  top += title_room;
  const Panel values{time,
                     value_axis(plotted, Shows::values, top, value_height),
                     Shows::values,
                     plotted.title,
                     unit_text(plotted.unit, plotted.lacks_values),
                     plotted.names,
                     plotted.first_key,
                     plotted.last_key};
  draw_frame(svg, values, !has_rates(plotted, options));
  if (std::holds_alternative<Curve<Color>>(plotted.track->curve)) draw_colors(svg, values, plotted);
  draw_moments(svg, values, plotted);
  // Names are drawn below the curves, so that they do not hide them.
  draw_moment_names(svg, values, plotted);
  draw_curves(svg, values, plotted.curve, false);
  for (const auto& points : plotted.simulated) draw_curves(svg, values, points, true);
  draw_keys(svg, values, plotted);
  if (const auto* texts = std::get_if<StepCurve<std::string>>(&plotted.track->curve)) draw_texts(svg, values, *texts);
  if (!has_rates(plotted, options)) return;
  top += value_height + between;
  const bool turns = std::holds_alternative<Curve<Quat>>(plotted.track->curve);
  const Panel rates{time,
                    value_axis(plotted, Shows::rates, top, rate_height),
                    Shows::rates,
                    turns ? "angular velocity" : "rate",
                    unit_text(plotted.rate_unit.empty() ? "per second" : plotted.rate_unit, plotted.lacks_rates),
                    plotted.rate_names,
                    plotted.first_key,
                    plotted.last_key};
  draw_frame(svg, rates, true);
  draw_moments(svg, rates, plotted);
  draw_curves(svg, rates, plotted.curve, false);
  for (const auto& points : plotted.simulated) draw_curves(svg, rates, points, true);
}

}  // namespace
}  // namespace plotting

std::string plot_svg(const StageDescription& stage, const Recording* recording, const PlotOptions& options) {
  if (options.columns < 1 || options.columns > 6)
    throw std::invalid_argument("a plot has 1 to 6 columns; found " + std::to_string(options.columns));
  const plotting::PlottedStage plotted = plotting::plotted_tracks(stage, recording, options);
  const std::size_t columns =
      std::clamp(plotted.tracks.size(), std::size_t{1}, static_cast<std::size_t>(options.columns));
  const double width = plotting::column_width(static_cast<int>(columns));
  std::vector<double> tops = {plotting::head};  // of the rows, then of the legend
  for (std::size_t i = 0; i < plotted.tracks.size(); i += columns) {
    double height = 0;
    for (std::size_t k = i; k < std::min(i + columns, plotted.tracks.size()); ++k)
      height = std::max(height, plotting::block_height(plotted.tracks[k], options));
    tops.push_back(tops.back() + height);
  }
  plotting::SvgWriter svg(width * static_cast<double>(columns),
                          tops.back() + plotting::foot + (plotted.left_out > 0 ? 18 : 0));
  svg.leaf("rect", {{"width", "100%"}, {"height", "100%"}, {"fill", "#f7f7f5"}});
  svg.text("text", {{"x", "14"}, {"y", "23"}, {"font-size", "14"}, {"font-weight", "600"}, {"fill", "#23262b"}},
           stage.name.empty() ? "tracks" : stage.name);
  if (plotted.tracks.empty())
    svg.text("text", {{"x", "14"}, {"y", "42"}, {"fill", "#6d7178"}}, "no tracks");
  else
    plotting::draw_legend(svg, plotted, 14, 42);
  for (std::size_t i = 0; i < plotted.tracks.size(); ++i) {
    const double left = width * static_cast<double>(i % columns);
    plotting::draw_block(
        svg, plotted.tracks[i], options,
        {plotted.from, plotted.until, left + plotting::left_margin, left + width - plotting::right_margin},
        tops[i / columns]);
  }
  if (plotted.left_out > 0)
    svg.text("text", {{"x", "14"}, {"y", plotting::px(tops.back() + 10)}, {"fill", "#6d7178"}},
             "and " + std::to_string(plotted.left_out) + " more, which are drawn where they are named");
  return svg.finish();
}

}  // namespace tweenfall
