#pragma once

// One frame of a plot: axes with ticks, curves through points.

#include "plot/axis.h"
#include "plot/svg_writer.h"
#include "plot/track_values.h"

#include <cmath>
#include <string>
#include <vector>

namespace tweenfall::plotting {

/// Where labels of values stand, px.
constexpr double left_margin = 58;

/// Whether a panel shows the values of points or their rates.
enum class Shows { values, rates };

[[nodiscard]] const std::vector<double>& numbers(const TrackPoint& point, Shows shows);

/// Color of a component by its name.
[[nodiscard]] const char* component_color(const std::string& name);

struct Panel {
  Axis time, value;
  Shows shows = Shows::values;
  std::string title, unit;
  std::vector<std::string> names;                     ///< of the components
  double first_key = -HUGE_VAL, last_key = HUGE_VAL;  ///< s; beyond these the frame is shaded
};

/// Frame, ticks, title with unit, and the names of the components in their colors.
void draw_frame(SvgWriter& svg, const Panel& panel, bool time_labels);

/// A line through the points for each component.
void draw_curves(SvgWriter& svg, const Panel& panel, const std::vector<TrackPoint>& points, bool dashed);

}  // namespace tweenfall::plotting
